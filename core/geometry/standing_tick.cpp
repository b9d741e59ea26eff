// Chooses storeys, fits the weights and measures the bodies of standing volumes.
#include "core/geometry/standing_tick.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/geometry/domain_makers.h"
#include "core/geometry/standing_text.h"

namespace bl::geometry {

namespace {

constexpr double kChordTolerance = 0.02;  // of meshes that are looked at [m]

std::vector<StoreyRun> runs_of(const StandingWish& wish, int storeys) {
  const bool has_setback = wish.setback > 0 || wish.courtyard_setback > 0;
  const int full = has_setback ? std::clamp(wish.full_storeys, 0, storeys) : storeys;
  std::vector<StoreyRun> runs;
  if (full > 0) runs.push_back({.storeys = full});
  if (storeys > full) runs.push_back({storeys - full, wish.setback, wish.courtyard_setback});
  return runs;
}

// The plates of a body, told by their areas, borders and middle.
void measure_body(StandingResult& result) {
  double moment_area = 0;
  Vector3 moment;
  double last_area = 0;
  for (const PlateStack& stack : result.body->stacks) {
    const double height = stack.top() - stack.bottom;
    // The sides of a courtyard have the courtyard beyond them, whatever moved them there.
    const auto add_sides = [&](const PlateRing& ring, bool is_courtyard) {
      const std::size_t count = ring.corners.size();
      const double free =
          length_of(ring, result.body->centre, PlateRing::kFree) + length_of(ring, result.body->centre, PlateRing::kPlot);
      result.free_facade_area += height * free;
      for (std::size_t k = 0; k < count; ++k) {
        const PlateRing::Corner& c = ring.corners[k];
        if (c.beyond < 0) continue;
        const double area = height * distance(c.at, ring.corners[(k + 1) % count].at);
        if (is_courtyard) {
          result.free_facade_area += area;
          continue;
        }
        const auto site = static_cast<std::uint32_t>(c.beyond);
        const auto known =
            std::find_if(result.walls.begin(), result.walls.end(), [site](const auto& wall) { return wall.first == site; });
        if (known == result.walls.end()) result.walls.emplace_back(site, area);
        else known->second += area;
        result.facade_area += area;
      }
    };
    for (const PlateRing& ring : stack.outlines) add_sides(ring, false);
    for (const PlateRing& ring : stack.courtyards) add_sides(ring, true);
    // What a smaller plate leaves free of the one below is roof.
    result.roof_area += std::max(0.0, last_area - stack.area);
    last_area = stack.area;
    for (const PlateFace& face : faces_of(stack, result.body->centre, kChordTolerance)) {
      const auto add_ring = [&](const Ring& ring) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Vector3 a = ring[k] - result.body->centre, b = ring[(k + 1) % ring.size()] - result.body->centre;
          const double twice = a.x * b.y - a.y * b.x;
          moment += 0.5 * twice * height * Vector3{(a.x + b.x) / 3, (a.y + b.y) / 3, 0.5 * (stack.bottom + stack.top())};
          moment_area += 0.5 * twice * height;
        }
      };
      add_ring(face.outer);
      for (const Ring& hole : face.holes) add_ring(hole);
    }
  }
  result.roof_area += last_area;
  result.facade_area += result.free_facade_area;
  std::sort(result.walls.begin(), result.walls.end());
  if (moment_area > 0)
    result.centroid = {result.body->centre.x + moment.x / moment_area, result.body->centre.y + moment.y / moment_area,
                       moment.z / moment_area};
}

// Sides towards other sites, which a diagram counts by itself, get the numbers of their wishes.
void name_sites(StandingBody& body, std::span<const std::uint32_t> members) {
  for (PlateStack& stack : body.stacks)
    for (std::vector<PlateRing>* rings : {&stack.outlines, &stack.courtyards})
      for (PlateRing& ring : *rings)
        for (PlateRing::Corner& corner : ring.corners)
          if (corner.beyond >= 0) corner.beyond = static_cast<std::int32_t>(members[static_cast<std::size_t>(corner.beyond)]);
}

// Height, mesh, walls and middle of a body that is not empty.
void take_body(StandingBody body, StandingResult& result) {
  if (!body.stacks.empty()) {
    result.height = body.stacks.back().top() - result.bottom;
    result.mesh = std::make_shared<const Mesh>(mesh_of(body, kChordTolerance));
  }
  result.body = std::make_shared<const StandingBody>(std::move(body));
  measure_body(result);
}

