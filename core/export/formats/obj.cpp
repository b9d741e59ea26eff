// Closed meshes as Wavefront OBJ: metres, z up, one object for each building, uses as materials.
#include "core/base/text.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/mesh_options.h"
#include "core/export/solids.h"
#include "core/export/wavefront_obj.h"

namespace bl::exporting {

namespace {

struct ObjFormat {
  // What is below the ground belongs to a model in metres, and whoever looks at it can hide it by its name.
  struct Options : MeshOptions {
    bool surroundings = false;
    Options() { cellars = true; }
  };

  static void declare(FormatBuilder<ObjFormat>& f) {
    f.id("obj").label("Meshes (Wavefront OBJ)");
    f.doc(
        "One closed object for each building, in metres from the origin of the scene, z up. The material of an object is its "
        "use; "
        "a folder also gets the colours of the materials.");
    f.ending(".obj").begins("# BehaviourLinks:");
    f.option(&Options::surroundings, "surroundings")
        .doc("With the buildings that stand already, and terrain, which is an open surface.");
    declare_mesh_options(f);
  }

  static std::string library_of(const Proposal& proposal) {
    std::string text = "# BehaviourLinks: " + identity_line(proposal) + "\n";
    const auto add = [&](const std::string& name, const drawing::Colour& c) {
      text += "newmtl " + name_in_obj(name) + "\nKd " + fixed(c.red, 4) + " " + fixed(c.green, 4) + " " + fixed(c.blue, 4) + "\n";
    };
    for (const UseRow& use : proposal.uses) add(use_name(use.use), use.colour);
    add("existing", kExistingColour);
    add("terrain", kTerrainColour);
    return text;
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options, bool is_folder) {
    std::vector<NamedMesh> meshes;
    for (const Solid& solid : solids_of(proposal, options.surroundings, options.cellars))
      meshes.push_back({solid.name, solid.mesh, solid.material});
    if (options.surroundings)
      for (const Solid& surface : terrains_of(proposal)) meshes.push_back({surface.name, surface.mesh, surface.material});
    ExportFiles made;
    made.notes = left_out_cellars(proposal, options.cellars);
    made.files.push_back({"proposal.obj", write_obj(meshes, identity_line(proposal), is_folder ? "proposal.mtl" : "")});
    if (is_folder) made.files.push_back({"proposal.mtl", library_of(proposal)});
    return made;
  }
};

}  // namespace

BL_FORMAT(obj, ObjFormat)

}  // namespace bl::exporting
