// The solver of standing volumes: in each tick it chooses whole storeys and adapts weights until floor areas are met.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/demand/shared_storeys.h"
#include "core/geometry/cellar.h"
#include "core/geometry/domain.h"
#include "core/geometry/fit_text.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/plot_measure.h"
#include "core/geometry/standing_text.h"
#include "core/geometry/standing_tick.h"
#include "core/traffic/street_line.h"

namespace bl {
namespace {

constexpr double kPlaceChords = 0.02;                     // [m] between arcs and their chords, for the place of a volume
constexpr double kDegree = 3.14159265358979323846 / 180;  // [rad]

struct StandingSolver {
  struct In {
    Selection members{{}, "footprint", {}}, boundary{{}, "boundary", {}};
    Selection streets{{}, "street", {}}, junctions{{}, "junction", {}};
    double tolerance = 0.005, street_reach = 15;
    int steps = 8;
  };
  struct Member {
    std::string id;
    Point3 position;
    double demand = 0, limit = 0, least = 0, storey_height = 0, weight = 0;
    std::string form;
    double angle = 0, aspect = 1, height_limit = 0, setback = 0, depth = 0, ground = 0;
    double courtyard_setback = 0, wing_depth = 0, border_distance = 0, street_distance = 0, exclusion_distance = 0;
    int storeys = 1, storeys_min = 1, full_storeys = 0, built = 0, order = 0, cellar_storeys = 0;
    double cellar_height = 3, least_room = 0;  // the last one as it came out of the last tick
    bool has_party_walls = true, has_border_walls = false;
    std::vector<std::string> bases, shares;
  };
  struct Plot {
    std::string id;
    std::shared_ptr<const geometry::Domain> domain, land;  // land: with what the boundary leaves out
    double open_area = 0;                                  // kept open beside the domain [m²]
  };
  struct Street {
    Selection start, end;
    std::vector<Point3> course;
  };
  struct Junction {
    std::string id;
    Point3 position;
  };
  struct Sets {
    Watched<Member> members;
    std::vector<Plot> plots;
    std::vector<Street> streets;
    std::vector<Junction> junctions;
  };
  struct Reply {
    double wanted = 0, fitted = 0, weight = 0, radius = 0, volume = 0, cell_volume = 0, floor_area = 0, surface_area = 0;
    double footprint = 0, spherical_area = 0, height = 0, bottom = 0, error = 0;
    std::string state, reason, stands_on;
    Shared<Table> neighbours, plates, building = {};
    Point3 centroid, stands_at = {};
    MeshPointer mesh;
    int storeys_built = 0, storeys_held = 0, cellars_built = 0;
    bool is_limited = false;
    double facade_area = 0, roof_area = 0, cellar_area = 0, hang = 0, drop = 0, least_room = 0;
  };
  struct Out {
    std::int64_t count = 0;
    double total_floor_area = 0, plot_area = 0, open_area = 0, covered = 0, fsi = 0, gsi = 0, osr = 0, mean_storeys = 0,
           largest_error = 0;
    std::string worst, message;
    SomeReplies<Reply> replies;
  };
  struct Kept {
    geometry::StandingTick::Cache cache;
    std::vector<std::string> names;
    std::vector<geometry::StandingWish> wishes;
    std::vector<std::pair<int, double>> cellars;  // of each member: storeys and their height [m]
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
    t.in(&In::streets, "streets").doc("The streets along which sides of the boundary have distances and set-backs of their own.");
    t.in(&In::junctions, "junctions").doc("The junctions of these streets.");
    t.in(&In::street_reach, "street_reach")
        .unit(Unit::metre)
        .range(0, 1000)
        .soft(3, 40)
        .doc(
            "A side of the boundary is along a street where its middle lies within this distance of the street's axis, and both "
            "have the same direction within 30°.");
    t.in(&In::steps, "steps").range(1, 60).soft(1, 20).doc("Steps of Newton's method in one tick, at most.");
    t.in(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(1e-9, 1)
        .soft(0.001, 0.1)
        .doc("The weights stay as they are while the error of every volume is within this share of what it wants.");
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of members that have a volume.");
    t.out(&Out::total_floor_area, "total_floor_area").shown_first().unit(Unit::square_metre).doc("Sum of all plates.");
    t.out(&Out::plot_area, "plot_area")
        .unit(Unit::square_metre)
        .doc("Area of the ground inside the boundary, with what it keeps open.");
    t.out(&Out::open_area, "open_area").unit(Unit::square_metre).doc("The part of it that the boundary keeps open.");
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
    t.set("streets", &Sets::streets)
        .reads(&Street::start, "street.start")
        .reads(&Street::end, "street.end")
        .reads(&Street::course, "street.course", Unit::metre);
    t.set("junctions", &Sets::junctions).reads(&Junction::id, "node.id").reads(&Junction::position, "node.position", Unit::metre);
    t.set("boundary", &Sets::plots)
        .reads(&Plot::id, "node.id")
        .reads(&Plot::domain, "boundary.domain")
        .reads(&Plot::land, "boundary.land")
        .reads(&Plot::open_area, "boundary.open_area");
    auto set = t.set("members", &Sets::members, &Out::replies);
    set.reads(&Member::id, "node.id").reads(&Member::position, "node.position", Unit::metre);
    set.reads(&Member::demand, "smart_volume.demand").reads(&Member::limit, "smart_volume.demand_limit");
    set.reads(&Member::least, "smart_volume.demand_min").reads(&Member::storey_height, "smart_volume.storey_height");
    set.reads(&Member::weight, "smart_volume.weight").writes(&Reply::weight, "smart_volume.weight");
    set.reads(&Member::form, "footprint.form").reads(&Member::angle, "footprint.angle", Unit::degree);
    set.reads(&Member::aspect, "footprint.aspect").reads(&Member::height_limit, "footprint.height_limit");
    set.reads(&Member::setback, "footprint.setback").reads(&Member::depth, "footprint.depth");
    set.reads(&Member::courtyard_setback, "footprint.courtyard_setback").reads(&Member::wing_depth, "footprint.wing_depth");
    set.reads(&Member::border_distance, "footprint.border_distance");
    set.reads(&Member::street_distance, "footprint.street_distance");
    set.reads(&Member::exclusion_distance, "footprint.exclusion_distance");
    set.reads(&Member::has_border_walls, "footprint.border_walls");
    set.reads(&Member::storeys, "footprint.storeys").reads(&Member::storeys_min, "footprint.storeys_min");
    set.reads(&Member::full_storeys, "footprint.full_storeys").reads(&Member::has_party_walls, "footprint.party_walls");
    set.reads(&Member::bases, "footprint.bases").reads(&Member::ground, "footprint.ground", Unit::metre);
    set.writes(&Reply::storeys_built, "footprint.storeys_built");
    set.reads(&Member::built, "footprint.storeys_held").writes(&Reply::storeys_held, "footprint.storeys_held");
    set.reads(&Member::shares, "footprint.shares").reads(&Member::order, "footprint.order");
    set.reads(&Member::cellar_storeys, "footprint.cellar_storeys").reads(&Member::cellar_height, "footprint.cellar_height");
    set.writes(&Reply::cellars_built, "footprint.cellars_built").writes(&Reply::cellar_area, "footprint.cellar_area");
    set.reads(&Member::least_room, "footprint.least_room").writes(&Reply::least_room, "footprint.least_room");
    set.writes(&Reply::is_limited, "footprint.is_limited");
    set.writes(&Reply::wanted, "smart_volume.wanted").writes(&Reply::fitted, "smart_volume.fitted");
    set.writes(&Reply::radius, "smart_volume.radius");
    set.writes(&Reply::volume, "smart_volume.volume").writes(&Reply::cell_volume, "smart_volume.cell_volume");
    set.writes(&Reply::floor_area, "smart_volume.floor_area").writes(&Reply::footprint, "smart_volume.footprint");
    set.writes(&Reply::surface_area, "smart_volume.surface_area").writes(&Reply::spherical_area, "smart_volume.spherical_area");
    set.writes(&Reply::height, "smart_volume.height").writes(&Reply::bottom, "smart_volume.bottom");
    set.writes(&Reply::error, "smart_volume.error").writes(&Reply::mesh, "smart_volume.mesh");
    set.writes(&Reply::state, "smart_volume.state").writes(&Reply::reason, "smart_volume.reason");
    set.writes(&Reply::centroid, "smart_volume.centroid").writes(&Reply::neighbours, "smart_volume.neighbours");
    set.writes(&Reply::stands_on, "smart_volume.stands_on").writes(&Reply::hang, "smart_volume.hang");
    set.writes(&Reply::drop, "smart_volume.drop").writes(&Reply::plates, "footprint.plates");
    set.writes(&Reply::building, "footprint.building").writes(&Reply::stands_at, "footprint.stands_at");
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
                 .has_party_walls = m.has_party_walls,
                 .has_border_walls = m.has_border_walls,
                 .border_distance = m.border_distance,
                 .street_distance = m.street_distance,
                 .exclusion_distance = m.exclusion_distance,
                 .wing_depth = m.wing_depth};
    wish.volume = std::max(std::min(m.demand, m.limit), m.least);
    wish.storeys = m.storeys;
    wish.least = m.storeys_min;
    wish.height_limit = m.height_limit;
    wish.built = m.built;
    wish.least_room = m.least_room;
    wish.setback = m.setback;
    wish.courtyard_setback = m.courtyard_setback;
    wish.full_storeys = m.full_storeys;
    wish.ground = m.ground;
    wish.order = m.order;
    return wish;
  }

