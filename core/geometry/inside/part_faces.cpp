// Faces are compared by area: what the faces of other parts cover of it, and what a cut would leave mixed.
#include "core/geometry/inside/part_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/text.h"

namespace bl::geometry {

namespace {

// How much volume may go with pieces that are too flat to keep, as a share of the whole.
constexpr double kLossShare = 1e-9;
// A face that a cut in here has made: it lies between the two halves, whatever the other parts say.
constexpr std::uint32_t kSettled = Domain::kInner - 1;

double perimeter_of(const Polygon& polygon) {
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) length += distance(polygon[i], polygon[(i + 1) % polygon.size()]);
  return length;
}

bool lies_in(const Polygon& polygon, const Plane& plane, double tolerance) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const Point3& p) { return std::abs(dot(plane.normal, p) - plane.offset) <= tolerance; });
}

std::array<Point3, 2> box_of(const std::vector<Point3>& points) {
  Point3 low = points.front(), high = points.front();
  for (const Point3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

struct Cover {
  Polygon polygon;
  Vector3 normal;
};

// How a face is cut so that little remains mixed.
struct Choice {
  Plane plane;
  double mixed = 0;
};

class Settler {
 public:
  Settler(const std::vector<LoosePart>& parts, const std::vector<Wall>& walls, double tolerance)
      : parts_(parts), walls_(walls), tolerance_(tolerance) {
    for (const LoosePart& loose : parts) boxes_.push_back(box_of(loose.part.vertices));
  }

  Result<std::vector<Domain::Piece>> run() {
    std::vector<Domain::Piece> pieces;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      find_neighbours(p);
      std::vector<SolidPart> open{parts_[p].part};
      bool is_whole = true;
      while (!open.empty()) {
        SolidPart part = std::move(open.back());
        open.pop_back();
        if (auto plane = wanted_cut(part)) {
          Halves halves = cut_in_two(part, *plane, tolerance_, kSettled);
          if (halves.inside && halves.outside) {
            is_whole = false;
            open.push_back(std::move(*halves.outside));
            open.push_back(std::move(*halves.inside));
            continue;
          }
        }
        if (auto named = name_faces(part); !named) return named.error();
        if (auto added = add(pieces, part, is_whole ? parts_[p].whole : nullptr); !added) return added.error();
      }
    }
    return pieces;
  }

 private:
  double slack(const Polygon& polygon) const { return 16 * tolerance_ * perimeter_of(polygon); }

  void find_neighbours(std::size_t p) {
    neighbours_.clear();
    for (std::size_t q = 0; q < parts_.size(); ++q)
      if (q != p && boxes_overlap(boxes_[p], boxes_[q], -16 * tolerance_)) neighbours_.push_back(q);
  }

  std::vector<Cover> covers_of(const PartFace& face, const Polygon& polygon) const {
    std::vector<Cover> covers;
    for (const std::size_t q : neighbours_) {
      const SolidPart& other = parts_[q].part;
      for (std::size_t f = 0; f < other.faces.size(); ++f) {
        if (dot(other.faces[f].plane.normal, face.plane.normal) > -0.5) continue;
        Polygon facing = other.polygon(f);
        if (!lies_in(facing, face.plane, 8 * tolerance_)) continue;
        if (common_area(polygon, facing, face.plane.normal) > slack(polygon))
          covers.push_back({std::move(facing), other.faces[f].plane.normal});
      }
    }
    return covers;
  }

  static double covered_area(const Polygon& polygon, const std::vector<Cover>& covers, const Vector3& normal) {
    double area = 0;
    for (const Cover& cover : covers) area += common_area(polygon, cover.polygon, normal);
    return area;
  }

  // What would be on the wrong side if the polygon were called covered or free as a whole.
  static double mixed_area(const Polygon& polygon, const std::vector<Cover>& covers, const Vector3& normal) {
    if (polygon.size() < 3) return 0;
    const double area = norm(area_vector(polygon)), covered = covered_area(polygon, covers, normal);
    return std::max(0.0, std::min(covered, area - covered));
  }

  std::optional<Plane> wanted_cut(const SolidPart& part) const {
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const PartFace& face = part.faces[f];
      if (face.side == kSettled) continue;
      const Polygon polygon = part.polygon(f);
      const std::vector<Cover> covers = covers_of(face, polygon);
      if (covers.empty() || mixed_area(polygon, covers, face.plane.normal) <= slack(polygon)) continue;
      if (auto plane = best_cut(polygon, covers, face.plane.normal)) return plane;
    }
    return std::nullopt;
  }

  std::optional<Plane> best_cut(const Polygon& polygon, const std::vector<Cover>& covers, const Vector3& normal) const {
    const double area = norm(area_vector(polygon)), least = slack(polygon);
    std::optional<Choice> best;
    for (const Cover& cover : covers) {
      for (std::size_t e = 0; e < cover.polygon.size(); ++e) {
        const Plane plane = edge_plane(cover.polygon, e, cover.normal);
        if (plane.normal == Vector3{}) continue;
        const Polygon inner = clipped(polygon, plane), outer = clipped(polygon, Plane{-plane.normal, -plane.offset});
        const double inner_area = norm(area_vector(inner));
        if (!(inner_area > least && inner_area < area - least)) continue;
        const double mixed = mixed_area(inner, covers, normal) + mixed_area(outer, covers, normal);
        if (!best || mixed < best->mixed - least) best = Choice{plane, mixed};
      }
    }
    return best ? std::optional<Plane>(best->plane) : std::nullopt;
  }

  Result<void> name_faces(SolidPart& part) const {
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      PartFace& face = part.faces[f];
      const Polygon polygon = part.polygon(f);
      const double area = norm(area_vector(polygon));
      if (face.side == kSettled || covered_area(polygon, covers_of(face, polygon), face.plane.normal) > 0.5 * area) {
        face.side = Domain::kInner;
      } else if (face.side == Domain::kInner && !name_by_wall(face, polygon) && area > slack(polygon)) {
        return Error{ErrorCode::internal, "", "a face of the boundary belongs to none of its sides: please report this shape"};
      }
    }
    return {};
  }

  bool name_by_wall(PartFace& face, const Polygon& polygon) const {
    double largest = 0;
    for (const Wall& wall : walls_) {
      if (dot(wall.normal, face.plane.normal) < 0.5 || !lies_in(wall.polygon, face.plane, 64 * tolerance_)) continue;
      const double common = common_area(polygon, wall.polygon, face.plane.normal);
      if (!(common > largest)) continue;
      largest = common;
      face.side = wall.side;
    }
    return largest > 0;
  }

  // Whole pieces keep their bits; of others, what is flat is left out, and the maker accounts for the volume.
  static Result<void> add(std::vector<Domain::Piece>& pieces, const SolidPart& part, const Domain::Piece* whole) {
    if (whole == nullptr) {
      if (auto piece = piece_of(part)) pieces.push_back(std::move(*piece));
      return {};
    }
    Domain::Piece piece = *whole;
    for (std::size_t k = 0, f = 0; k < piece.sides.size(); ++k)
      if (piece.shape.faces[k].size() > 2) piece.sides[k] = part.faces[f++].side;
    pieces.push_back(std::move(piece));
    return {};
  }

  const std::vector<LoosePart>& parts_;
  const std::vector<Wall>& walls_;
  double tolerance_;
  std::vector<std::array<Point3, 2>> boxes_;
  std::vector<std::size_t> neighbours_;
};

