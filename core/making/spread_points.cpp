// Best candidates, then relaxation in a sampled power diagram, then clearance and separation; all steps have fixed counts.
#include "core/making/spread_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/geometry/plan_ring.h"
#include "core/making/ball_grid.h"
#include "core/making/prism_samples.h"

namespace bl::making {

namespace {

constexpr std::size_t kSamplesPerPoint = 32, kFewestSamples = 4096;
constexpr int kRelaxations = 24;            // of which the last third is without attraction
constexpr double kFill = 0.6;               // equal balls in disorder fill about so much of a room: larger radii never fit
constexpr double kFooting = 0.2;            // how deep a ball on the ground sinks into it, as a share of its radius
constexpr std::size_t kSpareSamples = 256;  // candidates for a point that must move away from another one

// Newton's method with the four basic operations only: std::cbrt may differ by a bit between libraries.
double cube_root(double number) {
  double root = std::max(1.0, number);
  for (int i = 0; i < 1000; ++i) {
    const double next = (2 * root + number / (root * root)) / 3;
    if (!(next < root)) break;  // falls until rounding stops it
    root = next;
  }
  return root;
}

class Spreader {
 public:
  Spreader(std::vector<geometry::Ring> rings, double bottom, double top, std::span<const double> volumes, std::uint64_t seed,
           std::span<const std::pair<std::size_t, std::size_t>> pairs, std::span<const std::uint8_t> on_ground);
  std::vector<Point3> run();

 private:
  void place_candidates();
  double score(std::size_t site, const Point3& at, const std::vector<std::size_t>& placed) const;
  void relax(double attraction);
  void assign();
  void revive_hidden();
  void move_to_centroids();
  void attract(double strength);
  void keep_clear();
  void separate();
  Point3 at_buildable_height(Point3 point, std::size_t site) const;
  Point3 at_own_height(Point3 point, std::size_t site) const;

  bool is_inside(const Point3& point) const;
  Point3 nearest_side(const Point3& point) const;