  // What is below the ground; nothing under a volume that stands on another.
  static geometry::PlateStack cellar_of(const std::pair<int, double>& wish, const geometry::StandingResult& result) {
    if (result.stands_on >= 0 || !result.body) return geometry::cellar_of({}, 0, wish.second);
    return geometry::cellar_of(*result.body, wish.first, wish.second);
  }

  static Reply reply_of(const geometry::StandingWish& wish, const geometry::StandingResult& result,
                        const geometry::PlateStack& cellar, std::span<const std::string> names) {
    Table neighbours{{"node", "area"}, {}}, plates;
    for (const auto& [site, area] : result.walls) neighbours.rows.push_back({names[site], area});
    if (result.body) geometry::write_body(*result.body, plates);
    const double around = result.facade_area + result.roof_area + result.footprint;
    return {.wanted = wish.volume,
            .fitted = geometry::fitted_volume(wish, result),
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
            .error = geometry::error_of(wish, result),
            .state = std::string(name_of(result.state)),
            .reason = geometry::missing_text(wish, result, names),
            .stands_on = !(result.floor_area > 0) ? ""
                         : result.stands_on < 0   ? std::string(geometry::kTheGround)
                                                  : names[static_cast<std::size_t>(result.stands_on)],
            .neighbours = std::move(neighbours),
            .plates = std::move(plates),
            .centroid = result.centroid,
            .mesh = result.mesh,
            .storeys_built = result.storeys.count,
            .storeys_held = result.storeys_held,
            .cellars_built = cellar.storeys,
            .is_limited = result.storeys.is_limited,
            .facade_area = result.facade_area,
            .roof_area = result.roof_area,
            .cellar_area = cellar.storeys * cellar.area,
            .least_room = result.storeys.least_room};
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

  // The host of the building that a volume shares; nothing where it has one of its own.
  static std::optional<std::size_t> host_of(const Kept& kept, std::size_t i) {
    if (!kept.cache.shares[i].empty()) return i;
    const std::int32_t host = kept.wishes[i].host;
    return host >= 0 ? std::optional(static_cast<std::size_t>(host)) : std::nullopt;
  }

  // With fewer storeys the mean may be another one. A limit that leaves room for some has to do so by the mean of each number of
  // storeys on the way there.
  static double storey_height_of(std::span<const geometry::BuildingShare> shares, int held, int wished) {
    double height = 0;
    for (int storeys = std::max(1, held - 1); storeys <= std::max(held, wished); ++storeys)
      height = std::max(height, geometry::mean_storey_height(shares, storeys));
    return height;
  }

  // What a volume shows of the building that it shares.
  static Table building_of(std::size_t i, std::span<const Member> members, const Kept& kept) {
    const auto host = host_of(kept, i);
    if (!host) return demand::table_of(std::nullopt);
    const geometry::StandingResult& whole = kept.cache.results[*host];
    const geometry::StandingWish& wish = kept.wishes[*host];
    const auto floors = [&](std::size_t m) { return std::max(members[m].demand, members[m].least) / members[m].storey_height; };
    double all = 0;
    std::size_t lowest = *host;
    for (const geometry::BuildingShare& share : kept.cache.shares[*host]) {
      all += floors(share.site);
      if (members[share.site].height_limit < members[lowest].height_limit) lowest = share.site;
    }
    return demand::table_of(
        demand::Building{.host = kept.names[*host],
                         .wished = wish.storeys,
                         .least = wish.least,
                         .held = whole.storeys.count,
                         .storey_height = storey_height_of(kept.cache.shares[*host], whole.storeys.count, wish.storeys),
                         .bottom = whole.bottom,
                         .top = whole.bottom + whole.height,
                         .limit = wish.height_limit,
                         .part = all > 0 ? floors(i) / all : 0,
                         .limited_by = kept.names[lowest]});
  }

  // Where a volume stands, and in which building.
  static void place_reply(std::size_t i, std::span<const Member> members, const Kept& kept, Reply& reply) {
    const std::size_t host = host_of(kept, i).value_or(i);
    reply.building = building_of(i, members, kept);
    reply.stands_at = geometry::nearest_place(*kept.cache.results[host].body, members[host].position, kPlaceChords);
  }

  // What one of a building asks for is read of the others too.
  static void add_sharers(const Kept& kept, std::vector<std::uint32_t>& answered) {
    std::vector<std::size_t> hosts;
    for (const std::uint32_t i : answered)
      if (const auto host = host_of(kept, i)) hosts.push_back(*host);
    if (hosts.empty()) return;
    std::sort(hosts.begin(), hosts.end());
    hosts.erase(std::unique(hosts.begin(), hosts.end()), hosts.end());
    for (const std::size_t host : hosts)
      for (const geometry::BuildingShare& share : kept.cache.shares[host]) answered.push_back(share.site);
    std::sort(answered.begin(), answered.end());
    answered.erase(std::unique(answered.begin(), answered.end()), answered.end());
  }

  // Whose footprint each volume shares. Returns what is wrong with that, sentences after semicolons. A limit of height on one of
  // them is one on the building.
  static std::string find_hosts(std::span<const Member> members, Kept& kept) {
    std::string words;
    std::vector<std::int32_t> hosts(members.size(), geometry::StandingWish::kGround);
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (members[i].shares.empty()) continue;
      const std::string& host = members[i].shares.front();
      const auto found = std::lower_bound(kept.names.begin(), kept.names.end(), host);
      const auto n = static_cast<std::size_t>(found - kept.names.begin());
      const bool is_there = n < kept.names.size() && *found == host;
      const std::string why = !is_there                    ? "is no volume of this solver"
                              : n == i                     ? "is itself"
                              : !members[n].shares.empty() ? "shares the footprint of another itself"
                                                           : "";
      if (why.empty()) hosts[i] = static_cast<std::int32_t>(n);
      else
        words += "; `" + kept.names[i] + "` has a footprint of its own, because `" + host + "`, whose footprint it shares, " +
                 why + ": change its `shares`";
      if (members[i].shares.size() > 1)
        words += "; `" + kept.names[i] + "` shares the footprint of `" + host + "` alone of the " +
                 std::to_string(members[i].shares.size()) + " that its `shares` name";
      if (why.empty() && !members[i].bases.empty())
        words += "; the `bases` of `" + kept.names[i] + "` have no effect, because it shares the footprint of `" + host + "`";
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (hosts[i] < 0) continue;
      const auto host = static_cast<std::size_t>(hosts[i]);
      kept.wishes[i].host = hosts[i];
      kept.wishes[i].base = geometry::StandingWish::kGround;
      kept.wishes[host].height_limit = std::min(kept.wishes[host].height_limit, members[i].height_limit);
    }
    return words;
  }

