// The SmartVolumes solver: in each tick it adapts the weights of its members and computes their power cells.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/domain.h"
#include "core/geometry/fit_text.h"
#include "core/geometry/standing.h"
#include "core/geometry/volume_tick.h"

namespace bl {
namespace {

struct SmartVolumesSolver {
  using Method = geometry::FitMethod;
  // What the fit starts from in the next tick (FitState); the parts that belong to one member are kept there.
  struct Memory {
    double momentum = 1, residual = -1, share = 1, least_ratio = 0;
    std::string problem;
  };
  struct In {
    Selection members{{}, "smart_volume", {}}, boundary{{}, "boundary", {}};
    Method method = Method::newton;
    geometry::Metric metric = geometry::Metric::power;
    double gain = 0, tolerance = 0.005;
    int steps = 4, tessellation_depth = 1, resolution = 64;
    Memory last;
  };
  struct Member {
    std::string id;
    Point3 position;
    double demand = 0, limit = 0, least = 0, storey_height = 0, weight = 0, last_step = 0, last_direction = 0;
    double by_floor_area = 0, volume = 0, floor_area = 0;  // the last two as they came out of the last tick
    std::string standing;
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
    double wanted = 0, fitted = 0, weight = 0, radius = 0, volume = 0, cell_volume = 0, floor_area = 0, surface_area = 0;
    double footprint = 0, spherical_area = 0, height = 0, bottom = 0, error = 0, last_step = 0, last_direction = 0;
    std::string state, reason;
    Shared<Table> neighbours;
    Point3 centroid;
    MeshPointer mesh;
    double hang = 0, drop = 0;
    std::string stands_on = {};
  };
  struct Out {
    std::int64_t count = 0;
    double total_demand = 0, total_volume = 0, boundary_volume = 0, fill = 0, largest_error = 0, total_floor_area = 0;
    Memory memory;
    std::string worst, message;
    SomeReplies<Reply> replies;
  };

