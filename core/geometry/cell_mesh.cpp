// Wraps whole cells with one centre, and the parts of cells in several pieces each with its own, put together where they are
// open.
#include "core/geometry/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/geometry/inside/none.h"
#include "core/geometry/tessellate.h"

namespace bl::geometry {

namespace {

// A site this share of its radius inside its own cell is the centre of the shrink-wrap, as in 2007.
constexpr double kInsideShare = 1e-6;
// Of the ball's radius: places of two parts that are no farther apart are one.
constexpr double kRemadeWeld = 1e-7;
constexpr double kUnwrapped = std::numeric_limits<double>::infinity();

Mesh mesh_of_one(const Polyhedron& part, double radius, int depth, const Point3& centre, const Point3& at) {
  std::vector<FaceLoop> loops;
  for (const PolyhedronFace& face : part.faces) loops.push_back(part.loop(face));
  return tessellate(part.vertices, loops, depth, radius, {centre}, at);
}

void append_mesh(const Mesh& part, Mesh& whole) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles) whole.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

// Vertices of the parts' borders that are one place become one vertex, so that those who follow edges find no gap.
void weld_borders(Mesh& mesh, const std::vector<std::uint32_t>& border, double tolerance) {
  if (border.empty()) return;
  std::vector<std::uint32_t> order = border, twin(mesh.vertices.size());
  std::iota(twin.begin(), twin.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const double a = mesh.vertices[i].x, b = mesh.vertices[j].x;
    return a != b ? a < b : i < j;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (twin[order[i]] != order[i]) continue;
    const Point3& place = mesh.vertices[order[i]];
    for (std::size_t j = i + 1; j < order.size() && mesh.vertices[order[j]].x - place.x <= tolerance; ++j)
      if (twin[order[j]] == order[j] && distance(mesh.vertices[order[j]], place) <= tolerance) twin[order[j]] = order[i];
  }
  std::vector<std::uint32_t> number(mesh.vertices.size());
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (twin[v] == v) {
      number[v] = count;
      mesh.vertices[count++] = mesh.vertices[v];
    }
  mesh.vertices.resize(count);
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = number[twin[corner]];
}

void drop_unused(Mesh& mesh) {
  std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);
  std::vector<Point3> used;
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) {
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.vertices[corner]);
      }
      corner = number[corner];
    }
  mesh.vertices = std::move(used);
}

}  // namespace

bool holds(const Polyhedron& part, double squared_radius, const Point3& point, double margin) {
  for (const PolyhedronFace& face : part.faces) {
    if (!(dot(face.normal, point) <= face.offset - margin)) return false;
  }
  return squared_norm(point) <= squared_radius;
}

Point3 wrap_centre(const Polyhedron& part, double squared_radius, const Point3& other) {
  return holds(part, squared_radius, {}, kInsideShare * std::sqrt(squared_radius)) ? Point3{} : other;
}

Mesh make_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, std::span<const OpenPart> open,
               const PowerSite& site, int depth, const Point3& centroid) {
  // Towards the site, or where it is not inside its own cell, towards the centroid.
  const double radius = std::sqrt(site.weight);
  if (parts.size() == 1) return mesh_of_one(parts[0], radius, depth, wrap_centre(parts[0], site.weight, centroid), site.position);
  // Each part has a point of its own, because the way to one in another part may lead out of the domain.
  Mesh whole;
  std::vector<std::uint32_t> border, own;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (shapes[k].is_empty) continue;
    const WrapTargets targets{wrap_centre(parts[k], site.weight, shapes[k].centroid), open[k].marks, open[k].seams};
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    append_mesh(tessellate(open[k].corners, open[k].faces(), depth, radius, targets, site.position, &own), whole);
    for (const std::uint32_t vertex : own) border.push_back(first + vertex);
  }
  // Both sides of an opening have found its corners within the tolerance; wrapping and adding up may have moved them a little
  // more.
  weld_borders(whole, border, 8 * seam_tolerance(parts));
  return whole;
}

Mesh make_coarse_mesh(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, std::span<const OpenPart> open,
                      const PowerSite& site, const Point3& centroid) {
  Mesh whole;
  MeshWrap wrap{site.position, std::sqrt(site.weight), {}, {}};
  const OpenPart whole_cell;
  if (parts.size() == 1) open = {&whole_cell, 1};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts.size() > 1 && shapes[k].is_empty) continue;
    const Point3 centre = wrap_centre(parts[k], site.weight, parts.size() == 1 ? centroid : shapes[k].centroid);
    const Mesh mesh = parts.size() == 1 ? mesh_of_one(parts[k], kUnwrapped, 0, {}, site.position)
                                        : tessellate(open[k].corners, open[k].faces(), 0, kUnwrapped, {}, site.position);
    MeshWrap::Part part{static_cast<std::uint32_t>(mesh.triangles.size()), site.position + centre, {}};
    for (const Point3& seam : open[k].seams) part.seams.push_back(site.position + seam);
    const std::size_t first = whole.vertices.size();
    append_mesh(mesh, whole);
    wrap.seams.resize(whole.vertices.size(), 0);
    std::copy(open[k].marks.begin(), open[k].marks.end(), wrap.seams.begin() + static_cast<std::ptrdiff_t>(first));
    wrap.parts.push_back(std::move(part));
  }
  whole.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return whole;
}

MeshPointer mesh_of_depth(const MeshPointer& mesh, int depth) {
  if (!mesh.coarse() || !mesh.coarse()->wrap || mesh.has_depth(depth)) return mesh;
  const Mesh& coarse = *mesh.coarse();
  const MeshWrap& wrap = *coarse.wrap;
  Mesh whole;
  std::vector<std::uint32_t> border, own;
  std::size_t at = 0;
  for (const MeshWrap::Part& part : wrap.parts) {
    const auto triangles = std::span(coarse.triangles).subspan(at, part.triangles);
    at += part.triangles;
    std::uint32_t lowest = kNone, end = 0;
    for (const auto& [a, b, c] : triangles) {
      lowest = std::min({lowest, a, b, c});
      end = std::max({end, a + 1, b + 1, c + 1});
    }
    if (triangles.empty()) continue;
    // The triangles of a face share their first corner, and the second ones go round it.
    std::vector<std::vector<std::uint32_t>> loops;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (t == 0 || triangles[t][0] != triangles[t - 1][0]) loops.emplace_back();
      loops.back().push_back(triangles[t][1] - lowest);
    }
    std::vector<Point3> corners;
    for (std::uint32_t v = lowest; v < end; ++v) corners.push_back(coarse.vertices[v] - wrap.ball_centre);
    std::vector<Point3> seams;
    for (const Point3& seam : part.seams) seams.push_back(seam - wrap.ball_centre);
    const std::vector<FaceLoop> faces(loops.begin(), loops.end());
    const WrapTargets targets{part.centre - wrap.ball_centre, std::span(wrap.seams).subspan(lowest, end - lowest), seams};
    const auto first = static_cast<std::uint32_t>(whole.vertices.size());
    append_mesh(tessellate(corners, faces, depth, wrap.radius, targets, wrap.ball_centre, &own), whole);
    for (const std::uint32_t vertex : own) border.push_back(first + vertex);
  }
  weld_borders(whole, border, kRemadeWeld * wrap.radius);
  // The centres of the coarse faces among them.
  drop_unused(whole);
  return std::make_shared<const Mesh>(std::move(whole));
}

}  // namespace bl::geometry
