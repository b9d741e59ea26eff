// Exports meshes as a Wavefront OBJ text: metres, z up, one object per mesh.
#pragma once

#include <span>
#include <string>

#include "core/base/mesh.h"

namespace bl::exporting {

struct NamedMesh {
  std::string name;
  MeshPointer mesh;  ///< none: a comment says that this volume has no shape
};

/// Shortest numbers that read back as the same doubles. Names are made legal and unique; a changed name stays in a comment.
/// `note`: a sentence for the header, none where empty.
std::string write_obj(std::span<const NamedMesh> meshes, const std::string& note = {});

}  // namespace bl::exporting