  static void declare(TypificationBuilder<SmartVolumesSolver>& t) {
    t.id("smart_volumes_solver").label("SmartVolumes solver");
    t.column(CanvasColumn::second).icon(Icon::cycle);
    t.doc(
        "Divides a boundary among SmartVolumes by a bounded power diagram whose cells are cut to balls. It adapts the weights in "
        "every tick until each volume has what it wants. A scene may hold several solvers, each with its own members and "
        "boundary.");
    t.in(&In::members, "members")
        .doc("The SmartVolumes that this solver takes care of; a SmartVolume belongs to one solver only.");
    t.in(&In::boundary, "boundary").doc("The boundary that is divided. The selection must give exactly one node.");
    t.in(&In::method, "method",
         {{Method::feedback, "feedback", "Each weight follows the error of its own volume, as in 2007, with acceleration."},
          {Method::newton, "newton", "Newton's method on the exact response of all volumes; few steps at any fill."}})
        .doc("How the weights are adapted.");
    t.in(&In::metric, "metric",
         {{geometry::Metric::power, "power", "Squared distance minus squared radius: walls are flat, measured exactly."},
          {geometry::Metric::additive, "additive", "Distance minus radius: walls are hyperboloids. Sampled, without meshes."},
          {geometry::Metric::multiplicative, "multiplicative",
           "Distance divided by radius: walls are spheres. Sampled, without meshes."}})
        .doc("The distance that divides the boundary. All but the power distance are sampled, and use Newton's method.");
    t.in(&In::resolution, "resolution")
        .range(8, 256)
        .soft(32, 128)
        .doc("Number of sample lines along the longest side of the boundary, for metrics that are sampled.");
    t.in(&In::gain, "gain")
        .unit(Unit::per_metre)
        .range(0, 1000)
        .soft(0, 1)
        .doc(
            "Change of weight per missing volume, the same for all, as in 2007; 0 derives it for each volume from its free "
            "surface.");
    t.in(&In::steps, "steps")
        .range(1, 50)
        .soft(1, 20)
        .doc("Steps of adaptation in one tick. With more steps the scene settles in fewer, slower ticks.");
    t.in(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(1e-9, 1)
        .soft(0.001, 0.1)
        .doc("Tolerance: the weights stay as they are while the error of every volume is within this share of what it wants.");
    t.in(&In::tessellation_depth, "tessellation_depth")
        .range(0, 4)
        .doc(
            "How often each face of the displayed and exported meshes is split in four. Volumes, areas and sun do not depend on "
            "it. The volume of the mesh itself does: it is below that of the shape, by a tenth on average at 1 and by less than "
            "a hundredth at 4.");
    declare_results(t);
    declare_sets(t);
  }

  static void declare_results(TypificationBuilder<SmartVolumesSolver>& t) {
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of members that have a volume.");
    t.out(&Out::total_demand, "total_demand").unit(Unit::cubic_metre).doc("Sum of what the members want.");
    t.out(&Out::total_volume, "total_volume").unit(Unit::cubic_metre).doc("Sum of the volumes of the members.");
    t.out(&Out::boundary_volume, "boundary_volume").unit(Unit::cubic_metre).doc("Volume inside the boundary.");
    t.out(&Out::fill, "fill").shown_first().unit(Unit::ratio).soft(0, 1).doc("Share of the boundary that the members take.");
    t.out(&Out::largest_error, "largest_error")
        .means()
        .traced()
        .shown_first()
        .unit(Unit::ratio)
        .doc("Largest error of a member, as a share of what it wants.");
    t.out(&Out::worst, "worst").shown_first().doc("Id of the member with the largest error; empty where all volumes are exact.");
    t.out(&Out::total_floor_area, "total_floor_area").unit(Unit::square_metre).doc("Sum of the floor areas of the members.");
    t.out(&Out::message, "message")
        .doc("Which demands cannot be met, by how much, and for which volumes; empty where every demand can be met.");
    memory(t, &Memory::momentum, "momentum", "Counter of the acceleration of the feedback; 1 is a fresh start.");
    memory(t, &Memory::residual, "residual",
           "Distance from the demands at which Newton's last step started; negative where there is no step to judge.");
    memory(t, &Memory::share, "share", "Share of Newton's full step that was taken last.");
    memory(t, &Memory::least_ratio, "least_ratio", "Smallest share of a demand that Newton's steps may lead to.");
    memory(t, &Memory::problem, "problem", "Hash of the problem that the last step belongs to; another problem starts anew.");
  }

  static void declare_sets(TypificationBuilder<SmartVolumesSolver>& t) {
    t.set("boundary", &Sets::plots).reads(&Plot::id, "node.id").reads(&Plot::domain, "boundary.domain");
    auto set = t.set("members", &Sets::members, &Out::replies);
    set.reads(&Member::id, "node.id")
        .reads(&Member::position, "node.position", Unit::metre)
        .reads(&Member::demand, "smart_volume.demand");
    set.reads(&Member::limit, "smart_volume.demand_limit").reads(&Member::least, "smart_volume.demand_min");
    set.reads(&Member::by_floor_area, "smart_volume.by_floor_area").writes(&Reply::fitted, "smart_volume.fitted");
    set.reads(&Member::volume, "smart_volume.volume").reads(&Member::floor_area, "smart_volume.floor_area");
    set.reads(&Member::storey_height, "smart_volume.storey_height").reads(&Member::weight, "smart_volume.weight");
    set.reads(&Member::last_step, "smart_volume.last_step").writes(&Reply::last_step, "smart_volume.last_step");
    set.reads(&Member::last_direction, "smart_volume.last_direction")
        .writes(&Reply::last_direction, "smart_volume.last_direction");
    set.writes(&Reply::wanted, "smart_volume.wanted").writes(&Reply::error, "smart_volume.error");
    set.writes(&Reply::weight, "smart_volume.weight").writes(&Reply::radius, "smart_volume.radius");
    set.writes(&Reply::volume, "smart_volume.volume").writes(&Reply::cell_volume, "smart_volume.cell_volume");
    set.writes(&Reply::floor_area, "smart_volume.floor_area").writes(&Reply::footprint, "smart_volume.footprint");
    set.writes(&Reply::surface_area, "smart_volume.surface_area").writes(&Reply::spherical_area, "smart_volume.spherical_area");
    set.writes(&Reply::height, "smart_volume.height")
        .writes(&Reply::bottom, "smart_volume.bottom")
        .writes(&Reply::mesh, "smart_volume.mesh");
    set.writes(&Reply::state, "smart_volume.state").writes(&Reply::reason, "smart_volume.reason");
    set.writes(&Reply::centroid, "smart_volume.centroid").writes(&Reply::neighbours, "smart_volume.neighbours");
    set.reads(&Member::standing, "smart_volume.standing").writes(&Reply::stands_on, "smart_volume.stands_on");
    set.writes(&Reply::hang, "smart_volume.hang").writes(&Reply::drop, "smart_volume.drop");
  }

  template <class M>
  static void memory(TypificationBuilder<SmartVolumesSolver>& t, M Memory::*member, const char* id, const char* doc) {
    t.memory(&Out::memory, &In::last, member, id).doc(doc);
  }

  static Result<std::shared_ptr<const geometry::Domain>> domain_of(const std::vector<Plot>& plots) {
    if (plots.empty())
      return Error{ErrorCode::missing, "boundary", "a boundary is needed and none was found: add one, or choose one here"};
    std::string found;
    for (const Plot& plot : plots) found += (found.empty() ? "`" : ", `") + plot.id + "`";
    if (plots.size() > 1)
      return Error{ErrorCode::conflict, "boundary",
                   std::to_string(plots.size()) + " boundaries were found (" + found + "): choose one of them here"};
    if (plots.front().domain) return plots.front().domain;
    return Error{ErrorCode::missing, "boundary",
                 "the boundary " + found + " has no shape: see its own error, or make it simpler where it has none"};
  }

  // The members as the geometry has them.
  struct Volumes {
    std::vector<geometry::PowerSite> sites;
    std::vector<double> wanted, aims, storey_heights;  // [m³], [m³] of shape, [m]
    std::vector<geometry::Standing> standing;
    geometry::FitState last;
  };

  // What is kept from tick to tick.
  struct Kept {
    geometry::VolumeTick::Cache cache;
    std::vector<std::string> names;
    Volumes volumes;                                // of the members as they were read
    std::vector<geometry::PowerSite> sites;         // the same, as the fit leaves them; only its memory is kept
    std::vector<double> volume, floor_area, error;  // of each member, as they came out
  };

  static geometry::Standing rule_of(const std::string& standing) {
    return standing == "ground"   ? geometry::Standing::ground
           : standing == "bridge" ? geometry::Standing::bridge
                                  : geometry::Standing::stack;
  }

  // The shape whose floor area is right has the wanted volume times this: volume / (floor area x storey height), which hardly
  // changes with the size of a shape. It is taken from the shape of the last tick, so that a shape that has what it wants
  // keeps it, and with it its weight.
  static double volume_by_floors(const Member& member) {
    constexpr double kMost = 4;
    const double floors = member.floor_area * member.storey_height;
    if (!(member.by_floor_area > 0) || !(floors > 0) || !(member.volume > 0)) return 1;
    return 1 + member.by_floor_area * (std::clamp(member.volume / floors, 1 / kMost, kMost) - 1);
  }

  static void take_member(const Member& member, std::size_t i, Volumes& volumes) {
    volumes.sites[i] = {member.position, member.weight};
    volumes.wanted[i] = std::max(std::min(member.demand, member.limit), member.least);
    volumes.aims[i] = volumes.wanted[i] * volume_by_floors(member);
    volumes.storey_heights[i] = member.storey_height;
    volumes.standing[i] = rule_of(member.standing);
    volumes.last.previous_move[i] = member.last_step;
    volumes.last.direction[i] = member.last_direction;
  }

  // Those that have changed, or all.
  static void take_members(const In& in, const Watched<Member>& members, bool is_anew, Volumes& volumes) {
    volumes.last.momentum = std::max(1.0, in.last.momentum);
    volumes.last.problem = std::strtoull(in.last.problem.c_str(), nullptr, 16);
    volumes.last.residual = in.last.residual;
    volumes.last.share = in.last.share;
    volumes.last.least_ratio = in.last.least_ratio;
    if (!is_anew) {
      for (const std::uint32_t i : members.changed) take_member(members.all[i], i, volumes);
      return;
    }
    const std::size_t count = members.all.size();
    volumes.sites.resize(count);
    volumes.standing.resize(count);
    for (auto* numbers :
         {&volumes.wanted, &volumes.aims, &volumes.storey_heights, &volumes.last.previous_move, &volumes.last.direction})
      numbers->resize(count);
    for (std::size_t i = 0; i < count; ++i) take_member(members.all[i], i, volumes);
  }

  // Below this share of what is asked for a volume has nothing, whatever the limits say that it should aim at.
  static constexpr double kNothing = 1e-3;

  // Limits that leave a volume nothing must not look as if it had what it wants.
  static bool is_denied(const Member& member, double wanted) { return member.demand > 0 && wanted <= kNothing * member.demand; }

  // What is compared with what is wanted [m³].
  static double fitted_of(const Member& member, const geometry::CellMeasure& cell) {
    if (!(member.by_floor_area > 0)) return cell.volume;
    return cell.volume + member.by_floor_area * (cell.floor_area * member.storey_height - cell.volume);
  }

  static double error_of(const Member& member, double wanted, double fitted) {
    return is_denied(member, wanted) ? 1.0 : wanted > 0 ? std::abs(fitted - wanted) / wanted : 0.0;
  }

  // Of what the fit and the cell of one member come to.
  static Reply reply_of(std::uint32_t i, double wanted, double weight, const geometry::VolumeTick::Outcome& done,
                        std::span<const Member> members, std::span<const std::string> names) {
    const geometry::CellMeasure& cell = done.cells[i];
    const std::int32_t on = done.stances[i].stands_on;
    Table neighbours{{"node", "area"}, {}};
    const auto is_wall = [](const geometry::FacetArea& facet) { return facet.kind == geometry::FacetArea::Kind::site; };
    neighbours.rows.resize(static_cast<std::size_t>(std::count_if(cell.facets.begin(), cell.facets.end(), is_wall)));
    auto row = neighbours.rows.begin();
    for (const geometry::FacetArea& facet : cell.facets) {
      if (!is_wall(facet)) continue;
      row->emplace_back(names[facet.index]);
      row++->emplace_back(facet.area);
    }
    const double fitted = fitted_of(members[i], cell);
    Reply reply{
        .wanted = wanted,
        .fitted = fitted,
        .weight = weight,
        .radius = std::sqrt(std::max(0.0, weight)),
        .volume = cell.volume,
        .cell_volume = cell.cell_volume,
        .floor_area = cell.floor_area,
        .surface_area = cell.surface_area,
        .footprint = cell.footprint,
        .spherical_area = cell.spherical_area,
        .height = cell.height,
        .bottom = cell.bottom,
        .error = error_of(members[i], wanted, fitted),
        .last_step = done.state.previous_move.empty() ? 0 : done.state.previous_move[i],
        .last_direction = done.state.direction.empty() ? 0 : done.state.direction[i],
        .state = std::string(name_of(cell.state)),
        .reason = wanted > 0 ? geometry::with_names(cell.reason, names) : "wants nothing: raise its demand to give it a volume",
        .neighbours = std::move(neighbours),
        .centroid = cell.centroid,
        .mesh = cell.mesh,
        .hang = done.stances[i].hang,
        .drop = done.stances[i].drop,
        .stands_on = on == geometry::Stance::kNothing  ? ""
                     : on == geometry::Stance::kGround ? "the ground"
                                                       : names[static_cast<std::size_t>(on)]};
    if (!is_denied(members[i], wanted)) return reply;
    reply.state = std::string(name_of(geometry::SiteState::starved));
    reply.reason = "its limit of " + fixed(members[i].limit, 1) + " m³ leaves it next to nothing of the " +
                   fixed(members[i].demand, 0) + " m³ that it asks for: raise what limits it, or lower its demand";
    return reply;
  }

  // What came out of those that were answered, or of all.
  static void take_outcome(const geometry::VolumeTick::Outcome& done, std::span<const Member> members,
                           std::span<const std::uint32_t> answered, bool is_anew, Kept& kept) {
    const auto take = [&](std::size_t i) {
      kept.volume[i] = done.cells[i].volume;
      kept.floor_area[i] = done.cells[i].floor_area;
      kept.error[i] = error_of(members[i], kept.volumes.wanted[i], fitted_of(members[i], done.cells[i]));
    };
    for (auto* numbers : {&kept.volume, &kept.floor_area, &kept.error}) numbers->resize(members.size());
    if (is_anew)
      for (std::size_t i = 0; i < members.size(); ++i) take(i);
    else
      for (const std::uint32_t i : answered) take(i);
  }

  static void add_up(const Kept& kept, std::span<const Member> members, Out& out) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      out.count += kept.volume[i] > 0 ? 1 : 0;
      out.total_demand += kept.volumes.wanted[i];
      out.total_volume += kept.volume[i];
      out.total_floor_area += kept.floor_area[i];
      if (kept.error[i] <= out.largest_error) continue;
      out.largest_error = kept.error[i];
      out.worst = members[i].id;
    }
    out.fill = out.total_volume / out.boundary_volume;
  }

