// The boundary of a power diagram: a hull of points, a plan with holes and steps, or a closed mesh, cut back and hollowed.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/site_domain.h"

namespace bl {

namespace {

struct Boundary {
  enum class Form { hull, plan, mesh };

  struct In {
    Form form = Form::hull;
    std::vector<Point3> points = {{-20, -20, 0},  {20, -20, 0},  {20, 20, 0},  {-20, 20, 0},
                                  {-20, -20, 20}, {20, -20, 20}, {20, 20, 20}, {-20, 20, 20}};
    std::vector<Point3> plan = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
    double bottom = 0, height = 20;
    Table holes, steps;
    std::vector<Point3> vertices;
    Table triangles, setbacks, exclusions;
  };

  struct Out {
    Table planes, land_planes;
    double volume = 0, ground_area = 0, open_area = 0;
    Table open_areas;
    MeshPointer shape;
  };

  static void declare(TypificationBuilder<Boundary>& t) {
    t.id("boundary").label("Boundary");
    t.column(CanvasColumn::second);
    t.doc("The space that SmartVolumes may take. Their power cells together fill it, and no cell reaches outside it.");
    t.in(&In::form, "form",
         {{Form::hull, "hull", "The convex hull of `points`: the smallest convex body that holds them all."},
          {Form::plan, "plan", "The polygon `plan` without its `holes`, from `bottom` to `height` above it, with its `steps`."},
          {Form::mesh, "mesh", "The solid within the closed mesh of `vertices` and `triangles`."}})
        .doc("How the boundary is given.");
    t.in(&In::points, "points")
        .unit(Unit::metre)
        .doc("At least four points that do not lie in one plane. Used where the form is `hull`.");
    t.in(&In::plan, "plan")
        .unit(Unit::metre)
        .doc("Corners of a polygon, in order around it; their heights are ignored. Used where the form is `plan`.");
    t.in(&In::bottom, "bottom")
        .unit(Unit::metre)
        .range(-1e5, 1e5)
        .soft(-20, 20)
        .combine(CombineRule::blend)
        .doc("Height of the underside above the origin. Used where the form is `plan`.");
    t.in(&In::height, "height")
        .unit(Unit::metre)
        .range(0.01, 1e5)
        .soft(3, 200)
        .combine(CombineRule::blend)
        .doc("Height of the boundary from its underside to its top. Used where the form is `plan`.");
    ring_columns(t.in(&In::holes, "holes"))
        .doc("Courts and other holes in the plan, one corner per row. Used where the form is `plan`.");
    ring_columns(t.in(&In::steps, "steps"))
        .column(height_column("top", "Height of this step's top above the origin, in its first row."))
        .doc("Parts of the plan that rise to a height of their own, from `bottom` on. Used where the form is `plan`.");
    t.in(&In::vertices, "vertices").unit(Unit::metre).doc("Corners of the mesh. Used where the form is `mesh`.");
    t.in(&In::triangles, "triangles")
        .column(index_column("a", "First"))
        .column(index_column("b", "Second"))
        .column(index_column("c", "Third"))
        .doc("The closed surface: three corners per triangle, with one orientation throughout. Used where the form is `mesh`.");
    declare_cuts(t);
    declare_results(t);
  }

  static void declare_cuts(TypificationBuilder<Boundary>& t) {
    t.in(&In::setbacks, "setbacks")
        .column(component_column("x", "First"))
        .column(component_column("y", "Second"))
        .column(component_column("z", "Third"))
        .column(height_column("offset", "Distance of the plane from the origin along the normal, for a normal of length 1."))
        .doc("Planes that limit the boundary, such as setbacks. The part on the side of the normal is cut away.");
    ring_columns(t.in(&In::exclusions, "exclusions"))
        .column(height_column("bottom", "Height of the underside above the origin, in the first row."))
        .column(height_column("top", "Height of the top above the origin, in the first row."))
        .column({.id = "use",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "In the first row: the use of ground that is kept open, such as `garden`; empty for all else."})
        .doc(
            "Solids that are cut out of the boundary, such as buildings that stay, and ground that is kept open. Each is a plan "
            "between two heights.");
  }