  std::vector<geometry::Ring> rings_;  // the plan, then its holes
  double bottom_, top_, spacing_ = 0;
  std::span<const std::pair<std::size_t, std::size_t>> pairs_;
  std::span<const std::uint8_t> on_ground_;
  Random random_;
  std::vector<Point3> samples_;
  std::vector<BallSite> sites_;
  std::vector<std::vector<std::size_t>> neighbours_;
  std::vector<BallGrid::Hit> owners_;  // per sample
  std::vector<std::size_t> counts_;    // samples per site
};

Spreader::Spreader(std::vector<geometry::Ring> rings, double bottom, double top, std::span<const double> volumes,
                   std::uint64_t seed, std::span<const std::pair<std::size_t, std::size_t>> pairs,
                   std::span<const std::uint8_t> on_ground)
    : rings_(std::move(rings)),
      bottom_(bottom),
      top_(top),
      pairs_(pairs),
      on_ground_(on_ground),
      random_(seed, 0x51),
      sites_(volumes.size()),
      neighbours_(volumes.size()) {
  double area = 0;
  for (std::size_t r = 0; r < rings_.size(); ++r) area += (r == 0 ? 1 : -1) * std::abs(geometry::signed_area(rings_[r]));
  const double prism = area * (top - bottom);
  const double demand = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  const double share = std::min(1.0, kFill * prism / demand);
  constexpr double kBall = 4.1887902047863910;  // 4π/3
  for (std::size_t i = 0; i < volumes.size(); ++i) sites_[i].radius = cube_root(volumes[i] * share / kBall);
  spacing_ = cube_root(prism / static_cast<double>(volumes.size()));
  samples_ = prism_samples(rings_, bottom, top, std::max(kFewestSamples, kSamplesPerPoint * volumes.size()), seed);
  for (const auto& [a, b] : pairs) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
}

// By the even-odd rule over all rings, the holes among them.
bool Spreader::is_inside(const Point3& point) const {
  bool inside = false;
  for (const geometry::Ring& ring : rings_) inside = inside != geometry::ring_contains(ring, point);
  return inside;
}

Point3 Spreader::nearest_side(const Point3& point) const {
  const auto away = [&](const Point3& p) { return (p.x - point.x) * (p.x - point.x) + (p.y - point.y) * (p.y - point.y); };
  Point3 best = geometry::nearest_on_ring(rings_.front(), point);
  for (const geometry::Ring& ring : rings_) {
    const Point3 other = geometry::nearest_on_ring(ring, point);
    if (away(other) < away(best)) best = other;
  }
  return best;
}

std::vector<Point3> Spreader::run() {
  place_candidates();
  for (int k = 0; k < kRelaxations; ++k) relax(std::max(0.0, 0.6 * (1 - 1.5 * k / kRelaxations)));
  keep_clear();
  separate();
  std::vector<Point3> points;
  for (const BallSite& site : sites_) points.push_back(site.at);
  return points;
}

// How well a site would stand there: as far from all placed ones as possible, or, where neighbours are placed already, as near
// to them as the balls allow.
double Spreader::score(std::size_t site, const Point3& at, const std::vector<std::size_t>& placed) const {
  double clearance = std::numeric_limits<double>::infinity();
  for (const std::size_t other : placed)
    clearance = std::min(clearance, distance(at, sites_[other].at) - sites_[site].radius - sites_[other].radius);
  double apart = 0;
  bool any = false;
  for (const std::size_t other : neighbours_[site]) {
    if (!std::binary_search(placed.begin(), placed.end(), other)) continue;
    any = true;
    apart += std::max(0.0, distance(at, sites_[other].at) - sites_[site].radius - sites_[other].radius);
  }
  return any ? 4 * std::min(0.0, clearance) - apart : clearance;
}

// Mitchell's best candidate (1991), the largest demand first, drawn from the samples.
void Spreader::place_candidates() {
  std::vector<std::size_t> order(sites_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sites_[a].radius > sites_[b].radius; });
  // Fewer candidates for many points keep the quadratic cost of this step in bounds.
  const double count = static_cast<double>(sites_.size());
  const int candidates = static_cast<int>(std::clamp(3e7 / (count * count), 2.0, 16.0));
  std::vector<std::size_t> placed;  // ascending
  for (const std::size_t site : order) {
    double best = -std::numeric_limits<double>::infinity();
    Point3 at = samples_[0];
    for (int k = 0; k < (neighbours_[site].empty() ? candidates : 3 * candidates); ++k) {
      const Point3 candidate = at_own_height(samples_[random_.below(samples_.size())], site);
      const double value = placed.empty() ? 0 : score(site, candidate, placed);
      if (value > best) {
        best = value;
        at = candidate;
      }
    }
    sites_[site].at = at;
    placed.insert(std::upper_bound(placed.begin(), placed.end(), site), site);
  }
}

void Spreader::assign() {
  const BallGrid grid(sites_, spacing_);
  owners_.resize(samples_.size());
  counts_.assign(sites_.size(), 0);
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    owners_[s] = grid.nearest(samples_[s]);
    ++counts_[owners_[s].site];
  }
}

// A site without samples is hidden under larger ones: it jumps to the sample that is served worst, and takes it over.
void Spreader::revive_hidden() {
  for (std::size_t site = 0; site < sites_.size(); ++site) {
    if (counts_[site] > 0) continue;
    std::size_t worst = samples_.size();
    for (std::size_t s = 0; s < samples_.size(); ++s)
      if (counts_[owners_[s].site] > 1 && (worst == samples_.size() || owners_[s].power > owners_[worst].power)) worst = s;
    if (worst == samples_.size()) return;
    --counts_[owners_[worst].site];
    owners_[worst] = {site, -sites_[site].radius * sites_[site].radius};
    counts_[site] = 1;
  }
}

