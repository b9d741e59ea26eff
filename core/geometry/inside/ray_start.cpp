// Newton steps with cells that are looked at along rays, and room made for those that are left without.
#include "core/geometry/inside/ray_start.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/geometry/inside/careful_growth.h"
#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/ray_cell.h"
#include "core/geometry/inside/site_grid.h"

namespace bl::geometry {

namespace {

constexpr int kSteps = 3;
// Sweeps over the linear system of a step: it need not be solved better than the rays know it.
constexpr int kSweeps = 12;
// A step leaves at least this share of r³, and at most its inverse.
constexpr double kLeastOfRayCube = 0.2;
// Of a cell less than this is reckoned as this, when it is asked how much it should grow.
constexpr double kLeastRayShare = 1e-3;
// Sites nearer to each other than this share of the domain's size are one place, and do not know each other.
constexpr double kSamePlace = 1e-6;
// Cells that are made one after the other by one thread, their rows side by side.
constexpr std::size_t kRaysAtATime = 128;
// Fewer sites are quickly done from any start. Where less than a tenth of the domain is left free, cells have nothing but each
// other to be cut by, and rays lead astray as often as not.
constexpr std::size_t kFewSites = 8;
constexpr double kMostFill = 0.9;
// A demand below this share of the mean is beyond what single precision holds of its cell.
constexpr double kLeastDemand = 1e-12;
// A ball counts as near to others if it meets them with this many times the weight that it begins with, or would begin with if
// all demands were like its own. It may grow beyond that; then it does not see all that it meets.
constexpr double kWidening = 1.2;
// So many times the pairs of balls that meet where sites are spread evenly, and they are not; so many times that in one chunk,
// and it is not worth while to count on.
constexpr double kCrowded = 1.6, kCrowdedChunk = 8 * kCrowded;
// Room is made in rounds, as who gets it may take it from others; they end after so many looks per site.
constexpr std::size_t kMostLooks = 3;

// Of the entries of a chunk those of one cell: how its volume follows its neighbours' weights, and who is near.
struct Row {
  std::uint32_t first = 0, end = 0, first_near = 0, end_near = 0;
};
struct RowChunk {
  RayResponse response;
  std::vector<std::uint32_t> near;
  double expected = 0;  // entries, if sites were spread evenly
  bool is_crowded = false;
};

class RayFit {
 public:
  RayFit(const ConvexDomain& domain, std::span<const PowerSite> sites, std::span<const double> demands, ThreadPool* pool)
      : pool_(pool), scene_{domain, {}, {}, {}} {
    std::vector<std::uint32_t> all(sites.size());
    std::iota(all.begin(), all.end(), 0u);
    const double sum = std::accumulate(demands.begin(), demands.end(), 0.0);
    const double mean = weight_of_volume(sum / static_cast<double>(all.size()));
    std::vector<PowerSite> wide(sites.begin(), sites.end());
    for (const std::uint32_t i : all) {
      wide[i].weight = kWidening * sites[i].weight * std::max(1.0, weight_of_volume(demands[i]) / mean);
    }
    grid_.build(wide, all);
    if (grid_.is_uneven()) return;
    for (const std::uint32_t i : grid_.order()) {
      scene_.sites.push_back(sites[i]);
      scene_.demand.push_back(demands[i]);
      scene_.ball.push_back(std::sqrt(weight_of_volume(demands[i])));
      weight_.push_back(sites[i].weight);
    }
    volume_.resize(all.size());
    response_.resize(all.size());
    row_.resize(all.size());
    chunk_.resize((all.size() + kRaysAtATime - 1) / kRaysAtATime);
    is_even_ = find_all_near(wide);
  }

  // Are sites spread evenly enough for this to be worth while?
  bool is_even() const { return is_even_; }

  void run() {
    for (int step = 0; step < kSteps; ++step) {
      look_at_all();
      move();
      show_weights();
    }
    make_room();
  }

  std::vector<double> weights() const {
    std::vector<double> weights(weight_.size());
    for (std::size_t p = 0; p < weights.size(); ++p) weights[grid_.order()[p]] = weight_[p];
    return weights;
  }

 private:
  template <class Body>
  void for_each_chunk(std::size_t count, const Body& body) {
    if (pool_ != nullptr) return pool_->for_each_chunk(count, kRaysAtATime, body);
    for (std::size_t begin = 0; begin < count; begin += kRaysAtATime) body(begin, std::min(count, begin + kRaysAtATime));
  }

  void show_weights() {
    for (std::size_t p = 0; p < weight_.size(); ++p) scene_.sites[p].weight = weight_[p];
  }

  RayCell::Near near(std::uint32_t p) const {
    return std::span(chunk_[p / kRaysAtATime].near).subspan(row_[p].first_near, row_[p].end_near - row_[p].first_near);
  }

  // Whose balls meet, as wide as they may become. False where many more do than would if the sites were spread evenly: on a line
  // or in a plane, and in clusters.
  bool find_all_near(std::span<const PowerSite> wide) {
    double mean = 0, least = wide[0].weight;
    for (const PowerSite& site : wide) {
      mean += std::sqrt(site.weight) / static_cast<double>(wide.size());
      least = std::min(least, site.weight);
    }
    const double others = static_cast<double>(wide.size() - 1), per_volume = others / scene_.domain.volume;
    for_each_chunk(wide.size(), [&](std::size_t begin, std::size_t end) {
      RowChunk& rows = chunk_[begin / kRaysAtATime];
      for (std::size_t p = begin; p < end; ++p) {
        const double reach = std::sqrt(wide[grid_.order()[p]].weight) + mean;
        rows.expected += std::min(others, 4 * std::numbers::pi / 3 * reach * reach * reach * per_volume);
      }
      for (std::size_t p = begin; p < end && !rows.is_crowded; ++p) {
        find_near(static_cast<std::uint32_t>(p), wide[grid_.order()[p]].weight, least, rows.near);
        rows.is_crowded = static_cast<double>(rows.near.size()) > kCrowdedChunk * rows.expected;
      }
    });
    double meet = 0, expected = 0;
    for (const RowChunk& rows : chunk_) {
      if (rows.is_crowded) return false;
      meet += static_cast<double>(rows.near.size());
      expected += rows.expected;
    }
    return meet <= kCrowded * expected;
  }

