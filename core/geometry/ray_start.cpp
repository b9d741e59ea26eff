// Cells along rays: what planes cut off each ray from a point of the cell, and Newton steps with the sums of that.
#include "core/geometry/ray_start.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/geometry/fit_numbers.h"
#include "core/geometry/ray_cast.h"
#include "core/geometry/site_grid.h"

namespace bl {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr int kSteps = 3;
// Sweeps over the linear system of a step: it need not be solved better than the rays know it.
constexpr int kSweeps = 8;
// A step leaves at least this share of r³, and at most its inverse.
constexpr double kLeastOfCube = 0.2;
// A cell is looked at from a point that has this share of the demanded ball's radius around it, where it has one: at the site
// itself, or not far from it.
constexpr double kRoomToLook = 0.3;
constexpr int kMostMoves = 30;
// A cell that has no room for a ball of this share of that radius gets it: Newton has nothing to go by in an empty cell.
constexpr double kLeastRoom = 0.15;
// It need not become larger for that than this share of its demand; found by so many halvings.
constexpr double kEnoughShare = 0.5;
constexpr int kHalvings = 8;
// A plane nearer than this counts as that near: the sums divide by it.
constexpr double kLeastDistance = 1e-3;
// Of a cell less than this is reckoned as this, when it is asked how much it should grow.
constexpr double kLeastShare = 1e-3;
// Sites nearer to each other than this share of the domain's size are one place, and do not know each other.
constexpr double kSamePlace = 1e-6;
// Cells that are made one after the other by one thread, their rows side by side.
constexpr std::size_t kChunk = 128;
// Fewer sites are quickly done from any start. Where less than a tenth of the domain is left free, cells have nothing but each
// other to be cut by, and rays lead astray as often as not.
constexpr std::size_t kFewSites = 8;
constexpr double kMostFill = 0.9;
// A ball may come to this many times the weight that it begins with, or would begin with if all demands were like its own.
constexpr double kWidening = 1.2;
// So many times the pairs of balls that meet where sites are spread evenly, and they are not.
constexpr double kCrowded = 1.6;
// Rounds of making room: who gets it may take it from others.
constexpr int kMostMends = 10;
// Two sites nearer than this share of a ball have only a sliver between being swallowed and swallowing, which rays miss.
constexpr double kNearPair = 1e-3;

// A plane that cuts a ball, relative to its site.
struct Cut {
  Vector3 normal;
  double offset;        // from the site
  double bond;          // twice the distance of the other site; 0: a side of the domain
  std::uint32_t place;  // of the other site
  double distance;      // from the point that is looked from
};
struct Cuts {
  std::vector<Cut> all;
  std::vector<float> area;
  double least = 0;  // of the offsets
};

// Of the entries of a chunk those of one cell: how its volume follows its neighbours' weights, and who may ever cut its ball.
struct Row {
  std::uint32_t first = 0, end = 0, first_near = 0, end_near = 0;
};
struct RowChunk {
  std::vector<std::uint32_t> column;
  std::vector<double> value;
  std::vector<std::uint32_t> near;
  bool has_near_pair = false;
};

class RayFit {
 public:
  RayFit(const ConvexDomain& domain, std::span<const PowerSite> sites, std::span<const double> demands, ThreadPool* pool)
      : domain_(domain), pool_(pool), sites_(sites.begin(), sites.end()) {
    std::vector<std::uint32_t> all(sites.size());
    double sum = 0;
    for (const double demand : demands) sum += demand;
    std::iota(all.begin(), all.end(), 0u);
    const double mean = weight_of_volume(sum / static_cast<double>(all.size()));
    std::vector<PowerSite> wide(sites.begin(), sites.end());
    for (const std::uint32_t i : all) {
      wide[i].weight = kWidening * sites[i].weight * std::max(1.0, weight_of_volume(demands[i]) / mean);
    }
    grid_.build(wide, all);
    if (grid_.is_uneven()) return;
    for (const std::uint32_t i : grid_.order()) {
      demand_.push_back(demands[i]);
      ball_.push_back(std::sqrt(weight_of_volume(demand_.back())));
      seen_.push_back(sites[i]);
      weight_.push_back(sites[i].weight);
    }
    volume_.resize(all.size());
    response_.resize(all.size());
    row_.resize(all.size());
    chunk_.resize((all.size() + kChunk - 1) / kChunk);
    for_each_chunk([&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) find_near(static_cast<std::uint32_t>(p), wide[grid_.order()[p]].weight);
    });
    is_even_ = !is_crowded(wide);
  }

