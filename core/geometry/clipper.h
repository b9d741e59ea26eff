// A convex polyhedron that is cut by one plane after the other: the working shape behind cells and domains.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vector.h"
#include "core/geometry/convex_domain.h"
#include "core/geometry/power_cells.h"

namespace bl {

/// One face of a Clipper; its corners are `loops[first .. first + count)`.
struct ClippedFace {
  Vector3 normal;     ///< unit, outward
  double offset = 0;  ///< [m], signed distance of the plane from the origin of the Clipper
  FacetArea::Kind kind = FacetArea::Kind::plane;
  std::uint32_t index = 0;
  std::uint32_t first = 0, count = 0;
};

/// Each vertex is judged once per cut, so that all faces agree on what is cut away: the polyhedron stays a closed surface
/// (every directed edge has its twin exactly once) whatever the rounding says. Vertices within a tolerance outside the plane
/// count as touching and stay. A cut through a vertex makes a second vertex at the same place instead of merging: edges and
/// faces of no extent are harmless to every measure, wrong topology is not.
class Clipper {
 public:
  /// Starts from the domain, moved so that `origin` becomes the origin. Plane k becomes a face named (plane, k).
  void start(const ConvexDomain& domain, const Point3& origin);
  /// Starts from an axis-parallel box; all faces are named (plane, box_index).
  void start_box(const Vector3& minimum, const Vector3& maximum, std::uint32_t box_index);
  /// Keeps normal·x <= offset. Returns false when nothing is left.
  bool cut(const Vector3& normal, double offset, FacetArea::Kind kind, std::uint32_t index);

  bool is_empty() const { return vertices.empty(); }
  /// Largest distance of a vertex from the origin, squared [m²].
  double reach_squared() const { return reach_squared_; }
  /// Volume from the vertices alone, relative to their mean [m³]; `centroid` relative to the origin.
  double volume_and_centroid(Point3& centroid) const;

  std::vector<Point3> vertices;  ///< relative to the origin [m]
  std::vector<ClippedFace> faces;
  std::vector<std::uint32_t> loops;

 private:
  struct Crossing {
    std::uint32_t inner, outer;  ///< ends of the cut edge, as numbered before the cut
    std::uint32_t next;          ///< crossing that follows on the new face
  };
  std::uint32_t crossing(std::uint32_t inner, std::uint32_t outer);
  void cut_face(const ClippedFace& face);
  void close_cut(const Vector3& normal, double offset, FacetArea::Kind kind, std::uint32_t index);
  void measure_reach();

  double reach_squared_ = 0, start_reach_ = 0;
  std::uint32_t kept_ = 0;
  std::vector<double> side_;           // signed distance per vertex; positive: cut away
  std::vector<std::uint32_t> number_;  // new number per vertex that stays
  std::vector<Crossing> crossings_;
  std::vector<Point3> new_vertices_;
  std::vector<ClippedFace> new_faces_;
  std::vector<std::uint32_t> new_loops_;
};

}  // namespace bl