StandingResult result_of(const FootprintDiagram& diagram, const StandingSite& site, std::uint32_t i,
                         std::span<const std::uint32_t> members, std::span<const BuildingShare> shares,
                         SharedBuilding& building) {
  const FootprintMeasure& measure = diagram.footprints()[i];
  StandingResult result;
  result.state = measure.state;
  result.weight = site.site.weight;
  result.volume = measure.volume;
  result.floor_area = measure.floor_area;
  result.footprint = measure.footprint;
  result.bottom = site.site.position.z;
  result.centroid = site.site.position;
  StandingBody body = body_of(diagram, i);
  name_sites(body, members);
  if (!shares.empty()) {
    building = share_out(body, shares, site.angle);
    body = building.whole;
    result.volume = 0;
    for (const PlateStack& stack : body.stacks) result.volume += stack.storeys * stack.storey_height * stack.area;
  }
  take_body(std::move(body), result);
  return result;
}

// The sites of a level, and the storeys that they may have below `highest`. `bottom`: of the ground, or the roof.
std::vector<StandingSite> sites_of(std::span<const StandingWish> wishes, const StandingTick::Level& level,
                                   const StandingTick::Cache& kept, double bottom, double highest,
                                   std::vector<Storeys>& storeys) {
  std::vector<StandingSite> sites;
  for (const std::uint32_t i : level.members) {
    StandingSite& site = sites.emplace_back(wishes[i].site);
    // The edge of a roof is no border of the plot.
    if (level.base >= 0) {
      site.border_distance = site.street_distance = site.exclusion_distance = 0;
      site.has_border_walls = false;
    }
    site.site.position.z = level.base < 0 ? floor_of(wishes[i], bottom, highest) : bottom;
    const double room = highest - site.site.position.z;
    storeys.push_back(kept.shares[i].empty() ? storeys_of(wishes[i], room)
                                             : storeys_of(wishes[i], kept.shares[i], room, site.storey_height));
    site.runs = runs_of(wishes[i], storeys.back().count);
  }
  return sites;
}

bool is_member(std::span<const StandingWish> wishes, std::size_t i) {
  const std::int32_t host = wishes[i].host;
  // Who shares the footprint of somebody who shares one has a footprint of its own.
  return host >= 0 && host != static_cast<std::int32_t>(i) && wishes[static_cast<std::size_t>(host)].host < 0;
}

// Who shares the footprint of each wish, itself among them, from the ground up; none where nobody does.
std::vector<std::vector<BuildingShare>> shares_of(std::span<const StandingWish> wishes) {
  std::vector<std::vector<BuildingShare>> shares(wishes.size());
  const auto share_of = [&](std::uint32_t i) {
    return BuildingShare{i, wishes[i].volume / wishes[i].site.storey_height, wishes[i].site.storey_height};
  };
  for (std::uint32_t i = 0; i < wishes.size(); ++i) {
    if (!is_member(wishes, i)) continue;
    const auto host = static_cast<std::uint32_t>(wishes[i].host);
    if (shares[host].empty()) shares[host].push_back(share_of(host));
    shares[host].push_back(share_of(i));
  }
  for (std::vector<BuildingShare>& of_one : shares)
    std::stable_sort(of_one.begin(), of_one.end(),
                     [&](const BuildingShare& a, const BuildingShare& b) { return wishes[a.site].order < wishes[b.site].order; });
  return shares;
}

// What one volume has of a building.
StandingResult part_of(const StandingResult& whole, const SharedBuilding& building, std::size_t share, bool is_host,
                       const StandingWish& wish) {
  StandingResult part;
  part.state = whole.state;
  part.weight = is_host ? whole.weight : wish.site.site.weight;
  part.bottom = whole.bottom;
  part.centroid = whole.centroid;
  part.is_shared = true;
  part.storeys = {0, whole.storeys.is_limited, is_host ? whole.storeys.least_room : 0};
  const StandingBody& body = building.parts[share];
  if (!body.stacks.empty()) part.bottom = body.stacks.front().bottom;
  else if (part.state == SiteState::alive) part.state = SiteState::starved;
  for (const PlateStack& stack : body.stacks) {
    part.storeys.count += stack.storeys;
    part.floor_area += stack.storeys * stack.area;
    part.volume += stack.storeys * stack.storey_height * stack.area;
  }
  part.footprint = body.stacks.empty() ? 0 : body.stacks.front().area;
  part.storeys_held = is_host ? whole.storeys.count : part.storeys.count;
  take_body(body, part);
  part.roof_area = building.roofs[share];
  return part;
}

