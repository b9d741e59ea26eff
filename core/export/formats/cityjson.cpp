// Buildings, plots and surroundings as CityJSON 2.0: solids of LoD 1.2 and 2.2 with semantic surfaces.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>

#include "core/drawing/use_colours.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/read_proposal.h"
#include "core/geometry/mesh_lines.h"
#include "core/geometry/plan_split.h"
#include "core/reading/figures.h"

namespace bl::exporting {

namespace {

// Equal storeys of a standing building, one upon another.
struct CityTier {
  const std::vector<geometry::PlateFace>* faces = nullptr;
  double bottom = 0, top = 0;  // [m]
};

bool are_equal(const std::vector<geometry::PlateFace>& a, const std::vector<geometry::PlateFace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const geometry::PlateFace& x, const geometry::PlateFace& y) {
    return x.outer == y.outer && x.holes == y.holes;
  });
}

constexpr double kSameHeight = 1e-6;  // [m]

std::vector<CityTier> tiers_of(const Building& b) {
  std::vector<CityTier> tiers;
  if (!b.is_standing) return tiers;
  for (const Storey& s : b.storeys) {
    if (!tiers.empty() && std::abs(tiers.back().top - s.bottom) < kSameHeight && are_equal(*tiers.back().faces, s.faces))
      tiers.back().top = s.top;
    else tiers.push_back({&s.faces, s.bottom, s.top});
  }
  return tiers;
}

// Roofs or undersides of all that stands, found by their heights.
class CityLids {
 public:
  void add(double height, const geometry::PlateFace& face) {
    Lid lid{height, &face, face.outer.front(), face.outer.front()};
    for (const Point3& p : face.outer) {
      lid.low = {std::min(lid.low.x, p.x), std::min(lid.low.y, p.y), 0};
      lid.high = {std::max(lid.high.x, p.x), std::max(lid.high.y, p.y), 0};
    }
    lids_.push_back(lid);
  }
  void sort() {
    std::stable_sort(lids_.begin(), lids_.end(), [](const Lid& a, const Lid& b) { return a.height < b.height; });
  }
  // Those at a height that may meet a face.
  std::vector<geometry::PlateFace> at(double height, const geometry::PlateFace& face) const {
    std::vector<geometry::PlateFace> found;
    auto lid = std::lower_bound(lids_.begin(), lids_.end(), height - kSameHeight,
                                [](const Lid& one, double least) { return one.height < least; });
    for (; lid != lids_.end() && lid->height <= height + kSameHeight; ++lid) {
      const auto is_beside = [&](auto coordinate) {
        return std::all_of(face.outer.begin(), face.outer.end(),
                           [&](const Point3& p) { return coordinate(p) <= coordinate(lid->low); }) ||
               std::all_of(face.outer.begin(), face.outer.end(),
                           [&](const Point3& p) { return coordinate(p) >= coordinate(lid->high); });
      };
      if (!is_beside([](const Point3& p) { return p.x; }) && !is_beside([](const Point3& p) { return p.y; }))
        found.push_back(*lid->face);
    }
    return found;
  }

 private:
  struct Lid {
    double height = 0;
    const geometry::PlateFace* face = nullptr;
    Point3 low, high;
  };
  std::vector<Lid> lids_;
};

struct CityJsonFormat {
  using CityText = nlohmann::ordered_json;
  struct Options : FormOptions {
    bool surroundings = true;
  };

  static std::string why_not(VolumeForm form) {
    return form == VolumeForm::balls
               ? "a ball is no building, and CityJSON says buildings: use form=cells, form=slabs or form=standing"
               : "";
  }

  static void declare(FormatBuilder<CityJsonFormat>& f) {
    f.id("cityjson").label("City model (CityJSON 2.0)");
    f.doc(
        "Each building with a prism over its outline (LoD 1.2) and its closed shape with ground, wall, roof and overhanging "
        "surfaces (LoD 2.2), and closure surfaces where a part of a proposed building stands on another; its use, storeys and "
        "areas as attributes; plots as land use, and ground that is kept open as plant cover, water body or land use. "
        "Coordinates are those of the scene's "
        "coordinate system, which is named where it has an EPSG code; else a note says that they are metres of the scene.");
    f.ending(".city.json").begins("{\"type\":\"CityJSON\",\"version\":\"2.0\",\"metadata\":{\"identifier\":\"BehaviourLinks");
    f.option(&Options::surroundings, "surroundings").doc("With the buildings that stand already.");
    declare_form_option(f);
  }

  // Tenths of a millimetre: finer than anybody builds.
  static constexpr double kStep = 1e-4;
  enum CitySurface { ground = 0, wall = 1, roof = 2, ceiling = 3, closure = 4 };

