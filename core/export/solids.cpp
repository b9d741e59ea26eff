// Bodies and their placing on a plate.
#include "core/export/solids.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace bl::exporting {

std::vector<Solid> solids_of(const Proposal& proposal, bool with_surroundings) {
  std::vector<Solid> solids;
  for (const Building& b : proposal.buildings) solids.push_back({b.label, use_name(b.use), b.colour, b.mesh, &b});
  if (with_surroundings)
    for (const Neighbour& n : proposal.neighbours)
      if (n.mesh) solids.push_back({n.name, "existing", kExistingColour, n.mesh, nullptr});
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
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) sides.emplace(triangle[k], triangle[(k + 1) % 3]);
  return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    return sides.count(side) == 1 && sides.count({side.second, side.first}) == 1;
  });
}

}  // namespace bl::exporting