// Corners of a boundary are where its planes meet, and off by rounding: a ground at -4e-15 m is one at 0.
double ground_of(const Domain& domain) { return 1e-9 * std::round(1e9 * domain.minimum.z); }

// On whom each wish stands, without circles: each member of one stands on the ground. Who stands on one volume of a building
// stands on the roof of the building.
std::vector<std::int32_t> bases_of(std::span<const StandingWish> wishes, std::vector<std::uint32_t>& in_circles) {
  const auto base_of = [&](std::size_t i) {
    if (is_member(wishes, i)) return StandingWish::kGround;
    const std::int32_t base = wishes[i].base;
    return base >= 0 && is_member(wishes, static_cast<std::size_t>(base)) ? wishes[static_cast<std::size_t>(base)].host : base;
  };
  std::vector<std::int32_t> bases;
  for (std::uint32_t i = 0; i < wishes.size(); ++i) {
    std::int32_t below = base_of(i);
    for (std::size_t step = 0; step < wishes.size() && below >= 0 && below != static_cast<std::int32_t>(i); ++step)
      below = base_of(static_cast<std::size_t>(below));
    const bool is_in_circle = below == static_cast<std::int32_t>(i);
    if (is_in_circle) in_circles.push_back(i);
    bases.push_back(is_in_circle ? StandingWish::kGround : base_of(i));
  }
  return bases;
}

// The levels, each after that of its base. What is known of a level is kept where it has the same members.
std::vector<StandingTick::Level> levels_of(std::span<const StandingWish> wishes, std::span<const std::int32_t> bases,
                                           std::vector<StandingTick::Level> kept) {
  std::map<std::int32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t i = 0; i < bases.size(); ++i)
    if (!is_member(wishes, i)) members[bases[i]].push_back(i);
  std::map<std::int32_t, std::size_t> kept_of;
  for (std::size_t k = 0; k < kept.size(); ++k) kept_of.emplace(kept[k].base, k);
  std::vector<StandingTick::Level> levels;
  const auto add = [&](std::int32_t base) {
    const auto found = members.find(base);
    if (found == members.end()) return;
    const auto known = kept_of.find(base);
    if (known != kept_of.end() && kept[known->second].members == found->second) levels.push_back(std::move(kept[known->second]));
    else levels.push_back({base, std::move(found->second), {}, {}, nullptr, 0});
  };
  add(StandingWish::kGround);
  for (std::size_t k = 0; members.size() > levels.size() && k < levels.size(); ++k)
    for (std::size_t m = 0; m < levels[k].members.size(); ++m) add(static_cast<std::int32_t>(levels[k].members[m]));
  return levels;
}

// The roof of a body up to the height `top`, as a domain on which others stand.
Result<Domain> roof_of(const StandingBody& body, double top) {
  if (body.stacks.empty()) return Error{ErrorCode::infeasible, "", "has no roof, because it has no footprint"};
  const PlateStack& highest = body.stacks.back();
  if (!(top > highest.top())) return Error{ErrorCode::infeasible, "", "fills the whole height of the boundary"};
  std::vector<Domain> parts;
  for (const PlateFace& face : faces_of(highest, body.centre, StandingTick::kRoofTolerance)) {
    auto part = extrude_plan(face.outer, face.holes, highest.top(), top);
    if (!part) return Error{part.error().code, "", "has a roof that nothing can stand on: " + part.error().message};
    parts.push_back(std::move(*part));
  }
  if (parts.size() == 1) return std::move(parts.front());
  return unite(parts);
}

// At the edge of a roof there is air, not the border of the plot.
void free_edges(StandingResult& result) {
  StandingBody body = *result.body;
  for (PlateStack& stack : body.stacks)
    for (std::vector<PlateRing>* rings : {&stack.outlines, &stack.courtyards})
      for (PlateRing& ring : *rings)
        for (PlateRing::Corner& corner : ring.corners)
          if (corner.beyond == PlateRing::kPlot) corner.beyond = PlateRing::kFree;
  result.body = std::make_shared<const StandingBody>(std::move(body));
}

}  // namespace