  static void declare_results(TypificationBuilder<Boundary>& t) {
    plane_columns(t.out(&Out::planes, "planes"))
        .doc("The boundary as convex pieces, in a fixed order. Where the boundary is convex, row k is the side `#k`.");
    plane_columns(t.out(&Out::land_planes, "land_planes"))
        .doc("The same with the ground that `exclusions` take away; empty where there are none.");
    t.out(&Out::volume, "volume").shown_first().unit(Unit::cubic_metre).doc("Volume inside the boundary.");
    t.out(&Out::ground_area, "ground_area")
        .shown_first()
        .unit(Unit::square_metre)
        .doc("Area that the boundary covers in plan, seen from above.");
    t.out(&Out::open_area, "open_area")
        .unit(Unit::square_metre)
        .doc("Ground that `exclusions` with a use keep open to the sky. It is land of the plot, and no part of `ground_area`.");
    t.out(&Out::open_areas, "open_areas")
        .column({.id = "use", .is_text = true, .default_value = std::string(), .doc = "The use of the open ground."})
        .column({.id = "area",
                 .unit = Unit::square_metre,
                 .doc = "Ground that is open: within the boundary, without other exclusions, and counted once."})
        .column({.id = "drawn", .unit = Unit::square_metre, .doc = "Area of the polygons of this use."})
        .doc("The same by use, in the order of `exclusions`.");
    t.out(&Out::shape, "shape").doc("The boundary as a triangle mesh, for display and export.");
    t.made("domain", {"planes"}, &geometry::shared_domain<Shared<Table>>)
        .doc("The solid that `planes` bound, for solvers and links.");
    t.made("land", {"land_planes"}, &geometry::shared_domain<Shared<Table>>)
        .doc(
            "The solid that `land_planes` bound: its sides are the border of the plot, and no sides of ground that is left out.");
  }

  static PortBuilder<Table> plane_columns(PortBuilder<Table> port) {
    return port.column({.id = "x", .doc = "First component of the outward unit normal."})
        .column({.id = "y", .doc = "Second component of the outward unit normal."})
        .column({.id = "z", .doc = "Third component of the outward unit normal."})
        .column({.id = "offset", .unit = Unit::metre, .doc = "Distance of the plane from the origin along the normal."})
        .column({.id = "piece", .doc = "Number of the convex piece that the plane bounds."})
        .column({.id = "side", .doc = "Number k of the side `#k` that the face lies in; -1 between two pieces."});
  }
  static PortBuilder<Table> ring_columns(PortBuilder<Table> port) {
    return port
        .column(
            {.id = "name", .is_text = true, .default_value = std::string(), .doc = "Rows with the same name make one polygon."})
        .column({.id = "x", .unit = Unit::metre, .minimum = -1e8, .maximum = 1e8, .doc = "East coordinate of the corner."})
        .column({.id = "y", .unit = Unit::metre, .minimum = -1e8, .maximum = 1e8, .doc = "North coordinate of the corner."});
  }
  static ColumnDefinition height_column(const char* id, const char* doc) {
    return {.id = id, .unit = Unit::metre, .minimum = -1e8, .maximum = 1e8, .doc = doc};
  }
  static ColumnDefinition index_column(const char* id, const std::string& which) {
    return {.id = id, .minimum = 0, .maximum = 1e9, .doc = which + " corner: its index in `vertices`, counted from 0."};
  }
  static ColumnDefinition component_column(const char* id, const std::string& which) {
    return {.id = id, .doc = which + " component of the normal, of any length."};
  }

  static std::vector<geometry::PlanSolid> solids_of(const Table& table) {
    std::vector<geometry::PlanSolid> solids;
    for (geometry::NamedRing& ring : geometry::read_rings(table))
      solids.push_back({std::move(ring.corners), ring.bottom, ring.top});
    return solids;
  }

  // A polygon of a table is named by the row of its first corner.
  static Error at_row(Error error, const In& in) {
    for (const auto& [port, table] : {std::pair{"holes/", &in.holes}, {"steps/", &in.steps}, {"exclusions/", &in.exclusions}}) {
      if (!error.place.starts_with(port)) continue;
      const auto number = parse_number(std::string_view(error.place).substr(std::string_view(port).size()));
      if (number) error.place = port + std::to_string(geometry::read_rings(*table)[static_cast<std::size_t>(*number)].first_row);
    }
    return error;
  }

  using Solids = std::vector<geometry::PlanSolid>;

