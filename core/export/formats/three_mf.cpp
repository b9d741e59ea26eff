// Closed meshes for printers as 3MF: three texts in a zip archive; one object for each building, uses as base materials.
#include <map>

#include "core/base/text.h"
#include "core/drawing/markup.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/mesh_options.h"
#include "core/export/solids.h"
#include "core/export/zip_archive.h"

namespace bl::exporting {

namespace {

// The comment of the archive, by which its files are known.
constexpr const char* kThreeMfEnd = "BehaviourLinks 3mf";

struct ThreeMfFormat {
  // A print stands on its plate, so cellars would lift the houses off it.
  struct Options : MeshOptions {
    double scale = 500;
    bool surroundings = false;
  };

  static void declare(FormatBuilder<ThreeMfFormat>& f) {
    f.id("3mf").label("Model for printers (3MF)");
    f.doc(
        "Closed meshes in millimetres at a model scale, on the plate with the lowest corner at the origin. Each building is an "
        "object with its name; its use is its material, with its colour.");
    f.ending(".3mf").marked({"PK\x03\x04", "", kThreeMfEnd});
    f.option(&Options::scale, "scale").unit(Unit::ratio).range(1, 100000).doc("The n of the scale 1:n.");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already.");
    declare_mesh_options(f);
  }

  static constexpr const char* kTypes =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
      "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
      "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
  static constexpr const char* kRelations =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
      "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Target=\"/3D/3dmodel.model\" "
      "Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";

  static void add_mesh(const Mesh& mesh, const ModelScale& scale, drawing::Markup& out) {
    out.open("mesh").open("vertices");
    for (const Point3& v : mesh.vertices) {
      const Point3 at = scale.millimetres(v);
      out.leaf("vertex", {{"x", shortest(at.x)}, {"y", shortest(at.y)}, {"z", shortest(at.z)}});
    }
    out.close().open("triangles");
    for (const auto& [a, b, c] : mesh.triangles)
      out.leaf("triangle", {{"v1", std::to_string(a)}, {"v2", std::to_string(b)}, {"v3", std::to_string(c)}});
    out.close().close();
  }

  static std::string model_of(const Proposal& proposal, const std::vector<Solid>& solids, const ModelScale& scale,
                              const Options& options) {
    drawing::Markup out;
    out.open("model", {{"unit", "millimeter"},
                       {"xml:lang", "en"},
                       {"xmlns", "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"},
                       {"xmlns:bl", "http://behaviourlinks.example/3mf"}});
    out.element("metadata", proposal.name(), {{"name", "Title"}});
    out.element("metadata", "BehaviourLinks", {{"name", "Application"}});
    out.element("metadata", "1:" + shortest(options.scale) + "; " + identity_line(proposal), {{"name", "Description"}});
    for (const auto& [name, value] : identity_of(proposal)) out.element("metadata", value, {{"name", "bl:" + name}});
    std::map<std::string, std::size_t> materials;
    out.open("resources").open("basematerials", {{"id", "1"}});
    for (const Solid& solid : solids)
      if (materials.emplace(solid.material, materials.size()).second)
        out.leaf("base", {{"name", solid.material}, {"displaycolor", drawing::hex(solid.colour)}});
    out.close();
    for (std::size_t k = 0; k < solids.size(); ++k) {
      out.open("object", {{"id", std::to_string(k + 2)},
                          {"type", "model"},
                          {"name", solids[k].name},
                          {"pid", "1"},
                          {"pindex", std::to_string(materials.at(solids[k].material))}});
      add_mesh(*solids[k].mesh, scale, out);
      out.close();
    }
    out.close().open("build");
    for (std::size_t k = 0; k < solids.size(); ++k) out.leaf("item", {{"objectid", std::to_string(k + 2)}});
    out.close().close();
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + out.str() + "\n";
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    ExportFiles made;
    made.notes = left_out_cellars(proposal, options.cellars);
    const std::vector<Solid> solids = printable_solids_of(proposal, options.surroundings, options.cellars, made.notes);
    const ModelScale scale(solids, options.scale);
    auto archive = zip_archive({{"[Content_Types].xml", kTypes},
                                {"_rels/.rels", kRelations},
                                {"3D/3dmodel.model", model_of(proposal, solids, scale, options)}},
                               kThreeMfEnd);
    if (!archive) return archive.error();
    made.files.push_back({"model.3mf", std::move(*archive)});
    return made;
  }
};

}  // namespace

BL_FORMAT(three_mf, ThreeMfFormat)

}  // namespace bl::exporting
