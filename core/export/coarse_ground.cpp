// Lays a grid over the plan; of the places of each of its fields the one next to its middle is kept.
#include "core/export/coarse_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace bl::exporting {

namespace {

// Fields about the points of a grid that ends at the borders of the surface.
class GroundGrid {
 public:
  GroundGrid(const Point3& low, const Point3& high, double step) : low_(low) {
    along_ = std::max(1.0, std::ceil((high.x - low.x) / step));
    across_ = std::max(1.0, std::ceil((high.y - low.y) / step));
    // A line has no width: its fields are as long as it is.
    width_ = std::max((high.x - low.x) / along_, 1e-9);
    depth_ = std::max((high.y - low.y) / across_, 1e-9);
  }
  using Field = std::pair<std::int64_t, std::int64_t>;
  Field field_of(const Point3& p) const { return {std::llround((p.x - low_.x) / width_), std::llround((p.y - low_.y) / depth_)}; }
  double off_middle(const Point3& p, const Field& field) const {
    const double x = p.x - low_.x - width_ * static_cast<double>(field.first),
                 y = p.y - low_.y - depth_ * static_cast<double>(field.second);
    return x * x + y * y;
  }

 private:
  Point3 low_;
  double along_ = 1, across_ = 1, width_ = 1, depth_ = 1;
};

Mesh gathered(const Mesh& ground, const GroundGrid& grid) {
  std::map<GroundGrid::Field, std::uint32_t> kept;  // the place of each field, as a number of `ground`
  for (std::uint32_t k = 0; k < ground.vertices.size(); ++k) {
    const GroundGrid::Field field = grid.field_of(ground.vertices[k]);
    const auto [found, is_new] = kept.emplace(field, k);
    if (!is_new && grid.off_middle(ground.vertices[k], field) < grid.off_middle(ground.vertices[found->second], field))
      found->second = k;
  }
  Mesh made;
  std::map<GroundGrid::Field, std::uint32_t> numbers;
  for (const auto& [field, vertex] : kept) {
    numbers.emplace(field, static_cast<std::uint32_t>(made.vertices.size()));
    made.vertices.push_back(ground.vertices[vertex]);
  }
  std::set<std::array<std::uint32_t, 3>> known;
  for (std::array<std::uint32_t, 3> corners : ground.triangles) {
    for (std::uint32_t& corner : corners) corner = numbers.at(grid.field_of(ground.vertices[corner]));
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (known.insert(corners).second) made.triangles.push_back(corners);
  }
  return made;
}

}  // namespace

Mesh coarse_ground(const Mesh& ground, std::size_t most_triangles) {
  if (ground.triangles.size() <= most_triangles) return ground;
  Point3 low = ground.vertices.front(), high = low;
  for (const Point3& v : ground.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const double width = high.x - low.x, depth = high.y - low.y;
  // Two triangles for each field; what turns out to be more gets a coarser grid.
  double step = std::sqrt(2 * std::max(width * depth, 1e-6) / static_cast<double>(std::max<std::size_t>(most_triangles, 2)));
  for (; step < 2 * (width + depth); step *= 1.25)
    if (Mesh made = gathered(ground, GroundGrid(low, high, step)); made.triangles.size() <= most_triangles) return made;
  return gathered(ground, GroundGrid(low, high, step));
}

}  // namespace bl::exporting
