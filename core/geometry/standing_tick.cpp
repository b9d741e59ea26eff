// Chooses storeys, fits the weights and measures the bodies of standing volumes.
#include "core/geometry/standing_tick.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bl::geometry {

namespace {

constexpr double kChordTolerance = 0.02;  // of meshes that are looked at [m]

std::vector<StoreyRun> runs_of(const StandingWish& wish, int storeys) {
  const int full = wish.setback > 0 ? std::clamp(wish.full_storeys, 0, storeys) : storeys;
  std::vector<StoreyRun> runs;
  if (full > 0) runs.push_back({full, 0});
  if (storeys > full) runs.push_back({storeys - full, wish.setback});
  return runs;
}

// The plates of a body, told by their areas, borders and middle.
void measure_body(StandingResult& result) {
  double moment_area = 0;
  Vector3 moment;
  double last_area = 0;
  for (const PlateStack& stack : result.body->stacks) {
    const double height = stack.top() - stack.bottom;
    const auto add_sides = [&](const PlateRing& ring) {
      const std::size_t count = ring.corners.size();
      const double free =
          length_of(ring, result.body->centre, PlateRing::kFree) + length_of(ring, result.body->centre, PlateRing::kPlot);
      result.free_facade_area += height * free;
      for (std::size_t k = 0; k < count; ++k) {
        const PlateRing::Corner& c = ring.corners[k];
        if (c.beyond < 0) continue;
        const double area = height * distance(c.at, ring.corners[(k + 1) % count].at);
        const auto site = static_cast<std::uint32_t>(c.beyond);
        const auto known =
            std::find_if(result.walls.begin(), result.walls.end(), [site](const auto& wall) { return wall.first == site; });
        if (known == result.walls.end()) result.walls.emplace_back(site, area);
        else known->second += area;
        result.facade_area += area;
      }
    };
    for (const PlateRing& ring : stack.outlines) add_sides(ring);
    for (const PlateRing& ring : stack.courtyards) add_sides(ring);
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

StandingResult result_of(const FootprintDiagram& diagram, const StandingSite& site, std::uint32_t i) {
  const FootprintMeasure& measure = diagram.footprints()[i];
  StandingResult result;
  result.state = measure.state;
  result.weight = site.site.weight;
  result.volume = measure.volume;
  result.floor_area = measure.floor_area;
  result.footprint = measure.footprint;
  result.bottom = site.site.position.z;
  result.centroid = site.site.position;
  auto body = std::make_shared<StandingBody>(body_of(diagram, i));
  if (!body->stacks.empty()) {
    result.height = body->stacks.back().top() - result.bottom;
    result.mesh = std::make_shared<const Mesh>(mesh_of(*body, kChordTolerance));
  }
  result.body = std::move(body);
  measure_body(result);
  return result;
}

// The sites of the wishes, with the storeys that they may have.
std::vector<StandingSite> sites_of(const Domain& domain, std::span<const StandingWish> wishes) {
  // Corners of a boundary are where its planes meet, and off by rounding: a ground at -4e-15 m is one at 0.
  const double bottom = 1e-9 * std::round(1e9 * domain.minimum.z), highest = domain.maximum.z - bottom;
  std::vector<StandingSite> sites;
  for (const StandingWish& wish : wishes) {
    StandingSite& site = sites.emplace_back(wish.site);
    site.site.position.z = bottom;
    site.runs = runs_of(wish, storeys_of(wish, highest).count);
  }
  return sites;
}

}  // namespace

Storeys storeys_of(const StandingWish& wish, double highest) {
  // A hair less than whole storeys is whole storeys: heights are sums of decimal fractions.
  const auto whole = [&wish](double height, double play) {
    return static_cast<int>(std::floor(std::clamp(height / wish.site.storey_height - play, 0.0, kMostStoreys) + 1e-9));
  };
  const int wished = std::min(wish.storeys, whole(highest, 0));
  int allowed = whole(wish.height_limit, 0);
  if (wish.was_limited && wish.built > 0 && allowed > wish.built)
    allowed = std::max(wish.built, whole(wish.height_limit, kStoreyPlay));
  return {std::max({1, wish.least, std::min(wished, allowed)}), allowed < wished};
}

Result<StandingTick::Outcome> StandingTick::run(const Domain& domain, std::span<const StandingWish> wishes, Cache& kept) const {
  if (auto set = kept.diagram.set_domain(domain); !set) return set.error();
  std::vector<StandingSite> sites = sites_of(domain, wishes);
  std::vector<FloorDemand> demands;
  for (std::uint32_t i = 0; i < wishes.size(); ++i) {
    const double area = wishes[i].volume / wishes[i].site.storey_height;
    demands.push_back({{i}, area, area});
  }
  Outcome outcome;
  if (steps > 0) {
    auto fit = fit_footprints(kept.diagram, sites, demands,
                              {.tolerance = tolerance, .most_steps = steps, .is_local = true, .pool = pool, .progress = {}});
    if (!fit) return fit.error();
    // Where only the steps of a tick did not suffice, nobody goes without: the next tick goes on.
    if (!fit->infeasible.empty()) outcome.losses = std::move(fit->losses);
    outcome.message = std::move(fit->infeasible);
  } else if (auto made = kept.diagram.update(sites, pool); !made) {
    return made.error();
  }
  kept.results.resize(sites.size());
  std::vector<std::uint32_t> touched = kept.diagram.take_touched();
  for (const std::uint32_t i : touched) kept.results[i] = result_of(kept.diagram, sites[i], i);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const Storeys storeys = storeys_of(wishes[i], domain.maximum.z - domain.minimum.z);
    const bool is_touched = std::binary_search(touched.begin(), touched.end(), i);
    if (is_touched || !(storeys == kept.results[i].storeys)) outcome.differing.push_back(i);
    kept.results[i].storeys = storeys;
  }
  outcome.results = kept.results;
  return outcome;
}

}  // namespace bl::geometry