  std::vector<double> run() {
    if (is_even_) {
      for (int step = 0; step < kSteps; ++step) {
        look_at_all(true);
        move();
        show_weights();
      }
      mend();
      const auto order = grid_.order();
      for (std::size_t p = 0; p < order.size(); ++p) sites_[order[p]].weight = weight_[p];
    }
    std::vector<double> weights;
    for (const PowerSite& site : sites_) weights.push_back(site.weight);
    return weights;
  }

 private:
  template <class Body>
  void for_each_chunk(const Body& body) {
    if (pool_ != nullptr) return pool_->for_each_chunk(sites_.size(), kChunk, body);
    for (std::size_t p = 0; p < sites_.size(); p += kChunk) body(p, std::min(sites_.size(), p + kChunk));
  }

  // Do many more balls meet than would if the sites were spread evenly? On a line or in a plane they do, and in clusters. Or do two
  // sites nearly stand in one place?
  bool is_crowded(std::span<const PowerSite> wide) const {
    std::size_t meet = 0;
    for (const RowChunk& rows : chunk_) {
      if (rows.has_near_pair) return true;
      meet += rows.near.size();
    }
    double mean = 0, sum = 0;
    for (const PowerSite& site : wide) mean += std::sqrt(site.weight) / static_cast<double>(wide.size());
    for (const PowerSite& site : wide) {
      const double reach = std::sqrt(site.weight) + mean;
      sum += reach * reach * reach;
    }
    const double expected = 4 * std::numbers::pi / 3 * sum * static_cast<double>(wide.size()) / domain_.volume;
    return static_cast<double>(meet) > kCrowded * expected;
  }

  void show_weights() {
    for (std::size_t p = 0; p < seen_.size(); ++p) seen_[p].weight = weight_[p];
  }

  // Whoever may ever cut the ball of a site: the balls as wide as they may become.
  void find_near(std::uint32_t p, double weight) {
    std::vector<std::uint32_t>& near = chunk_[p / kChunk].near;
    const double radius = std::sqrt(weight), same = kSamePlace * domain_.size();
    const Point3& at = seen_[p].position;
    row_[p].first_near = static_cast<std::uint32_t>(near.size());
    grid_.search(
        at, weight, grid_.order()[p], {}, [&] { return radius; },
        [&](const SiteGrid::Entry& entry) {
          const double gap = distance(at, entry.position);
          if (gap > same) near.push_back(grid_.place_of(entry.site));
          if (gap < kNearPair * radius && entry.site != grid_.order()[p]) chunk_[p / kChunk].has_near_pair = true;
        });
    row_[p].end_near = static_cast<std::uint32_t>(near.size());
  }

  // Reads what was seen, writes weights, volumes and rows: cells do not see what others do at the same time.
  void look_at_all(bool with_rays) {
    for_each_chunk([&](std::size_t begin, std::size_t end) {
      RowChunk& rows = chunk_[begin / kChunk];
      rows.column.clear();
      rows.value.clear();
      Cuts cuts;
      for (std::size_t p = begin; p < end; ++p) look_at(static_cast<std::uint32_t>(p), with_rays, cuts, rows);
    });
  }

