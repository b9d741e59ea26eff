// Ear clipping in plain doubles: quadratic in the number of corners, which footprints and façades have few of.
#include "core/geometry/polygon_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bl::geometry {

namespace {

double squared_plane_distance(const Point3& a, const Point3& b) { return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y); }

// Outer rings run counter-clockwise, holes clockwise; rings of no area stay as they are.
bool is_turned(const Ring& ring, std::size_t number) { return number == 0 ? signed_area(ring) < 0 : signed_area(ring) > 0; }

using Loop = std::vector<std::uint32_t>;

class Clipping {
 public:
  explicit Clipping(std::span<const Ring> rings) {
    for (const Ring& ring : rings) points_.insert(points_.end(), ring.begin(), ring.end());
  }

  std::vector<std::array<std::uint32_t, 3>> run(std::span<const Ring> rings) {
    std::vector<Loop> holes;
    std::uint32_t first = 0;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      Loop loop(rings[r].size());
      std::iota(loop.begin(), loop.end(), first);
      first += static_cast<std::uint32_t>(rings[r].size());
      if (is_turned(rings[r], r)) std::reverse(loop.begin(), loop.end());
      if (r == 0) loop_ = std::move(loop);
      else if (loop.size() >= 3) holes.push_back(std::move(loop));
    }
    if (loop_.size() < 3) return {};
    // The rightmost hole first: its bridge to the outside cannot run through another one that is bridged later.
    std::sort(holes.begin(), holes.end(), [this](const Loop& a, const Loop& b) {
      const double right_a = points_[rightmost(a)].x, right_b = points_[rightmost(b)].x;
      return right_a != right_b ? right_a > right_b : a.front() < b.front();
    });
    while (!holes.empty()) {
      const Loop hole = holes.front();
      holes.erase(holes.begin());
      join(hole, holes);
    }
    clip();
    return std::move(triangles_);
  }

 private:
  std::uint32_t rightmost(const Loop& loop) const {
    return *std::max_element(loop.begin(), loop.end(), [this](std::uint32_t a, std::uint32_t b) {
      return points_[a].x != points_[b].x ? points_[a].x < points_[b].x : points_[a].y < points_[b].y;
    });
  }

  bool crosses(const Loop& loop, const Point3& from, const Point3& to) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point3 &a = points_[loop[i]], &b = points_[loop[(i + 1) % loop.size()]];
      if (turn(a, b, from) * turn(a, b, to) < 0 && turn(from, to, a) * turn(from, to, b) < 0) return true;
      // Through a corner.
      if (turn(from, to, a) == 0 && a != from && a != to && dot(a - from, a - to) < 0) return true;
    }
    return false;
  }

  // Does the way to `to` leave corner i of a loop into the polygon?
  bool leads_inside(const Loop& loop, std::size_t i, const Point3& to) const {
    const Point3 &before = points_[loop[(i + loop.size() - 1) % loop.size()]], &here = points_[loop[i]],
                 &after = points_[loop[(i + 1) % loop.size()]];
    if (turn(before, here, after) >= 0) return turn(before, here, to) >= 0 && turn(here, after, to) >= 0;
    return turn(before, here, to) >= 0 || turn(here, after, to) >= 0;
  }

  // The hole becomes part of the loop by a bridge to the nearest corner that can be seen from its rightmost one.
  void join(const Loop& hole, const std::vector<Loop>& others) {
    const std::uint32_t start = rightmost(hole);
    const auto begin = std::find(hole.begin(), hole.end(), start);
    const auto begins = static_cast<std::size_t>(begin - hole.begin());
    std::vector<std::size_t> order(loop_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return squared_plane_distance(points_[loop_[a]], points_[start]) <
             squared_plane_distance(points_[loop_[b]], points_[start]);
    });
    const auto seen = std::find_if(order.begin(), order.end(), [&](std::size_t i) {
      const Point3 &from = points_[start], &to = points_[loop_[i]];
      return leads_inside(loop_, i, from) && leads_inside(hole, begins, to) && !crosses(loop_, from, to) &&
             !crosses(hole, from, to) &&
             std::none_of(others.begin(), others.end(), [&](const Loop& other) { return crosses(other, from, to); });
    });
    const std::size_t at = seen == order.end() ? order.front() : *seen;
    Loop bridge(begin, hole.end());
    bridge.insert(bridge.end(), hole.begin(), begin);
    bridge.push_back(start);
    bridge.push_back(loop_[at]);
    loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(at) + 1, bridge.begin(), bridge.end());
  }

  bool is_ear(std::size_t i) {
    const std::size_t count = loop_.size();
    const std::uint32_t ia = loop_[(i + count - 1) % count], ib = loop_[i], ic = loop_[(i + 1) % count];
    const Point3 &a = points_[ia], &b = points_[ib], &c = points_[ic];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t k = 0; k < count; ++k, ++steps_) {
      const std::uint32_t id = loop_[k];
      const Point3& p = points_[id];
      // Corners at the same place (the two ends of a bridge) are on its rim, not in it.
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    // A side from the other end of a bridge may begin at a corner of the ear and run right through it.
    steps_ += count;
    return !crosses(loop_, a, c);
  }

  void clip() {
    std::size_t i = 0, tried = 0;
    // Rings that cross themselves could ask for a cubic number of steps; no sound ring comes near this.
    const std::size_t most = 1000000 + 40 * loop_.size() * loop_.size();
    while (loop_.size() > 3) {
      // Degenerate: any corner, so that the mesh stays closed.
      const bool is_forced = tried >= loop_.size() || steps_ > most;
      if (!is_forced && !is_ear(i)) {
        i = (i + 1) % loop_.size();
        ++tried;
        continue;
      }
      const std::size_t count = loop_.size();
      add(loop_[(i + count - 1) % count], loop_[i], loop_[(i + 1) % count]);
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(i));
      i = i % loop_.size();
      tried = 0;
    }
    add(loop_[0], loop_[1], loop_[2]);
  }

  // There and back along a bridge is no triangle, and its edges cancel each other out.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }

  std::vector<Point3> points_;
  std::size_t steps_ = 0;
  Loop loop_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> polygon_triangles(std::span<const Ring> rings) { return Clipping(rings).run(rings); }

Mesh prism_mesh(const Ring& outer, std::span<const Ring> holes, double bottom, double top) {
  std::vector<Ring> rings{outer};
  rings.insert(rings.end(), holes.begin(), holes.end());
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (is_turned(rings[r], r)) std::reverse(rings[r].begin(), rings[r].end());
  Mesh mesh;
  for (const double height : {bottom, top})
    for (const Ring& ring : rings)
      for (const Point3& corner : ring) mesh.vertices.push_back({corner.x, corner.y, height});
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size() / 2);
  for (const auto& [a, b, c] : polygon_triangles(rings)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  std::uint32_t first = 0;
  for (const Ring& ring : rings) {
    const auto size = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % size;
      mesh.triangles.push_back({a, b, b + count});
      mesh.triangles.push_back({a, b + count, a + count});
    }
    first += size;
  }
  return mesh;
}

}  // namespace bl::geometry
