// Finds what two parts have in common, gives both the same corners along it, and takes the ball's disc out of it.
#include "core/geometry/cell_seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/geometry/solid_part.h"

namespace bl {

namespace {

using Loop = std::vector<std::uint32_t>;
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

// A disc that is smaller than the ball by more than three orders of magnitude is no opening: the radius left of the ball there.
constexpr double kLeastReach = 1e-7;
// Of the parts' extent: what rounding may move a corner by, with room.
constexpr double kPlaceShare = 1e-9;
constexpr std::uint32_t kClosed = 0xffffffffu;

// A polygon that two parts have in common and that the ball reaches.
struct Opening {
  Polygon outline;     // counter-clockwise seen from the first part's outside
  Point3 centre;       // the point of it that is nearest to the ball's middle
  double area = 0;
};

struct SeamFace {
  Vector3 normal;
  double offset = 0;
  Loop loop;
  bool is_inner = false;
  std::vector<std::pair<std::uint32_t, bool>> openings;  // while they are sought: which, and whether seen from behind
  std::uint32_t opening = kClosed, seam = 0;             // afterwards: what the whole face is
};

struct SeamPart {
  std::size_t own = 0;  // corners that the part came with
  std::vector<Point3> corners;
  std::vector<SeamFace> faces;
  std::size_t openings = 0;

  Polygon polygon(const Loop& loop) const {
    Polygon points;
    for (const std::uint32_t c : loop) points.push_back(corners[c]);
    return points;
  }
  std::uint32_t find_or_add(const Point3& place, double tolerance) {
    for (std::uint32_t c = 0; c < corners.size(); ++c)
      if (distance(corners[c], place) <= tolerance) return c;
    corners.push_back(place);
    return static_cast<std::uint32_t>(corners.size() - 1);
  }
};

// The two sides of a line through a convex polygon; corners within the tolerance of the line belong to both.
std::pair<Polygon, Polygon> cut_outline(const Polygon& polygon, const Vector3& outward, double offset, double tolerance) {
  std::pair<Polygon, Polygon> sides;
  const auto depth_of = [&](const Point3& p) { return dot(outward, p) - offset; };
  double farthest[2] = {0, 0};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = depth_of(a), at_b = depth_of(b);
    if (at_a <= tolerance) sides.first.push_back(a);
    if (at_a >= -tolerance) sides.second.push_back(a);
    farthest[0] = std::max(farthest[0], -at_a);
    farthest[1] = std::max(farthest[1], at_a);
    if ((at_a < -tolerance && at_b > tolerance) || (at_a > tolerance && at_b < -tolerance)) {
      const Point3 crossing = a + (at_a / (at_a - at_b)) * (b - a);
      sides.first.push_back(crossing);
      sides.second.push_back(crossing);
    }
  }
  if (farthest[0] <= tolerance) sides.first.clear();
  if (farthest[1] <= tolerance) sides.second.clear();
  return sides;
}

// Where two corners are one place its edge has no direction and bounds nothing.
bool edge_line(const Polygon& polygon, std::size_t i, const Vector3& normal, double tolerance, Vector3& outward, double& offset) {
  const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
  const double length = distance(a, b);
  if (length <= tolerance) return false;
  outward = cross(b - a, normal) / length;
  offset = dot(outward, a);
  return true;
}

double outline_area(const Polygon& polygon) { return polygon.size() < 3 ? 0 : norm(area_vector(polygon)); }

Point3 nearest_in(const Polygon& polygon, const Vector3& normal, double offset) {
  const Point3 foot = offset * normal;
  Point3 best = foot;
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    is_inside = is_inside && dot(normal, cross(along, foot - a)) >= 0;
    const Point3 on_edge = a + std::clamp(dot(foot - a, along) / std::max(1e-300, squared_norm(along)), 0.0, 1.0) * along;
    if (squared_norm(foot - on_edge) >= least) continue;
    least = squared_norm(foot - on_edge);
    best = on_edge;
  }
  return is_inside ? foot : best;
}

