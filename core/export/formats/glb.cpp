// Closed meshes as binary glTF 2.0: metres, Y up, one node for each building with its figures, uses as materials.
#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include <nlohmann/json.hpp>

#include "core/base/mathematics.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/mesh_options.h"
#include "core/export/solids.h"

namespace bl::exporting {

namespace {

struct GlbFormat {
  using GlbJson = nlohmann::ordered_json;
  // What is below the ground belongs to a model in metres, and whoever looks at it can hide it by its name.
  struct Options : MeshOptions {
    bool surroundings = true;
    Options() { cellars = true; }
  };

  static void declare(FormatBuilder<GlbFormat>& f) {
    f.id("glb").label("3D model (glTF 2.0 binary)");
    f.doc(
        "One file with all closed meshes, in metres, Y up: x east, y up, z south. Each building is a node with its name and its "
        "figures as extras; its use is its material. Coordinates are singles from the origin of the scene.");
    f.ending(".glb").marked({"glTF", "\"generator\":\"BehaviourLinks\"", ""});
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already, and terrain.");
    declare_mesh_options(f);
  }

  // Colours of glTF are linear, those of screens are not.
  static double linear(double value) {
    return value <= 0.04045 ? value / 12.92 : mathematics::power((value + 0.055) / 1.055, 2.4);
  }

  static void put(std::string& out, std::uint32_t bits) {
    for (int k = 0; k < 4; ++k) out += static_cast<char>((bits >> (8 * k)) & 0xffu);
  }

  struct GlbBuilder {
    GlbJson nodes = GlbJson::array(), meshes = GlbJson::array(), accessors = GlbJson::array(), views = GlbJson::array(),
            materials = GlbJson::array();
    std::map<std::string, std::size_t> material_of = {};
    std::string bytes = {};

    std::size_t view(std::size_t start, int target) {
      views.push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes.size() - start}, {"target", target}});
      return views.size() - 1;
    }

    std::size_t positions(const Mesh& mesh) {
      const std::size_t start = bytes.size();
      std::array<float, 3> low, high;
      low.fill(3e38f), high.fill(-3e38f);
      for (const Point3& v : mesh.vertices) {
        const std::array<float, 3> at = {static_cast<float>(v.x), static_cast<float>(v.z), static_cast<float>(-v.y)};
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
          put(bytes, std::bit_cast<std::uint32_t>(at[k]));
        }
      }
      accessors.push_back({{"bufferView", view(start, 34962)},
                           {"componentType", 5126},
                           {"count", mesh.vertices.size()},
                           {"type", "VEC3"},
                           {"min", low},
                           {"max", high}});
      return accessors.size() - 1;
    }

    std::size_t indices(const Mesh& mesh) {
      const std::size_t start = bytes.size();
      for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) put(bytes, corner);
      accessors.push_back({{"bufferView", view(start, 34963)},
                           {"componentType", 5125},
                           {"count", mesh.triangles.size() * 3},
                           {"type", "SCALAR"}});
      return accessors.size() - 1;
    }

    void add(const Solid& solid) {
      const auto [found, is_new] = material_of.emplace(solid.material, materials.size());
      if (is_new)
        materials.push_back(
            {{"name", solid.material},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {linear(solid.colour.red), linear(solid.colour.green), linear(solid.colour.blue), 1}},
               {"metallicFactor", 0},
               {"roughnessFactor", 0.9}}}});
      const std::size_t position = positions(*solid.mesh), index = indices(*solid.mesh);
      meshes.push_back(
          {{"name", solid.name},
           {"primitives",
            GlbJson::array({{{"attributes", {{"POSITION", position}}}, {"indices", index}, {"material", found->second}}})}});
      GlbJson node = {{"name", solid.name}, {"mesh", meshes.size() - 1}};
      if (const Building* b = solid.building; b != nullptr && solid.is_cellar) {
        double area = 0, volume = 0;
        for (const Storey& s : b->cellars) area += s.floor_area, volume += s.floor_area * (s.top - s.bottom);
        node["extras"] = {{"cellar_of", b->id},
                          {"use", b->use},
                          {"storeys", b->cellars.size()},
                          {"cellar_area_m2", area},
                          {"volume_m3", volume}};
      } else if (b != nullptr) {
        node["extras"] = {{"id", b->id},
                          {"use", b->use},
                          {"form", b->is_standing ? "standing" : "rounded"},
                          {"storeys", b->storeys.size()},
                          {"floor_area_m2", b->floor_area},
                          {"asked_floor_area_m2", b->asked_area},
                          {"volume_m3", b->volume},
                          {"asked_volume_m3", b->asked_volume}};
      }
      nodes.push_back(std::move(node));
    }
  };

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    GlbBuilder made;
    for (const Solid& solid : solids_of(proposal, options.surroundings, options.cellars)) made.add(solid);
    if (options.surroundings)
      for (const Solid& surface : terrains_of(proposal)) made.add(surface);
    GlbJson extras;
    for (const auto& [name, value] : identity_of(proposal)) extras[name] = value;
    GlbJson order = GlbJson::array();
    for (std::size_t k = 0; k < made.nodes.size(); ++k) order.push_back(k);
    const GlbJson document = {{"asset", {{"version", "2.0"}, {"generator", "BehaviourLinks"}, {"extras", extras}}},
                              {"scene", 0},
                              {"scenes", GlbJson::array({{{"name", proposal.name()}, {"nodes", order}}})},
                              {"nodes", made.nodes},
                              {"meshes", made.meshes},
                              {"materials", made.materials},
                              {"accessors", made.accessors},
                              {"bufferViews", made.views},
                              {"buffers", GlbJson::array({{{"byteLength", made.bytes.size()}}})}};
    std::string text = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    if (made.bytes.size() > 0xf0000000u) return Error{ErrorCode::out_of_range, "", "the meshes are larger than a GLB can hold"};
    std::string out = "glTF";
    put(out, 2);
    put(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + made.bytes.size()));
    put(out, static_cast<std::uint32_t>(text.size()));
    out += "JSON" + text;
    put(out, static_cast<std::uint32_t>(made.bytes.size()));
    out.append("BIN\0", 4);
    return ExportFiles{{{"proposal.glb", out + made.bytes}}, left_out_cellars(proposal, options.cellars)};
  }
};

}  // namespace

BL_FORMAT(glb, GlbFormat)

}  // namespace bl::exporting
