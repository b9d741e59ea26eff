// The solver of standing volumes: in each tick it chooses whole storeys and adapts weights until floor areas are met.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/domain.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/standing_tick.h"

namespace bl {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;  // [rad]

struct StandingSolver {
  struct In {
    Selection members{{}, "footprint", {}}, boundary{{}, "boundary", {}};
    double tolerance = 0.005;
    int steps = 8;
  };
  struct Member {
    std::string id;
    Point3 position;
    double demand = 0, limit = 0, least = 0, storey_height = 0, weight = 0;
    std::string form;
    double angle = 0, aspect = 1, height_limit = 0, setback = 0, depth = 0, ground = 0;
    int storeys = 1, storeys_min = 1, full_storeys = 0, built = 0;
    bool has_party_walls = true, was_limited = false;
    std::vector<std::string> bases;
  };
  struct Plot {
    std::string id;
    std::shared_ptr<const geometry::Domain> domain;
  };
  struct Sets {
    Watched<Member> members;
    std::vector<Plot> plots;
  };
  struct Reply {
    double wanted = 0, weight = 0, radius = 0, volume = 0, cell_volume = 0, floor_area = 0, surface_area = 0, footprint = 0;
    double spherical_area = 0, height = 0, bottom = 0, error = 0;
    std::string state, reason, stands_on;
    Shared<Table> neighbours, plates;
    Point3 centroid;
    MeshPointer mesh;
    int storeys_built = 0;
    bool is_limited = false;
    double facade_area = 0, roof_area = 0, hang = 0, drop = 0;
  };
  struct Out {
    std::int64_t count = 0;
    double total_floor_area = 0, plot_area = 0, covered = 0, fsi = 0, gsi = 0, osr = 0, mean_storeys = 0, largest_error = 0;
    std::string worst, message;
    SomeReplies<Reply> replies;
  };
  struct Kept {
    geometry::StandingTick::Cache cache;
    std::vector<std::string> names;
    std::vector<geometry::StandingWish> wishes;
  };

