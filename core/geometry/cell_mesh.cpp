// Wraps whole cells with one centre, and cells in several pieces so that no gap opens between them.
#include "core/geometry/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/tessellate.h"

namespace bl {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A site this share of its radius inside its own cell is the centre of the shrink-wrap, as in 2007.
constexpr double kInsideShare = 1e-6;

Mesh mesh_of(const Polyhedron& part, double radius, int depth, const Point3& wrap_centre, const Point3& at) {
  std::vector<FaceLoop> loops;
  for (const PolyhedronFace& face : part.faces) {
    if (face.kind != FaceKind::inner) loops.push_back(part.loop(face));
  }
  return tessellate(part.vertices, loops, depth, {}, radius, wrap_centre, at);
}

// Nearest point of a face to the middle of its ball: where the ball reaches the face at all, it is in the ball and in the face.
Point3 nearest_on_face(const Polyhedron& part, const PolyhedronFace& face) {
  const Point3 foot = face.offset * face.normal;
  const FaceLoop loop = part.loop(face);
  Point3 best = foot;
  double least = kInfinity;
  bool is_inside = true;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point3 a = part.vertices[loop[i]], along = part.vertices[loop[(i + 1) % loop.size()]] - a;
    is_inside = is_inside && dot(face.normal, cross(along, foot - a)) >= 0;
    const Point3 on_edge = a + std::clamp(dot(foot - a, along) / std::max(1e-300, squared_norm(along)), 0.0, 1.0) * along;
    if (squared_norm(foot - on_edge) >= least) continue;
    least = squared_norm(foot - on_edge);
    best = on_edge;
  }
  return is_inside ? foot : best;
}

// The place on the ball, on the way from a point in it to one beyond it.
Point3 place_on_ball(double squared_radius, const Point3& inside, const Point3& beyond) {
  const Vector3 way = beyond - inside;
  const double a = squared_norm(way), b = dot(way, inside), rest = std::max(0.0, squared_radius - squared_norm(inside));
  const double root = std::sqrt(b * b + a * rest), t = b > 0 ? rest / (b + root) : (root - b) / a;
  return inside + std::min(1.0, t) * way;
}

// A face between two parts that the ball reaches, and the point of it that both of them see.
struct Seam {
  Vector3 normal;
  double offset, rounding;
  Point3 centre;
  bool holds(const Point3& point) const { return std::abs(dot(normal, point) - offset) <= rounding; }
};

std::vector<Seam> seams_of(const Polyhedron& part, double squared_radius) {
  std::vector<Seam> seams;
  const double rounding = 1e-9 * std::sqrt(part.reach_squared);
  for (const PolyhedronFace& face : part.faces) {
    if (face.kind != FaceKind::inner || face.offset * face.offset >= squared_radius) continue;
    const Point3 nearest = nearest_on_face(part, face);
    if (squared_norm(nearest) < squared_radius) seams.push_back({face.normal, face.offset, rounding, nearest});
  }
  return seams;
}

// One of several parts. Each moves its vertices towards a point of its own, because the way to one in another part may lead out
// of the domain. What lies on a face between two parts stays there and moves to a point that both of them see, so that no gap
// opens.
Mesh mesh_of_part(const Polyhedron& part, const PowerSite& site, int depth, const Point3& centre) {
  const std::vector<Seam> seams = seams_of(part, site.weight);
  Mesh mesh = mesh_of(part, kInfinity, depth, {}, {});
  for (Point3& vertex : mesh.vertices) {
    const auto seam = std::find_if(seams.begin(), seams.end(), [&](const Seam& s) { return s.holds(vertex); });
    if (squared_norm(vertex) > site.weight) {
      vertex = place_on_ball(site.weight, seam == seams.end() ? centre : seam->centre, vertex);
    }
    vertex += site.position;
  }
  return mesh;
}

}  // namespace

bool holds(const Polyhedron& part, double squared_radius, const Point3& point, double margin) {
  for (const PolyhedronFace& face : part.faces) {
    if (!(dot(face.normal, point) <= face.offset - margin)) return false;
  }
  return squared_norm(point) <= squared_radius;
}

Mesh make_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, const PowerSite& site, int depth,
               const Point3& centroid) {
  // Towards the site, or where it is not inside its own cell, towards the centroid.
  const double margin = kInsideShare * std::sqrt(site.weight);
  const bool is_inside =
      std::any_of(parts.begin(), parts.end(), [&](const Polyhedron& part) { return holds(part, site.weight, {}, margin); });
  if (parts.size() == 1) {
    return mesh_of(parts[0], std::sqrt(site.weight), depth, is_inside ? Point3{} : centroid, site.position);
  }
  Mesh whole;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (shapes[k].is_empty) continue;
    const Point3 centre = holds(parts[k], site.weight, {}, margin) ? Point3{} : shapes[k].centroid;
    const Mesh mesh = mesh_of_part(parts[k], site, depth, centre);
    const std::uint32_t first = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles) whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return whole;
}

MeshPointer make_coarse_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, const PowerSite& site,
                             const Point3& centroid) {
  const double margin = kInsideShare * std::sqrt(site.weight);
  Mesh whole;
  MeshWrap wrap{site.position, std::sqrt(site.weight), {}, {}};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts.size() > 1 && shapes[k].is_empty) continue;
    const Point3 other = parts.size() == 1 ? centroid : shapes[k].centroid;
    const Point3 centre = holds(parts[k], site.weight, {}, margin) ? Point3{} : other;
    const Mesh mesh = mesh_of(parts[k], kInfinity, 0, {}, site.position);
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    MeshWrap::Part part{static_cast<std::uint32_t>(mesh.triangles.size()), site.position + centre, {}};
    wrap.seams.resize(first + mesh.vertices.size(), 0);
    const std::vector<Seam> seams = parts.size() == 1 ? std::vector<Seam>() : seams_of(parts[k], site.weight);
    for (std::size_t s = 0; s < std::min<std::size_t>(seams.size(), MeshWrap::kMostSeams); ++s) {
      part.seams.push_back(site.position + seams[s].centre);
      // Corners only: the centre of a face that counts lies on no face between parts.
      for (std::size_t v = 0; v < parts[k].vertices.size(); ++v)
        if (seams[s].holds(parts[k].vertices[v])) wrap.seams[first + v] |= 1u << s;
    }
    whole.vertices.insert(whole.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles) whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    wrap.parts.push_back(std::move(part));
  }
  whole.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return std::make_shared<const Mesh>(std::move(whole));
}

}  // namespace bl