struct NamedPlane {
  Plane plane;
  std::uint32_t side;
};

// The whole face that two parts share: its number in each.
std::optional<std::pair<std::size_t, std::size_t>> shared_face(const SolidPart& a, const SolidPart& b, double tolerance) {
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    if (a.faces[f].side != Domain::kInner) continue;
    const Plane& plane = a.faces[f].plane;
    const Polygon polygon = a.polygon(f);
    const double least = 16 * tolerance * perimeter_of(polygon), area = norm(area_vector(polygon));
    for (std::size_t g = 0; g < b.faces.size(); ++g) {
      if (b.faces[g].side != Domain::kInner || dot(plane.normal, b.faces[g].plane.normal) > -0.5) continue;
      const Polygon facing = b.polygon(g);
      if (!lies_in(facing, plane, 8 * tolerance)) continue;
      const double common = common_area(polygon, facing, plane.normal);
      if (common > least && common > area - least && common > norm(area_vector(facing)) - least) return std::pair{f, g};
    }
  }
  return std::nullopt;
}

// Adds the planes of a part, each once; false where two faces in one plane are of different sides.
bool add_planes(std::vector<NamedPlane>& planes, const SolidPart& part, std::size_t without, double tolerance) {
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (f == without) continue;
    const PartFace& face = part.faces[f];
    const Polygon polygon = part.polygon(f);
    const auto same = std::find_if(planes.begin(), planes.end(), [&](const NamedPlane& known) {
      return dot(known.plane.normal, face.plane.normal) > 0.5 && lies_in(polygon, known.plane, 8 * tolerance);
    });
    if (same == planes.end()) planes.push_back({face.plane, face.side});
    else if (same->side != face.side) return false;
  }
  return true;
}

