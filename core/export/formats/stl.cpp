// Closed meshes for printers as STL: millimetres at a model scale, one named solid for each building.
#include <bit>

#include "core/base/text.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/mesh_options.h"
#include "core/export/solids.h"

namespace bl::exporting {

namespace {

enum class StlLayout { text, binary };

struct StlFormat {
  // A print stands on its plate, so cellars would lift the houses off it.
  struct Options : MeshOptions {
    double scale = 500;
    StlLayout layout = StlLayout::binary;
    bool surroundings = false;
  };

  static void declare(FormatBuilder<StlFormat>& f) {
    f.id("stl").label("Model for printers (STL)");
    f.doc(
        "Closed meshes in millimetres at a model scale, with the lowest corner at the origin. A file has all buildings in one "
        "body of "
        "triangles, a folder gets a file for each building, named by its id. As text each building is a solid with its name, "
        "which "
        "not every program reads.");
    f.ending(".stl").marked({"solid ", " BehaviourLinks, 1:", ""}).begins("BehaviourLinks binary");
    f.option(&Options::scale, "scale").unit(Unit::ratio).range(1, 100000).doc("The n of the scale 1:n.");
    f.option(&Options::layout, "layout",
             {{StlLayout::binary, "binary", "Small, and read by all programs; it has no names."},
              {StlLayout::text, "text", "Named solids, one for each building."}})
        .doc("How triangles are written.");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already.");
    declare_mesh_options(f);
  }

  static std::string solid_name(std::string text) {
    for (char& c : text) c = static_cast<unsigned char>(c) <= 0x20 ? '_' : c;
    return text;
  }

  static Vector3 normal_of(const Point3& a, const Point3& b, const Point3& c) {
    const Vector3 normal = cross(b - a, c - a);
    const double length = norm(normal);
    return length > 0 ? normal / length : Vector3{};
  }

  static std::string numbers(const Point3& p) {
    const auto single = [](double value) { return shortest(static_cast<double>(static_cast<float>(value))); };
    return single(p.x) + " " + single(p.y) + " " + single(p.z);
  }

  static std::string as_text(const std::vector<Solid>& solids, const ModelScale& scale, const std::string& note) {
    std::string out;
    for (const Solid& solid : solids) {
      const std::string name = solid_name(solid.name) + "_" + solid_name(solid.material);
      out += "solid " + name + (out.empty() ? " " + note : "") + "\n";
      for (const auto& [i, j, k] : solid.mesh->triangles) {
        const Point3 a = scale.millimetres(solid.mesh->vertices[i]), b = scale.millimetres(solid.mesh->vertices[j]),
                     c = scale.millimetres(solid.mesh->vertices[k]);
        out += "facet normal " + numbers(normal_of(a, b, c)) + "\n outer loop\n  vertex " + numbers(a) + "\n  vertex " +
               numbers(b) + "\n  vertex " + numbers(c) + "\n endloop\nendfacet\n";
      }
      out += "endsolid " + name + "\n";
    }
    return out;
  }

  static void put(std::string& out, std::uint32_t bits, int bytes) {
    for (int k = 0; k < bytes; ++k) out += static_cast<char>((bits >> (8 * k)) & 0xffu);
  }
  static void put(std::string& out, const Point3& p) {
    for (const double value : {p.x, p.y, p.z}) put(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  }

  static std::string as_binary(const std::vector<Solid>& solids, const ModelScale& scale, const Proposal& proposal) {
    // A head of 80 bytes that begins with "solid" would be taken for text.
    std::string out = "BehaviourLinks binary; mm; tick " + std::to_string(proposal.tick) + "; hash " + proposal.hash + "; form " +
                      reading::choice_of(proposal.form).id;
    out.resize(80, ' ');
    std::uint32_t count = 0;
    for (const Solid& solid : solids) count += static_cast<std::uint32_t>(solid.mesh->triangles.size());
    put(out, count, 4);
    for (const Solid& solid : solids)
      for (const auto& [i, j, k] : solid.mesh->triangles) {
        const Point3 a = scale.millimetres(solid.mesh->vertices[i]), b = scale.millimetres(solid.mesh->vertices[j]),
                     c = scale.millimetres(solid.mesh->vertices[k]);
        put(out, normal_of(a, b, c));
        for (const Point3& p : {a, b, c}) put(out, p);
        put(out, 0, 2);
      }
    return out;
  }

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options, bool is_folder) {
    ExportFiles made;
    made.notes = left_out_cellars(proposal, options.cellars);
    const std::vector<Solid> solids = printable_solids_of(proposal, options.surroundings, options.cellars, made.notes);
    // All files of a folder lie in one frame, so that they fit together.
    const ModelScale scale(solids, options.scale);
    const std::string note = "BehaviourLinks, 1:" + shortest(options.scale) + ", mm; " + identity_line(proposal);
    const auto add = [&](const std::string& name, const std::vector<Solid>& part) {
      made.files.push_back(
          {name, options.layout == StlLayout::text ? as_text(part, scale, note) : as_binary(part, scale, proposal)});
    };
    if (!is_folder) add("model.stl", solids);
    std::size_t existing = 0;
    for (std::size_t k = 0; is_folder && k < solids.size(); ++k) {
      const Building* building = solids[k].building;
      const std::string name = building == nullptr ? "existing_" + std::to_string(++existing) : building->id;
      add(name + (solids[k].is_cellar ? "-cellar" : "") + ".stl", {solids[k]});
    }
    return made;
  }
};

}  // namespace

BL_FORMAT(stl, StlFormat)

}  // namespace bl::exporting