Result<void> StandingTick::run_level(const Domain& ground, double bottom, std::span<const StandingWish> wishes, Level& level,
                                     Cache& kept, Outcome& outcome) const {
  const bool is_roof = level.base >= 0;
  const auto set = is_roof ? level.diagram.set_domain(level.domain) : level.diagram.set_domain(ground, streets, land);
  if (!set) return set.error();
  std::vector<Storeys> storeys;
  std::vector<StandingSite> sites = sites_of(wishes, level, kept, bottom, ground.maximum.z, storeys);
  std::vector<FloorDemand> demands;
  for (std::uint32_t k = 0; k < sites.size(); ++k) {
    const StandingWish& wish = wishes[level.members[k]];
    const std::vector<BuildingShare>& shares = kept.shares[level.members[k]];
    double area = shares.empty() ? wish.volume / wish.site.storey_height : 0;
    for (const BuildingShare& share : shares) area += share.area;
    demands.push_back({{k}, area, area});
  }
  if (steps > 0) {
    auto fit = fit_footprints(level.diagram, sites, demands,
                              {.tolerance = tolerance, .most_steps = steps, .is_local = true, .pool = pool, .progress = {}});
    if (!fit) return error_of_wish(fit.error(), level.members);
    // Where only the steps of a tick did not suffice, nobody goes without: the next tick goes on.
    if (!fit->infeasible.empty())
      for (const FloorLoss& loss : fit->losses) outcome.losses.push_back({level.members[loss.demand], loss.wanted, loss.had});
    if (is_roof && !fit->infeasible.empty()) outcome.on_roofs.push_back({level.base, std::move(fit->infeasible)});
    else if (!is_roof) outcome.message = std::move(fit->infeasible);
  } else if (auto made = level.diagram.update(sites, pool); !made) {
    return error_of_wish(made.error(), level.members);
  }
  std::vector<std::uint32_t> touched = level.diagram.take_touched();
  for (std::uint32_t k = 0; k < sites.size(); ++k)
    if (const std::uint32_t i = level.members[k]; !(kept.shares[i] == kept.shares_before[i])) touched.push_back(k);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::uint32_t k : touched) {
    const std::uint32_t i = level.members[k];
    kept.results[i] = result_of(level.diagram, sites[k], k, level.members, kept.shares[i], kept.buildings[i]);
    if (is_roof) free_edges(kept.results[i]);
  }
  for (std::uint32_t k = 0; k < sites.size(); ++k) {
    const std::uint32_t i = level.members[k];
    const bool is_touched = std::binary_search(touched.begin(), touched.end(), k);
    // A site that has nothing may get another weight and still have nothing: no footprint is touched then.
    const double weight = sites[k].site.weight;
    if (is_touched || !(storeys[k] == kept.results[i].storeys) || weight != kept.results[i].weight)
      outcome.differing.push_back(i);
    kept.results[i].storeys = storeys[k];
    kept.results[i].storeys_held = storeys[k].count;
    kept.results[i].weight = weight;
    kept.results[i].stands_on = level.base;
  }
  return {};
}

// Where a roof carries nothing, those who stand on it have nothing, and keep the weights with which they come back.
Result<void> StandingTick::run_roof(const Domain& ground, std::span<const StandingWish> wishes, Level& level, Cache& kept,
                                    Outcome& outcome) const {
  const auto base = static_cast<std::size_t>(level.base);
  const std::shared_ptr<const StandingBody> below = kept.results[base].body;
  Result<void> roof;
  if (!level.below || level.below != below || level.top != ground.maximum.z) {
    auto made = below ? roof_of(*below, ground.maximum.z) : Result<Domain>(Error{ErrorCode::infeasible, "", "has no roof"});
    if (made) level.domain = std::move(*made);
    else roof = made.error();
    level.below = below;
    level.top = ground.maximum.z;
  }
  const double bottom = kept.results[base].bottom + kept.results[base].height;
  if (roof) roof = run_level(ground, bottom, wishes, level, kept, outcome);
  if (roof) return roof;
  level.below = nullptr;
  outcome.on_roofs.push_back({level.base, roof.error().message});
  level.diagram = FootprintDiagram();
  for (const std::uint32_t i : level.members) {
    StandingResult none;
    none.state = SiteState::starved;
    none.weight = wishes[i].site.site.weight;
    none.storeys = storeys_of(wishes[i], ground.maximum.z - bottom);
    none.storeys_held = none.storeys.count;
    none.stands_on = level.base;
    kept.buildings[i] = {{}, std::vector<StandingBody>(kept.shares[i].size()), std::vector<double>(kept.shares[i].size(), 0)};
    none.bottom = bottom;
    none.centroid = wishes[i].site.site.position;
    none.body = std::make_shared<const StandingBody>();
    kept.results[i] = std::move(none);
    outcome.differing.push_back(i);
  }
  return {};
}

