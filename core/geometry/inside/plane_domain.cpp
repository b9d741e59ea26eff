// A convex domain from half-spaces: a large box is cut by them, then the corners are made exact.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/geometry/inside/clipper.h"
#include "core/geometry/inside/domain_parts.h"

namespace bl::geometry {

namespace {

constexpr double kWeldShare = 1e-12;

double determinant(const Vector3& a, const Vector3& b, const Vector3& c) { return dot(a, cross(b, c)); }

// The point on three planes (Cramer's rule).
Point3 meeting_point(const Plane& a, const Plane& b, const Plane& c) {
  const Vector3 sum =
      a.offset * cross(b.normal, c.normal) + b.offset * cross(c.normal, a.normal) + c.offset * cross(a.normal, b.normal);
  return sum / determinant(a.normal, b.normal, c.normal) + Vector3{};
}

Result<std::vector<Plane>> unit_planes(std::span<const Plane> planes) {
  std::vector<Plane> result;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double length = norm(planes[k].normal);
    if (!is_finite(planes[k].normal) || !std::isfinite(planes[k].offset) || !std::isfinite(length)) {
      return Error{ErrorCode::not_finite, "", "boundary plane " + std::to_string(k) + " has a number that is not finite"};
    }
    if (!(length > 1e-100))
      return Error{ErrorCode::geometry, "", "boundary plane " + std::to_string(k) + " has no direction: its normal is zero"};
    result.push_back({planes[k].normal / length, planes[k].offset / length});
  }
  return result;
}

// Welds corners that fell together and writes the faces; each corner is the best-conditioned meeting point of its planes.
ConvexDomain exact_domain(const Polyhedron& shape, const std::vector<Plane>& planes, const Point3& origin) {
  double size = std::sqrt(shape.reach_squared);
  std::vector<std::uint32_t> place(shape.vertices.size());
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t v = 0; v < shape.vertices.size(); ++v) {
    const auto same = std::find_if(firsts.begin(), firsts.end(), [&](std::uint32_t w) {
      return distance(shape.vertices[w], shape.vertices[v]) <= kWeldShare * size;
    });
    place[v] = static_cast<std::uint32_t>(same - firsts.begin());
    if (same == firsts.end()) firsts.push_back(v);
  }
  std::vector<std::vector<std::uint32_t>> around(firsts.size());
  ConvexDomain domain;
  domain.planes = planes;
  domain.faces.resize(planes.size());
  for (const PolyhedronFace& face : shape.faces) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t v = place[shape.loops[face.first + i]];
      if (loop.empty() || loop.back() != v) loop.push_back(v);
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3 || loop.size() < domain.faces[face.index].size()) continue;
    domain.faces[face.index] = loop;
  }
  for (std::uint32_t k = 0; k < domain.faces.size(); ++k) {
    for (const std::uint32_t v : domain.faces[k]) around[v].push_back(k);
  }
  for (std::size_t v = 0; v < firsts.size(); ++v) {
    const auto& sides = around[v];
    Point3 corner = shape.vertices[firsts[v]] + origin;
    double best = 0.01;
    for (std::size_t a = 0; a < sides.size(); ++a) {
      for (std::size_t b = a + 1; b < sides.size(); ++b) {
        for (std::size_t c = b + 1; c < sides.size(); ++c) {
          const double det = std::abs(determinant(planes[sides[a]].normal, planes[sides[b]].normal, planes[sides[c]].normal));
          if (det <= best) continue;
          best = det;
          corner = meeting_point(planes[sides[a]], planes[sides[b]], planes[sides[c]]);
        }
      }
    }
    domain.vertices.push_back(corner);
  }
  return domain;
}

}  // namespace

Result<ConvexDomain> from_planes(std::span<const Plane> input) {
  if (input.size() < 4)
    return Error{ErrorCode::geometry, "", "a boundary needs at least 4 planes, " + std::to_string(input.size()) + " given"};
  auto planes = unit_planes(input);
  if (!planes) return planes.error();
  const double far_away = 2 * kLargestCoordinate;
  Vector3 low{-far_away, -far_away, -far_away}, high{far_away, far_away, far_away};
  Clipper clipper;
  Polyhedron shape;
  Point3 origin;
  // The first pass finds where the domain is, at the rounding of the large box; the others repeat it at the domain's own.
  for (int pass = 0; pass < 4; ++pass) {
    origin = 0.5 * (low + high);
    clipper.start_box(low - origin, high - origin);
    for (std::uint32_t k = 0; k < planes->size(); ++k) {
      const Plane& plane = (*planes)[k];
      if (!clipper.cut(plane.normal, plane.offset - dot(plane.normal, origin), FaceKind::plane, k)) {
        return Error{
            ErrorCode::geometry, "",
            "the boundary planes leave no space: plane " + std::to_string(k) + " cuts away what the planes before it left"};
      }
    }
    clipper.finish_as_cut(shape);
    if (std::any_of(shape.faces.begin(), shape.faces.end(),
                    [](const PolyhedronFace& face) { return face.kind == FaceKind::frame; })) {
      return Error{ErrorCode::geometry, "", "the boundary planes do not close: the space reaches farther than 1e8 m"};
    }
    const double box = distance(low, high);
    low = high = shape.vertices.front() + origin;
    for (const Point3& v : shape.vertices) {
      const Point3 p = v + origin;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double margin = 0.25 * distance(low, high) + 1e-12 * box;
    low -= Vector3{margin, margin, margin};
    high += Vector3{margin, margin, margin};
  }
  return finish_domain(exact_domain(shape, *planes, origin));
}

}  // namespace bl::geometry