// Lloyd's step (1982): each site goes to the centroid of its samples, or to the nearest of them where the plan is notched there.
void Spreader::move_to_centroids() {
  std::vector<Point3> centroids(sites_.size());
  for (std::size_t s = 0; s < samples_.size(); ++s) centroids[owners_[s].site] += samples_[s];
  std::vector<double> nearest(sites_.size(), -1);  // negative: the centroid is inside
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (counts_[i] == 0) continue;
    centroids[i] *= 1.0 / static_cast<double>(counts_[i]);
    if (is_inside(centroids[i])) sites_[i].at = centroids[i];
    else nearest[i] = std::numeric_limits<double>::infinity();
  }
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const std::size_t i = owners_[s].site;
    if (nearest[i] < 0) continue;
    const double away = squared_norm(samples_[s] - centroids[i]);
    if (away >= nearest[i]) continue;
    nearest[i] = away;
    sites_[i].at = samples_[s];
  }
}

// Where a ball has to stand on the ground, its height is given.
Point3 Spreader::at_own_height(Point3 point, std::size_t site) const {
  if (!on_ground_.empty() && on_ground_[site] != 0)
    point.z = bottom_ + std::min((1 - kFooting) * sites_[site].radius, (top_ - bottom_) / 2);
  return point;
}

Point3 Spreader::at_buildable_height(Point3 point, std::size_t site) const {
  const double clear = std::min(sites_[site].radius, (top_ - bottom_) / 2);
  point.z = std::clamp(point.z, bottom_ + clear, top_ - clear);
  return at_own_height(point, site);
}

// Neighbours that do not touch come nearer; each gives way by its share of the pull, the mean over its pairs.
void Spreader::attract(double strength) {
  std::vector<Vector3> pull(sites_.size());
  for (const auto& [a, b] : pairs_) {
    const Vector3 way = sites_[b].at - sites_[a].at;
    const double apart = norm(way), gap = apart - sites_[a].radius - sites_[b].radius;
    if (gap <= 0) continue;
    const Vector3 step = way * (strength * gap / apart);
    pull[a] += step / static_cast<double>(neighbours_[a].size());
    pull[b] -= step / static_cast<double>(neighbours_[b].size());
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const Point3 moved = sites_[i].at + 0.5 * pull[i];
    if (is_inside(moved)) sites_[i].at = moved;
  }
}

void Spreader::relax(double attraction) {
  assign();
  revive_hidden();
  move_to_centroids();
  if (attraction > 0 && !pairs_.empty()) attract(attraction);
  for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].at = at_buildable_height(sites_[i].at, i);
}

// Moves sites away from the nearest side until their ball fits, or as far as that helps.
void Spreader::keep_clear() {
  const auto clearance = [&](const Point3& point) {
    const Point3 side = nearest_side(point);
    return norm(Vector3{point.x - side.x, point.y - side.y, 0});
  };
  for (BallSite& site : sites_) {
    double step = 1;
    for (int k = 0; k < 12; ++k) {
      const Point3 side = nearest_side(site.at);
      const Vector3 inward{site.at.x - side.x, site.at.y - side.y, 0};
      const double clear = norm(inward);
      if (clear >= site.radius || clear == 0) break;
      const Point3 moved = site.at + inward * (step * (site.radius - clear) / clear);
      if (is_inside(moved) && clearance(moved) > clear) site.at = moved;
      else step /= 2;
    }
  }
}

