// The meshes of one cell in all pieces of its domain: finely divided and wrapped, or coarse for a graphics processor to wrap.
#pragma once

#include <memory>
#include <span>

#include "core/base/mesh.h"
#include "core/geometry/inside/cell_seams.h"
#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Is the point in the ball, and behind all faces by at least `margin` [m]? Relative to the site, as the part is.
bool holds(const Polyhedron& part, double squared_radius, const Point3& point, double margin);

/// The point that the vertices of a part are wrapped towards: the site, or `other` where the site is not well inside.
Point3 wrap_centre(const Polyhedron& part, double squared_radius, const Point3& other);

/// The parts in the pieces of the domain become one closed mesh that is open from part to part where the ball is. `centroid` of
/// the shape, relative to the site. `open`: what open_parts says of more than one part, else nothing.
Mesh make_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, std::span<const OpenPart> open,
               const PowerSite& site, int depth, const Point3& centroid);
/// The same parts as fans of triangles, a face's centre first, not wrapped; `wrap` says how make_mesh would go on. The
/// triangles come in the order in which make_mesh divides them.
Mesh make_coarse_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, std::span<const OpenPart> open,
                      const PowerSite& site, const Point3& centroid);

/// How often the faces of shapes for studies are split in four.
inline constexpr int kStudyDepth = 1;

/// The mesh of a cell at another depth than the displayed one, made from its coarse mesh. A mesh without a coarse one is returned
/// unchanged; nullptr stays nullptr.
MeshPointer mesh_of_depth(const MeshPointer& mesh, int depth);

/// The mesh of a cell for studies, whatever its displayed depth.
inline MeshPointer study_mesh(const MeshPointer& mesh) { return mesh_of_depth(mesh, kStudyDepth); }

}  // namespace bl::geometry
