// Projections of meshes along the sun's rays.
#include "core/sun/shadow_shape.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "core/base/mathematics.h"

namespace bl::sun {

namespace {

constexpr double kLeastRise = 1e-6;  // of a unit vector to the sun: lower suns throw shadows without end
constexpr double kLongest = 1e5;     // of a shadow [m]: beyond that the earth is not level any more

// A strict weak order of points, so that equal corners meet whatever mesh they come from.
struct PointOrder {
  bool operator()(const Point3& a, const Point3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
};

Point3 on_ground(const Point3& p, const Vector3& toward, double ground) {
  const double back = (p.z - ground) / toward.z;
  return {p.x - toward.x * back, p.y - toward.y * back, ground};
}

// Where an edge passes the plane: the same bits from both ends.
Point3 crossing(Point3 a, Point3 b, double ground) {
  if (PointOrder{}(b, a)) std::swap(a, b);
  const double share = (ground - a.z) / (b.z - a.z);
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, ground};
}

// The part of a triangle that is not below the plane: none, or three or four corners.
struct PartAbove {
  std::array<Point3, 4> corners;
  std::size_t count = 0;

  operator std::span<const Point3>() const { return std::span(corners).first(count); }
};

PartAbove above_ground(const Point3& a, const Point3& b, const Point3& c, double ground) {
  PartAbove part;
  const Point3 corners[3] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    const Point3 &here = corners[i], &next = corners[(i + 1) % 3];
    if (here.z >= ground) part.corners[part.count++] = here;
    if ((here.z < ground && next.z > ground) || (here.z > ground && next.z < ground))
      part.corners[part.count++] = crossing(here, next, ground);
  }
  if (part.count < 3) part.count = 0;
  return part;
}

// Is there a shadow to draw at all?
bool has_shape(const Mesh& mesh, const Vector3& toward, double ground) {
  if (!(toward.z > kLeastRise)) return false;
  double highest = ground;
  for (const Point3& vertex : mesh.vertices) highest = std::max(highest, vertex.z);
  return (highest - ground) * mathematics::hypotenuse(toward.x, toward.y) <= kLongest * toward.z;
}

double turn(const Point3& a, const Point3& b, const Point3& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Andrew's monotone chain.
std::vector<Point3> hull_in_plan(std::vector<Point3> points) {
  std::sort(points.begin(), points.end(), PointOrder{});
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  std::vector<Point3> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point3& point : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull.size() < 3 ? std::vector<Point3>{} : hull;
}

// Walls of neighbours stand back to back; what is left over are those along the outline of the lit side.
using Walls = std::map<std::pair<Point3, Point3>, int, decltype([](const auto& a, const auto& b) {
                         const PointOrder less;
                         if (less(a.first, b.first) || less(b.first, a.first)) return less(a.first, b.first);
                         return less(a.second, b.second);
                       })>;

class MeshWriter {
 public:
  void add(const Point3& a, const Point3& b, const Point3& c) {
    const std::array<std::uint32_t, 3> corners{index(a), index(b), index(c)};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) mesh.triangles.push_back(corners);
  }
  Mesh mesh;

 private:
  std::uint32_t index(const Point3& point) {
    const auto [it, is_new] = indices_.emplace(point, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(point);
    return it->second;
  }
  std::map<Point3, std::uint32_t, PointOrder> indices_;
};

}  // namespace

std::vector<Point3> shadow_outline(const Mesh& mesh, const Vector3& toward, double ground) {
  if (!has_shape(mesh, toward, ground)) return {};
  // Corners are thrown onto the ground once for all triangles that meet in them.
  std::vector<bool> is_above(mesh.vertices.size());
  std::vector<Point3> points;
  for (const auto& triangle : mesh.triangles) {
    const Point3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    if (a.z >= ground && b.z >= ground && c.z >= ground) {
      for (const std::uint32_t corner : triangle) is_above[corner] = true;
      continue;
    }
    const PartAbove part = above_ground(a, b, c, ground);
    for (const Point3& corner : std::span<const Point3>(part)) points.push_back(on_ground(corner, toward, ground));
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (is_above[v]) points.push_back(on_ground(mesh.vertices[v], toward, ground));
  return hull_in_plan(std::move(points));
}

Mesh shadow_volume(const Mesh& mesh, const Vector3& toward, double ground) {
  if (!has_shape(mesh, toward, ground)) return {};
  MeshWriter writer;
  Walls walls;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    if (!(dot(cross(q - p, r - p), toward) > 0)) continue;
    const PartAbove above = above_ground(p, q, r, ground);
    const std::span<const Point3> part = above;
    for (std::size_t i = 2; i < part.size(); ++i) {
      writer.add(part[0], part[i - 1], part[i]);
      writer.add(on_ground(part[0], toward, ground), on_ground(part[i], toward, ground), on_ground(part[i - 1], toward, ground));
    }
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Point3 &from = part[i], &to = part[(i + 1) % part.size()];
      const auto back = walls.find({to, from});
      if (back == walls.end()) ++walls[{from, to}];
      else if (--back->second == 0) walls.erase(back);
    }
  }
  for (const auto& [wall, count] : walls)
    for (int i = 0; i < count; ++i) {
      const auto& [from, to] = wall;
      const Point3 low_from = on_ground(from, toward, ground), low_to = on_ground(to, toward, ground);
      writer.add(from, low_from, low_to);
      writer.add(from, low_to, to);
    }
  return std::move(writer.mesh);
}

std::vector<SunPlane> solar_envelope(const Point3& a, const Point3& b, const Point3& inside, std::span<const Vector3> suns) {
  std::vector<SunPlane> planes;
  for (const Vector3& sun : suns) {
    Vector3 normal = cross(b - a, sun);
    const double length = norm(normal);
    if (!(sun.z > kLeastRise) || !(length > 1e-9 * distance(a, b))) continue;
    normal = normal / length;
    if (normal.z < 0) normal = -normal;
    // The sun has to stand behind the building, seen from the edge: the plane then rises over it.
    const Vector3 level{(b - a).y, -(b - a).x, 0};
    if (!(dot(level, sun) * dot(level, inside - a) > 0)) continue;
    planes.push_back({normal, dot(normal, a)});
  }
  return planes;
}

}  // namespace bl::sun
