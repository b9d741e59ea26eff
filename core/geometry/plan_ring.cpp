// Ring geometry in plain doubles: rings come in local metres, where rounding stays far below a millimetre.
#include "core/geometry/plan_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bl::geometry {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

int sign(double number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

double plane_distance(const Point3& a, const Point3& b) {
  return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

Point3 nearest_on_segment(const Point3& a, const Point3& b, const Point3& point) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  if (squared == 0) return a;
  const double t = std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / squared, 0.0, 1.0);
  return {a.x + t * dx, a.y + t * dy, 0};
}

// Is c, known to be collinear with a and b, between them?
bool between(const Point3& a, const Point3& b, const Point3& c) {
  return std::min(a.x, b.x) <= c.x && c.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= c.y && c.y <= std::max(a.y, b.y);
}

std::optional<Point3> meeting_point(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double from_a = turn(c, d, a), from_b = turn(c, d, b);
  const int sa = sign(from_a), sb = sign(from_b), sc = sign(turn(a, b, c)), sd = sign(turn(a, b, d));
  if (sa * sb < 0 && sc * sd < 0) {
    const double t = from_a / (from_a - from_b);
    return Point3{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0};
  }
  if (sc == 0 && between(a, b, c)) return Point3{c.x, c.y, 0};
  if (sd == 0 && between(a, b, d)) return Point3{d.x, d.y, 0};
  if (sa == 0 && between(c, d, a)) return Point3{a.x, a.y, 0};
  if (sb == 0 && between(c, d, b)) return Point3{b.x, b.y, 0};
  return std::nullopt;
}

struct SweepEdge {
  Point3 from, to;
  std::size_t ring, index;
  double low = 0, high = 0, bottom = 0, top = 0;  // extents along the sweep and across it
};

struct Extent {
  double west = kFar, east = -kFar, south = kFar, north = -kFar;
};

Extent extent_of(std::span<const Point3> ring) {
  Extent extent;
  for (const Point3& p : ring) {
    extent.west = std::min(extent.west, p.x), extent.east = std::max(extent.east, p.x);
    extent.south = std::min(extent.south, p.y), extent.north = std::max(extent.north, p.y);
  }
  return extent;
}

// The edges of a ring that reach into `within`.
void append_edges(std::vector<SweepEdge>& edges, std::span<const Point3> ring, std::size_t which, const Extent& within) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (std::max(a.x, b.x) < within.west || std::min(a.x, b.x) > within.east || std::max(a.y, b.y) < within.south ||
        std::min(a.y, b.y) > within.north)
      continue;
    edges.push_back({a, b, which, i});
  }
}

// Fills in the extents. Few edges are swept along x; many along the direction that most of their length has, since edges that
// lie side by side then lie far apart across it.
void lay_out(std::vector<SweepEdge>& edges) {
  constexpr std::size_t kMany = 1024;
  double east = 1, north = 0, slack = 0;
  if (edges.size() > kMany) {
    double twice_cos = 0, twice_sin = 0, farthest = 0;  // of twice the angle, so that there and back are one direction
    for (const SweepEdge& edge : edges) {
      const double x = edge.to.x - edge.from.x, y = edge.to.y - edge.from.y;
      twice_cos += x * x - y * y;
      twice_sin += 2 * x * y;
      farthest = std::max({farthest, std::abs(edge.to.x), std::abs(edge.to.y)});
    }
    const double length = std::sqrt(twice_cos * twice_cos + twice_sin * twice_sin);
    if (length > 0 && std::isfinite(length)) {
      east = std::sqrt(std::max(0.0, (1 + twice_cos / length) / 2));
      north = std::copysign(std::sqrt(std::max(0.0, (1 - twice_cos / length) / 2)), twice_sin);
      slack = 1e-12 * farthest;  // edges that touch must not be rounded apart
    }
  }
  for (SweepEdge& edge : edges) {
    const double u = edge.from.x * east + edge.from.y * north, v = edge.from.y * east - edge.from.x * north;
    const double to_u = edge.to.x * east + edge.to.y * north, to_v = edge.to.y * east - edge.to.x * north;
    edge.low = std::min(u, to_u) - slack, edge.high = std::max(u, to_u) + slack;
    edge.bottom = std::min(v, to_v) - slack, edge.top = std::max(v, to_v) + slack;
  }
}