  static void add_up(const Kept& kept, std::span<const geometry::StandingResult> results, Out& out) {
    out.plot_area = kept.cache.plot_area + out.open_area;
    for (std::size_t i = 0; i < results.size(); ++i) {
      out.count += results[i].volume > 0 ? 1 : 0;
      out.total_floor_area += results[i].floor_area;
      out.covered += results[i].stands_on < 0 ? results[i].footprint : 0;
      const double error = geometry::error_of(kept.wishes[i], results[i]);
      if (error <= out.largest_error) continue;
      out.largest_error = error;
      out.worst = kept.names[i];
    }
    out.fsi = out.plot_area > 0 ? out.total_floor_area / out.plot_area : 0;
    out.gsi = out.plot_area > 0 ? out.covered / out.plot_area : 0;
    out.osr = out.total_floor_area > 0 ? (out.plot_area - out.covered) / out.total_floor_area : 0;
    out.mean_storeys = out.covered > 0 ? out.total_floor_area / out.covered : 0;
  }

  // Of the streets between two junctions; none where no member tells sides along streets from others.
  static std::vector<geometry::StreetAxis> streets_of(const In& in, const Sets& sets) {
    std::vector<geometry::StreetAxis> axes;
    const bool is_asked = std::ranges::any_of(sets.members.all, [](const Member& m) {
      return m.border_distance != m.street_distance || (m.has_border_walls && (m.setback > 0 || m.wing_depth < m.depth));
    });
    if (!is_asked) return axes;
    const auto place = [&sets](const Selection& end) -> const Point3* {
      if (end.ids.size() != 1) return nullptr;
      const auto found = std::ranges::lower_bound(sets.junctions, end.ids.front(), {}, &Junction::id);
      return found == sets.junctions.end() || found->id != end.ids.front() ? nullptr : &found->position;
    };
    for (const Street& street : sets.streets) {
      const Point3 *start = place(street.start), *end = place(street.end);
      if (start != nullptr && end != nullptr)
        axes.push_back({traffic::street_line(*start, street.course, *end), in.street_reach});
    }
    return axes;
  }

