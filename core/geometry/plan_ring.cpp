// Ring geometry in plain doubles: rings come in local metres, where rounding stays far below a millimetre.
#include "core/geometry/plan_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bl {

namespace {

// Twice the signed area of the triangle a, b, c: positive where c lies left of a → b.
double turn(const Point3& a, const Point3& b, const Point3& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

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

struct Edge {
  Point3 from, to;
  std::size_t ring, index;
  double low, high;  // extent in x
};

void append_edges(std::vector<Edge>& edges, std::span<const Point3> ring, std::size_t which) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    edges.push_back({a, b, which, i, std::min(a.x, b.x), std::max(a.x, b.x)});
  }
}

// Sweeps along x over edges that overlap there, and asks `meet` for the wanted pairs; the first answer wins.
template <class Meet>
std::optional<Crossing> sweep(std::vector<Edge> edges, const Meet& meet) {
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.ring != b.ring ? a.ring < b.ring : a.index < b.index;
  });
  std::vector<const Edge*> active;
  for (const Edge& edge : edges) {
    std::erase_if(active, [&](const Edge* other) { return other->high < edge.low; });
    for (const Edge* other : active) {
      const bool other_first = other->ring != edge.ring ? other->ring < edge.ring : other->index < edge.index;
      const Edge &first = other_first ? *other : edge, &second = other_first ? edge : *other;
      if (const auto where = meet(first, second)) return Crossing{first.index, second.index, *where};
    }
    active.push_back(&edge);
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
  std::vector<Edge> edges;
  append_edges(edges, ring, 0);
  return sweep(std::move(edges), [count](const Edge& a, const Edge& b) -> std::optional<Point3> {
    const bool follows = b.index == a.index + 1, closes = a.index == 0 && b.index == count - 1;
    if (!follows && !closes) return meeting_point(a.from, a.to, b.from, b.to);
    // Neighbours share one point; they must not run back over each other.
    const Edge &before = follows ? a : b, &after = follows ? b : a;
    const Vector3 in = before.to - before.from, out = after.to - after.from;
    if (turn(before.from, before.to, after.to) == 0 && in.x * out.x + in.y * out.y < 0) return before.to;
    return std::nullopt;
  });
}

std::optional<Crossing> find_crossing(std::span<const Point3> a, std::span<const Point3> b) {
  std::vector<Edge> edges;
  append_edges(edges, a, 0);
  append_edges(edges, b, 1);
  return sweep(std::move(edges), [](const Edge& first, const Edge& second) -> std::optional<Point3> {
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

}  // namespace bl
