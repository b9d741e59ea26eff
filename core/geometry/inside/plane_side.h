// On which side of a plane the vertices of a clipper lie, several vertices at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/vector.h"

namespace bl::geometry {

/// Coordinates in arrays of their own, readable up to a multiple of four: what stands behind the last vertex must be copies of
/// it.
struct VertexLanes {
  const double *x, *y, *z;
  std::uint32_t count;
};
constexpr std::uint32_t kVertexLanes = 4;
constexpr std::size_t padded_to_lanes(std::size_t count) { return (count + kVertexLanes - 1) / kVertexLanes * kVertexLanes; }

struct PlaneSides {
  bool is_any_beyond;  ///< by more than the tolerance
  double nearest;      ///< least distance of a vertex from the plane [m]
};
/// Writes the signed distance of each vertex from normal·x = offset [m], and a bit for each that lies beyond by more than the
/// tolerance, in words of 64. The same bits on every processor, because each lane is computed by itself; a test compares both
/// ways, with and without registers for four.
PlaneSides find_plane_sides(const VertexLanes& vertices, const Vector3& normal, double offset, double tolerance, double* beyond,
                            std::uint64_t* taken, bool may_use_fours = true);
/// How far vertices reach along 26 directions, those of a cube's faces, edges and corners: enough to see of most planes that no
/// vertex lies beyond them, without a look at any vertex.
class Reaches {
 public:
  /// Of at least one vertex.
  void measure(const VertexLanes& vertices);
  /// No vertex has a larger product with `along` than this, but for rounding. Any vector is the sum of three of the 26
  /// directions, none of them backwards, so that it reaches no farther than they do together.
  double bound(const Vector3& along) const;

 private:
  // By 9 x + 3 y + z of the direction, each of them -1, 0 or 1; the middle one is none.
  std::array<double, 27> most_{};
};

/// The largest of some numbers that are not negative, readable as the coordinates are.
double largest_of_lanes(const double* numbers, std::uint32_t count);

}  // namespace bl::geometry
