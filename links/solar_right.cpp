// Makes the volumes that take most sun from a receiver give way, as long as the receiver has less sun than it needs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/base/direction.h"
#include "core/base/text.h"
#include "core/define/last_proposals.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"
#include "core/demand/shared_storeys.h"
#include "core/sun/loss_table.h"

namespace bl {

namespace {

struct SolarRight {
  enum class Mode { lower, move, shave };
  struct In {
    Mode mode = Mode::shave;
    double gain = 0.2, tolerance = 0.02, play = 0.125, storey_room = 0.5, least = 0.2;
  };
  struct Ends {
    std::string receiver;
    Point3 place;
    double deficit = 0, required = 0, possible = 0, least = 0;
    Shared<Table> losses;
    std::vector<std::string> held_back;
    All<std::string> ids;
    All<Point3> positions;
    All<double> demands, limits, wanted, volumes, radii, footprints, bottoms;
    All<double> storey_heights;
    All<std::optional<int>> built, wished, least_storeys;
    All<std::optional<double>> height_limits;
    All<bool> are_limits_locked, are_positions_locked;
    All<std::optional<bool>> are_heights_locked;
    All<std::optional<Shared<Table>>> buildings;
  };
  struct Out {
    All<std::optional<Vector3>> moves;
    All<std::optional<double>> limits, height_limits;
    std::optional<std::vector<std::string>> held_back;
  };

