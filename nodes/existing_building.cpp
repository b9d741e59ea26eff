// An existing building: a footprint between two heights or a closed mesh, with the source of its height.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/polygon_triangles.h"

namespace bl {

namespace {

struct ExistingBuilding {
  enum class Form { extrusion, mesh };
  enum class Source { geometry, tag, levels, neighbour, assumed };

  struct In {
    Form form = Form::extrusion;
    std::vector<Point3> outline = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
    Table holes;
    double base = 0, height = 9.6;
    bool is_above_sea = false;
    Source height_source = Source::assumed;
    double storey_height = 3.2;
    std::string use, origin;
    std::vector<Point3> vertices;
    Table triangles;
  };

  struct Out {
    double volume = 0, footprint = 0, floor_area = 0, top = 0;
    bool is_assumed = false;
    MeshPointer mesh;
  };

  static void declare(TypificationBuilder<ExistingBuilding>& t) {
    t.id("existing_building").label("Existing building");
    t.doc("A building that exists already and stays. It is context, from a map or a city model.");
    t.in(&In::form, "form",
         {{Form::extrusion, "extrusion", "The outline from the base up to the height."},
          {Form::mesh, "mesh", "The closed mesh of `vertices` and `triangles`; the outline is its footprint."}})
        .doc("How the body is given.");
    t.in(&In::outline, "outline")
        .unit(Unit::metre)
        .doc("Corners of the footprint, in order around it; their heights are ignored.");
    t.in(&In::holes, "holes")
        .column({.id = "name", .is_text = true, .default_value = std::string(), .doc = "Rows with the same name make one court."})
        .column({.id = "x", .unit = Unit::metre, .minimum = -1e8, .maximum = 1e8, .doc = "East coordinate of the corner."})
        .column({.id = "y", .unit = Unit::metre, .minimum = -1e8, .maximum = 1e8, .doc = "North coordinate of the corner."})
        .doc("Courts in the footprint, one corner per row.");
    t.in(&In::base, "base")
        .unit(Unit::metre)
        .range(-1e4, 1e5)
        .soft(-20, 50)
        .combine(CombineRule::blend)
        .doc("Height of the underside above the origin.");
    t.in(&In::is_above_sea, "is_above_sea")
        .doc(
            "The source gave heights above the sea. When off, they count from the ground: an import of a terrain, or onto one, "
            "adds the height of the ground to the base.");
    t.in(&In::height, "height")
        .unit(Unit::metre)
        .range(0.01, 1e5)
        .soft(2, 200)
        .combine(CombineRule::blend)
        .doc("Height from the underside to the top. Used where the form is `extrusion`.");
    t.in(&In::height_source, "height_source",
         {{Source::geometry, "geometry", "Measured on the model that the building came from."},
          {Source::tag, "tag", "Given as an attribute of the building in its source."},
          {Source::levels, "levels", "The number of storeys times the storey height."},
          {Source::neighbour, "neighbour", "Assumed: the median of known buildings nearby."},
          {Source::assumed, "default", "Assumed: nothing is known about it."}})
        .doc("Source of the height; the last two are assumptions, and are drawn as such.");
    t.in(&In::storey_height, "storey_height")
        .unit(Unit::metre)
        .range(1, 50)
        .soft(2.4, 6)
        .doc("Height from floor to floor, used to estimate the floor area.");
    t.in(&In::use, "use").doc("What the building is used for, such as `apartments`.");
    t.in(&In::origin, "origin").doc("Origin of the data: the source, and the building's id in it.");
    t.in(&In::vertices, "vertices").unit(Unit::metre).doc("Corners of the mesh. Used where the form is `mesh`.");
    t.in(&In::triangles, "triangles")
        .column(index_column("a", "First"))
        .column(index_column("b", "Second"))
        .column(index_column("c", "Third"))
        .doc("The closed surface: three corners per triangle, counter-clockwise seen from outside.");
    declare_results(t);
  }