// Open edges of a sweep, by number, on shelves across it: an edge lies on each shelf that it reaches.
class EdgeBuckets {
 public:
  explicit EdgeBuckets(const std::vector<SweepEdge>& edges) : edges_(edges), asked_(edges.size(), edges.size()) {
    double top = -kFar;
    for (const SweepEdge& edge : edges) bottom_ = std::min(bottom_, edge.bottom), top = std::max(top, edge.top);
    const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(edges.size()))), 1, 1024);
    shelves_.resize(count);
    per_metre_ = top > bottom_ ? static_cast<double>(count) / (top - bottom_) : 0;
  }

  // Hands the edge to those that are open beside it, and opens it. `ask(number)` says whether they meet; of those that do, the
  // first one of the sweep is the answer, else the edge itself.
  template <class Ask>
  std::size_t open(std::size_t number, const Ask& ask) {
    const SweepEdge& edge = edges_[number];
    std::size_t best = number;
    for (std::size_t s = at(edge.bottom); s <= at(edge.top); ++s) {
      std::erase_if(shelves_[s], [&](std::size_t other) { return edges_[other].high < edge.low; });
      for (const std::size_t other : shelves_[s]) {
        if (other >= best || asked_[other] == number) continue;
        asked_[other] = number;
        if (edges_[other].top < edge.bottom || edges_[other].bottom > edge.top) continue;
        if (ask(other)) best = other;
      }
      shelves_[s].push_back(number);
    }
    return best;
  }

 private:
  std::size_t at(double across) const {
    const double place = (across - bottom_) * per_metre_;
    return place > 0 ? std::min(static_cast<std::size_t>(place), shelves_.size() - 1) : 0;
  }

  const std::vector<SweepEdge>& edges_;
  std::vector<std::size_t> asked_;  // who asked an edge last
  std::vector<std::vector<std::size_t>> shelves_;
  double bottom_ = kFar, per_metre_ = 0;
};

// Sweeps over edges that overlap, and asks `meet` for the wanted pairs; the first answer wins.
template <class Meet>
std::optional<Crossing> sweep(std::vector<SweepEdge> edges, const Meet& meet) {
  lay_out(edges);
  std::sort(edges.begin(), edges.end(), [](const SweepEdge& a, const SweepEdge& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.ring != b.ring ? a.ring < b.ring : a.index < b.index;
  });
  EdgeBuckets shelves(edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::optional<Crossing> found;
    shelves.open(i, [&](std::size_t k) {
      const SweepEdge &edge = edges[i], &other = edges[k];
      const bool other_first = other.ring != edge.ring ? other.ring < edge.ring : other.index < edge.index;
      const SweepEdge &first = other_first ? other : edge, &second = other_first ? edge : other;
      const auto where = meet(first, second);
      if (where) found = Crossing{first.index, second.index, *where};
      return where.has_value();
    });
    if (found) return found;
  }
  return std::nullopt;
}

}  // namespace

double signed_area(std::span<const Point3> ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += turn(ring[0], ring[i], ring[i + 1]);
  return twice / 2;
}

double perimeter(std::span<const Point3> ring) {
  double length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) length += plane_distance(ring[i], ring[(i + 1) % ring.size()]);
  return length;
}

bool ring_contains(std::span<const Point3> ring, const Point3& point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point3 &a = ring[i], &b = ring[j];
    if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

Point3 nearest_on_ring(std::span<const Point3> ring, const Point3& point) {
  Point3 best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 candidate = nearest_on_segment(ring[i], ring[(i + 1) % ring.size()], point);
    const double away = (candidate.x - point.x) * (candidate.x - point.x) + (candidate.y - point.y) * (candidate.y - point.y);
    if (away < best_distance) {
      best_distance = away;
      best = candidate;
    }
  }
  return best;
}

std::optional<Crossing> find_self_crossing(std::span<const Point3> ring) {
  const std::size_t count = ring.size();
  std::vector<SweepEdge> edges;
  append_edges(edges, ring, 0, extent_of(ring));
  return sweep(std::move(edges), [count](const SweepEdge& a, const SweepEdge& b) -> std::optional<Point3> {
    const bool follows = b.index == a.index + 1, closes = a.index == 0 && b.index == count - 1;
    if (!follows && !closes) return meeting_point(a.from, a.to, b.from, b.to);
    // Neighbours share one point; they must not run back over each other.
    const SweepEdge &before = follows ? a : b, &after = follows ? b : a;
    const Vector3 in = before.to - before.from, out = after.to - after.from;
    if (turn(before.from, before.to, after.to) == 0 && in.x * out.x + in.y * out.y < 0) return before.to;
    return std::nullopt;
  });
}

std::optional<Crossing> find_crossing(std::span<const Point3> a, std::span<const Point3> b) {
  std::vector<SweepEdge> edges;
  append_edges(edges, a, 0, extent_of(b));
  append_edges(edges, b, 1, extent_of(a));
  return sweep(std::move(edges), [](const SweepEdge& first, const SweepEdge& second) -> std::optional<Point3> {
    if (first.ring == second.ring) return std::nullopt;
    return meeting_point(first.from, first.to, second.from, second.to);
  });
}

Ring hull_of_plan(std::span<const Point3> points) {
  Ring sorted(points.begin(), points.end());
  for (Point3& point : sorted) point.z = 0;
  std::sort(sorted.begin(), sorted.end(), [](const Point3& a, const Point3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  Ring hull;
  const auto add = [&hull](const Point3& point, std::size_t keep) {
    while (hull.size() >= keep + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
    hull.push_back(point);
  };
  for (const Point3& point : sorted) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) add(sorted[i], lower);
  hull.pop_back();
  return hull;
}

double depth_below_hull(std::span<const Point3> ring, std::span<const Point3> hull) {
  double deepest = 0;
  for (const Point3& point : ring) deepest = std::max(deepest, plane_distance(point, nearest_on_ring(hull, point)));
  return deepest;
}

}  // namespace bl::geometry