  static void declare(TypificationBuilder<StandingSolver>& t) {
    t.id("standing_solver").label("Standing solver");
    t.column(CanvasColumn::second).icon(Icon::cycle);
    t.doc(
        "Divides the ground of a boundary among volumes that stand: whole storeys on footprints. In every tick it chooses "
        "storeys "
        "under all limits, and adapts weights until the plates of each volume add up to the floor area that it wants. Where a "
        "limit "
        "takes a storey away, the footprint grows. Those that stand on the roof of another divide that roof among themselves.");
    t.in(&In::members, "members").doc("The volumes with footprints that this solver takes care of.");
    t.in(&In::boundary, "boundary").doc("The boundary whose ground is divided. The selection must give exactly one node.");
    t.in(&In::steps, "steps").range(1, 60).soft(1, 20).doc("Steps of Newton's method in one tick, at most.");
    t.in(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(1e-9, 1)
        .soft(0.001, 0.1)
        .doc("The weights stay as they are while the error of every volume is within this share of what it wants.");
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of members that have a volume.");
    t.out(&Out::total_floor_area, "total_floor_area").shown_first().unit(Unit::square_metre).doc("Sum of all plates.");
    t.out(&Out::plot_area, "plot_area").unit(Unit::square_metre).doc("Area of the ground inside the boundary.");
    t.out(&Out::covered, "covered").unit(Unit::square_metre).doc("Sum of the footprints.");
    t.out(&Out::fsi, "fsi").shown_first().unit(Unit::ratio).doc("Floor space index: floor area / plot area.");
    t.out(&Out::gsi, "gsi").unit(Unit::ratio).doc("Ground space index: covered area / plot area.");
    t.out(&Out::osr, "osr").unit(Unit::ratio).doc("Open space ratio: open ground / floor area.");
    t.out(&Out::mean_storeys, "mean_storeys").unit(Unit::count).doc("Floor area / covered area.");
    t.out(&Out::largest_error, "largest_error")
        .means()
        .traced()
        .shown_first()
        .unit(Unit::ratio)
        .doc("Largest error of a member, as a share of what it wants.");
    t.out(&Out::worst, "worst").shown_first().doc("Id of the member with the largest error; empty where all are exact.");
    t.out(&Out::message, "message").doc("Why demands cannot be met, and by which volumes; empty where they can.");
    declare_sets(t);
  }

  static void declare_sets(TypificationBuilder<StandingSolver>& t) {
    t.set("boundary", &Sets::plots).reads(&Plot::id, "node.id").reads(&Plot::domain, "boundary.domain");
    auto set = t.set("members", &Sets::members, &Out::replies);
    set.reads(&Member::id, "node.id").reads(&Member::position, "node.position", Unit::metre);
    set.reads(&Member::demand, "smart_volume.demand").reads(&Member::limit, "smart_volume.demand_limit");
    set.reads(&Member::least, "smart_volume.demand_min").reads(&Member::storey_height, "smart_volume.storey_height");
    set.reads(&Member::weight, "smart_volume.weight").writes(&Reply::weight, "smart_volume.weight");
    set.reads(&Member::form, "footprint.form").reads(&Member::angle, "footprint.angle", Unit::degree);
    set.reads(&Member::aspect, "footprint.aspect").reads(&Member::height_limit, "footprint.height_limit");
    set.reads(&Member::setback, "footprint.setback").reads(&Member::depth, "footprint.depth");
    set.reads(&Member::storeys, "footprint.storeys").reads(&Member::storeys_min, "footprint.storeys_min");
    set.reads(&Member::full_storeys, "footprint.full_storeys").reads(&Member::has_party_walls, "footprint.party_walls");
    set.reads(&Member::bases, "footprint.bases").reads(&Member::ground, "footprint.ground", Unit::metre);
    set.reads(&Member::built, "footprint.storeys_built").writes(&Reply::storeys_built, "footprint.storeys_built");
    set.reads(&Member::was_limited, "footprint.is_limited").writes(&Reply::is_limited, "footprint.is_limited");
    set.writes(&Reply::wanted, "smart_volume.wanted").writes(&Reply::radius, "smart_volume.radius");
    set.writes(&Reply::volume, "smart_volume.volume").writes(&Reply::cell_volume, "smart_volume.cell_volume");
    set.writes(&Reply::floor_area, "smart_volume.floor_area").writes(&Reply::footprint, "smart_volume.footprint");
    set.writes(&Reply::surface_area, "smart_volume.surface_area").writes(&Reply::spherical_area, "smart_volume.spherical_area");
    set.writes(&Reply::height, "smart_volume.height").writes(&Reply::bottom, "smart_volume.bottom");
    set.writes(&Reply::error, "smart_volume.error").writes(&Reply::mesh, "smart_volume.mesh");
    set.writes(&Reply::state, "smart_volume.state").writes(&Reply::reason, "smart_volume.reason");
    set.writes(&Reply::centroid, "smart_volume.centroid").writes(&Reply::neighbours, "smart_volume.neighbours");
    set.writes(&Reply::stands_on, "smart_volume.stands_on").writes(&Reply::hang, "smart_volume.hang");
    set.writes(&Reply::drop, "smart_volume.drop").writes(&Reply::plates, "footprint.plates");
    set.writes(&Reply::facade_area, "footprint.facade_area").writes(&Reply::roof_area, "footprint.roof_area");
  }

  static geometry::FootprintForm form_of(const std::string& form) {
    return form == "round"  ? geometry::FootprintForm::round
           : form == "cell" ? geometry::FootprintForm::cell
                            : geometry::FootprintForm::block;
  }

  static geometry::StandingWish wish_of(const Member& m) {
    geometry::StandingWish wish;
    wish.site = {.site = {m.position, m.weight},
                 .form = form_of(m.form),
                 .angle = m.angle * kDegree,
                 .aspect = m.aspect,
                 .runs = {},
                 .storey_height = m.storey_height,
                 .depth = m.depth,
                 .has_party_walls = m.has_party_walls};
    wish.volume = std::max(std::min(m.demand, m.limit), m.least);
    wish.storeys = m.storeys;
    wish.least = m.storeys_min;
    wish.height_limit = m.height_limit;
    wish.built = m.built;
    wish.was_limited = m.was_limited;
    wish.setback = m.setback;
    wish.full_storeys = m.full_storeys;
    wish.ground = m.ground;
    return wish;
  }

  static double error_of(const geometry::StandingWish& wish, double volume) {
    return wish.volume > 0 ? std::abs(volume - wish.volume) / wish.volume : 0;
  }

  static std::string reason_of(const geometry::StandingWish& wish, const geometry::StandingResult& result,
                               std::span<const std::string> names) {
    if (!(wish.volume > 0)) return "wants nothing: raise its demand to give it a volume";
    if (result.state == geometry::SiteState::coincident) return "stands in the place of a heavier volume: move one of them";
    if (result.floor_area > 0) return "";
    if (wish.base >= 0)
      return "has no footprint: `" + names[static_cast<std::size_t>(wish.base)] +
             "`, on which it stands, its neighbours and its " + "set-back leave it no roof where it stands";
    return "has no footprint: its neighbours, its set-back and the plot leave it nothing where it stands";
  }

  static Reply reply_of(const geometry::StandingWish& wish, const geometry::StandingResult& result,
                        std::span<const std::string> names) {
    Table neighbours{{"node", "area"}, {}}, plates;
    for (const auto& [site, area] : result.walls) neighbours.rows.push_back({names[site], area});
    if (result.body) geometry::write_body(*result.body, plates);
    const double around = result.facade_area + result.roof_area + result.footprint;
    return {.wanted = wish.volume,
            .weight = result.weight,
            .radius = std::sqrt(std::max(0.0, result.weight)),
            .volume = result.volume,
            .cell_volume = result.volume,
            .floor_area = result.floor_area,
            .surface_area = around,
            .footprint = result.footprint,
            .spherical_area = result.free_facade_area,
            .height = result.height,
            .bottom = result.bottom,
            .error = error_of(wish, result.volume),
            .state = std::string(name_of(result.state)),
            .reason = reason_of(wish, result, names),
            .stands_on = !(result.floor_area > 0) ? ""
                         : wish.base < 0          ? "the ground"
                                                  : names[static_cast<std::size_t>(wish.base)],
            .neighbours = std::move(neighbours),
            .plates = std::move(plates),
            .centroid = result.centroid,
            .mesh = result.mesh,
            .storeys_built = result.storeys.count,
            .is_limited = result.storeys.is_limited,
            .facade_area = result.facade_area,
            .roof_area = result.roof_area};
  }

  // On whom each volume stands. Returns what is wrong with that, sentences after semicolons.
  static std::string find_bases(std::span<const Member> members, Kept& kept) {
    std::string words;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (members[i].bases.empty()) continue;
      const std::string& base = members[i].bases.front();
      const auto found = std::lower_bound(kept.names.begin(), kept.names.end(), base);
      const bool is_there = found != kept.names.end() && *found == base;
      if (is_there) kept.wishes[i].base = static_cast<std::int32_t>(found - kept.names.begin());
      else words += "; `" + kept.names[i] + "` stands on the ground, because `" + base + "` is no volume of this solver";
      if (members[i].bases.size() > 1)
        words += "; `" + kept.names[i] + "` stands on `" + base + "` alone of the " + std::to_string(members[i].bases.size()) +
                 " that its `bases` or links of the kind `stack` name";
    }
    return words;
  }

