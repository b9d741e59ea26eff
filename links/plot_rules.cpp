// Holds volumes to the rules of the plot that they stand on, by limiting their demands.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/last_proposals.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"
#include "core/demand/shared_storeys.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/plot_measure.h"

namespace bl {

namespace {

struct PlotRules {
  struct In {
    bool hold_fsi = true, hold_gsi = true, hold_height = true, hold_setback = true;
    double gain = 0.2, tolerance = 0.01, least = 0.2;
  };
  struct Ends {
    std::vector<Point3> polygon;
    double ground = 0, fsi = 0, fsi_max = 0, gsi = 0, gsi_max = 0, height_max = 0, setback = 0;
    All<std::string> ids;
    All<Point3> centroids;
    All<double> demands, limits, wanted, volumes, bottoms, heights;
    All<bool> locked;
    All<double> storey_heights;
    All<std::optional<int>> built, wished, least_storeys;
    All<std::optional<double>> height_limits;
    All<std::optional<bool>> heights_locked;
    All<std::optional<Shared<Table>>> buildings;
    All<std::optional<Point3>> places;
    All<std::optional<double>> footings;
    All<std::string> stands_on;
  };
  struct Out {
    All<std::optional<double>> limits, height_limits, border_distances, street_distances;
  };

  static void declare(LinkBuilder<PlotRules>& l) {
    l.id("plot_rules")
        .label("Plot rules")
        .doc(
            "Limits the demands of the volumes on a plot until its rules are kept. FSI and GSI limit all volumes in one "
            "proportion; a volume above the largest height is limited by itself. When there is room again, the limits rise in "
            "the same way, up to what each volume wants. Just below the allowed figure they stay as they are. Volumes that stand "
            "keep the largest height by fewer storeys, and their demands for it.");
    l.family(LinkFamily::ground);
    l.param(&In::hold_fsi, "hold_fsi").doc("When on, floor area beyond the largest FSI limits all volumes on the plot.");
    l.param(&In::hold_gsi, "hold_gsi").doc("When on, built ground beyond the largest GSI limits all volumes on the plot.");
    l.param(&In::hold_height, "hold_height")
        .doc("When on, a volume that reaches beyond the largest height is limited by itself: one that stands in its storeys.");
    l.param(&In::hold_setback, "hold_setback")
        .doc(
            "When on, volumes that stand keep the setback of the plot from the border of their boundary, in all storeys. Where "
            "the plot has sides inside the boundary, they may still reach over these. Ground that the boundary leaves out is no "
            "border: `exclusion_distance` of a footprint keeps from it.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc(
            "Gain: how strongly the limits change with an overshoot in one tick. Volumes follow some ticks later, so that large "
            "gains oscillate.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.0001, 0.5)
        .soft(0.005, 0.05)
        .doc(
            "Dead band: the limits stay as they are while a figure is below the allowed one by no more than this share of it. "
            "The band must be wider than the errors of volumes (the solver's tolerance), or the limits never settle.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc(
            "Share of a demand, or of wished storeys, that no rule takes away. Where that is not enough, the link reports that "
            "the "
            "rule cannot be met.");
    read_ends(l);
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes_if_there(&Out::height_limits, End::to, "footprint.height_limit", Unit::metre);
    l.proposes_if_there(&Out::border_distances, End::to, "footprint.border_distance", Unit::metre);
    l.proposes_if_there(&Out::street_distances, End::to, "footprint.street_distance", Unit::metre);
  }

  static void read_ends(LinkBuilder<PlotRules>& l) {
    l.reads(&Ends::polygon, End::from, "plot.polygon", Unit::metre);
    l.reads(&Ends::ground, End::from, "plot.ground", Unit::metre)
        .reads(&Ends::height_max, End::from, "plot.height_max", Unit::metre);
    l.reads(&Ends::fsi, End::from, "plot.fsi", Unit::ratio).reads(&Ends::fsi_max, End::from, "plot.fsi_max", Unit::ratio);
    l.reads(&Ends::gsi, End::from, "plot.gsi", Unit::ratio).reads(&Ends::gsi_max, End::from, "plot.gsi_max", Unit::ratio);
    l.reads(&Ends::setback, End::from, "plot.setback", Unit::metre);
    l.reads(&Ends::ids, End::to, "node.id").reads(&Ends::centroids, End::to, "smart_volume.centroid", Unit::metre);
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volumes, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads(&Ends::bottoms, End::to, "smart_volume.bottom", Unit::metre)
        .reads(&Ends::heights, End::to, "smart_volume.height", Unit::metre);
    l.reads_lock(&Ends::locked, End::to, "smart_volume.demand_limit");
    l.reads(&Ends::storey_heights, End::to, "smart_volume.storey_height", Unit::metre);
    l.reads_if_there(&Ends::built, End::to, "footprint.storeys_held").reads_if_there(&Ends::wished, End::to, "footprint.storeys");
    l.reads_if_there(&Ends::least_storeys, End::to, "footprint.storeys_min");
    l.reads_if_there(&Ends::height_limits, End::to, "footprint.height_limit", Unit::metre);
    l.reads_lock_if_there(&Ends::heights_locked, End::to, "footprint.height_limit");
    l.reads_if_there(&Ends::buildings, End::to, "footprint.building");
    l.reads_if_there(&Ends::places, End::to, "footprint.stands_at", Unit::metre);
    l.reads_if_there(&Ends::footings, End::to, "footprint.ground", Unit::metre);
    l.reads(&Ends::stands_on, End::to, "smart_volume.stands_on");
  }

  using Bases = std::vector<double>;  // of the volumes [m]
  static Bases height_bases(const Ends& ends) {
    std::vector<geometry::HeightBase> volumes;
    for (std::size_t i = 0; i < ends.ids.values.size(); ++i)
      volumes.push_back({ends.ids.values[i], ends.stands_on.values[i], ends.footings.values[i]});
    return geometry::height_bases(volumes, ends.ground);
  }

  // One that keeps the largest height by its storeys, or by those of the building that it shares.
  struct Standing : demand::StandingVolume {
    double height = 0;        // that it may have [m]
    std::string holder, who;  // by id, and in a sentence
  };
  // Nothing for a rounded volume.
  static std::optional<Standing> standing(const Ends& ends, const Bases& bases, std::size_t i) {
    if (!ends.built.values[i]) return std::nullopt;
    const auto building = demand::building_in(ends.buildings.values[i]);
    const demand::StandingVolume own{*ends.built.values[i],         *ends.wished.values[i],
                                     *ends.least_storeys.values[i], ends.storey_heights.values[i],
                                     *ends.height_limits.values[i], *ends.heights_locked.values[i]};
    return Standing{demand::standing_in(own, building),
                    ends.height_max + bases[i] - demand::ground_below(building, ends.bottoms.values[i]),
                    demand::holder_of(building, ends.ids.values[i]), demand::named_holder(building, ends.ids.values[i])};
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    Out out;
    out.limits.values.resize(ends.demands.values.size());
    out.height_limits.values.resize(ends.demands.values.size());
    out.border_distances.values.resize(ends.demands.values.size());
    if (ends.polygon.size() < 3) return out;
    const Bases bases = height_bases(ends);
    std::vector<std::size_t> on_plot;
    for (std::size_t i = 0; i < ends.demands.values.size(); ++i)
      if (geometry::ring_contains(ends.polygon, ends.places.values[i].value_or(ends.centroids.values[i]))) on_plot.push_back(i);
    const demand::LimitedVolumes held{ends.ids.values,    ends.demands.values, ends.limits.values,
                                      ends.wanted.values, ends.volumes.values, ends.locked.values};
    double room = 2;
    if (in.hold_fsi) room = std::min(room, demand::answer_within(ends.fsi_max, ends.fsi, in.tolerance));
    if (in.hold_gsi) room = std::min(room, demand::answer_within(ends.gsi_max, ends.gsi, in.tolerance, kLittleGround));
    const std::vector<double> own = own_limits(ends, tick);
    const demand::LimitedVolumes said{ends.ids.values,    ends.demands.values, own,
                                      ends.wanted.values, ends.volumes.values, ends.locked.values};
    double share = share_granted(said, on_plot);
    if (room < 1) share = std::min(share, share_granted(held, on_plot));
    for (const std::size_t i : on_plot) {
      // All volumes of the plot have the share of the least limited one, but for those that are too high.
      double limit = share * (1 + in.gain * (room - 1));
      const auto volume = standing(ends, bases, i);
      if (in.hold_height && volume) out.height_limits.values[i] = demand::limit_at(*volume, volume->height, in.least);
      else if (in.hold_height) limit = std::min(limit, height_share(in, ends, bases, i, own[i]));
      if (in.hold_setback && ends.setback > 0 && volume) out.border_distances.values[i] = ends.setback;
      out.limits.values[i] = demand::limit_that_grants(ends.demands.values[i], std::max(in.least, limit));
    }
    out.street_distances = out.border_distances;
    tell(in, ends, bases, held, on_plot, tick);
    return out;
  }

 private:
  // A share of the land. Where less of it is built on, the limits follow the difference to the aim as a share of this, not of the
  // small built area: small footprints come and go with the lowest part of a volume, faster than volumes can follow.
  static constexpr double kLittleGround = 0.1;

  // What the link has said itself; all of the demand where it has said nothing. It holds nothing that others limit: only where it
  // tightens does it begin from what is in force.
  static std::vector<double> own_limits(const Ends& ends, const Tick& tick) {
    std::vector<double> limits;
    for (std::size_t i = 0; i < ends.demands.values.size(); ++i)
      limits.push_back(own_word(tick, "smart_volume.demand_limit", i, ends.limits.values[i]).value_or(ends.demands.values[i]));
    return limits;
  }

  static double height_share(const In& in, const Ends& ends, const Bases& bases, std::size_t i, double own) {
    const double answer = demand::answer_within(ends.height_max, top(ends, bases, i), in.tolerance);
    const double limit = answer < 1 ? std::min(own, ends.limits.values[i]) : own;
    return demand::granted_share(ends.demands.values[i], limit) * (1 + in.gain * (answer - 1));
  }
  static double top(const Ends& ends, const Bases& bases, std::size_t i) {
    return ends.bottoms.values[i] + ends.heights.values[i] - bases[i];
  }

  static constexpr std::size_t kMostHeights = 4;

  // The broken rules as sentences, grouped by the volumes whose demands could correct them.
  struct Broken {
    std::vector<std::string> found;
    std::vector<std::size_t> who;
  };

  static std::string listed(const Broken& broken) {
    std::string text;
    for (std::size_t k = 0; k < std::min(kMostHeights, broken.found.size()); ++k) text += (k == 0 ? "" : ", ") + broken.found[k];
    if (broken.found.size() > kMostHeights) text += " and " + std::to_string(broken.found.size() - kMostHeights) + " more";
    return text;
  }

  static std::string joined(const std::string& a, const std::string& b, const char* with) {
    return a.empty() || b.empty() ? a + b : a + with + b;
  }

  // The rules that no limit can correct any more, with the volumes that hold them up; a volume that holds up both is named once.
  static std::string unmet(const demand::LimitedVolumes& held, const Broken& all, const Broken& heights, double least) {
    const std::string by = all.found.empty() ? "" : held_by(held, all.who, least);
    const std::string heights_by = heights.found.empty() ? "" : held_by(held, heights.who, least);
    if (by == heights_by || by.empty() || heights_by.empty())
      return joined(joined(listed(all), listed(heights), ", "), by.empty() ? heights_by : by, ", ");
    return listed(all) + ", " + by + "; " + listed(heights) + ", " + heights_by;
  }

  // Names the storeys that volumes that stand have given up for the largest height.
  static void tell_storeys(const In& in, const Ends& ends, const Bases& bases, const std::vector<std::size_t>& on_plot,
                           const Tick& tick) {
    std::string lost;
    std::vector<std::string> told;  // a building of several volumes is told once
    for (const std::size_t i : on_plot) {
      const auto volume = standing(ends, bases, i);
      // Another rule may leave less still: then it is not this one that takes the storeys.
      if (!in.hold_height || !volume || volume->built >= volume->wished || !demand::takes_storeys(*volume, volume->height) ||
          !demand::is_in_force(*volume, volume->height) || std::find(told.begin(), told.end(), volume->holder) != told.end())
        continue;
      told.push_back(volume->holder);
      lost += (lost.empty() ? "" : ", ") + volume->who + " has " + demand::storeys_left(*volume, volume->height);
    }
    if (!lost.empty()) remark(tick, LinkRemark::short_of, {ErrorCode::infeasible, "from", lost + " by the rules of the plot"});
  }

  // Reports every broken rule: as being worked on, or as unmet where the volumes cannot be limited further.
  static void tell(const In& in, const Ends& ends, const Bases& bases, const demand::LimitedVolumes& held,
                   const std::vector<std::size_t>& on_plot, const Tick& tick) {
    Broken all{{}, on_plot}, stuck, sinking;
    std::string low, ways;  // volumes that stand and can be no lower; what would let them
    if (in.hold_fsi && ends.fsi > ends.fsi_max) all.found.push_back("FSI " + demand::found_of_allowed(ends.fsi, ends.fsi_max, 2));
    if (in.hold_gsi && ends.gsi > ends.gsi_max) all.found.push_back("GSI " + demand::found_of_allowed(ends.gsi, ends.gsi_max, 2));
    for (const std::size_t i : on_plot)
      if (in.hold_height && ends.volumes.values[i] > 0 && top(ends, bases, i) > ends.height_max) {
        const std::string found = "height " + demand::found_of_allowed(top(ends, bases, i), ends.height_max, 1, " m") + " at `" +
                                  ends.ids.values[i] + "`";
        const auto volume = standing(ends, bases, i);
        if (volume && demand::is_at_least(*volume, in.least)) {
          low = joined(low, found + ", " + demand::held_at_least(volume->holder, *volume, in.least), "; ");
          ways = joined(ways, demand::way_to_fewer(*volume, in.least) + " of `" + volume->holder + "`", ", ");
          continue;
        }
        Broken& height = !volume && is_at_least(held, i, in.least) ? stuck : sinking;
        height.found.push_back(found);
        height.who.push_back(i);
      }
    tell_storeys(in, ends, bases, on_plot, tick);
    const Broken none;
    const bool is_all_stuck = is_exhausted(held, on_plot, in.least);
    const std::string found = joined(unmet(held, is_all_stuck ? all : none, stuck, in.least), low, "; ");
    const std::string work = joined(is_all_stuck ? "" : listed(all), listed(sinking), ", ");
    if (!found.empty()) {
      const std::string unlock = unlocking(held, is_all_stuck && !all.found.empty() ? on_plot : stuck.who, in.least);
      const bool is_by_demand = found != low;
      const std::string lower = joined(is_by_demand ? "lower what is insisted on or `least`" : "", ways, ", or ");
      remark(tick, LinkRemark::unmet,
             {ErrorCode::infeasible, "from", "cannot be met: " + found + "; loosen the rule," + unlock + " or " + lower});
    } else if (!work.empty()) {
      remark(tick, LinkRemark::at_work, {ErrorCode::infeasible, "from", work});
    }
  }
};

}  // namespace

}  // namespace bl

BL_LINK(plot_rules, PlotRules)