  // The search is for planes that come near, and so passes over sites deep within the ball; not so with the least weight of all.
  void find_near(std::uint32_t p, double weight, double least, std::vector<std::uint32_t>& near) {
    const double radius = std::sqrt(weight), same = kSamePlace * scene_.domain.size();
    const Point3& at = scene_.sites[p].position;
    row_[p].first_near = static_cast<std::uint32_t>(near.size());
    grid_.search(
        at, least, grid_.order()[p], {}, [&] { return radius; },
        [&](const SiteGrid::Entry& entry) {
          const double squared = squared_norm(entry.position - at), sum = squared + (weight - entry.weight);
          const bool meets = squared < weight || sum < 0 || sum * sum < 4 * squared * weight;
          if (meets && squared > same * same) near.push_back(grid_.place_of(entry.site));
        });
    row_[p].end_near = static_cast<std::uint32_t>(near.size());
  }

  // Reads what was seen, writes weights, volumes and rows: cells do not see what others do at the same time.
  void look_at_all() {
    for_each_chunk(weight_.size(), [&](std::size_t begin, std::size_t end) {
      RowChunk& rows = chunk_[begin / kRaysAtATime];
      rows.response.column.clear();
      rows.response.value.clear();
      RayCell cell(scene_);
      for (auto p = static_cast<std::uint32_t>(begin); p < end; ++p) {
        weight_[p] = cell.look(p, near(p));
        row_[p].first = static_cast<std::uint32_t>(rows.response.column.size());
        const RayCell::Measure seen = cell.measure(rows.response);
        row_[p].end = static_cast<std::uint32_t>(rows.response.column.size());
        volume_[p] = seen.volume;
        response_[p] = seen.response;
      }
    });
  }

  // Room for all cells; whom that has cost room himself is looked at again. That need not end: then it ends here, and the fit
  // will see who has been left without a cell.
  void make_room() {
    std::vector<std::uint32_t> looked(weight_.size());
    std::iota(looked.begin(), looked.end(), 0u);
    for (std::size_t looks = 0; looks <= kMostLooks * weight_.size(); looks += looked.size()) {
      for_each_chunk(looked.size(), [&](std::size_t begin, std::size_t end) {
        RayCell cell(scene_);
        for (std::size_t k = begin; k < end; ++k) {
          const std::uint32_t p = looked[k];
          if (!cell.has_room(p, near(p))) weight_[p] = cell.look(p, near(p));
        }
      });
      std::vector<std::uint32_t> again;
      for (std::uint32_t p = 0; p < weight_.size(); ++p) {
        if (weight_[p] != scene_.sites[p].weight) again.insert(again.end(), near(p).begin(), near(p).end());
      }
      show_weights();
      if (again.empty()) return;
      std::sort(again.begin(), again.end());
      again.erase(std::unique(again.begin(), again.end()), again.end());
      looked = std::move(again);
    }
  }

  void move() {
    const std::vector<double> wanted = changes_towards(scene_.demand, volume_, true, kLeastRayShare);
    std::vector<double> change(wanted.size(), 0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t p = 0; p < change.size(); ++p) {
        if (!(response_[p] > 0)) continue;
        const RayResponse& others = chunk_[p / kRaysAtATime].response;
        double sum = wanted[p];
        for (std::uint32_t k = row_[p].first; k < row_[p].end; ++k) sum += others.value[k] * change[others.column[k]];
        change[p] = sum / response_[p];
      }
    }
    for (std::size_t p = 0; p < change.size(); ++p) {
      if (!std::isfinite(change[p])) continue;
      const double cube = cube_of_radius(weight_[p]), moved = cube + 1.5 * std::sqrt(weight_[p]) * change[p];
      weight_[p] = weight_of_cube(std::clamp(moved, kLeastOfRayCube * cube, cube / kLeastOfRayCube));
    }
  }

  ThreadPool* pool_;
  SiteGrid grid_;
  bool is_even_ = false;
  // By place in the grid.
  RayScene scene_;
  std::vector<double> weight_, volume_, response_;
  std::vector<Row> row_;
  std::vector<RowChunk> chunk_;
};

}  // namespace

std::vector<double> weights_by_rays(const Domain& domain, std::span<const PowerSite> sites, std::vector<double> weights,
                                    std::span<const double> demands, ThreadPool* pool) {
  if (!domain.is_convex() || sites.size() < kFewSites) return weights;
  double sum = 0, least = demands[0];
  std::vector<PowerSite> start(sites.begin(), sites.end());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    // Weights that differ were made so for a reason: sites that crowd or lie outside.
    if (!(weights[i] > 0) || weights[i] != weights[0]) return weights;
    start[i].weight = weights[i];
    sum += demands[i];
    least = std::min(least, demands[i]);
  }
  if (sum > kMostFill * domain.volume || !(least > 0) || least < kLeastDemand * sum / static_cast<double>(sites.size())) {
    return weights;
  }
  RayFit fit(domain.largest_piece(), start, demands, pool);
  if (!fit.is_even()) return weights;
  fit.run();
  return fit.weights();
}

}  // namespace bl::geometry
