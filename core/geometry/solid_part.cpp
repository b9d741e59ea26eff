// Cutting a convex body by a plane: each vertex is judged once, so that all faces agree on what is cut away.
#include "core/geometry/solid_part.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/geometry/inside/domain_parts.h"
#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

constexpr double kPlaceShare = 1e-10;
constexpr double kRounding = 0x1.0p-52;

// Cuts one half off a part, whose vertices have been judged: `sign` is +1 for the inner half, -1 for the outer one.
class Half {
 public:
  Half(const SolidPart& part, const std::vector<double>& away, double sign) : part_(part), away_(away), sign_(sign) {}

  SolidPart make(const Plane& plane, std::uint32_t cut_side, const std::vector<Point3>& on_edges,
                 const std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>& crossings) {
    SolidPart half;
    number_.assign(part_.vertices.size() + on_edges.size(), kNone);
    for (const PartFace& face : part_.faces) {
      const auto is_inside = [&](std::uint32_t v) { return sign_ * away_[v] < 0; };
      if (std::none_of(face.loop.begin(), face.loop.end(), is_inside)) continue;
      PartFace kept{face.plane, face.side, {}};
      for (std::size_t i = 0; i < face.loop.size(); ++i) {
        const std::uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        if (sign_ * away_[a] <= 0) kept.loop.push_back(place(half, a, part_.vertices[a]));
        if (away_[a] * away_[b] >= 0) continue;
        const std::uint32_t cut = crossings.at(std::minmax(a, b));
        kept.loop.push_back(place(half, static_cast<std::uint32_t>(part_.vertices.size()) + cut, on_edges[cut]));
      }
      half.faces.push_back(std::move(kept));
    }
    close(half, {sign_ > 0 ? plane.normal : -plane.normal, sign_ * plane.offset}, cut_side);
    return half;
  }

 private:
  std::uint32_t place(SolidPart& half, std::uint32_t vertex, const Point3& at) {
    if (number_[vertex] == kNone) {
      number_[vertex] = static_cast<std::uint32_t>(half.vertices.size());
      half.vertices.push_back(at);
    }
    return number_[vertex];
  }

  // The new face goes along the edges that lack a twin, the other way round.
  static void close(SolidPart& half, const Plane& plane, std::uint32_t cut_side) {
    std::map<std::uint32_t, std::uint32_t> next;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const PartFace& face : half.faces)
      for (std::size_t i = 0; i < face.loop.size(); ++i) edges.emplace_back(face.loop[i], face.loop[(i + 1) % face.loop.size()]);
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges)
      if (!std::binary_search(edges.begin(), edges.end(), std::pair{to, from})) next[to] = from;
    PartFace cut{plane, cut_side, {}};
    for (auto at = next.begin(); at != next.end() && cut.loop.size() < next.size(); at = next.find(at->second))
      cut.loop.push_back(at->first);
    if (cut.loop.size() > 2) half.faces.push_back(std::move(cut));
  }

  const SolidPart& part_;
  const std::vector<double>& away_;
  double sign_;
  std::vector<std::uint32_t> number_;
};

}  // namespace

Polygon SolidPart::polygon(std::size_t face) const {
  Polygon corners;
  for (const std::uint32_t v : faces[face].loop) corners.push_back(vertices[v]);
  return corners;
}

double place_tolerance(const Vector3& minimum, const Vector3& maximum) {
  double largest = 0;
  for (const Vector3& p : {minimum, maximum}) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return std::max(kPlaceShare * distance(minimum, maximum), 64 * kRounding * largest);
}

Halves cut_in_two(const SolidPart& part, const Plane& plane, double tolerance, std::uint32_t cut_side) {
  std::vector<double> away;
  bool has_inside = false, has_outside = false;
  for (const Point3& v : part.vertices) {
    const double d = dot(plane.normal, v) - plane.offset;
    away.push_back(std::abs(d) <= tolerance ? 0 : d);
    has_inside |= away.back() < 0;
    has_outside |= away.back() > 0;
  }
  if (!has_outside) return {part, std::nullopt};
  if (!has_inside) return {std::nullopt, part};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;
  std::vector<Point3> on_edges;
  for (const PartFace& face : part.faces) {
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      const auto [a, b] = std::minmax(face.loop[i], face.loop[(i + 1) % face.loop.size()]);
      if (away[a] * away[b] >= 0 || !crossings.emplace(std::pair{a, b}, on_edges.size()).second) continue;
      const double share = away[a] / (away[a] - away[b]);
      on_edges.push_back(part.vertices[a] + share * (part.vertices[b] - part.vertices[a]));
    }
  }
  return {Half(part, away, 1).make(plane, cut_side, on_edges, crossings),
          Half(part, away, -1).make(plane, cut_side, on_edges, crossings)};
}