  static void declare_results(TypificationBuilder<ExistingBuilding>& t) {
    t.out(&Out::volume, "volume").unit(Unit::cubic_metre).doc("Volume of the body.");
    t.out(&Out::footprint, "footprint").unit(Unit::square_metre).doc("Area of the outline without its courts.");
    t.out(&Out::floor_area, "floor_area")
        .unit(Unit::square_metre)
        .doc(
            "Estimate: the footprint times the number of whole storeys, at least one. For a mesh: its volume divided by the "
            "storey height.");
    t.out(&Out::top, "top").unit(Unit::metre).doc("Height of the highest point above the origin.");
    t.out(&Out::is_assumed, "is_assumed").doc("On where the height is an assumption: taken from neighbours, or the default.");
    t.out(&Out::mesh, "mesh").doc("The body as a closed triangle mesh, for display, shadows and export.");
  }

  static ColumnDefinition index_column(const char* id, const std::string& which) {
    return {.id = id, .minimum = 0, .maximum = 1e9, .doc = which + " corner: its index in `vertices`, counted from 0."};
  }

  static Result<void> check_ring(const std::vector<Point3>& ring, const std::string& place) {
    if (ring.size() < 3)
      return Error{ErrorCode::geometry, place, "a ring needs at least 3 corners; this one has " + std::to_string(ring.size())};
    if (const auto crossing = geometry::find_self_crossing(ring))
      return Error{
          ErrorCode::geometry, place,
          "the ring meets itself at (" + fixed(crossing->where.x, 3) + ", " + fixed(crossing->where.y, 3) + "): redraw it there"};
    return {};
  }

  static Result<Mesh> given_mesh(const In& in) {
    Mesh mesh{in.vertices, {}};
    for (std::size_t row = 0; row < in.triangles.rows.size(); ++row) {
      auto& corners = mesh.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const double index = in.triangles.number(row, i == 0 ? "a" : i == 1 ? "b" : "c");
        if (!(index < static_cast<double>(in.vertices.size())) || index != std::floor(index))
          return Error{ErrorCode::out_of_range, "triangles/" + std::to_string(row),
                       "names a vertex that does not exist, " + shortest(index)};
        corners[i] = static_cast<std::uint32_t>(index);
      }
    }
    if (mesh.triangles.empty() || !(enclosed_volume(mesh) > 0))
      return Error{ErrorCode::geometry, "triangles",
                   "the mesh encloses no volume, or is turned inside out: turn its triangles, or use the form `extrusion`"};
    return mesh;
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (auto sound = check_ring(in.outline, "outline"); !sound) return sound.error();
    Out out;
    std::vector<geometry::Ring> holes;
    out.footprint = std::abs(geometry::signed_area(in.outline));
    for (const geometry::NamedRing& hole : geometry::read_rings(in.holes)) {
      if (auto sound = check_ring(hole.corners, "holes/" + std::to_string(hole.first_row)); !sound) return sound.error();
      holes.push_back(hole.corners);
      out.footprint -= std::abs(geometry::signed_area(hole.corners));
    }
    if (!(out.footprint > 0)) return Error{ErrorCode::geometry, "outline", "the outline encloses no area outside its courts"};
    out.is_assumed = in.height_source == Source::neighbour || in.height_source == Source::assumed;
    if (in.form == Form::extrusion) {
      out.top = in.base + in.height;
      out.volume = out.footprint * in.height;
      out.floor_area = out.footprint * std::max(1.0, std::floor(in.height / in.storey_height + 1e-9));
      out.mesh = std::make_shared<const Mesh>(geometry::prism_mesh(in.outline, holes, in.base, out.top));
      return out;
    }
    auto mesh = given_mesh(in);
    if (!mesh) return mesh.error();
    out.top = mesh->vertices.front().z;
    for (const Point3& vertex : mesh->vertices) out.top = std::max(out.top, vertex.z);
    out.volume = enclosed_volume(*mesh);
    out.floor_area = out.volume / in.storey_height;
    out.mesh = std::make_shared<const Mesh>(std::move(*mesh));
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(existing_building, ExistingBuilding)