// Does every edge have a twin? Where more than three planes meet in one corner, rounding can tear it.
bool is_closed(const ConvexDomain& shape) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  for (const auto& face : shape.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      edges.emplace_back(face[i], face[(i + 1) % face.size()]);
      twins.emplace_back(face[(i + 1) % face.size()], face[i]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  return edges == twins && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

// The union of two pieces is convex where the half-spaces of both, less those of the face between them, enclose no less.
std::optional<Domain::Piece> merged(const Domain::Piece& a, const Domain::Piece& b, double tolerance) {
  const std::array<Point3, 2> here{a.shape.minimum, a.shape.maximum}, there{b.shape.minimum, b.shape.maximum};
  if (!boxes_overlap(here, there, -16 * tolerance)) return std::nullopt;
  const SolidPart first = part_of(a), second = part_of(b);
  const auto between = shared_face(first, second, tolerance);
  if (!between) return std::nullopt;
  std::vector<NamedPlane> planes;
  if (!add_planes(planes, first, between->first, tolerance) || !add_planes(planes, second, between->second, tolerance))
    return std::nullopt;
  std::vector<Plane> bounds;
  Domain::Piece piece;
  for (const NamedPlane& named : planes) bounds.push_back(named.plane);
  auto shape = from_planes(bounds);
  const double sum = a.shape.volume + b.shape.volume;
  if (!shape || std::abs(shape->volume - sum) > 1e-10 * sum || !is_closed(*shape)) return std::nullopt;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (shape->faces[k].size() < 3) return std::nullopt;
    piece.sides.push_back(planes[k].side);
  }
  piece.shape = std::move(*shape);
  return piece;
}

// Pieces from `first` on; those before it stay as they are.
void merge_pieces(std::vector<Domain::Piece>& pieces, std::size_t first, double tolerance) {
  for (bool is_merged = true; is_merged;) {
    is_merged = false;
    for (std::size_t a = first; a < pieces.size(); ++a) {
      for (std::size_t b = a + 1; b < pieces.size();) {
        auto both = merged(pieces[a], pieces[b], tolerance);
        if (!both) {
          ++b;
          continue;
        }
        pieces[a] = std::move(*both);
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(b));
        // A larger piece may fit to one that was tried before.
        is_merged = true;
      }
    }
  }
}

}  // namespace

double volume_of(const std::vector<LoosePart>& parts) {
  double volume = 0;
  for (const LoosePart& loose : parts) volume += volume_of(loose.part);
  return volume;
}

Result<Domain> settled_domain(const std::vector<LoosePart>& parts, const std::vector<Wall>& walls, double tolerance,
                              std::uint32_t side_count) {
  const double volume = volume_of(parts);
  auto pieces = Settler(parts, walls, tolerance).run();
  if (!pieces) return pieces.error();
  const auto is_whole = [&](const Domain::Piece& piece) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const LoosePart& part) { return part.whole != nullptr && part.whole->shape == piece.shape; });
  };
  const auto first = std::stable_partition(pieces->begin(), pieces->end(), is_whole);
  merge_pieces(*pieces, static_cast<std::size_t>(first - pieces->begin()), tolerance);
  auto domain = join_pieces(std::move(*pieces));
  if (!domain) return domain;
  if (auto whole = check_volume(domain->volume, volume); !whole) return whole.error();
  domain->side_count = side_count;
  return domain;
}

Result<void> check_volume(double kept, double wanted) {
  if (std::abs(kept - wanted) <= kLossShare * wanted) return {};
  return Error{ErrorCode::geometry, "",
               "the boundary falls into pieces that are too thin to keep: " + shortest(wanted - kept) + " m³ of " +
                   shortest(wanted) + " m³ would be lost"};
}

}  // namespace bl::geometry
