// A closed mesh as convex pieces: its convex hull is split along faces of the mesh until each part is wholly in or out.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/base/text.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/inside/coplanar_groups.h"
#include "core/geometry/inside/cut_faces.h"
#include "core/geometry/inside/mesh_shells.h"
#include "core/geometry/inside/part_faces.h"

namespace bl::geometry {

namespace {

// A mesh that falls into more is a sculpture, not a boundary to divide space with.
constexpr std::size_t kMostPieces = 5000;

struct OpenPart {
  SolidPart part;
  std::vector<std::uint32_t> candidates;  // faces that may pass through it
};

// The parts of the hull that are inside; nothing where they are too many.
std::optional<std::vector<LoosePart>> inner_parts(const Mesh& mesh, const ConvexDomain& hull, const std::vector<CutFace>& faces,
                                                  double tolerance) {
  std::vector<OpenPart> open(1);
  open[0].part = part_of(Domain(hull).pieces.front());
  // Whether a face of the hull is surface, and of which side, is found out like that of any other face.
  for (PartFace& face : open[0].part.faces) face.side = Domain::kInner;
  open[0].candidates.resize(faces.size());
  std::iota(open[0].candidates.begin(), open[0].candidates.end(), 0u);
  std::vector<LoosePart> inside;
  while (!open.empty()) {
    OpenPart now = std::move(open.back());
    open.pop_back();
    const auto crossing = crossing_faces(now.part, faces, now.candidates, tolerance);
    const auto plane = best_plane(now.part, faces, crossing, tolerance);
    Halves halves = plane ? cut_in_two(now.part, *plane, tolerance, Domain::kInner) : Halves{};
    if (halves.inside && halves.outside) {
      open.push_back({std::move(*halves.outside), crossing});
      open.push_back({std::move(*halves.inside), crossing});
    } else if (winding_number(mesh, middle_of(now.part)) > 0.5) {
      inside.push_back({std::move(now.part), nullptr});
    }
    if (inside.size() + open.size() > kMostPieces) return std::nullopt;
  }
  return inside;
}

}  // namespace

Result<Domain> from_closed_mesh(const Mesh& given) {
  const auto mesh = ready_mesh(given);
  if (!mesh) return mesh.error();
  if (auto convex = from_mesh(*mesh)) return Domain(std::move(*convex));
  const auto hull = convex_hull(mesh->vertices);
  if (!hull) return hull.error();
  const CoplanarGroups groups = coplanar_groups(mesh->vertices, mesh->triangles);
  const double tolerance = place_tolerance(hull->minimum, hull->maximum);
  std::vector<CutFace> faces;
  std::vector<Wall> walls;
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    Polygon polygon;
    for (const std::uint32_t v : mesh->triangles[t]) polygon.push_back(mesh->vertices[v]);
    const Plane& plane = groups.planes[groups.group_of[t]];
    walls.push_back({polygon, plane.normal, groups.group_of[t]});
    faces.push_back({std::move(polygon), plane});
  }
  const auto parts = inner_parts(*mesh, *hull, faces, tolerance);
  if (!parts)
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh falls into more than " + std::to_string(kMostPieces) + " convex pieces: simplify it"};
  const double wanted = enclosed_volume(*mesh), kept = volume_of(*parts);
  if (!(std::abs(kept - wanted) <= 1e-9 * wanted))
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh encloses " + shortest(wanted) + " m³, its convex pieces " + shortest(kept) +
                     " m³: it has parts too thin to be told apart"};
  return settled_domain(*parts, walls, tolerance, static_cast<std::uint32_t>(groups.planes.size()));
}

}  // namespace bl::geometry
