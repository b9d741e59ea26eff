// Bodies and their placing on a plate.
#include "core/export/solids.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/polygon_triangles.h"

namespace bl::exporting {

std::vector<Solid> solids_of(const Proposal& proposal, bool with_surroundings) {
  std::vector<Solid> solids;
  for (const Building& b : proposal.buildings) solids.push_back({b.label, use_name(b.use), b.colour, b.mesh, &b});
  if (with_surroundings)
    for (const Neighbour& n : proposal.neighbours)
      if (n.mesh) solids.push_back({n.name, "existing", kExistingColour, n.mesh, nullptr});
  return solids;
}

std::vector<Solid> printable_solids_of(const Proposal& proposal, bool with_surroundings, std::vector<std::string>& notes) {
  std::vector<Solid> solids = solids_of(proposal, false);
  if (!with_surroundings) return solids;
  for (const Neighbour& n : proposal.neighbours) {
    if (!n.mesh) continue;
    std::shared_ptr<const Mesh> mesh = n.mesh;
    if (!is_closed(*mesh)) {
      mesh = std::make_shared<const Mesh>(geometry::prism_mesh(n.face.outer, n.face.holes, n.bottom, n.top));
      notes.push_back(n.name + " has a mesh with holes, which no printer takes: it is an upright body over its outline");
    }
    solids.push_back({n.name, "existing", kExistingColour, std::move(mesh), nullptr});
  }
  return solids;
}

std::vector<Solid> terrains_of(const Proposal& proposal) {
  std::vector<Solid> surfaces;
  for (const auto& mesh : proposal.terrains) {
    const std::string number = proposal.terrains.size() > 1 ? " " + std::to_string(surfaces.size() + 1) : "";
    surfaces.push_back({"terrain" + number, "terrain", kTerrainColour, mesh, nullptr});
  }
  return surfaces;
}

ModelScale::ModelScale(const std::vector<Solid>& solids, double denominator) : factor_(1000 / denominator) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  corner_ = {kFar, kFar, kFar};
  for (const Solid& solid : solids)
    for (const Point3& v : solid.mesh->vertices)
      corner_ = {std::min(corner_.x, v.x), std::min(corner_.y, v.y), std::min(corner_.z, v.z)};
}

bool is_closed(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides, opposite;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      sides.emplace_back(triangle[k], triangle[(k + 1) % 3]);
      opposite.emplace_back(triangle[(k + 1) % 3], triangle[k]);
    }
  std::sort(sides.begin(), sides.end());
  std::sort(opposite.begin(), opposite.end());
  return !sides.empty() && sides == opposite && std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

}  // namespace bl::exporting