  static void declare(LinkBuilder<SolarRight>& l) {
    l.id("solar_right")
        .label("Solar right")
        .doc(
            "Protects the sun that a receiver needs. While it has less, the volumes that shade it give way, each in proportion "
            "to the sun that it would bring back. A volume that would bring next to nothing, because it is far or because "
            "others shade the same place, is not limited. A volume that stands loses storeys: "
            "its height limit falls by a tenth of a storey in a tick, and its footprint grows.");
    l.family(LinkFamily::sun);
    l.param(&In::mode, "mode",
            {{Mode::lower, "lower", "The volume's position sinks to the foot of its shape at most; the volume gets wider."},
             {Mode::move, "move", "The volume moves away in plan."},
             {Mode::shave, "shave", "The volume's demand limit falls until the receiver has its sun; then it may rise again."}})
        .doc("How a volume gives way. One that stands loses storeys in the modes `lower` and `shave`, and keeps its demand.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc("Gain: how strongly a volume gives way to missing sun in one tick, as a share of its radius, height or demand.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .soft(0.005, 0.1)
        .doc("The sun that may be missing as the mean over the points that count, as a share of the required sun.");
    l.param(&In::play, "play")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("How much more may be missing before volumes are shaved, as a share of the tolerance.");
    l.param(&In::storey_room, "storey_room")
        .unit(Unit::ratio)
        .range(0, 10)
        .soft(0, 2)
        .doc(
            "A storey comes back when the worst point of the receiver, within its required share, has this share of the required "
            "sun beyond it. Smaller than what a storey takes, storeys would come and go.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc(
            "Share of a demand, or of wished storeys, that is never taken away. If that is not enough, the link reports that the "
            "rule is not met.");
    read_ends(l);
    l.proposes(&Out::moves, End::to, "node.position", Unit::metre);
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes_if_there(&Out::height_limits, End::to, "footprint.height_limit", Unit::metre);
    l.proposes(&Out::held_back, End::from, "shadow_receiver.held_back");
  }

  static void read_ends(LinkBuilder<SolarRight>& l) {
    l.reads(&Ends::receiver, End::from, "node.id").reads(&Ends::place, End::from, "node.position", Unit::metre);
    l.reads(&Ends::deficit, End::from, "shadow_receiver.deficit", Unit::second);
    l.reads(&Ends::required, End::from, "shadow_receiver.required_sun", Unit::second);
    l.reads(&Ends::possible, End::from, "shadow_receiver.sun_possible", Unit::second);
    l.reads(&Ends::least, End::from, "shadow_receiver.sun_of_share", Unit::second);
    l.reads(&Ends::losses, End::from, "shadow_receiver.losses").reads(&Ends::held_back, End::from, "shadow_receiver.held_back");
    l.reads(&Ends::ids, End::to, "node.id").reads(&Ends::positions, End::to, "node.position", Unit::metre);
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volumes, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads(&Ends::radii, End::to, "smart_volume.radius", Unit::metre)
        .reads(&Ends::bottoms, End::to, "smart_volume.bottom", Unit::metre);
    l.reads(&Ends::footprints, End::to, "smart_volume.footprint", Unit::square_metre);
    l.reads(&Ends::storey_heights, End::to, "smart_volume.storey_height", Unit::metre);
    l.reads_if_there(&Ends::built, End::to, "footprint.storeys_held").reads_if_there(&Ends::wished, End::to, "footprint.storeys");
    l.reads_if_there(&Ends::least_storeys, End::to, "footprint.storeys_min");
    l.reads_if_there(&Ends::height_limits, End::to, "footprint.height_limit", Unit::metre);
    l.reads_lock(&Ends::are_limits_locked, End::to, "smart_volume.demand_limit");
    l.reads_lock(&Ends::are_positions_locked, End::to, "node.position");
    l.reads_lock_if_there(&Ends::are_heights_locked, End::to, "footprint.height_limit");
    l.reads_if_there(&Ends::buildings, End::to, "footprint.building");
  }

  static std::optional<demand::Building> building_of(const Ends& ends, std::size_t i) {
    return demand::building_in(ends.buildings.values[i]);
  }

  // As one that stands and loses storeys; nothing for a rounded volume, and in the mode `move`.
  static std::optional<demand::StandingVolume> standing(const In& in, const Ends& ends, std::size_t i) {
    if (in.mode == Mode::move || !ends.built.values[i]) return std::nullopt;
    return demand::standing_in({*ends.built.values[i], *ends.wished.values[i], *ends.least_storeys.values[i],
                                ends.storey_heights.values[i], *ends.height_limits.values[i], *ends.are_heights_locked.values[i]},
                               building_of(ends, i));
  }

  // Weights of volumes that stand may be below 0, and who shares a footprint has none.
  static double radius_of(const Ends& ends, std::size_t i) {
    if (!ends.built.values[i]) return ends.radii.values[i];
    return std::sqrt(std::max(0.0, ends.footprints.values[i]) / std::numbers::pi);
  }

  // Of who shares the footprint of another, and moves with that one alone.
  static std::string why_it_stays(const Ends& ends, std::size_t i) {
    return demand::why_it_stays(building_of(ends, i), ends.ids.values[i]);
  }

  static constexpr double kLittle = 0.05;  // of what the worst one takes; of a radius that is left to sink
  static constexpr double kSeen = 18;      // [s] that a sentence shows: 0.01 h
  static std::string hours(double seconds) { return fixed(seconds / 3600, 2) + " h"; }

  // The sun missing beyond the tolerance, as a share of the required sun. Sun that no caster takes is not counted.
  static double shortage(const In& in, const Ends& ends) {
    const double unavoidable = std::max(0.0, ends.required - ends.possible);
    return std::clamp((ends.deficit - unavoidable) / ends.required, 0.0, 1.0) - in.tolerance;
  }

  // What the worst point of the required share has beyond its need, as a share of the need.
  static double surplus_of(const Ends& ends) { return std::max(0.0, (ends.least - ends.required) / ends.required); }

  // Direction in plan away from the receiver. Where both lie on one point, their ids give the direction.
  static Vector3 away(const Ends& ends, std::size_t i) {
    const Point3& position = ends.positions.values[i];
    const Vector3 between{position.x - ends.place.x, position.y - ends.place.y, 0};
    const double length = norm(between);
    return length > 0 ? between / length : direction_by_name(ends.receiver, ends.ids.values[i]);
  }

  static double fall_left(const Ends& ends, std::size_t i) {
    return std::max(0.0, ends.positions.values[i].z - ends.bottoms.values[i]);
  }

  // Who takes the sun besides. Whoever cannot give way, as a building that stands already, is no advice.
  static std::string others_of(const Ends& ends) {
    const std::vector<std::string> others = sun::other_takers(*ends.losses, ends.ids.values);
    if (others.empty()) return "";
    constexpr std::size_t kMost = 3;
    std::string text;
    for (std::size_t k = 0; k < std::min(kMost, others.size()); ++k) text += (k == 0 ? ": `" : ", `") + others[k] + "`";
    if (others.size() > kMost) text += " and " + std::to_string(others.size() - kMost) + " more";
    return text + (others.size() == 1 ? " takes it" : " take it") + ", which this link does not lead to";
  }

  // Why the volumes that take the sun cannot give way any further; empty while one of them can.
  static std::string why_held(const In& in, const Ends& ends, const std::vector<std::size_t>& all) {
    const demand::LimitedVolumes held{ends.ids.values,    ends.demands.values, ends.limits.values,
                                      ends.wanted.values, ends.volumes.values, ends.are_limits_locked.values};
    const std::string advice = "; lower `required_sun`";
    if (all.empty()) return "no volume at the end of this link brings it more" + others_of(ends) + advice;
    std::string holders;
    const auto add = [&](const std::string& holder) { holders += (holders.empty() ? "" : ", ") + holder; };
    std::vector<std::size_t> who;
    std::string ways;
    for (const std::size_t i : all) {
      const auto volume = standing(in, ends, i);
      if (!volume) {
        who.push_back(i);
      } else if (demand::is_at_least(*volume, in.least)) {
        add(demand::held_at_least(demand::holder_of(building_of(ends, i), ends.ids.values[i]), *volume, in.least));
        const std::string way = demand::way_to_fewer(*volume, in.least);
        if (ways.find(way) == std::string::npos) ways += ", " + way;
      } else {
        return "";
      }
    }
    if (who.empty()) return holders + advice + ways + ", or move the volume";
    if (in.mode == Mode::shave && !is_exhausted(held, who, in.least)) return "";
    if (in.mode == Mode::shave) {
      add(held_by(held, who, in.least));
      return holders + advice + " or `least`," + unlocking(held, who, in.least) + " or move the volume";
    }
    for (const std::size_t i : who) {
      const bool is_locked = ends.are_positions_locked.values[i];
      if (const std::string stays = why_it_stays(ends, i); !stays.empty()) {
        add(stays);
        continue;
      }
      if (!is_locked && (in.mode == Mode::move || fall_left(ends, i) > kLittle * radius_of(ends, i))) return "";
      add((i == who.front() ? "held by `" : "`") + ends.ids.values[i] +
          (is_locked ? "` (its position is locked)" : "` (it has sunk as far as it can)"));
    }
    return holders + advice + ", or let them be shaved";
  }

  // Reports missing sun: as being worked on, or as unmet where the volumes cannot give way any further.
  static void tell(const In& in, const Ends& ends, const std::vector<double>& shares, const Tick& tick) {
    std::vector<std::size_t> who;
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (shares[i] > kLittle) who.push_back(i);
    const std::string found = "`" + ends.receiver + "` is short of " + hours(ends.deficit) + " of sun";
    const std::string held_up = why_held(in, ends, who);
    const std::string possible =
        " and can have " + hours(ends.required - ends.deficit) + " of the " + hours(ends.required) + ", ";
    const std::string said = held_up.empty() ? found : "cannot be met: " + found + possible + held_up;
    remark(tick, held_up.empty() ? LinkRemark::at_work : LinkRemark::unmet, {ErrorCode::infeasible, "from", said});
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    Out out;
    if (!(ends.required > 0)) return out;
    const std::vector<double> shares = sun::loss_shares(*ends.losses, ends.ids.values);
    out.moves.values.resize(shares.size());
    out.limits.values.resize(shares.size());
    out.height_limits.values.resize(shares.size());
    std::string lost;
    std::vector<std::string> held_back;
    const double missing = shortage(in, ends);
    const bool is_kept = missing <= in.play * in.tolerance;
    if (!is_kept) tell(in, ends, shares, tick);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (ends.ids.values[i] == ends.receiver) continue;
      const double answer = in.gain * std::max(0.0, missing) * shares[i];
      if (const auto volume = standing(in, ends, i)) {
        const auto own = own_height(ends, i, volume->limit, tick);
        const auto limit = height_of(in, ends, *volume, own, is_kept, shares[i]);
        const std::string who = demand::named_holder(building_of(ends, i), ends.ids.values[i]);
        if (own && limit && volume->built < volume->wished && demand::is_in_force(*volume, *own) &&
            demand::takes_storeys(*volume, *limit) && lost.find(who) == std::string::npos)
          lost += (lost.empty() ? "" : ", ") + who + " has " + demand::storeys_left(*volume, *limit);
        out.height_limits.values[i] = limit;
        if (limit) held_back.push_back(ends.ids.values[i]);
        continue;
      }
      if (in.mode == Mode::lower) {
        if (const double fall = answer * fall_left(ends, i); fall > 0) out.moves.values[i] = Vector3{0, 0, -fall};
      } else if (in.mode == Mode::move) {
        const double way = answer * radius_of(ends, i);
        if (way > 0 && why_it_stays(ends, i).empty()) out.moves.values[i] = away(ends, i) * way;
      } else {
        const auto own = own_word(tick, "smart_volume.demand_limit", i, ends.limits.values[i]);
        out.limits.values[i] = limit_of(in, ends, i, own, missing, is_kept ? 0 : answer, shares[i]);
      }
    }
    if (const double beyond = ends.required - ends.possible; is_kept && ends.deficit > 0 && beyond > in.tolerance * ends.required)
      remark(tick, LinkRemark::unmet,
             {ErrorCode::infeasible, "from",
              "cannot be met: `" + ends.receiver + "` can have " + hours(ends.possible) + " of its " + hours(ends.required) +
                  " of sun where nobody takes any; lower `required_sun`, or choose another period at the sun"});
    if (!held_back.empty()) out.held_back = std::move(held_back);
    if (is_kept && !lost.empty())
      remark(tick, LinkRemark::short_of, {ErrorCode::infeasible, "to", lost + ", " + what_for(in, ends)});
    return out;
  }

