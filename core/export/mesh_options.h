// The options of all formats that write closed meshes.
#pragma once

#include "core/export/format.h"

namespace bl::exporting {

/// What the options of such a format begin with. Each of them says whether it has cellars where nobody asks.
struct MeshOptions : FormOptions {
  bool cellars = false;
};

template <class T>
void declare_mesh_options(FormatBuilder<T>& f) {
  f.option(&MeshOptions::cellars, "cellars")
      .doc("With the storeys below the ground, as one more body for each building that has some.");
  declare_form_option(f);
}

}  // namespace bl::exporting