  static Memory memory_of(const geometry::FitState& state) {
    return {.momentum = state.momentum,
            .residual = state.residual,
            .share = state.share,
            .least_ratio = state.least_ratio,
            .problem = hex_digits(state.problem)};
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    const auto found = domain_of(sets.plots);
    if (!found) return found.error();
    Out out;
    out.boundary_volume = (*found)->volume;
    const std::span<const Member> members = sets.members.all;
    if (members.empty() || (tick.is_recall && in.metric != geometry::Metric::power)) return out;
    std::optional<Kept> own;
    Kept& kept = tick.memo != nullptr ? tick.memo->of<Kept>() : own.emplace();
    const std::vector<std::string>& names = kept.names;
    // So it is, too, after an evaluation that has failed, and after a recall.
    const bool is_anew = sets.members.is_anew || names.size() != members.size();
    if (is_anew) {
      kept.names.clear();
      for (const Member& member : members) kept.names.push_back(member.id);
    }
    take_members(in, sets.members, is_anew, kept.volumes);
    const Volumes& volumes = kept.volumes;
    std::vector<geometry::PowerSite>& sites = kept.sites = volumes.sites;
    const geometry::VolumeTick now{.metric = in.metric,
                                   .samples = in.resolution,
                                   .method = in.method,
                                   .gain = in.gain,
                                   .steps = tick.is_recall ? 0 : in.steps,
                                   .tolerance = in.tolerance,
                                   .tessellation_depth = in.tessellation_depth,
                                   .storey_heights = volumes.storey_heights,
                                   .standing = volumes.standing,
                                   .pool = tick.pool};
    const auto done = now.run(**found, sites, volumes.aims, volumes.last, kept.cache);
    if (!done) return Error{done.error().code, "members", geometry::with_names(done.error().message, names)};
    std::vector<std::uint32_t>& answered = out.replies.members;
    std::set_union(done->differing.begin(), done->differing.end(), sets.members.changed.begin(), sets.members.changed.end(),
                   std::back_inserter(answered));
    take_outcome(*done, members, answered, is_anew, kept);
    add_up(kept, members, out);
    out.replies.replies.reserve(answered.size());
    for (const std::uint32_t i : answered)
      out.replies.replies.push_back(reply_of(i, volumes.wanted[i], sites[i].weight, *done, members, names));
    out.memory = memory_of(done->state);
    out.message = losses_text(done->losses, out.total_demand, names);
    if (!done->note.empty()) out.message += (out.message.empty() ? "" : "; ") + geometry::with_names(done->note, names);
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(smart_volumes_solver, SmartVolumesSolver)
