// Domains cut by planes, joined, and hollowed by other solids.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/geometry/domain_makers.h"
#include "core/geometry/inside/cut_faces.h"
#include "core/geometry/inside/part_faces.h"

namespace bl::geometry {

namespace {

constexpr std::size_t kMostParts = 5000;

// A solid that is taken away, ready for many questions.
struct Tool {
  std::vector<SolidPart> parts;
  std::vector<CutFace> surface;
};

Tool tool_of(const Domain& domain) {
  Tool tool;
  for (const Domain::Piece& piece : domain.pieces) {
    const SolidPart& part = tool.parts.emplace_back(part_of(piece));
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      if (part.faces[f].side != Domain::kInner) tool.surface.push_back({part.polygon(f), part.faces[f].plane});
  }
  return tool;
}

double common_volume(const SolidPart& a, const SolidPart& b, double tolerance) {
  if (!boxes_overlap(a.vertices, b.vertices, tolerance)) return 0;
  std::optional<SolidPart> rest = a;
  for (const PartFace& face : b.faces) {
    rest = cut_in_two(*rest, face.plane, tolerance, Domain::kInner).inside;
    if (!rest) return 0;
  }
  return volume_of(*rest);
}

double surface_of(const SolidPart& part) {
  double area = 0;
  for (std::size_t f = 0; f < part.faces.size(); ++f) area += norm(area_vector(part.polygon(f)));
  return area;
}

// Takes a tool away from one part after the other: each is split along faces of the tool until it is wholly in or out.
class Carver {
 public:
  Carver(const Tool& tool, double tolerance) : tool_(tool), tolerance_(tolerance) {}

  void carve(const LoosePart& loose, std::vector<LoosePart>& kept) {
    const SolidPart& part = loose.part;
    if (kept.size() > kMostParts) return;  // the maker will refuse it
    double common = 0;
    for (const SolidPart& other : tool_.parts) common += common_volume(part, other, tolerance_);
    // What a cut within the tolerance may do to volumes is more; this only spares cuts that are not needed for certain.
    const double volume = volume_of(part), slack = std::min(0.25 * volume, 1e-3 * tolerance_ * surface_of(part));
    if (common <= slack) {
      kept.push_back(loose);
      return;
    }
    if (common >= volume - slack) return;
    std::vector<std::uint32_t> all(tool_.surface.size());
    std::iota(all.begin(), all.end(), 0u);
    const auto plane = best_plane(part, tool_.surface, crossing_faces(part, tool_.surface, all, tolerance_), tolerance_);
    Halves halves = plane ? cut_in_two(part, *plane, tolerance_, Domain::kInner) : Halves{};
    if (!halves.inside || !halves.outside) {
      // The tool's surface passes within the tolerance of the part's: the larger share decides.
      if (common < 0.5 * volume) kept.push_back(loose);
      return;
    }
    carve({std::move(*halves.outside), nullptr}, kept);
    carve({std::move(*halves.inside), nullptr}, kept);
  }

 private:
  const Tool& tool_;
  double tolerance_;
};

double tolerance_of(std::span<const Domain> domains) {
  Vector3 low = domains.front().minimum, high = domains.front().maximum;
  for (const Domain& domain : domains) {
    low = {std::min(low.x, domain.minimum.x), std::min(low.y, domain.minimum.y), std::min(low.z, domain.minimum.z)};
    high = {std::max(high.x, domain.maximum.x), std::max(high.y, domain.maximum.y), std::max(high.z, domain.maximum.z)};
  }
  return place_tolerance(low, high);
}

std::vector<LoosePart> loose_parts(const Domain& domain) {
  std::vector<LoosePart> parts;
  for (const Domain::Piece& piece : domain.pieces) parts.push_back({part_of(piece), &piece});
  return parts;
}

void carve_all(std::vector<LoosePart>& parts, const Domain& solid, double tolerance) {
  const Tool tool = tool_of(solid);
  Carver carver(tool, tolerance);
  std::vector<LoosePart> kept;
  for (const LoosePart& part : parts) carver.carve(part, kept);
  parts = std::move(kept);
}

void add_walls(std::vector<Wall>& walls, const Domain& domain, std::uint32_t first_side, bool is_turned) {
  for (const Domain::Piece& piece : domain.pieces) {
    const SolidPart part = part_of(piece);
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      if (part.faces[f].side == Domain::kInner) continue;
      const Vector3 normal = part.faces[f].plane.normal;
      walls.push_back({part.polygon(f), is_turned ? -normal : normal, first_side + part.faces[f].side});
    }
  }
}

void shift_sides(SolidPart& part, std::uint32_t shift) {
  for (PartFace& face : part.faces)
    if (face.side != Domain::kInner) face.side += shift;
}

// A solid with hundreds of corners on several levels is cut better as a plan (site_domain).
Result<void> check_count(const std::vector<LoosePart>& parts) {
  if (parts.size() <= kMostParts) return {};
  return Error{ErrorCode::geometry, "",
               "the boundary falls into more than " + std::to_string(kMostParts) + " pieces: simplify what is cut out of it"};
}

Result<std::vector<Plane>> cutting_planes(std::span<const Plane> planes) {
  std::vector<Plane> result;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double length = norm(planes[k].normal);
    if (!std::isfinite(length) || !std::isfinite(planes[k].offset))
      return Error{ErrorCode::not_finite, std::to_string(k), "the plane has a number that is not finite"};
    if (!(length > 1e-100))
      return Error{ErrorCode::geometry, std::to_string(k), "the plane has no direction: its normal is zero"};
    result.push_back({planes[k].normal / length, planes[k].offset / length});
  }
  return result;
}

