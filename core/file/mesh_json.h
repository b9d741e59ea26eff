// Meshes as JSON: {"vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...]}, in metres and from 0.
#pragma once

#include "core/base/mesh.h"
#include "core/define/json_text.h"

namespace bl {

/// Vertices and triangles; the wrap of a coarse mesh is left out.
Json mesh_to_json(const Mesh& mesh);
/// Null where the JSON is no mesh: another form, numbers that are not finite, or indices of missing vertices.
MeshPointer mesh_from_json(const Json& json);

}  // namespace bl