  // What is built otherwise than people have set it. Sentences after semicolons.
  static std::string find_other_storeys(const Kept& kept, std::span<const geometry::StandingResult> results, double top,
                                        double tolerance) {
    std::string words;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const geometry::StandingWish& wish = kept.wishes[i];
      if (!(wish.volume > 0)) continue;
      if (wish.storeys < wish.least)
        words += "; `" + kept.names[i] + "` has " + how_many(static_cast<std::size_t>(wish.least), "storey") +
                 ", the least that it may have, and not " + std::to_string(wish.storeys) +
                 ": lower `storeys_min`, or raise `storeys`";
      if (wish.base < 0 && results[i].bottom < wish.ground && results[i].body)
        words += "; `" + kept.names[i] + "` stands at " + fixed(results[i].bottom, 1) + " m and not at " + fixed(wish.ground, 1) +
                 " m, because the boundary leaves no storey above that";
      if (results[i].body && results[i].bottom + results[i].height > top + 1e-6)
        words += "; `" + kept.names[i] + "` reaches " + fixed(results[i].bottom + results[i].height, 1) +
                 " m, and the boundary " + fixed(top, 1) + " m: the least of its storeys need more height than there is";
      // On their way to what they want, volumes are smaller.
      if (!results[i].body || error_of(wish, results[i].volume) > tolerance) continue;
      int with_area = 0;
      for (const geometry::PlateStack& stack : results[i].body->stacks) with_area += stack.storeys;
      if (with_area < results[i].storeys.count)
        words += "; the set-back of `" + kept.names[i] + "` leaves nothing of its upper " +
                 how_many(static_cast<std::size_t>(results[i].storeys.count - with_area), "storey") +
                 ": lower it, or the number of storeys";
    }
    return words;
  }