  // Room for all cells; whom that has cost room himself is looked at again.
  void mend() {
    look_at_all(false);
    Cuts cuts;
    std::vector<std::uint32_t> again;
    for (int round = 0; round < kMostMends; ++round) {
      again.clear();
      for (std::size_t p = 0; p < seen_.size(); ++p) {
        if (weight_[p] == seen_[p].weight) continue;
        const auto& near = chunk_[p / kChunk].near;
        again.insert(again.end(), near.begin() + row_[p].first_near, near.begin() + row_[p].end_near);
      }
      show_weights();
      if (again.empty()) return;
      std::sort(again.begin(), again.end());
      again.erase(std::unique(again.begin(), again.end()), again.end());
      for (const std::uint32_t p : again) look_at(p, false, cuts, chunk_[p / kChunk]);
    }
    show_weights();
  }

  void look_at(std::uint32_t p, bool with_rays, Cuts& cuts, RowChunk& rows) {
    if (!with_rays && has_room(p, rows)) return;
    gather(p, rows, cuts);
    Point3 eye = place_to_look(p, cuts);
    make_room(p, eye, cuts);
    if (with_rays) measure(p, eye, cuts, rows);
  }

  // Around the site itself, as most have it: told without roots and lists.
  bool has_room(std::uint32_t p, const RowChunk& rows) const {
    const PowerSite& own = seen_[p];
    const double room = kRoomToLook * ball_[p], four_squares = 4 * room * room;
    if (own.weight < room * room) return false;
    for (const Plane& plane : domain_.planes) {
      if (plane.offset - dot(plane.normal, own.position) < room) return false;
    }
    for (std::uint32_t k = row_[p].first_near; k < row_[p].end_near; ++k) {
      const PowerSite& other = seen_[rows.near[k]];
      const double squared = squared_norm(other.position - own.position), sum = squared + (own.weight - other.weight);
      if (sum < 0 || sum * sum < four_squares * squared) return false;
    }
    return true;
  }

  void gather(std::uint32_t p, const RowChunk& rows, Cuts& cuts) const {
    cuts.all.clear();
    const PowerSite& own = seen_[p];
    const double radius = std::sqrt(own.weight);
    cuts.least = radius;
    for (const Plane& plane : domain_.planes) {
      const double offset = plane.offset - dot(plane.normal, own.position);
      if (offset < radius) cuts.all.push_back({plane.normal, offset, 0, kNone, offset});
      cuts.least = std::min(cuts.least, offset);
    }
    for (std::uint32_t k = row_[p].first_near; k < row_[p].end_near; ++k) {
      const PowerSite& other = seen_[rows.near[k]];
      const Vector3 to = other.position - own.position;
      const double squared = squared_norm(to), inverse = 1 / std::sqrt(squared),
                   offset = 0.5 * (squared + (own.weight - other.weight)) * inverse;
      if (!(offset < radius)) continue;
      cuts.all.push_back({inverse * to, offset, 2 * squared * inverse, rows.near[k], offset});
      cuts.least = std::min(cuts.least, offset);
    }
  }

  // A point with some room around it inside all planes and the ball: the site's own place, or one that the planes push it to
  // in turns. Sides of the domain have the last word, since weights cannot move them.
  Point3 place_to_look(std::uint32_t p, const Cuts& cuts) const {
    const double room = kRoomToLook * ball_[p], radius = std::sqrt(weight_[p]);
    Point3 eye;
    bool has_moved = cuts.least < room;
    for (int move = 0; move < kMostMoves && has_moved; ++move) {
      has_moved = false;
      for (std::size_t k = cuts.all.size(); k-- > 0;) {
        const double lack = room - (cuts.all[k].offset - dot(cuts.all[k].normal, eye));
        if (!(lack > 0)) continue;
        // A little more than it takes, or it would never end.
        eye += (-1.05 * lack) * cuts.all[k].normal;
        has_moved = true;
      }
      const double far = norm(eye);
      if (far > radius - room) eye *= std::max(0.0, radius - room) / far;
    }
    for (std::size_t k = 0; k < cuts.all.size() && has_moved; ++k) {
      const double lack = room - (cuts.all[k].offset - dot(cuts.all[k].normal, eye));
      if (cuts.all[k].bond == 0 && lack > 0) eye += -lack * cuts.all[k].normal;
    }
    return eye;
  }

