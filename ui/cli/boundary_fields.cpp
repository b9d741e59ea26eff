// Makes a domain from the fields of a boundary.
#include "ui/cli/boundary_fields.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/geometry/domain_makers.h"
#include "ui/cli/json_fields.h"

namespace bl::cli {

const char* const kBoundaryForms =
    "{\"planes\": [[a, b, c, d], ...]}, {\"vertices\": [[x, y, z], ...]}, {\"plan\": [[x, y], ...], \"bottom\": z, \"top\": z} "
    "or "
    "{\"mesh\": {\"vertices\": [...], \"triangles\": [...]}}";

namespace {

// The place of what a maker complains about: what is told of one point or plane names it already.
Result<geometry::Domain> told(Result<geometry::ConvexDomain> made, const std::string& place) {
  if (!made) return made.error().within(place);
  return geometry::Domain(std::move(*made));
}

Result<geometry::Domain> from_vertex_list(const Json& json, const std::string& place) {
  const auto list = list_at(json, "vertices", place);
  if (!list) return list.error();
  const std::string here = slash(place, "vertices");
  const auto vertices = points_at(**list, here);
  if (!vertices) return vertices.error();
  return told(geometry::convex_hull(*vertices), here);
}

Result<geometry::Domain> from_plane_list(const Json& json, const std::string& place) {
  const auto list = list_at(json, "planes", place);
  if (!list) return list.error();
  const std::string here = slash(place, "planes");
  std::vector<geometry::Plane> planes;
  for (std::size_t k = 0; k < (*list)->size(); ++k) {
    const auto plane = numbers_at((**list)[k], 4, "a plane [a, b, c, d]", slash(here, k));
    if (!plane) return plane.error();
    planes.push_back({{(*plane)[0], (*plane)[1], (*plane)[2]}, (*plane)[3]});
  }
  return told(from_planes(planes), here);
}

Result<std::vector<Point3>> ring_at(const Json& json, const std::string& place) {
  if (!json.is_array()) return Error{ErrorCode::wrong_kind, place, "expects corners [[x, y], ...], found " + excerpt(json)};
  std::vector<Point3> ring;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto corner = numbers_at(json[i], 2, "a corner [x, y]", slash(place, i));
    if (!corner) return corner.error();
    ring.push_back({(*corner)[0], (*corner)[1], 0});
  }
  return ring;
}

Result<double> height_at(const Json& json, const char* key, const std::string& place) {
  const auto it = json.find(key);
  if (it == json.end())
    return Error{ErrorCode::missing, slash(place, key), std::string("`") + key + "` is missing: a plan needs its heights in m"};
  return number_at(*it, slash(place, key));
}

Result<geometry::Domain> from_plan(const Json& json, const std::string& place) {
  const auto plan = ring_at(json["plan"], slash(place, "plan"));
  if (!plan) return plan.error();
  const auto bottom = height_at(json, "bottom", place), top = height_at(json, "top", place);
  if (!bottom) return bottom.error();
  if (!top) return top.error();
  std::vector<std::vector<Point3>> holes;
  if (json.contains("holes")) {
    const auto list = list_at(json, "holes", place);
    if (!list) return list.error();
    for (std::size_t k = 0; k < (*list)->size(); ++k) {
      auto hole = ring_at((**list)[k], slash(slash(place, "holes"), k));
      if (!hole) return hole.error();
      holes.push_back(std::move(*hole));
    }
  }
  auto solid = geometry::extrude_plan(*plan, holes, *bottom, *top);
  if (!solid) return solid.error().within(place);
  return solid;
}

Result<geometry::Domain> from_mesh_object(const Json& mesh, const std::string& place) {
  if (!mesh.is_object())
    return Error{ErrorCode::wrong_kind, place,
                 "expects {\"vertices\": [[x, y, z], ...], \"triangles\": [[i, j, k], ...]}, found " + excerpt(mesh)};
  const auto vertices = list_at(mesh, "vertices", place), triangles = list_at(mesh, "triangles", place);
  if (!vertices) return vertices.error();
  if (!triangles) return triangles.error();
  const auto points = points_at(**vertices, slash(place, "vertices"));
  if (!points) return points.error();
  Mesh result;
  result.vertices = *points;
  for (std::size_t t = 0; t < (*triangles)->size(); ++t) {
    const std::string here = slash(slash(place, "triangles"), t);
    const auto corners = indices_at((**triangles)[t], points->size(), "vertex", here);
    if (!corners) return corners.error();
    if (corners->size() != 3)
      return Error{ErrorCode::wrong_kind, here, "expects a triangle [i, j, k], found " + excerpt((**triangles)[t])};
    result.triangles.push_back({(*corners)[0], (*corners)[1], (*corners)[2]});
  }
  auto solid = geometry::from_closed_mesh(result);
  if (!solid) return solid.error().within(place);
  return solid;
}

}  // namespace

Result<BoundaryReading> boundary_at(const Json& json, const std::string& place) {
  if (!json.is_object()) return Error{ErrorCode::wrong_kind, place, std::string("expects ") + kBoundaryForms};
  BoundaryReading reading;
  reading.has_given_planes = json.contains("planes");
  Result<geometry::Domain> domain =
      Error{ErrorCode::missing, place, std::string("expects `planes`, `vertices`, `plan` or `mesh`: ") + kBoundaryForms};
  if (json.contains("planes")) domain = from_plane_list(json, place);
  else if (json.contains("vertices")) domain = from_vertex_list(json, place);
  else if (json.contains("plan")) domain = from_plan(json, place);
  else if (json.contains("mesh")) domain = from_mesh_object(json["mesh"], slash(place, "mesh"));
  if (!domain) return domain.error();
  // Left out without a word, these would give another domain than was meant.
  for (const char* const key : {"hole", "holes", "step", "steps", "setback", "setbacks", "exclusion", "exclusions"}) {
    if (!json.contains(key) || (key == std::string("holes") && json.contains("plan"))) continue;
    return Error{ErrorCode::unknown_field, slash(place, key),
                 "is not read here: a plan takes `holes`; give a boundary with other cuts as `mesh`"};
  }
  reading.domain = std::move(*domain);
  return reading;
}

}  // namespace bl::cli