  static void add_up(const Kept& kept, std::span<const geometry::StandingResult> results, Out& out) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      out.count += results[i].volume > 0 ? 1 : 0;
      out.total_floor_area += results[i].floor_area;
      out.covered += kept.wishes[i].base < 0 ? results[i].footprint : 0;
      const double error = error_of(kept.wishes[i], results[i].volume);
      if (error <= out.largest_error) continue;
      out.largest_error = error;
      out.worst = kept.names[i];
    }
    out.fsi = out.plot_area > 0 ? out.total_floor_area / out.plot_area : 0;
    out.gsi = out.plot_area > 0 ? out.covered / out.plot_area : 0;
    out.osr = out.total_floor_area > 0 ? (out.plot_area - out.covered) / out.total_floor_area : 0;
    out.mean_storeys = out.covered > 0 ? out.total_floor_area / out.covered : 0;
  }

  static Result<const geometry::Domain*> domain_of(const std::vector<Plot>& plots) {
    if (plots.size() == 1 && plots.front().domain) return plots.front().domain.get();
    if (plots.size() == 1)
      return Error{ErrorCode::missing, "boundary", "the boundary `" + plots.front().id + "` has no shape: see its own error"};
    return Error{ErrorCode::missing, "boundary",
                 plots.empty() ? "a boundary is needed and none was found: add one, or choose one here"
                               : std::to_string(plots.size()) + " boundaries were found: choose one of them here"};
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    const auto domain = domain_of(sets.plots);
    if (!domain) return domain.error();
    Out out;
    if (sets.members.all.empty()) return out;
    std::optional<Kept> own;
    Kept& kept = tick.memo != nullptr ? tick.memo->of<Kept>() : own.emplace();
    kept.names.clear();
    kept.wishes.clear();
    for (const Member& member : sets.members.all) {
      kept.names.push_back(member.id);
      kept.wishes.push_back(wish_of(member));
    }
    std::string words = find_bases(sets.members.all, kept);
    const geometry::StandingTick now{.steps = tick.is_recall ? 0 : in.steps, .tolerance = in.tolerance, .pool = tick.pool};
    const auto done = now.run(**domain, kept.wishes, kept.cache);
    if (!done) return Error{done.error().code, "members", done.error().message};
    std::vector<std::uint32_t>& answered = out.replies.members;
    std::set_union(done->differing.begin(), done->differing.end(), sets.members.changed.begin(), sets.members.changed.end(),
                   std::back_inserter(answered));
    if (sets.members.is_anew) {
      answered.clear();
      for (std::uint32_t i = 0; i < kept.names.size(); ++i) answered.push_back(i);
    }
    out.plot_area = kept.cache.plot_area;
    for (const std::uint32_t i : done->in_circles) {
      kept.wishes[i].base = geometry::StandingWish::kGround;
      words += "; `" + kept.names[i] +
               "` stands on the ground, because it would stand upon itself: change its `bases`, or the `stack` link to it";
    }
    words += find_other_storeys(kept, done->results, (*domain)->maximum.z, in.tolerance);
    add_up(kept, done->results, out);
    for (const std::uint32_t i : answered) out.replies.replies.push_back(reply_of(kept.wishes[i], done->results[i], kept.names));
    out.message = done->message;
    for (const auto& [base, text] : done->on_roofs) {
      const std::string& name = kept.names[static_cast<std::size_t>(base)];
      words += text.starts_with("has ") || text.starts_with("fills ")
                   ? "; `" + name + "` " + text + ", so that nothing stands on it"
                   : "; on the roof of `" + name + "` " + text;
    }
    out.message += words;
    for (std::size_t k = 0; k < done->losses.size() && k < 3; ++k)
      out.message += "; " + kept.names[done->losses[k].demand] + " has " + fixed(done->losses[k].had, 0) + " of " +
                     fixed(done->losses[k].wanted, 0) + " m²";
    if (out.message.starts_with("; ")) out.message.erase(0, 2);
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(standing_solver, StandingSolver)