  void look_from(const Point3& eye, Cuts& cuts) const {
    for (Cut& cut : cuts.all) cut.distance = cut.offset - dot(cut.normal, eye);
  }

  // Raises the weight of a cell without room until there is some, and moves the eye there. How much that takes depends on where
  // one looks from, so it may be far too much: of that as little as leaves the cell near its demand.
  void make_room(std::uint32_t p, Point3& eye, Cuts& cuts) {
    if (cuts.least >= kRoomToLook * ball_[p]) return;
    look_from(eye, cuts);
    const double room = kLeastRoom * ball_[p], far = norm(eye) + room, before = weight_[p];
    double high = std::max(0.0, far * far - before);
    for (const Cut& cut : cuts.all) high = std::max(high, cut.bond * (room - cut.distance));
    if (high > 0) {
      double low = 0;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        raise(p, before + middle, cuts);
        (is_worth_looking(p, cuts) ? high : low) = middle;
      }
      raise(p, before + high, cuts);
      eye = place_to_look(p, cuts);
      look_from(eye, cuts);
    }
    for (Cut& cut : cuts.all) cut.distance = std::max(cut.distance, kLeastDistance * ball_[p]);
  }

  void raise(std::uint32_t p, double weight, Cuts& cuts) {
    for (Cut& cut : cuts.all) cut.offset += cut.bond > 0 ? (weight - weight_[p]) / cut.bond : 0;
    weight_[p] = weight;
    cuts.least = 0;
  }

  bool is_worth_looking(std::uint32_t p, Cuts& cuts) const {
    const Point3 eye = place_to_look(p, cuts);
    look_from(eye, cuts);
    const auto is_away = [&](const Cut& cut) { return cut.distance > kLeastDistance * ball_[p]; };
    if (!std::all_of(cuts.all.begin(), cuts.all.end(), is_away) || squared_norm(eye) >= weight_[p]) return false;
    Hits hits;
    cast(p, eye, cuts, hits);
    const Hits::Parts parts = hits.parts(rays());
    double sum = 0;
    for (std::size_t d = 0; d < Rays::kCount; ++d) sum += static_cast<double>(parts.ahead[d] + parts.back[d]);
    return 4 * std::numbers::pi / 3 * sum * ball_[p] * ball_[p] * ball_[p] > kEnoughShare * demand_[p];
  }

  static const Rays& rays() {
    static const Rays made;
    return made;
  }

  void cast(std::uint32_t p, const Point3& eye, const Cuts& cuts, Hits& hits) const {
    const auto ball = static_cast<std::int32_t>(cuts.all.size());
    hits.begin_at_ball(rays(), (1 / ball_[p]) * eye, weight_[p] / (ball_[p] * ball_[p]), ball);
    for (std::int32_t k = 0; k < ball; ++k) {
      const Cut& cut = cuts.all[static_cast<std::size_t>(k)];
      hits.cut(rays(), (ball_[p] / cut.distance) * cut.normal, k);
    }
  }

  // With t the length of a ray and s its share of the sphere, the volume is the sum of (4π/3) s t³, and a facet's area over its
  // plane's distance from the eye that of 4π s t³ over the rays that end in it.
  void measure(std::uint32_t p, const Point3& eye, Cuts& cuts, RowChunk& rows) {
    Hits hits;
    cast(p, eye, cuts, hits);
    const auto ball = static_cast<std::int32_t>(cuts.all.size());
    cuts.area.assign(cuts.all.size() + 1, 0);
    float* const area = cuts.area.data();
    const Hits::Parts parts = hits.parts(rays());
    float sum = 0;
    for (std::size_t d = 0; d < Rays::kCount; ++d) {
      const std::int32_t here = hits.cut_ahead[d], there = hits.cut_back[d];
      sum += parts.ahead[d] + parts.back[d];
      area[here] += here == ball ? parts.ahead[d] * hits.own_ahead[d] : parts.ahead[d];
      area[there] += there == ball ? parts.back[d] * hits.own_back[d] : parts.back[d];
    }
    write_row(p, static_cast<double>(sum), cuts, rows);
  }

  void write_row(std::uint32_t p, double sum, const Cuts& cuts, RowChunk& rows) {
    constexpr double kFullAngle = 4 * std::numbers::pi;
    const double unit = ball_[p], cube = kFullAngle * unit * unit * unit;
    volume_[p] = cube / 3 * sum;
    double response = cube / (unit * unit) * static_cast<double>(cuts.area[cuts.all.size()]);
    row_[p].first = static_cast<std::uint32_t>(rows.column.size());
    for (std::size_t k = 0; k < cuts.all.size(); ++k) {
      const Cut& cut = cuts.all[k];
      if (!(cuts.area[k] > 0) || cut.bond == 0) continue;
      const double value = cube * static_cast<double>(cuts.area[k]) / (cut.distance * cut.bond);
      response += value;
      rows.column.push_back(cut.place);
      rows.value.push_back(value);
    }
    row_[p].end = static_cast<std::uint32_t>(rows.column.size());
    response_[p] = response;
  }

  // Growth is asked for by the 2/3 power of what is short, and the sum stays what it was, as in the fit itself.
  std::vector<double> wanted() const {
    std::vector<double> wanted(volume_.size());
    double lost = 0, total = 0;
    for (std::size_t p = 0; p < volume_.size(); ++p) {
      const double missing = demand_[p] - volume_[p];
      wanted[p] = missing;
      if (missing > 0) {
        const double volume = std::max(volume_[p], kLeastShare * demand_[p]), side = cube_root(demand_[p] / volume);
        wanted[p] = 1.5 * volume * (side * side - 1);
      }
      lost += missing - wanted[p];
      total += volume_[p];
    }
    for (std::size_t p = 0; p < volume_.size() && lost > 0 && total > 0; ++p) wanted[p] += lost / total * volume_[p];
    return wanted;
  }

  void move() {
    const std::vector<double> wanted = this->wanted();
    std::vector<double> change(wanted.size(), 0);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (std::size_t p = 0; p < change.size(); ++p) {
        if (!(response_[p] > 0)) continue;
        const RowChunk& rows = chunk_[p / kChunk];
        double sum = wanted[p];
        for (std::uint32_t k = row_[p].first; k < row_[p].end; ++k) sum += rows.value[k] * change[rows.column[k]];
        change[p] = sum / response_[p];
      }
    }
    for (std::size_t p = 0; p < change.size(); ++p) {
      const double cube = cube_of_radius(weight_[p]), moved = cube + 1.5 * std::sqrt(weight_[p]) * change[p];
      weight_[p] = weight_of_cube(std::clamp(moved, kLeastOfCube * cube, cube / kLeastOfCube));
    }
  }

  const ConvexDomain& domain_;
  ThreadPool* pool_;
  std::vector<PowerSite> sites_;
  SiteGrid grid_;
  bool is_even_ = false;
  // By place in the grid; what is seen are the weights of the step before.
  std::vector<PowerSite> seen_;
  std::vector<double> demand_, ball_, weight_, volume_, response_;
  std::vector<Row> row_;
  std::vector<RowChunk> chunk_;
};

}  // namespace

std::vector<double> weights_by_rays(const Domain& domain, std::span<const PowerSite> sites, std::vector<double> weights,
                                    std::span<const double> demands, ThreadPool* pool) {
  if (!domain.is_convex() || sites.size() < kFewSites) return weights;
  double sum = 0;
  std::vector<PowerSite> start(sites.begin(), sites.end());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    // Weights that differ were made so for a reason: sites that crowd or lie outside.
    if (!(demands[i] > 0) || !(weights[i] > 0) || weights[i] != weights[0]) return weights;
    start[i].weight = weights[i];
    sum += demands[i];
  }
  return sum <= kMostFill * domain.volume ? RayFit(domain.largest_piece(), start, demands, pool).run() : weights;
}

}  // namespace bl
