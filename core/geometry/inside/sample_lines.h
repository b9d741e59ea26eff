// Parallel lines through a domain, in three directions at right angles: what the sampled diagram is measured along.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/geometry/domain.h"

namespace bl::geometry {

/// Axes of a sampling grid and where its lines run. Coordinates in it are relative to the middle of the domain's box.
struct SampleFrame {
  std::array<Vector3, 3> axis;  ///< unit vectors at right angles
  Point3 origin;                ///< [m]
  double step = 1;              ///< between lines [m]; each stands for a column of step²
  std::array<double, 3> low{};  ///< lower corner of the grid, in the frame [m]
  std::array<int, 3> count{};   ///< steps along each axis

  Vector3 turned(const Vector3& v) const { return {dot(axis[0], v), dot(axis[1], v), dot(axis[2], v)}; }
  Vector3 to_frame(const Point3& p) const { return turned(p - origin); }
  Point3 to_world(const Vector3& f) const { return origin + (f.x * axis[0] + f.y * axis[1] + f.z * axis[2]); }
  /// Coordinate of the line number `i` along an axis across it.
  double line_at(std::size_t across, int i) const { return low[across] + (i + 0.5) * step; }
};

/// Axes tilted against everything that is upright, level or at 45 degrees in plan: a wall that ran along the lines would fall
/// wholly between two of them, and its error would not average out.
SampleFrame tilted_frame(const Domain& domain, double step);
/// The third axis upright, the others turned in plan for the same reason.
SampleFrame upright_frame(const Domain& domain, double step);

/// Where the lines along one axis run inside the domain, exactly: one stretch for each piece that a line meets.
class SampleLines {
 public:
  struct Stretch {
    double from, to;                   ///< coordinates along the line [m]
    std::uint32_t from_face, to_face;  ///< into faces(), the planes that the line enters and leaves by
  };
  struct Face {
    std::uint32_t side;  ///< of the domain, or Domain::kInner
    double share;        ///< |cosine| between the line and the plane's normal
  };

  /// Lines along axis `along`; u counts them along axis along + 1, v along axis along + 2 (modulo 3).
  void build(const Domain& domain, const SampleFrame& frame, std::size_t along, ThreadPool* pool);

  std::span<const Stretch> on(int u, int v) const {
    const Row& row = rows_[static_cast<std::size_t>(v)];
    const std::size_t k = static_cast<std::size_t>(u);
    return std::span(row.stretches).subspan(row.first[k], row.first[k + 1] - row.first[k]);
  }
  const Face& face(std::uint32_t k) const { return faces_[k]; }
  /// Sum of all stretches [m]; times step² it is the domain's volume as these lines see it.
  double length() const { return length_; }
  std::size_t count() const { return count_; }

 private:
  struct Row {
    std::vector<std::uint32_t> first;  // stretches of line u: first[u] .. first[u + 1)
    std::vector<Stretch> stretches;
  };
  std::vector<Row> rows_;
  std::vector<Face> faces_;
  double length_ = 0;
  std::size_t count_ = 0;
};

}  // namespace bl::geometry
