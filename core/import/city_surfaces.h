// Surfaces of a city model over shared vertices: are they a closed solid, which mesh is it, and what does it cover in plan.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/mesh.h"
#include "core/geometry/plan_ring.h"

namespace bl::importing {

/// One flat face: its outer ring, then its holes, as indices of vertices; what it is called ("GroundSurface"), or nothing.
struct CitySurface {
  std::vector<std::vector<std::uint32_t>> rings;
  std::string semantic;
};

/// What became of the surfaces of one object.
struct CitySolid {
  Mesh mesh;                  ///< outward where it is closed
  bool is_closed = false;     ///< every edge has its twin, so that there is an inside
  bool was_turned = false;    ///< the surfaces looked inward, or in different directions, and were turned
  bool had_no_floor = false;  ///< open at its foot only, and closed there
  std::size_t open_edges = 0;
  double volume = 0;  ///< [m³] where it is closed
};

/// Vertices at one place count as one. Surfaces of several shells may be given together.
CitySolid city_solid(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces);

/// About how many steps the triangles of the surfaces take: quadratic in the corners of each; 0 for those of few corners.
double triangles_effort(const std::vector<CitySurface>& surfaces);

/// The outlines of the surfaces in plan: counter-clockwise outer rings and clockwise holes, as chained, unjudged. Of a solid the
/// ground counts: surfaces called so, else those that look down, else those that look up.
std::vector<geometry::Ring> city_outlines(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces);

}  // namespace bl::importing