  // What lost storeys bring: all of the sun, or all but what the tolerance lets it lack.
  static std::string what_for(const In& in, const Ends& ends) {
    if (ends.deficit < kSeen) return "so that `" + ends.receiver + "` keeps its sun";
    return "for the sun of `" + ends.receiver + "`, which lacks " + hours(ends.deficit) + " of its " + hours(ends.required) +
           " nevertheless: `tolerance` and `play` let it lack " + hours((1 + in.play) * in.tolerance * ends.required) +
           " in the mean of its points";
  }

  // What the link holds for this receiver: of several receivers the tightest word counts, and one that has taken nothing would
  // hold on what another lets go.
  static std::optional<double> own_height(const Ends& ends, std::size_t i, double in_force, const Tick& tick) {
    const auto own = own_word(tick, "footprint.height_limit", i, in_force);
    const bool is_its_own = !has_last_word(tick) ||
                            std::find(ends.held_back.begin(), ends.held_back.end(), ends.ids.values[i]) != ends.held_back.end();
    return is_its_own ? own : std::nullopt;
  }

  // Nobody knows beforehand how much sun a storey takes: it comes back only where there is much more than enough. The limit falls
  // from the one in force, whoever holds it, but what is kept or rises is the link's own word alone.
  static std::optional<double> height_of(const In& in, const Ends& ends, demand::StandingVolume volume,
                                         const std::optional<double>& own, bool is_kept, double share) {
    if (!is_kept && share > kLittle) return demand::lower_limit(volume, share * demand::kStoreyPace, in.least);
    if (!own) return std::nullopt;
    volume.limit = *own;
    return is_kept && surplus_of(ends) > in.storey_room ? demand::higher_limit(volume) : demand::kept_limit(volume);
  }

  // The limit stays as it is from half the tolerance to a little beyond it, or the last moments of sun would be shaved off
  // without end. A volume that takes little may grow nevertheless. Limits that others set are not held: only where the link
  // tightens does it begin from the one in force.
  static std::optional<double> limit_of(const In& in, const Ends& ends, std::size_t i, const std::optional<double>& own,
                                        double missing, double answer, double share) {
    const double room = std::max({0.0, -missing - 0.5 * in.tolerance, std::min(1.0, surplus_of(ends)), 1 - share / kLittle});
    const double demand = ends.demands.values[i], in_force = demand::granted_share(demand, ends.limits.values[i]);
    const double held = own ? demand::granted_share(demand, *own) : 1;
    const double from = answer > 0 ? std::min(held, in_force) : held;
    return demand::limit_that_grants(demand, std::max(in.least, from * (1 - answer) * (1 + in.gain * room)));
  }
};

}  // namespace

}  // namespace bl

BL_LINK(solar_right, SolarRight)
