// Exports meshes as a Wavefront OBJ text: metres, z up, one object per mesh.
#pragma once

#include <span>
#include <string>

#include "core/base/mesh.h"

namespace bl::exporting {

struct NamedMesh {
  std::string name;
  MeshPointer mesh;           ///< none: a comment says that this volume has no shape
  std::string material = {};  ///< none where empty
};

/// Shortest numbers that read back as the same doubles. Names are made legal and unique; a changed name stays in a comment.
/// `note`: a sentence for the header, none where empty. `library`: the file that holds the materials, none where empty.
std::string write_obj(std::span<const NamedMesh> meshes, const std::string& note = {}, const std::string& library = {});
/// A name as OBJ and MTL files can hold it: blanks and marks with a meaning become `_`.
std::string name_in_obj(const std::string& name);

}  // namespace bl::exporting