// Points that ended too close to an earlier one move to the loneliest of some samples: balls of that size around all points
// cover less than two hundredths of the prism, so that nearly every sample is free.
void Spreader::separate() {
  const double limit = kSpreadSeparation * spacing_ * 1.01;
  const BallGrid grid(sites_, spacing_);
  std::vector<std::size_t> crowded;
  for (std::size_t i = 0; i < sites_.size(); ++i)
    if (grid.crowded(i, limit) || !is_inside(sites_[i].at)) crowded.push_back(i);
  const std::size_t stride = std::max<std::size_t>(1, samples_.size() / kSpareSamples);
  for (const std::size_t i : crowded) {
    double best = -1;
    Point3 at = sites_[i].at;
    for (std::size_t s = i % stride; s < samples_.size(); s += stride) {
      const Point3 free = at_own_height(samples_[s], i);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < sites_.size(); ++j)
        if (j != i) nearest = std::min(nearest, squared_norm(free - sites_[j].at));
      if (nearest > best) {
        best = nearest;
        at = free;
      }
    }
    sites_[i].at = at;
  }
}

Result<void> check(std::span<const Point3> plan, double bottom, double top, std::span<const double> volumes,
                   std::span<const std::pair<std::size_t, std::size_t>> pairs) {
  const bool finite = std::all_of(plan.begin(), plan.end(), [](const Point3& p) { return is_finite(p); });
  if (plan.size() < 3 || !finite || geometry::find_self_crossing(plan) || !(std::abs(geometry::signed_area(plan)) > 0))
    return Error{ErrorCode::geometry, "plan", "The plan must be a simple polygon of at least 3 finite points with an area."};
  if (!(top > bottom) || !std::isfinite(top - bottom))
    return Error{ErrorCode::out_of_range, "plan",
                 "The top (" + shortest(top) + " m) must lie above the bottom (" + shortest(bottom) + " m)."};
  for (std::size_t i = 0; i < volumes.size(); ++i)
    if (!(volumes[i] > 0) || !std::isfinite(volumes[i]))
      return Error{ErrorCode::out_of_range, "volumes/" + std::to_string(i),
                   "The demand is " + shortest(volumes[i]) + " m³. It must be greater than zero and finite."};
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs[k].first >= volumes.size() || pairs[k].second >= volumes.size() || pairs[k].first == pairs[k].second)
      return Error{ErrorCode::not_found, "neighbours/" + std::to_string(k),
                   "The pair (" + std::to_string(pairs[k].first) + ", " + std::to_string(pairs[k].second) +
                       ") must name two different points of " + std::to_string(volumes.size()) + ", counted from 0."};
  return {};
}

}  // namespace

Result<std::vector<Point3>> spread_points(std::span<const Point3> plan, double bottom, double top,
                                          std::span<const double> volumes, std::uint64_t seed,
                                          std::span<const std::pair<std::size_t, std::size_t>> neighbours,
                                          std::span<const geometry::Ring> holes, std::span<const std::uint8_t> on_ground) {
  if (auto sound = check(plan, bottom, top, volumes, neighbours); !sound) return sound.error();
  if (!on_ground.empty() && on_ground.size() != volumes.size())
    return Error{ErrorCode::out_of_range, "on_ground",
                 "There are " + std::to_string(on_ground.size()) + " words on standing for " + std::to_string(volumes.size()) +
                     " points. Give one for each point, or none."};
  std::vector<geometry::Ring> rings{geometry::Ring(plan.begin(), plan.end())};
  for (std::size_t h = 0; h < holes.size(); ++h) {
    const std::string place = "holes/" + std::to_string(h);
    if (holes[h].size() < 3 || geometry::find_self_crossing(holes[h]))
      return Error{ErrorCode::geometry, place, "A hole must be a simple polygon of at least 3 points."};
    for (const geometry::Ring& ring : rings)
      if (geometry::find_crossing(ring, holes[h]))
        return Error{ErrorCode::geometry, place, "The hole must lie inside the plan and must not meet another hole."};
    if (!geometry::ring_contains(plan, holes[h].front()))
      return Error{ErrorCode::geometry, place, "The hole must lie inside the plan."};
    rings.push_back(holes[h]);
  }
  if (volumes.empty()) return std::vector<Point3>();
  return Spreader(std::move(rings), bottom, top, volumes, seed, neighbours, on_ground).run();
}

}  // namespace bl::making