  static Result<const geometry::Domain*> domain_of(const std::vector<Plot>& plots) {
    if (plots.size() == 1 && plots.front().domain) return plots.front().domain.get();
    if (plots.size() == 1)
      return Error{ErrorCode::missing, "boundary", "the boundary `" + plots.front().id + "` has no shape: see its own error"};
    return Error{ErrorCode::missing, "boundary",
                 plots.empty() ? "a boundary is needed and none was found: add one, or choose one here"
                               : std::to_string(plots.size()) + " boundaries were found: choose one of them here"};
  }

  static void gather(std::span<const Member> members, Kept& kept) {
    kept.names.clear();
    kept.wishes.clear();
    kept.cellars.clear();
    for (const Member& member : members) {
      kept.names.push_back(member.id);
      kept.wishes.push_back(wish_of(member));
      kept.cellars.emplace_back(member.cellar_storeys, member.cellar_height);
    }
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    const auto domain = domain_of(sets.plots);
    if (!domain) return domain.error();
    Out out;
    if (sets.members.all.empty()) return out;
    std::optional<Kept> own;
    Kept& kept = tick.memo != nullptr ? tick.memo->of<Kept>() : own.emplace();
    gather(sets.members.all, kept);
    std::string words = find_bases(sets.members.all, kept) + find_hosts(sets.members.all, kept);
    const std::vector<geometry::StreetAxis> streets = streets_of(in, sets);
    const geometry::StandingTick now{.steps = tick.is_recall ? 0 : in.steps,
                                     .tolerance = in.tolerance,
                                     .streets = streets,
                                     .land = sets.plots.front().land.get(),
                                     .pool = tick.pool};
    const auto done = now.run(**domain, kept.wishes, kept.cache);
    if (!done) return Error{done.error().code, "members", geometry::with_names(done.error().message, kept.names)};
    std::vector<std::uint32_t>& answered = out.replies.members;
    std::set_union(done->differing.begin(), done->differing.end(), sets.members.changed.begin(), sets.members.changed.end(),
                   std::back_inserter(answered));
    if (sets.members.is_anew) {
      answered.clear();
      for (std::uint32_t i = 0; i < kept.names.size(); ++i) answered.push_back(i);
    }
    add_sharers(kept, answered);
    out.open_area = sets.plots.front().open_area;
    for (const std::uint32_t i : done->in_circles) {
      kept.wishes[i].base = geometry::StandingWish::kGround;
      words += "; `" + kept.names[i] +
               "` stands on the ground, because it would stand upon itself: change its `bases`, or the `stack` link to it";
    }
    words += geometry::outside_text(kept.wishes, done->results, **domain, kept.names);
    words += geometry::other_storeys_text(kept.wishes, done->results, kept.cache.results, **domain, in.tolerance,
                                          kept.names);
    for (std::size_t i = 0; i < kept.names.size(); ++i)
      if (kept.cellars[i].first > 0) words += geometry::lost_cellar_text(done->results[i], i, kept.names);
    add_up(kept, done->results, out);
    for (const std::uint32_t i : answered) {
      out.replies.replies.push_back(
          reply_of(kept.wishes[i], done->results[i], cellar_of(kept.cellars[i], done->results[i]), kept.names));
      place_reply(i, sets.members.all, kept, out.replies.replies.back());
    }
    out.message = done->message;
    for (const auto& [base, text] : done->on_roofs) {
      const std::string& name = kept.names[static_cast<std::size_t>(base)];
      words += text.starts_with("has ") || text.starts_with("fills ")
                   ? "; `" + name + "` " + text + ", so that nothing stands on it"
                   : "; on the roof of `" + name + "` " + geometry::with_names(text, kept.names);
    }
    out.message += words;
    out.message += geometry::floor_losses_text(done->losses, kept.names);
    if (out.message.starts_with("; ")) out.message.erase(0, 2);
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(standing_solver, StandingSolver)