class SeamMaker {
 public:
  SeamMaker(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius)
      : radius_(std::sqrt(squared_radius)), tolerance_(seam_tolerance(parts)) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      SeamPart& part = parts_.emplace_back();
      if (shapes[k].is_empty) continue;
      part.corners = parts[k].vertices;
      part.own = part.corners.size();
      for (const PolyhedronFace& face : parts[k].faces) {
        const auto loop = parts[k].loop(face);
        part.faces.push_back({face.normal, face.offset, Loop(loop.begin(), loop.end()), face.kind == FaceKind::inner, {}, kClosed, 0});
      }
    }
  }

  std::vector<OpenPart> run() {
    find_openings();
    for (SeamPart& part : parts_) split_faces(part);
    share_corners();
    std::vector<OpenPart> out;
    for (SeamPart& part : parts_) {
      if (part.openings > 0) cross_rims(part);
      out.push_back(finish(part));
    }
    return out;
  }

 private:
  bool is_reached(const SeamFace& face) const { return face.is_inner && std::abs(face.offset) < radius_; }
  bool is_in_ball(const Point3& p) const { return squared_norm(p) <= radius_ * radius_; }
  bool is_on_ball(const Point3& p) const { return std::abs(norm(p) - radius_) <= 2 * tolerance_; }

  void find_openings() {
    // A ball that is hardly larger than rounding has no disc that could be told from a point.
    if (!(radius_ > 1e4 * tolerance_)) return;
    for (std::size_t a = 0; a < parts_.size(); ++a)
      for (SeamFace& own : parts_[a].faces) {
        if (!is_reached(own)) continue;
        for (std::size_t b = a + 1; b < parts_.size(); ++b)
          for (SeamFace& other : parts_[b].faces)
            if (is_reached(other) && dot(own.normal, other.normal) < -1 + 1e-9) join(parts_[a], own, parts_[b], other);
      }
  }

  void join(SeamPart& a, SeamFace& own, SeamPart& b, SeamFace& other) {
    if (a.openings >= MeshWrap::kMostSeams || b.openings >= MeshWrap::kMostSeams) return;
    Opening opening{a.polygon(own.loop), {}, 0};
    const Polygon bounds = b.polygon(other.loop);
    for (const Point3& corner : bounds)
      if (std::abs(dot(own.normal, corner) - own.offset) > 4 * tolerance_) return;
    Vector3 outward;
    double offset = 0;
    for (std::size_t i = 0; i < bounds.size() && !opening.outline.empty(); ++i)
      if (edge_line(bounds, i, other.normal, tolerance_, outward, offset))
        opening.outline = cut_outline(opening.outline, outward, offset, tolerance_).first;
    opening.area = outline_area(opening.outline);
    if (!(opening.area > tolerance_ * radius_)) return;
    opening.centre = nearest_in(opening.outline, own.normal, own.offset);
    if (!(norm(opening.centre) < (1 - kLeastReach) * radius_)) return;
    const auto number = static_cast<std::uint32_t>(openings_.size());
    own.openings.emplace_back(number, false);
    other.openings.emplace_back(number, true);
    ++a.openings;
    ++b.openings;
    openings_.push_back(std::move(opening));
  }

  // A face that is all of one opening is that; any other becomes one face for each of its openings, and the rest.
  void split_faces(SeamPart& part) {
    const std::size_t count = part.faces.size();
    std::uint32_t seam = 0;
    for (std::size_t f = 0; f < count; ++f) {
      const auto openings = part.faces[f].openings;
      if (openings.empty()) continue;
      const Polygon whole = part.polygon(part.faces[f].loop);
      SeamFace piece = part.faces[f];
      part.faces[f].seam = seam;
      part.faces[f].opening = openings.front().first;
      if (openings.size() == 1 && openings_[openings.front().first].area >= (1 - 1e-9) * outline_area(whole)) {
        ++seam;
        continue;
      }
      std::vector<Polygon> rest{whole};
      part.faces[f].loop.clear();
      for (const auto& [number, is_behind] : openings) {
        piece.opening = number;
        piece.seam = seam++;
        add_piece(part, piece, openings_[number].outline, is_behind);
        rest = without(rest, openings_[number].outline, is_behind ? -piece.normal : piece.normal);
      }
      piece.opening = kClosed;
      for (const Polygon& polygon : rest) add_piece(part, piece, polygon, false);
    }
    std::erase_if(part.faces, [](const SeamFace& face) { return face.loop.size() < 3; });
  }

  void add_piece(SeamPart& part, SeamFace piece, const Polygon& outline, bool is_behind) const {
    piece.loop.clear();
    for (const Point3& place : outline) {
      const std::uint32_t corner = part.find_or_add(place, tolerance_);
      if (piece.loop.empty() || (piece.loop.back() != corner && piece.loop.front() != corner)) piece.loop.push_back(corner);
    }
    if (is_behind) std::reverse(piece.loop.begin(), piece.loop.end());
    part.faces.push_back(std::move(piece));
  }

  std::vector<Polygon> without(const std::vector<Polygon>& polygons, const Polygon& taken, const Vector3& normal) const {
    std::vector<Polygon> left;
    for (Polygon inside : polygons) {
      Vector3 outward;
      double offset = 0;
      for (std::size_t i = 0; i < taken.size() && !inside.empty(); ++i) {
        if (!edge_line(taken, i, normal, tolerance_, outward, offset)) continue;
        auto [in, out] = cut_outline(inside, outward, offset, tolerance_);
        if (outline_area(out) > tolerance_ * radius_) left.push_back(std::move(out));
        inside = std::move(in);
      }
    }
    return left;
  }

  // In the ball every part gets the corners that others have on its edges; everywhere those that it has got itself.
  void share_corners() {
    std::vector<Point3> shared;
    for (const SeamPart& part : parts_)
      for (const Point3& corner : part.corners)
        if (part.openings > 0 && norm(corner) <= radius_ + tolerance_) shared.push_back(corner);
    for (SeamPart& part : parts_) {
      if (part.openings == 0) continue;
      std::vector<Point3> places(part.corners.begin() + static_cast<std::ptrdiff_t>(part.own), part.corners.end());
      places.insert(places.end(), shared.begin(), shared.end());
      insert(part, [&](std::uint32_t from, std::uint32_t to) {
        const Point3 start = part.corners[from];
        const Vector3 way = part.corners[to] - start;
        const double length = norm(way);
        std::vector<std::pair<double, Point3>> found;
        for (const Point3& place : places) {
          const double at = dot(place - start, way) / std::max(1e-300, length);
          if (at > 2 * tolerance_ && at < length - 2 * tolerance_ &&
              distance(place, start + (at / length) * way) <= 2 * tolerance_)
            found.emplace_back(at, place);
        }
        return found;
      });
    }
  }

  // `on_edge(from, to)` says what is to be inserted there: how far from `from`, and where.
  template <class OnEdge>
  void insert(SeamPart& part, const OnEdge& on_edge) {
    std::map<EdgeKey, Loop> inserted;
    for (SeamFace& face : part.faces) {
      Loop loop;
      for (std::size_t i = 0; i < face.loop.size(); ++i) {
        const std::uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        const EdgeKey key = std::minmax(a, b);
        const auto [it, is_new] = inserted.emplace(key, Loop());
        if (is_new) {
          auto found = on_edge(key.first, key.second);
          std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
          for (const auto& [at, place] : found) {
            const std::uint32_t corner = part.find_or_add(place, tolerance_);
            if (corner != a && corner != b && (it->second.empty() || it->second.back() != corner)) it->second.push_back(corner);
          }
        }
        loop.push_back(a);
        if (a < b) loop.insert(loop.end(), it->second.begin(), it->second.end());
        else loop.insert(loop.end(), it->second.rbegin(), it->second.rend());
      }
      face.loop = std::move(loop);
    }
  }

  // Where the rim of an opening goes through the ball's surface both faces of the edge get a corner.
  void cross_rims(SeamPart& part) {
    std::vector<EdgeKey> rims;
    for (const SeamFace& face : part.faces)
      for (std::size_t i = 0; face.opening != kClosed && i < face.loop.size(); ++i)
        rims.push_back(std::minmax(face.loop[i], face.loop[(i + 1) % face.loop.size()]));
    std::sort(rims.begin(), rims.end());
    insert(part, [&](std::uint32_t from, std::uint32_t to) {
      std::vector<std::pair<double, Point3>> found;
      if (!std::binary_search(rims.begin(), rims.end(), EdgeKey{from, to})) return found;
      const Point3 start = part.corners[from];
      const Vector3 way = part.corners[to] - start;
      const double a = squared_norm(way), b = dot(start, way), c = squared_norm(start) - radius_ * radius_;
      const double discriminant = b * b - a * c, length = std::sqrt(a);
      // A chord this short is a tangent.
      if (!(discriminant > 0) || 2 * std::sqrt(discriminant) <= 1e-6 * radius_ * length) return found;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * std::sqrt(discriminant)) / a;
        if (t * length > tolerance_ && t * length < length - tolerance_) found.emplace_back(t * length, start + t * way);
      }
      return found;
    });
  }

  OpenPart finish(SeamPart& part) {
    OpenPart out;
    std::vector<SeamFace> faces;
    faces.swap(part.faces);
    out.seams.resize(part.openings);
    for (const SeamFace& face : faces) {
      if (face.opening == kClosed) out.loops.push_back(face.loop);
      else open(part, face, out);
    }
    out.corners = std::move(part.corners);
    out.marks.resize(part.openings > 0 ? out.corners.size() : 0, 0);
    return out;
  }

  // A corner of the face as it is seen from the opening's centre: its place on the circle, itself where it lies there.
  std::uint32_t on_circle(SeamPart& part, std::uint32_t corner, const Point3& centre) const {
    const Point3 place = part.corners[corner];
    if (is_on_ball(place)) return corner;
    return part.find_or_add(place_on_ball(radius_ * radius_, centre, place), tolerance_);
  }

  void open(SeamPart& part, const SeamFace& face, OpenPart& out) const {
    const Point3 centre = openings_[face.opening].centre;
    out.seams[face.seam] = centre;
    const std::uint32_t bit = 1u << face.seam;
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      const std::uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
      if (is_in_ball(0.5 * (part.corners[a] + part.corners[b]))) continue;
      const Loop inner = inner_line(part, face, a, b, centre);
      out.marks.resize(part.corners.size(), 0);
      for (const std::uint32_t corner : inner) out.marks[corner] |= bit;
      add_sector(a, b, inner, out);
    }
  }

  // Between the places of a and b on the circle, outside of it and on its side of the edge: along tangents in both places and in
  // the one that is nearest to the edge. That one's line has the whole edge behind it; where it touches beyond the two places,
  // the others' lines have.
  Loop inner_line(SeamPart& part, const SeamFace& face, std::uint32_t a, std::uint32_t b, const Point3& centre) const {
    const std::uint32_t first = on_circle(part, a, centre), last = on_circle(part, b, centre);
    if (first == last) return {first};
    const Point3 middle = face.offset * face.normal, start = part.corners[a];
    const double disc = std::sqrt(std::max(0.0, radius_ * radius_ - face.offset * face.offset));
    const Vector3 along = part.corners[b] - start;
    const Point3 nearest =
        start + std::clamp(dot(middle - start, along) / std::max(1e-300, squared_norm(along)), 0.0, 1.0) * along;
    std::vector<Vector3> touching{(part.corners[first] - middle) / disc, (part.corners[last] - middle) / disc};
    const Vector3 towards = (nearest - middle) / std::max(1e-300, distance(nearest, middle));
    const auto turn = [&](const Vector3& from, const Vector3& to) { return dot(face.normal, cross(from, to)); };
    if (turn(touching[0], touching[1]) < 1e-9) return {first, last};
    if (turn(touching[0], towards) > 1e-9 && turn(towards, touching[1]) > 1e-9) touching.insert(touching.begin() + 1, towards);
    Loop line{first};
    for (std::size_t k = 0; k + 1 < touching.size(); ++k) {
      const double scale = disc / (1 + dot(touching[k], touching[k + 1]));
      part.corners.push_back(middle + scale * (touching[k] + touching[k + 1]));
      line.push_back(static_cast<std::uint32_t>(part.corners.size() - 1));
    }
    line.push_back(last);
    return line;
  }

  // What lies between an edge of the face and the inner line: a triangle at both ends, and what is between them.
  static void add_sector(std::uint32_t a, std::uint32_t b, const Loop& inner, OpenPart& out) {
    const auto add = [&](Loop loop) {
      loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
      if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      if (loop.size() > 2) out.loops.push_back(std::move(loop));
    };
    const std::size_t count = inner.size();
    if (count <= 2) return add({inner.front(), a, b, inner.back()});
    add({inner[0], a, inner[1]});
    if (count == 3) add({inner[1], a, b});
    else add({inner[1], a, b, inner[2]});
    add({inner[count - 2], b, inner[count - 1]});
  }

  double radius_, tolerance_;
  std::vector<SeamPart> parts_;
  std::vector<Opening> openings_;
};

}  // namespace

double seam_tolerance(std::span<const Polyhedron> parts) {
  double squared = 0;
  for (const Polyhedron& part : parts) squared = std::max(squared, part.reach_squared);
  return kPlaceShare * std::sqrt(squared);
}

std::vector<OpenPart> open_parts(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius) {
  return SeamMaker(parts, shapes, squared_radius).run();
}

}  // namespace bl
