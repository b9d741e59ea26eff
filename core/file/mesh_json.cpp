// Reading and writing meshes as JSON.
#include "core/file/mesh_json.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace bl {

namespace {

template <class Holds>
bool is_triple(const Json& json, Holds&& holds) {
  return json.is_array() && json.size() == 3 && std::all_of(json.begin(), json.end(), holds);
}

// Without the sign that a zero may have in a text.
double coordinate(const Json& json) { return json.get<double>() + 0.0; }

bool is_length(const Json& json) { return json.is_number() && std::isfinite(json.get<double>()); }

}  // namespace

Json mesh_to_json(const Mesh& mesh) {
  Json json = {{"vertices", Json::array()}, {"triangles", Json::array()}};
  for (const Point3& at : mesh.vertices) json["vertices"].push_back({at.x, at.y, at.z});
  for (const auto& triangle : mesh.triangles) json["triangles"].push_back(triangle);
  return json;
}

MeshPointer mesh_from_json(const Json& json) {
  if (!json.is_object() || !json.contains("vertices") || !json.contains("triangles")) return nullptr;
  const Json &vertices = json["vertices"], &triangles = json["triangles"];
  if (!vertices.is_array() || !triangles.is_array()) return nullptr;
  auto mesh = std::make_shared<Mesh>();
  for (const Json& corner : vertices) {
    if (!is_triple(corner, is_length)) return nullptr;
    mesh->vertices.push_back({coordinate(corner[0]), coordinate(corner[1]), coordinate(corner[2])});
  }
  for (const Json& triangle : triangles) {
    const auto is_corner = [&](const Json& k) { return k.is_number_unsigned() && k.get<std::uint64_t>() < vertices.size(); };
    if (!is_triple(triangle, is_corner)) return nullptr;
    mesh->triangles.push_back(triangle.get<std::array<std::uint32_t, 3>>());
  }
  return mesh;
}

}  // namespace bl