SolidPart part_of(const Domain::Piece& piece) {
  SolidPart part{piece.shape.vertices, {}};
  for (std::size_t k = 0; k < piece.shape.planes.size(); ++k)
    if (piece.shape.faces[k].size() > 2) part.faces.push_back({piece.shape.planes[k], piece.sides[k], piece.shape.faces[k]});
  return part;
}

Result<Domain::Piece> piece_of(const SolidPart& part) {
  // A corner of two faces only lies within an edge: what a neighbour's cut has left there.
  std::vector<std::uint32_t> count(part.vertices.size(), 0), number(part.vertices.size(), 0);
  for (const PartFace& face : part.faces)
    for (const std::uint32_t v : face.loop) ++count[v];
  ConvexDomain shape;
  Domain::Piece piece;
  for (std::size_t v = 0; v < count.size(); ++v) {
    if (count[v] < 3) continue;
    number[v] = static_cast<std::uint32_t>(shape.vertices.size());
    shape.vertices.push_back(part.vertices[v]);
  }
  for (const PartFace& face : part.faces) {
    auto& loop = shape.faces.emplace_back();
    for (const std::uint32_t v : face.loop)
      if (count[v] > 2) loop.push_back(number[v]);
    if (loop.size() < 3) return Error{ErrorCode::geometry, "", "the part is flat"};
    shape.planes.push_back(face.plane);
    piece.sides.push_back(face.side);
  }
  auto finished = finish_domain(std::move(shape));
  if (!finished) return finished.error();
  piece.shape = std::move(*finished);
  return piece;
}

double volume_of(const SolidPart& part) {
  const Point3 origin = part.vertices.front();
  double six_volumes = 0;
  for (const PartFace& face : part.faces) {
    const Vector3 a = part.vertices[face.loop[0]] - origin;
    for (std::size_t i = 1; i + 1 < face.loop.size(); ++i)
      six_volumes += dot(a, cross(part.vertices[face.loop[i]] - origin, part.vertices[face.loop[i + 1]] - origin));
  }
  return six_volumes / 6;
}

Point3 middle_of(const SolidPart& part) {
  Vector3 sum;
  for (const Point3& v : part.vertices) sum += v - part.vertices.front();
  return part.vertices.front() + sum / static_cast<double>(part.vertices.size());
}

bool boxes_overlap(std::span<const Point3> a, std::span<const Point3> b, double tolerance) {
  for (double Vector3::*axis : {&Vector3::x, &Vector3::y, &Vector3::z}) {
    const auto is_less = [axis](const Point3& p, const Point3& q) { return p.*axis < q.*axis; };
    const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end(), is_less);
    const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end(), is_less);
    if (!(std::min((*a_high).*axis, (*b_high).*axis) - std::max((*a_low).*axis, (*b_low).*axis) > tolerance)) return false;
  }
  return true;
}

Vector3 area_vector(const Polygon& polygon) {
  Vector3 sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * sum;
}

// Sutherland and Hodgman (1974), for one plane.
Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = dot(plane.normal, a) - plane.offset, to = dot(plane.normal, b) - plane.offset;
    if (from <= 0) kept.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) kept.push_back(a + (from / (from - to)) * (b - a));
  }
  return kept;
}

Polygon clipped(const Polygon& polygon, const SolidPart& part, double depth) {
  Polygon kept = polygon;
  for (const PartFace& face : part.faces) {
    if (kept.size() < 3) return {};
    kept = clipped(kept, Plane{face.plane.normal, face.plane.offset - depth});
  }
  return kept;
}

Plane edge_plane(const Polygon& polygon, std::size_t edge, const Vector3& normal) {
  const Point3 &a = polygon[edge], &b = polygon[(edge + 1) % polygon.size()];
  Vector3 out = cross(b - a, normal);
  const double length = norm(out);
  if (length > 0) out = out / length;
  return {out + Vector3{}, dot(out, a)};
}

double common_area(const Polygon& a, const Polygon& b, const Vector3& normal) {
  Polygon kept = a;
  // `b` may run the other way round.
  const Vector3 up = dot(area_vector(b), normal) < 0 ? -normal : normal;
  for (std::size_t i = 0; i < b.size() && kept.size() > 2; ++i) kept = clipped(kept, edge_plane(b, i, up));
  return kept.size() > 2 ? std::abs(dot(area_vector(kept), normal)) : 0;
}

}  // namespace bl::geometry