  // With these exclusions.
  static Result<geometry::Domain> whole(const In& in, const Solids& exclusions) {
    auto domain = whole_plan_or_body(in, exclusions);
    // In a plan the exclusions have been cut out together with everything else.
    return domain && in.form != Form::plan ? without_solids(*domain, exclusions) : std::move(domain);
  }

  static Result<geometry::Domain> whole_plan_or_body(const In& in, const Solids& exclusions) {
    if (in.form == Form::hull) {
      auto hull = geometry::convex_hull(in.points);
      return hull ? Result<geometry::Domain>(geometry::Domain(std::move(*hull))) : hull.error().within("points");
    }
    if (in.form == Form::plan) {
      geometry::SitePlan site{in.plan, {}, in.bottom, in.bottom + in.height, solids_of(in.steps), exclusions};
      for (geometry::NamedRing& hole : geometry::read_rings(in.holes)) site.holes.push_back(std::move(hole.corners));
      for (geometry::PlanSolid& step : site.steps) step.bottom = in.bottom;
      return site_domain(site);
    }
    Mesh mesh{in.vertices, {}};
    for (std::size_t row = 0; row < in.triangles.rows.size(); ++row) {
      auto& corners = mesh.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = static_cast<std::uint32_t>(in.triangles.number(row, i == 0 ? "a" : i == 1 ? "b" : "c"));
    }
    auto domain = geometry::from_closed_mesh(mesh);
    return domain ? domain : Result<geometry::Domain>(domain.error().within("triangles"));
  }

  // What each use takes of the ground that all other exclusions leave, one after another: so nothing counts twice, nor what lies
  // outside.
  static Result<void> measure_open(const In& in, Out& out) {
    Solids cut;
    std::vector<std::string> uses;
    std::map<std::string, Solids> open;
    for (geometry::NamedRing& ring : geometry::read_rings(in.exclusions)) {
      const std::string& use = in.exclusions.text(ring.first_row, "use");
      if (!use.empty() && !open.contains(use)) uses.push_back(use);
      (use.empty() ? cut : open[use]).push_back({std::move(ring.corners), ring.bottom, ring.top});
    }
    out.open_areas.columns = {"use", "area", "drawn"};
    if (uses.empty()) return {};
    auto left = whole(in, cut);
    for (const std::string& use : uses) {
      if (!left) return left.error();
      double drawn = 0;
      for (geometry::PlanSolid& solid : open[use]) {
        drawn += std::abs(geometry::signed_area(solid.ring));
        cut.push_back(std::move(solid));
      }
      const double before = area_in_plan(*left);
      left = whole(in, cut);
      const double area = left ? std::max(0.0, before - area_in_plan(*left)) : 0;
      out.open_areas.rows.push_back({use, area, drawn});
      out.open_area += area;
    }
    return left ? Result<void>() : left.error();
  }

  // With these exclusions, and cut by the planes of `setbacks`.
  static Result<geometry::Domain> cut_back(const In& in, const Solids& exclusions) {
    auto domain = whole(in, exclusions);
    std::vector<geometry::Plane> setbacks;
    for (std::size_t row = 0; row < in.setbacks.rows.size(); ++row) {
      const Vector3 normal{in.setbacks.number(row, "x"), in.setbacks.number(row, "y"), in.setbacks.number(row, "z")};
      setbacks.push_back({normal, in.setbacks.number(row, "offset") * norm(normal)});
    }
    if (!domain || setbacks.empty()) return domain;
    auto cut = cut_domain(*domain, setbacks);
    return cut ? cut : Result<geometry::Domain>(cut.error().within("setbacks"));
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    const auto domain = cut_back(in, solids_of(in.exclusions));
    if (!domain) return at_row(domain.error(), in);
    Out out;
    geometry::write_domain(geometry::Domain(), out.land_planes);
    if (!in.exclusions.rows.empty()) {
      const auto land = cut_back(in, {});
      if (!land) return at_row(land.error(), in);
      geometry::write_domain(*land, out.land_planes);
    }
    if (auto measured = measure_open(in, out); !measured) return measured.error();
    write_domain(*domain, out.planes);
    out.volume = domain->volume;
    out.shape = std::make_shared<const Mesh>(to_mesh(*domain));
    out.ground_area = area_in_plan(*domain);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(boundary, Boundary)