// The plot is the ground of the boundary, and storeys end at its top: between them it may be narrower.
void StandingTick::measure_outside(const Domain& domain, bool is_known, Cache& kept, const Outcome& outcome) {
  const bool may_reach_out = !is_upright(domain);
  const auto measure = [&](StandingResult& result) {
    result.outside = may_reach_out && result.body ? reach_out_of(domain, *result.body) : BoundaryReach();
  };
  if (!is_known) std::ranges::for_each(kept.results, measure);
  else if (may_reach_out)
    for (const std::uint32_t i : outcome.differing) measure(kept.results[i]);
}

// Gives what buildings have to those who share them.
void StandingTick::share_buildings(std::span<const StandingWish> wishes, Cache& kept, Outcome& outcome) const {
  const auto has_shares = [](const std::vector<BuildingShare>& shares) { return !shares.empty(); };
  const std::vector<std::uint32_t> differing = outcome.differing;
  std::vector<std::uint8_t> is_anew(wishes.size(), 0);
  for (const std::uint32_t i : differing) is_anew[i] = 1;
  // Who has come to share a footprint, or no longer does.
  for (std::uint32_t i = 0; i < wishes.size(); ++i)
    if (!(kept.shares[i] == kept.shares_before[i]))
      for (const std::vector<BuildingShare>* shares : {&kept.shares[i], &kept.shares_before[i]})
        for (const BuildingShare& share : *shares)
          if (share.site < wishes.size()) outcome.differing.push_back(share.site);
  if (std::any_of(kept.shares.begin(), kept.shares.end(), has_shares)) {
    const bool is_first = kept.parts.size() != wishes.size();
    kept.parts.resize(wishes.size());
    for (std::uint32_t i = 0; i < wishes.size(); ++i) {
      const std::vector<BuildingShare>& shares = kept.shares[i];
      if (shares.empty()) {
        if (!is_member(wishes, i)) kept.parts[i] = kept.results[i];
        continue;
      }
      if (!is_first && is_anew[i] == 0 && shares == kept.shares_before[i]) continue;
      std::int32_t below = kept.results[i].stands_on;
      for (std::size_t m = 0; m < shares.size(); ++m) {
        StandingResult& part = kept.parts[shares[m].site];
        part = part_of(kept.results[i], kept.buildings[i], m, shares[m].site == i, wishes[shares[m].site]);
        const bool is_lowest = part.bottom <= kept.results[i].bottom;
        part.stands_on = is_lowest ? kept.results[i].stands_on : below;
        if (kept.results[i].stands_on >= 0) free_edges(part);
        if (part.floor_area > 0) below = static_cast<std::int32_t>(shares[m].site);
        outcome.differing.push_back(shares[m].site);
      }
    }
    outcome.results = kept.parts;
    split_losses(wishes, kept, outcome);
  } else {
    kept.parts.clear();
    outcome.results = kept.results;
  }
  kept.shares_before = kept.shares;
}

// Of a building that is short, all are short in proportion.
void StandingTick::split_losses(std::span<const StandingWish> wishes, const Cache& kept, Outcome& outcome) {
  std::vector<FloorLoss> losses;
  for (const FloorLoss& loss : outcome.losses) {
    if (kept.shares[loss.demand].empty()) losses.push_back(loss);
    for (const BuildingShare& share : kept.shares[loss.demand])
      if (wishes[share.site].volume > 0) losses.push_back({share.site, share.area, kept.parts[share.site].floor_area});
  }
  outcome.losses = std::move(losses);
}

Result<StandingTick::Outcome> StandingTick::run(const Domain& domain, std::span<const StandingWish> wishes, Cache& kept) const {
  Outcome outcome;
  const std::vector<std::int32_t> bases = bases_of(wishes, outcome.in_circles);
  kept.levels = levels_of(wishes, bases, std::move(kept.levels));
  kept.results.resize(wishes.size());
  kept.shares = shares_of(wishes);
  kept.shares_before.resize(wishes.size());
  kept.buildings.resize(wishes.size());
  const bool is_known = !kept.levels.empty() && kept.levels.front().diagram.is_of(domain);
  for (Level& level : kept.levels) {
    const bool is_roof = level.base >= 0;
    auto done = is_roof ? run_roof(domain, wishes, level, kept, outcome)
                        : run_level(domain, ground_of(domain), wishes, level, kept, outcome);
    if (!done) return done.error();
    if (!is_roof) kept.plot_area = level.diagram.plot_area();
  }
  measure_outside(domain, is_known, kept, outcome);
  share_buildings(wishes, kept, outcome);
  std::sort(outcome.differing.begin(), outcome.differing.end());
  outcome.differing.erase(std::unique(outcome.differing.begin(), outcome.differing.end()), outcome.differing.end());
  return outcome;
}

}  // namespace bl::geometry