  struct CityBuilder {
    const Proposal& proposal;
    CityText objects = CityText::object(), vertices = CityText::array();
    std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::size_t> places = {};
    CityLids roofs = {}, undersides = {};  // of all that stands
    std::size_t uncut = 0;                 // parts whose roofs and undersides could not be cut

    std::size_t vertex(const Point3& p) {
      const auto whole = [](double value) { return static_cast<std::int64_t>(std::llround(value / kStep)); };
      const auto [found, is_new] = places.emplace(std::tuple(whole(p.x), whole(p.y), whole(p.z)), vertices.size());
      if (is_new) vertices.push_back({whole(p.x), whole(p.y), whole(p.z)});
      return found->second;
    }

    // At a height; nothing where less than a triangle is left of it on the grid.
    CityText ring(const geometry::Ring& corners, double z, bool is_turned) {
      std::vector<std::size_t> indices;
      for (const Point3& corner : corners) {
        const std::size_t index = vertex({corner.x, corner.y, z});
        if (indices.empty() || indices.back() != index) indices.push_back(index);
      }
      while (indices.size() > 1 && indices.front() == indices.back()) indices.pop_back();
      if (is_turned) std::reverse(indices.begin(), indices.end());
      return indices.size() < 3 ? CityText() : CityText(indices);
    }
    CityText plate(const geometry::PlateFace& face, double z, bool is_turned) {
      CityText rings = CityText::array();
      if (CityText outer = ring(face.outer, z, is_turned); !outer.is_null()) rings.push_back(std::move(outer));
      else return CityText();
      for (const geometry::Ring& hole : face.holes)
        if (CityText inner = ring(hole, z, is_turned); !inner.is_null()) rings.push_back(std::move(inner));
      return rings;
    }

    struct Shell {
      CityText surfaces = CityText::array(), values = CityText::array();
      void add(CityText rings, CitySurface kind) {
        surfaces.push_back(std::move(rings));
        values.push_back(static_cast<int>(kind));
      }
      // Does each side run once in each direction?
      bool is_closed() const {
        std::vector<std::pair<std::size_t, std::size_t>> sides, opposite;
        for (const CityText& rings : surfaces)
          for (const CityText& one : rings)
            for (std::size_t k = 0; k < one.size(); ++k) {
              const auto from = one[k].get<std::size_t>(), to = one[(k + 1) % one.size()].get<std::size_t>();
              sides.emplace_back(from, to);
              opposite.emplace_back(to, from);
            }
        std::sort(sides.begin(), sides.end());
        std::sort(opposite.begin(), opposite.end());
        return sides == opposite && std::adjacent_find(sides.begin(), sides.end()) == sides.end();
      }
    };

    Shell prism(const geometry::PlateFace& face, double bottom, double top) {
      Shell shell;
      CityText low = plate(face, bottom, true), high = plate(face, top, false);
      if (low.is_null() || high.is_null()) return shell;
      // The walls follow the rings as they came out on the grid, so that sides fit.
      for (const CityText& ring : high) {
        std::vector<std::size_t> up = ring.get<std::vector<std::size_t>>(), down;
        for (const std::size_t index : up) {
          const CityText at = vertices[index];
          down.push_back(vertex({at[0].get<double>() * kStep, at[1].get<double>() * kStep, bottom}));
        }
        for (std::size_t k = 0; k < up.size(); ++k) {
          const std::size_t next = (k + 1) % up.size();
          shell.add(CityText::array({{down[k], down[next], up[next], up[k]}}), wall);
        }
      }
      shell.add(std::move(low), ground);
      shell.add(std::move(high), roof);
      return shell;
    }

    // Equal storeys one upon another, with one face of them.
    Shell part_of_building(const geometry::PlateFace& face, double bottom, double top, bool is_lowest) {
      const geometry::SplitFace low = geometry::split_face(face, roofs.at(bottom, face), kStep),
                                high = geometry::split_face(face, undersides.at(top, face), kStep);
      Shell shell;
      for (std::size_t r = 0; r < low.rings.size(); ++r)
        for (std::size_t k = 0; k < low.rings[r].size(); ++k) {
          const Point3 &from = low.rings[r][k], &to = low.rings[r][(k + 1) % low.rings[r].size()];
          std::vector<std::size_t> corners;
          const auto add = [&](const Point3& p, double z) { corners.push_back(vertex({p.x, p.y, z})); };
          add(from, bottom);
          for (const Point3& p : low.on_sides[r][k]) add(p, bottom);
          add(to, bottom), add(to, top);
          for (auto p = high.on_sides[r][k].rbegin(); p != high.on_sides[r][k].rend(); ++p) add(*p, top);
          add(from, top);
          shell.add(CityText::array({corners}), wall);
        }
      const auto lid = [&](const std::vector<geometry::PlateFace>& faces, double z, bool is_turned, CitySurface kind) {
        for (const geometry::PlateFace& one : faces)
          if (CityText made = plate(one, z, is_turned); !made.is_null()) shell.add(std::move(made), kind);
      };
      lid(low.free, bottom, true, is_lowest ? ground : ceiling);
      lid(low.covered, bottom, true, closure);
      lid(high.free, top, false, roof);
      lid(high.covered, top, false, closure);
      if (shell.is_closed()) return shell;
      ++uncut;
      return prism(face, bottom, top);
    }

