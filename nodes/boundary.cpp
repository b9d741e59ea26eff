// The boundary of a power diagram: the convex hull of points, or a plan polygon between two heights.
#include <algorithm>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/convex_domain.h"

namespace bl {

namespace {

struct Boundary {
  enum class Form { hull, plan };

  struct In {
    Form form = Form::hull;
    std::vector<Point3> points = {{-20, -20, 0},  {20, -20, 0},  {20, 20, 0},  {-20, 20, 0},
                                  {-20, -20, 20}, {20, -20, 20}, {20, 20, 20}, {-20, 20, 20}};
    std::vector<Point3> plan = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
    double bottom = 0, height = 20;
  };

  struct Out {
    Table planes;
    double volume = 0, ground_area = 0;
    MeshPointer shape;
  };

  static void declare(TypificationBuilder<Boundary>& t) {
    t.id("boundary").label("Boundary");
    t.doc("The space that SmartVolumes may take: all of their cells together fill it, and none reaches out of it.");
    t.in(&In::form, "form",
         {{Form::hull, "hull", "The convex hull of `points`: the smallest convex body that holds them all."},
          {Form::plan, "plan", "The polygon `plan`, drawn up from `bottom` to `height` above it."}})
        .doc("How the boundary is given.");
    t.in(&In::points, "points")
        .unit(Unit::metre)
        .doc("At least four points that do not lie in one plane. Used where the form is `hull`.");
    t.in(&In::plan, "plan")
        .unit(Unit::metre)
        .doc("Corners of a convex polygon, in order around it; their heights count for nothing. Used where the form is `plan`.");
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
    t.out(&Out::planes, "planes")
        .column({.id = "x", .doc = "First component of the outward unit normal."})
        .column({.id = "y", .doc = "Second component of the outward unit normal."})
        .column({.id = "z", .doc = "Third component of the outward unit normal."})
        .column({.id = "offset", .unit = Unit::metre, .doc = "Distance of the plane from the origin along the normal."})
        .doc("The sides of the boundary, in a fixed order: row k is the side `#k`. This is what other nodes and links read.");
    t.out(&Out::volume, "volume").unit(Unit::cubic_metre).doc("Volume inside the boundary.");
    t.out(&Out::ground_area, "ground_area")
        .unit(Unit::square_metre)
        .doc("Area that the boundary covers in plan, seen from above.");
    t.out(&Out::shape, "shape").doc("The boundary as a triangle mesh, for the eye and for export.");
  }

  // Of a convex body: what its upward triangles cover.
  static double area_in_plan(const Mesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3 normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      area += 0.5 * std::max(0.0, normal.z);
    }
    return area;
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    const bool is_hull = in.form == Form::hull;
    const auto domain = is_hull ? convex_hull(in.points) : extrude(in.plan, in.bottom, in.bottom + in.height);
    if (!domain) return domain.error().within(is_hull ? "points" : "plan");
    Out out;
    out.planes.columns = {"x", "y", "z", "offset"};
    for (const Plane& plane : domain->planes)
      out.planes.rows.push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
    out.volume = domain->volume;
    out.shape = std::make_shared<const Mesh>(to_mesh(*domain));
    out.ground_area = area_in_plan(*out.shape);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(boundary, Boundary)