// Inner faces that lie in the plane become surface, since what was behind them is gone.
void name_faces_in(SolidPart& part, const Plane& plane, double tolerance, std::uint32_t side) {
  for (PartFace& face : part.faces) {
    if (face.side != Domain::kInner || dot(face.plane.normal, plane.normal) < 0.5) continue;
    if (std::all_of(face.loop.begin(), face.loop.end(), [&](std::uint32_t v) {
          return std::abs(dot(plane.normal, part.vertices[v]) - plane.offset) <= 2 * tolerance;
        }))
      face.side = side;
  }
}

}  // namespace

Result<Domain> cut_domain(const Domain& domain, std::span<const Plane> planes) {
  if (domain.pieces.empty()) return Error{ErrorCode::geometry, "", "there is no boundary to cut"};
  auto units = cutting_planes(planes);
  if (!units) return units.error();
  const double tolerance = place_tolerance(domain.minimum, domain.maximum);
  std::vector<Domain::Piece> pieces;
  double volume = 0;
  for (const Domain::Piece& piece : domain.pieces) {
    std::optional<SolidPart> part = part_of(piece);
    bool is_changed = false;
    for (std::uint32_t k = 0; k < units->size() && part; ++k) {
      Halves halves = cut_in_two(*part, (*units)[k], tolerance, domain.side_count + k);
      is_changed |= halves.outside.has_value();
      part = std::move(halves.inside);
      if (part) name_faces_in(*part, (*units)[k], tolerance, domain.side_count + k);
    }
    if (!part) continue;
    volume += volume_of(*part);
    if (is_changed) {
      if (auto cut = piece_of(*part)) pieces.push_back(std::move(*cut));
      continue;
    }
    Domain::Piece same = piece;
    for (std::size_t k = 0, f = 0; k < same.sides.size(); ++k)
      if (same.shape.faces[k].size() > 2) same.sides[k] = part->faces[f++].side;
    pieces.push_back(std::move(same));
  }
  if (pieces.empty()) return Error{ErrorCode::geometry, "", "the planes cut the whole boundary away: nothing is left of it"};
  auto cut = join_pieces(std::move(pieces));
  if (!cut) return cut;
  if (auto whole = check_volume(cut->volume, volume); !whole) return whole.error();
  cut->side_count = domain.side_count + static_cast<std::uint32_t>(planes.size());
  return cut;
}

Result<Domain> unite(std::span<const Domain> domains) {
  if (domains.empty()) return Error{ErrorCode::geometry, "", "there is nothing to join"};
  if (domains.size() == 1) return domains.front();
  const double tolerance = tolerance_of(domains);
  std::vector<LoosePart> all;
  std::vector<Wall> walls;
  std::uint32_t sides = 0;
  for (std::size_t k = 0; k < domains.size(); ++k) {
    std::vector<LoosePart> parts = loose_parts(domains[k]);
    for (std::size_t j = 0; j < k; ++j) carve_all(parts, domains[j], tolerance);
    for (LoosePart& loose : parts) shift_sides(loose.part, sides);
    all.insert(all.end(), parts.begin(), parts.end());
    if (auto few = check_count(all); !few) return few.error();
    add_walls(walls, domains[k], sides, false);
    sides += domains[k].side_count;
  }
  return settled_domain(std::move(all), walls, tolerance, sides);
}

Result<Domain> exclude(const Domain& domain, std::span<const Domain> solids) {
  if (domain.pieces.empty()) return Error{ErrorCode::geometry, "", "there is no boundary to take anything away from"};
  const double tolerance = place_tolerance(domain.minimum, domain.maximum);
  std::vector<LoosePart> parts = loose_parts(domain);
  std::vector<Wall> walls;
  std::uint32_t sides = domain.side_count;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    carve_all(parts, solids[k], tolerance);
    if (auto few = check_count(parts); !few) return few.error().within(std::to_string(k));
    if (parts.empty())
      return Error{ErrorCode::geometry, std::to_string(k), "this exclusion takes away all that is left of the boundary"};
    add_walls(walls, solids[k], sides, true);
    sides += solids[k].side_count;
  }
  return settled_domain(std::move(parts), walls, tolerance, sides);
}

double area_in_plan(const Domain& domain) {
  double area = 0;
  if (domain.is_convex()) {
    const Mesh mesh = to_mesh(domain);
    for (const auto& [a, b, c] : mesh.triangles)
      area += 0.5 * std::max(0.0, cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z);
    return area;
  }
  // Over each piece a column of height 1, without what the earlier ones cover.
  const double tolerance = place_tolerance(domain.minimum, domain.maximum);
  std::vector<Domain> columns;
  for (const Domain::Piece& piece : domain.pieces) {
    std::vector<Point3> points;
    for (const Point3& v : piece.shape.vertices) {
      points.push_back({v.x, v.y, 0});
      points.push_back({v.x, v.y, 1});
    }
    auto column = convex_hull(points);
    if (!column) continue;
    std::vector<LoosePart> parts{{part_of(Domain(*column).pieces.front()), nullptr}};
    for (const Domain& earlier : columns) carve_all(parts, earlier, tolerance);
    area += volume_of(parts);
    columns.push_back(Domain(std::move(*column)));
  }
  return area;
}

Mesh to_mesh(const Domain& domain) {
  Mesh mesh;
  for (const Domain::Piece& piece : domain.pieces) {
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), piece.shape.vertices.begin(), piece.shape.vertices.end());
    for (std::size_t k = 0; k < piece.sides.size(); ++k) {
      if (piece.sides[k] == Domain::kInner) continue;
      const auto& face = piece.shape.faces[k];
      for (std::size_t i = 1; i + 1 < face.size(); ++i)
        mesh.triangles.push_back({first + face[0], first + face[i], first + face[i + 1]});
    }
  }
  return mesh;
}

}  // namespace bl::geometry