    std::vector<Shell> standing(const Building& b) {
      std::vector<Shell> shells;
      for (const CityTier& tier : tiers_of(b))
        for (const geometry::PlateFace& face : *tier.faces)
          shells.push_back(part_of_building(face, tier.bottom, tier.top, tier.bottom == b.storeys.front().bottom));
      return shells;
    }

    Shell body(const Mesh& mesh, double bottom) {
      Shell shell;
      const std::vector<Vector3> normals = geometry::unit_normals(mesh);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const std::size_t i = vertex(mesh.vertices[a]), j = vertex(mesh.vertices[b]), k = vertex(mesh.vertices[c]);
        if (i == j || j == k || k == i) continue;
        const double lowest = std::min({mesh.vertices[a].z, mesh.vertices[b].z, mesh.vertices[c].z});
        const double up = normals[t].z;
        const CitySurface kind = up > 0.1 ? roof : up > -0.1 ? wall : lowest < bottom + 0.01 && up < -0.99 ? ground : ceiling;
        shell.add(CityText::array({{i, j, k}}), kind);
      }
      return shell;
    }

    static CityText geometry_of(std::vector<Shell> shells, const char* lod, bool has_semantics) {
      std::erase_if(shells, [](const Shell& shell) { return shell.surfaces.empty(); });
      if (shells.empty()) return CityText();
      const bool is_one = shells.size() == 1;
      CityText boundaries = CityText::array(), values = CityText::array();
      for (Shell& shell : shells) {
        boundaries.push_back(CityText::array({std::move(shell.surfaces)}));
        values.push_back(CityText::array({std::move(shell.values)}));
      }
      CityText made = {
          {"type", is_one ? "Solid" : "MultiSolid"}, {"lod", lod}, {"boundaries", is_one ? boundaries[0] : boundaries}};
      if (has_semantics)
        made["semantics"] = {{"surfaces",
                              {{{"type", "GroundSurface"}},
                               {{"type", "WallSurface"}},
                               {{"type", "RoofSurface"}},
                               {{"type", "OuterCeilingSurface"}},
                               {{"type", "ClosureSurface"}}}},
                             {"values", is_one ? values[0] : values}};
      return made;
    }

    std::vector<Shell> bodies_of(const Mesh* mesh, double bottom) {
      std::vector<Shell> bodies;
      if (mesh != nullptr)
        for (const Mesh& part : geometry::bodies_of(*mesh)) bodies.push_back(body(part, bottom));
      return bodies;
    }

    void add_building(const std::string& id, CityText attributes, const std::vector<geometry::PlateFace>& outline, double bottom,
                      double top, std::vector<Shell> bodies) {
      std::vector<Shell> prisms;
      for (const geometry::PlateFace& face : outline) prisms.push_back(prism(face, bottom, top));
      CityText shapes = CityText::array();
      if (CityText made = geometry_of(std::move(prisms), "1.2", false); !made.is_null()) shapes.push_back(std::move(made));
      if (CityText made = geometry_of(std::move(bodies), "2.2", true); !made.is_null()) shapes.push_back(std::move(made));
      objects[id] = {{"type", "Building"}, {"attributes", std::move(attributes)}, {"geometry", std::move(shapes)}};
    }

    // Each storey below the ground is a part of its building.
    void add_cellars(const Building& b) {
      const std::string parent = "building/" + b.id;
      for (const Storey& s : b.cellars) {
        const std::string id = parent + "/" + std::to_string(s.number);
        std::vector<Shell> prisms;
        for (const geometry::PlateFace& face : s.faces) prisms.push_back(prism(face, s.bottom, s.top));
        CityText shapes = CityText::array();
        if (CityText made = geometry_of(std::move(prisms), "1.2", false); !made.is_null()) shapes.push_back(std::move(made));
        objects[id] = {{"type", "BuildingPart"},
                       {"attributes", {{"name", b.label}, {"function", b.use}, {"storey", s.number}, {"area_m2", s.floor_area}}},
                       {"parents", CityText::array({parent})},
                       {"geometry", std::move(shapes)}};
        if (!objects[parent].contains("children")) objects[parent]["children"] = CityText::array();
        objects[parent]["children"].push_back(id);
      }
    }

