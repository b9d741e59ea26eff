// Faces grow from the largest triangles, whose planes are the best conditioned.
#include "core/geometry/inside/coplanar_groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/base/mathematics.h"
#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

// Corners within this share of the shape's size of a plane belong to the same face: the noise of rotated boxes.
constexpr double kCoplanarShare = 1e-11;
constexpr double kPlaneRounding = 0x1.0p-52;

using Triangle = std::array<std::uint32_t, 3>;

// Order of planes that small noise in the normals does not change: bottom first, then walls by direction, top last.
std::tuple<long long, long long, double> plane_key(const Plane& plane) {
  constexpr double kSteps = 1e9;
  const long long level = std::llround(plane.normal.z * kSteps);
  const double horizontal = std::sqrt(plane.normal.x * plane.normal.x + plane.normal.y * plane.normal.y);
  const long long east = std::llround(plane.normal.x * kSteps), north = std::llround(plane.normal.y * kSteps);
  if (horizontal < 1e-9 || (east == 0 && north == 0)) return {level, 0, plane.offset};
  double angle = mathematics::arc_tangent(static_cast<double>(north), static_cast<double>(east));
  if (angle < 0) angle += 2 * std::numbers::pi;
  return {level, std::llround(angle * kSteps), plane.offset};
}

class Grouper {
 public:
  Grouper(std::span<const Point3> points, std::span<const Triangle> triangles) : points_(points), triangles_(triangles) {
    Vector3 low = points[0], high = points[0];
    double largest = 0;
    for (const Point3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    tolerance_ = std::max(kCoplanarShare * distance(low, high), 8 * kPlaneRounding * largest);
  }

  CoplanarGroups run() {
    group_of_.assign(triangles_.size(), kNone);
    for (const std::uint32_t seed : by_area()) {
      if (group_of_[seed] == kNone) grow(seed);
    }
    std::vector<std::uint32_t> order(planes_.size()), number(planes_.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(plane_key(planes_[a]), a) < std::tuple(plane_key(planes_[b]), b);
    });
    CoplanarGroups groups;
    for (const std::uint32_t group : order) {
      number[group] = static_cast<std::uint32_t>(groups.planes.size());
      groups.planes.push_back(planes_[group]);
    }
    for (const std::uint32_t group : group_of_) groups.group_of.push_back(number[group]);
    return groups;
  }

 private:
  Vector3 area_vector(const Triangle& t) const {
    return 0.5 * cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
  }

  // Largest first: their planes are the best conditioned.
  std::vector<std::uint32_t> by_area() const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) order.emplace_back(-squared_norm(area_vector(triangles_[t])), t);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    for (const auto& entry : order) result.push_back(entry.second);
    return result;
  }

  std::uint32_t owner_of(std::uint32_t from, std::uint32_t to) {
    if (owners_.empty()) {
      for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (unsigned i = 0; i < 3; ++i) owners_.push_back({{triangles_[t][i], triangles_[t][(i + 1) % 3]}, t});
      }
      std::sort(owners_.begin(), owners_.end());
    }
    const std::pair<std::uint32_t, std::uint32_t> edge{from, to};
    const auto found = std::lower_bound(owners_.begin(), owners_.end(), std::pair{edge, 0u});
    return found != owners_.end() && found->first == edge ? found->second : kNone;
  }

  void grow(std::uint32_t seed) {
    const Vector3 area = area_vector(triangles_[seed]);
    const double size = norm(area);
    const Vector3 normal = size > 0 ? area / size : Vector3{0, 0, 1};
    const Point3 at = points_[triangles_[seed][0]];
    const auto lies_in = [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](std::uint32_t v) { return std::abs(dot(normal, points_[v] - at)) <= tolerance_; });
    };
    const std::uint32_t group = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back({normal, dot(normal, at)});
    std::vector<std::uint32_t> open{seed};
    group_of_[seed] = group;
    while (!open.empty()) {
      const Triangle t = triangles_[open.back()];
      open.pop_back();
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t other = owner_of(t[(i + 1) % 3], t[i]);
        if (other == kNone || group_of_[other] != kNone || !lies_in(triangles_[other])) continue;
        group_of_[other] = group;
        open.push_back(other);
      }
    }
  }

  std::span<const Point3> points_;
  std::span<const Triangle> triangles_;
  double tolerance_ = 0;
  std::vector<std::uint32_t> group_of_;
  std::vector<Plane> planes_;
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> owners_;
};

}  // namespace

CoplanarGroups coplanar_groups(std::span<const Point3> points, std::span<const std::array<std::uint32_t, 3>> triangles) {
  return Grouper(points, triangles).run();
}

}  // namespace bl::geometry
