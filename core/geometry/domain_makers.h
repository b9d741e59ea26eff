// Makers of domains that need not be convex: plans with holes, closed meshes, and domains cut, joined and hollowed.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/domain.h"

namespace bl::geometry {

/// A plan polygon with holes between two heights [m]: convex or not, either orientation, closing duplicate and collinear
/// corners allowed. Sides: 0 the bottom, 1 the top, then one wall per side of the outer ring (counter-clockwise, from the first
/// corner given), then those of the holes in their order (clockwise, from their first corners). A convex plan without holes is
/// what `extrude` makes. The place of an error is `plan` or `holes/k`.
Result<Domain> extrude_plan(std::span<const Point3> plan, std::span<const std::vector<Point3>> holes, double bottom, double top);

/// A closed triangle mesh, in either orientation: any number of shells beside and within each other (a shell within another is
/// a cavity), with handles. Sides: groups of triangles that join in one plane, sorted as `convex_hull` sorts its planes. A
/// convex mesh is what `from_mesh` makes. Open, self-crossing and self-touching meshes are refused. The result does not depend
/// on the order of vertices and triangles.
Result<Domain> from_closed_mesh(const Mesh& mesh);

/// The intersection of a domain with half-spaces normal·x <= offset (normals of any length). Plane k is side `domain.side_count +
/// k`, whether it cuts or not. Pieces that no plane cuts keep their bits.
Result<Domain> cut_domain(const Domain& domain, std::span<const Plane> planes);

/// The union of domains that may overlap; earlier domains keep their pieces, and later ones are cut. The sides of domain k come
/// after all sides of the domains before it.
Result<Domain> unite(std::span<const Domain> domains);

/// A domain minus solids, which may overlap each other and reach outside it. The sides of solid k come after those of the domain
/// and of the solids before it. Pieces that no solid touches keep their bits.
Result<Domain> exclude(const Domain& domain, std::span<const Domain> solids);

/// The area that the domain covers in plan, seen from above [m²].
double area_in_plan(const Domain& domain);

/// The surface as triangles, oriented outward; faces between pieces are left out. The mesh encloses the domain's volume, but
/// where an edge of one piece ends within an edge of another its triangles do not share all corners.
Mesh to_mesh(const Domain& domain);

}  // namespace bl::geometry