    void add_all(bool with_surroundings) {
      for (const Building& b : proposal.buildings)
        for (const CityTier& tier : tiers_of(b))
          for (const geometry::PlateFace& face : *tier.faces) roofs.add(tier.top, face), undersides.add(tier.bottom, face);
      roofs.sort(), undersides.sort();
      for (const Building& b : proposal.buildings) {
        add_building("building/" + b.id,
                     {{"name", b.label},
                      {"function", b.use},
                      {"form", b.is_standing ? "standing" : "rounded"},
                      {"storeysAboveGround", b.storeys.size()},
                      {"storeysBelowGround", b.cellars.size()},
                      {"measuredHeight", b.top - b.bottom},
                      {"floor_area_m2", b.floor_area},
                      {"asked_floor_area_m2", b.asked_area},
                      {"volume_m3", b.volume},
                      {"asked_volume_m3", b.asked_volume},
                      {"is_proposed", true}},
                     b.outline, b.bottom, b.top, b.is_standing ? standing(b) : bodies_of(b.mesh.get(), b.bottom));
        add_cellars(b);
      }
      if (with_surroundings)
        for (const Neighbour& n : proposal.neighbours)
          add_building("existing/" + n.id,
                       {{"name", n.name}, {"function", n.use}, {"measuredHeight", n.top - n.bottom}, {"is_proposed", false}},
                       {n.face}, n.bottom, n.top, bodies_of(n.mesh.get(), n.bottom));
      for (const Land& land : proposal.lands)
        if (!land.is_boundary)
          add_surface("plot/" + land.id, "LandUse",
                      {{"name", land.name}, {"area_m2", land.area}, {"fsi", land.fsi}, {"gsi", land.gsi}}, land.faces,
                      land.ground);
      add_open_ground();
    }

    void add_surface(const std::string& id, const char* type, CityText attributes, const std::vector<geometry::PlateFace>& faces,
                     double height) {
      CityText surfaces = CityText::array();
      for (const geometry::PlateFace& face : faces)
        if (CityText made = plate(face, height, false); !made.is_null()) surfaces.push_back(std::move(made));
      if (surfaces.empty()) return;
      objects[id] = {
          {"type", type},
          {"attributes", std::move(attributes)},
          {"geometry", CityText::array({{{"type", "MultiSurface"}, {"lod", "1"}, {"boundaries", std::move(surfaces)}}})}};
    }

    static const char* type_of_ground(const std::string& use) {
      const drawing::GroundCover cover = drawing::cover_of_use(use);
      return cover == drawing::GroundCover::water    ? "WaterBody"
             : cover == drawing::GroundCover::plants ? "PlantCover"
                                                     : "LandUse";
    }

    void add_open_ground() {
      for (const OpenSpace& open : proposal.open_spaces)
        add_surface("open_space/" + open.use, type_of_ground(open.use),
                    {{"name", open.use}, {"function", open.use}, {"area_m2", open.area}, {"asked_area_m2", open.asked_area}},
                    open.faces, proposal.ground);
      for (const KeptGround& kept : proposal.kept)
        add_surface("kept_clear/" + kept.kind, type_of_ground(kept.kind),
                    {{"name", kept.kind}, {"function", kept.kind + ", kept clear"}}, kept.faces, proposal.ground);
    }
  };

  static Result<ExportFiles> write(const Proposal& proposal, const Options& options) {
    CityBuilder made{proposal};
    made.add_all(options.surroundings);
    const importing::GeoReference& place = proposal.reference;
    CityText document = {{"type", "CityJSON"}, {"version", "2.0"}};
    // Other members of the root would need an extension: what the file is of stands in its identifier.
    CityText metadata = {{"identifier", "BehaviourLinks; " + identity_line(proposal)}, {"title", proposal.name()}};
    if (place.crs.starts_with("EPSG:"))
      metadata["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/" + place.crs.substr(5);
    document["metadata"] = std::move(metadata);
    document["transform"] = {{"scale", {kStep, kStep, kStep}}, {"translate", {place.origin_x, place.origin_y, 0}}};
    ExportFiles files;
    if (!place.crs.starts_with("EPSG:"))
      files.notes.push_back("the scene has no coordinate system with an EPSG code: the coordinates are metres of the scene" +
                            way_to_system(proposal));
    if (made.uncut > 0)
      files.notes.push_back(reading::counted(made.uncut, "part") + (made.uncut == 1 ? " counts" : " count") +
                            " as roof or ceiling also where another one lies on it: no closed body has these cut out");
    document["CityObjects"] = std::move(made.objects);
    document["vertices"] = std::move(made.vertices);
    files.files.push_back({"proposal.city.json", document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"});
    return files;
  }
};

}  // namespace

BL_FORMAT(cityjson, CityJsonFormat)

}  // namespace bl::exporting
