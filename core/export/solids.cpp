// Bodies and their placing on a plate.
#include "core/export/solids.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/geometry/polygon_triangles.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

// Its plates are equal: one prism for each of their parts, without floors between, as stacks of storeys have.
std::shared_ptr<const Mesh> cellar_mesh(const Building& building) {
  Mesh mesh;
  for (const geometry::PlateFace& face : building.cellars.front().faces) {
    const Mesh part = geometry::prism_mesh(face.outer, face.holes, building.cellars.back().bottom, building.cellars.front().top);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

}  // namespace

std::vector<Solid> solids_of(const Proposal& proposal, bool with_surroundings, bool with_cellars) {
  std::vector<Solid> solids;
  for (const Building& b : proposal.buildings) {
    solids.push_back({b.label, use_name(b.use), b.colour, b.mesh, &b});
    if (with_cellars && !b.cellars.empty())
      solids.push_back({b.label + ", cellar", use_name(b.use), b.colour, cellar_mesh(b), &b, true});
  }
  if (with_surroundings)
    for (const Neighbour& n : proposal.neighbours)
      if (n.mesh) solids.push_back({n.name, "existing", kExistingColour, n.mesh, nullptr});
  return solids;
}

std::vector<Solid> printable_solids_of(const Proposal& proposal, bool with_surroundings, bool with_cellars,
                                       std::vector<std::string>& notes) {
  std::vector<Solid> solids = solids_of(proposal, false, with_cellars);
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

std::vector<std::string> left_out_cellars(const Proposal& proposal, bool with_cellars) {
  const auto count = static_cast<std::size_t>(
      std::count_if(proposal.buildings.begin(), proposal.buildings.end(), [](const Building& b) { return !b.cellars.empty(); }));
  if (with_cellars || count == 0) return {};
  return {"without the cellars of " + reading::counted(count, "volume") + "; --option cellars=yes writes them"};
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
