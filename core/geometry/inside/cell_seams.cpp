// Finds what two parts have in common, gives both the same corners along it, and takes the ball's disc out of it.
#include "core/geometry/inside/cell_seams.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/geometry/inside/seam_outline.h"

namespace bl::geometry {

namespace {

using CornerLoop = std::vector<std::uint32_t>;
using CornerPair = std::pair<std::uint32_t, std::uint32_t>;

// A disc that is smaller than the ball by more than three orders of magnitude is no opening: the radius left of the ball there.
constexpr double kLeastReach = 1e-7;
// Of the parts' extent: what rounding may move a corner by, with room.
constexpr double kSeamShare = 1e-9;
constexpr std::uint32_t kNoOpening = 0xffffffffu;

// A stretch of an opening's rim outside the ball, and the line around the disc that faces it.
struct OuterStretch {
  Point3 from, to;
  std::vector<Point3> inner;  // from the place of `from` on the circle to that of `to`
};

// A polygon that two parts have in common and that the ball reaches. What both have to agree on is worked out here, once.
struct Opening {
  Polygon outline;  // counter-clockwise seen from the first part's outside
  Vector3 normal;   // out of the first part
  Point3 middle;    // of the disc
  double disc = 0;  // its radius
  Point3 centre;    // the point of the outline that is nearest to the ball's middle
  std::vector<Point3> crossings;
  std::vector<OuterStretch> outer;
};

struct SeamFace {
  Vector3 normal;
  double offset = 0;
  CornerLoop loop;
  bool is_inner = false;
  std::vector<std::pair<std::uint32_t, bool>> openings = {};  // while they are sought: which, and whether seen from behind
  std::uint32_t opening = kNoOpening, seam = 0;               // afterwards: what the whole face is
  bool is_behind = false;
};

struct SeamPart {
  std::vector<Point3> corners;
  std::vector<SeamFace> faces;
  std::size_t openings = 0;

  Polygon polygon(const CornerLoop& loop) const {
    Polygon points;
    for (const std::uint32_t c : loop) points.push_back(corners[c]);
    return points;
  }
  std::uint32_t find_or_add(const Point3& place, double tolerance) {
    // Nearly all are far away, which shows without a root.
    const double near = 2 * tolerance * tolerance;
    for (std::uint32_t c = 0; c < corners.size(); ++c)
      if (squared_norm(corners[c] - place) <= near && distance(corners[c], place) <= tolerance) return c;
    corners.push_back(place);
    return static_cast<std::uint32_t>(corners.size() - 1);
  }
  // Edges of no extent go: their corners become one.
  void merge_places(double tolerance) {
    for (SeamFace& face : faces) {
      CornerLoop loop;
      for (const std::uint32_t corner : face.loop) {
        const std::uint32_t place = find_or_add(corners[corner], tolerance);
        if (loop.empty() || loop.back() != place) loop.push_back(place);
      }
      while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      face.loop = std::move(loop);
    }
  }
};

// What lies between a stretch of the rim and the line that faces it: a triangle at both ends, and what is between them.
void add_sector(const CornerLoop& path, const CornerLoop& inner, std::vector<CornerLoop>& loops) {
  const auto add = [&](CornerLoop loop) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() > 2) loops.push_back(std::move(loop));
  };
  const std::size_t count = inner.size();
  CornerLoop between = path;
  if (count > 2) {
    add({inner[0], path.front(), inner[1]});
    add({inner[count - 2], path.back(), inner[count - 1]});
    between.insert(between.begin(), inner[1]);
    if (count > 3) between.push_back(inner[2]);
  } else {
    between.insert(between.begin(), inner.front());
    between.push_back(inner.back());
  }
  add(std::move(between));
}

// Who lies near enough to some points to be looked at: most places of a cell lie far from each edge.
class PlaceBox {
 public:
  PlaceBox(std::span<const Point3> points, double margin) : low_(points.front()), high_(points.front()) {
    for (const Point3& p : points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
      high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
    low_ -= Vector3{margin, margin, margin};
    high_ += Vector3{margin, margin, margin};
  }
  bool holds(const Point3& p) const {
    return p.x >= low_.x && p.x <= high_.x && p.y >= low_.y && p.y <= high_.y && p.z >= low_.z && p.z <= high_.z;
  }

 private:
  Point3 low_, high_;
};

class SeamMaker {
 public:
  SeamMaker(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius)
      : radius_(std::sqrt(squared_radius)), tolerance_(seam_tolerance(parts)) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      SeamPart& part = parts_.emplace_back();
      if (shapes[k].is_empty) continue;
      part.corners = parts[k].vertices;
      for (const PolyhedronFace& face : parts[k].faces) {
        const auto loop = parts[k].loop(face);
        part.faces.push_back({face.normal, face.offset, CornerLoop(loop.begin(), loop.end()), face.kind == FaceKind::inner});
      }
    }
  }

  std::vector<OpenPart> run() {
    find_openings();
    for (Opening& opening : openings_) work_out(opening);
    for (SeamPart& part : parts_) split_faces(part);
    share_corners();
    std::vector<OpenPart> out;
    for (SeamPart& part : parts_) out.push_back(finish(part));
    return out;
  }

 private:
  bool is_reached(const SeamFace& face) const { return face.is_inner && std::abs(face.offset) < radius_; }

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
    const Polygon bounds = b.polygon(other.loop);
    for (const Point3& corner : bounds)
      if (std::abs(dot(own.normal, corner) - own.offset) > 4 * tolerance_) return;
    Polygon common = a.polygon(own.loop);
    Vector3 outward;
    double offset = 0;
    for (std::size_t i = 0; i < bounds.size() && !common.empty(); ++i)
      if (edge_line(bounds, i, other.normal, tolerance_, outward, offset))
        common = cut_outline(common, outward, offset, tolerance_).first;
    if (!(outline_area(common) > tolerance_ * radius_)) return;
    Opening opening;
    for (const Point3& corner : common)
      if (opening.outline.empty() ||
          (distance(opening.outline.back(), corner) > tolerance_ && distance(opening.outline.front(), corner) > tolerance_))
        opening.outline.push_back(corner);
    opening.normal = own.normal;
    opening.middle = own.offset * own.normal;
    opening.disc = std::sqrt(std::max(0.0, radius_ * radius_ - own.offset * own.offset));
    opening.centre = nearest_in_outline(opening.outline, own.normal, own.offset);
    if (!(norm(opening.centre) < (1 - kLeastReach) * radius_) || opening.outline.size() < 3) return;
    const auto number = static_cast<std::uint32_t>(openings_.size());
    own.openings.emplace_back(number, false);
    other.openings.emplace_back(number, true);
    ++a.openings;
    ++b.openings;
    openings_.push_back(std::move(opening));
  }

  // Cuts the rim where it goes through the ball's surface, and draws a line around the disc along what lies outside.
  void work_out(Opening& opening) const {
    for (std::size_t i = 0; i < opening.outline.size(); ++i) {
      const Point3 start = opening.outline[i], end = opening.outline[(i + 1) % opening.outline.size()];
      std::vector<Point3> places{start};
      const Vector3 way = end - start;
      const double a = squared_norm(way), b = dot(start, way), c = squared_norm(start) - radius_ * radius_;
      const double root = std::sqrt(std::max(0.0, b * b - a * c)), length = std::sqrt(a);
      // A chord this short is a tangent.
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * root) / a;
        if (2 * root <= 1e-6 * radius_ * length || t * length <= tolerance_ || t * length >= length - tolerance_) continue;
        places.push_back(start + t * way);
        opening.crossings.push_back(places.back());
      }
      places.push_back(end);
      for (std::size_t k = 0; k + 1 < places.size(); ++k)
        if (norm(0.5 * (places[k] + places[k + 1])) > radius_)
          opening.outer.push_back({places[k], places[k + 1], inner_line(opening, places[k], places[k + 1])});
    }
  }

  // A point of the rim as it is seen from the opening's centre: its place on the circle, itself where it lies there.
  Point3 on_circle(const Point3& centre, const Point3& place) const {
    return std::abs(norm(place) - radius_) <= 2 * tolerance_ ? place : place_on_ball(radius_ * radius_, centre, place);
  }

  // Between the places of two points on the circle, outside of it and on its side of the rim: along tangents in both places and
  // in the one that is nearest to the rim. That one's line has the whole stretch behind it; where it touches beyond the two
  // places, the others' lines have.
  std::vector<Point3> inner_line(const Opening& opening, const Point3& from, const Point3& to) const {
    const Point3 first = on_circle(opening.centre, from), last = on_circle(opening.centre, to);
    if (distance(first, last) <= tolerance_) return {first};
    const Vector3 along = to - from;
    const double at = dot(opening.middle - from, along) / std::max(1e-300, squared_norm(along));
    const Vector3 towards = from + std::clamp(at, 0.0, 1.0) * along - opening.middle;
    const Vector3 nearest = towards / std::max(1e-300, norm(towards));
    std::vector<Vector3> touching{(first - opening.middle) / opening.disc, (last - opening.middle) / opening.disc};
    const auto turn = [&](const Vector3& a, const Vector3& b) { return dot(opening.normal, cross(a, b)); };
    if (turn(touching[0], touching[1]) < 1e-6) return {first, last};
    if (turn(touching[0], nearest) > 1e-6 && turn(nearest, touching[1]) > 1e-6) touching.insert(touching.begin() + 1, nearest);
    std::vector<Point3> line{first};
    for (std::size_t k = 0; k + 1 < touching.size(); ++k) {
      const double scale = opening.disc / (1 + dot(touching[k], touching[k + 1]));
      line.push_back(opening.middle + scale * (touching[k] + touching[k + 1]));
    }
    line.push_back(last);
    return line;
  }

  // A face with openings becomes one face for each of them, and the rest.
  void split_faces(SeamPart& part) {
    if (part.openings == 0) return;
    part.merge_places(tolerance_);
    const std::size_t count = part.faces.size();
    std::uint32_t seam = 0;
    for (std::size_t f = 0; f < count; ++f) {
      SeamFace piece = part.faces[f];
      if (piece.openings.empty()) continue;
      std::vector<Polygon> rest{part.polygon(piece.loop)};
      part.faces[f].loop.clear();
      for (const auto& [number, is_behind] : piece.openings) {
        piece.opening = number;
        piece.is_behind = is_behind;
        piece.seam = seam++;
        add_piece(part, piece, openings_[number].outline, is_behind);
        rest = without(rest, openings_[number]);
      }
      piece.opening = kNoOpening;
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

  std::vector<Polygon> without(const std::vector<Polygon>& polygons, const Opening& opening) const {
    std::vector<Polygon> left;
    for (Polygon inside : polygons) {
      Vector3 outward;
      double offset = 0;
      for (std::size_t i = 0; i < opening.outline.size() && !inside.empty(); ++i) {
        if (!edge_line(opening.outline, i, opening.normal, tolerance_, outward, offset)) continue;
        auto [in, out] = cut_outline(inside, outward, offset, tolerance_);
        if (outline_area(out) > tolerance_ * radius_) left.push_back(std::move(out));
        inside = std::move(in);
      }
    }
    return left;
  }

  // Every edge gets the corners that lie on it: the part's own wherever they are, those of others in the ball, and where openings
  // have their rim on the ball.
  void share_corners() {
    std::vector<Point3> shared;
    for (const Opening& opening : openings_) shared.insert(shared.end(), opening.crossings.begin(), opening.crossings.end());
    for (const SeamPart& part : parts_)
      for (const Point3& corner : part.corners)
        if (part.openings > 0 && norm(corner) <= radius_ + tolerance_) shared.push_back(corner);
    for (SeamPart& part : parts_) {
      if (part.openings == 0) continue;
      std::vector<Point3> places = part.corners;
      const PlaceBox box(part.corners, 2 * tolerance_);
      std::copy_if(shared.begin(), shared.end(), std::back_inserter(places), [&](const Point3& p) { return box.holds(p); });
      insert(part, places);
    }
  }

  std::vector<std::pair<double, Point3>> places_on(const Point3& start, const Point3& end, std::span<const Point3> places) const {
    std::vector<std::pair<double, Point3>> found;
    const double length = distance(start, end);
    const Vector3 along = (end - start) / std::max(1e-300, length);
    const Point3 ends[2] = {start, end};
    const PlaceBox box(ends, 2 * tolerance_);
    for (const Point3& place : places) {
      if (!box.holds(place)) continue;
      const double at = dot(place - start, along);
      if (at > tolerance_ && at < length - tolerance_ && distance(place, start + at * along) <= 2 * tolerance_)
        found.emplace_back(at, place);
    }
    std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    return found;
  }

  void insert(SeamPart& part, std::span<const Point3> places) const {
    std::map<CornerPair, CornerLoop> inserted;
    for (SeamFace& face : part.faces) {
      CornerLoop loop;
      for (std::size_t i = 0; i < face.loop.size(); ++i) {
        const std::uint32_t a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        const CornerPair key = std::minmax(a, b);
        const auto [it, is_new] = inserted.emplace(key, CornerLoop());
        for (const auto& [at, place] : is_new ? places_on(part.corners[key.first], part.corners[key.second], places)
                                              : std::vector<std::pair<double, Point3>>()) {
          const std::uint32_t corner = part.find_or_add(place, tolerance_);
          if (corner != a && corner != b && (it->second.empty() || it->second.back() != corner)) it->second.push_back(corner);
        }
        loop.push_back(a);
        if (a < b) loop.insert(loop.end(), it->second.begin(), it->second.end());
        else loop.insert(loop.end(), it->second.rbegin(), it->second.rend());
      }
      face.loop = std::move(loop);
    }
  }

  OpenPart finish(SeamPart& part) const {
    OpenPart out;
    out.seams.resize(part.openings);
    for (const SeamFace& face : part.faces) {
      if (face.opening == kNoOpening) out.loops.push_back(face.loop);
      else open(part, face, out);
    }
    out.corners = std::move(part.corners);
    out.marks.resize(part.openings > 0 ? out.corners.size() : 0, 0);
    return out;
  }

  void open(SeamPart& part, const SeamFace& face, OpenPart& out) const {
    const Opening& opening = openings_[face.opening];
    out.seams[face.seam] = opening.centre;
    for (const OuterStretch& stretch : opening.outer) {
      CornerLoop inner;
      for (const Point3& place : stretch.inner) inner.push_back(part.find_or_add(place, tolerance_));
      out.marks.resize(part.corners.size(), 0);
      for (const std::uint32_t corner : inner) out.marks[corner] |= 1u << face.seam;
      std::uint32_t from = part.find_or_add(stretch.from, tolerance_), to = part.find_or_add(stretch.to, tolerance_);
      if (face.is_behind) {
        std::swap(from, to);
        std::reverse(inner.begin(), inner.end());
      }
      add_sector(path_along(face.loop, from, to), inner, out.loops);
    }
  }

  static CornerLoop path_along(const CornerLoop& loop, std::uint32_t from, std::uint32_t to) {
    const auto begin = std::find(loop.begin(), loop.end(), from);
    CornerLoop path{from};
    if (begin == loop.end() || std::find(loop.begin(), loop.end(), to) == loop.end()) return {from, to};
    for (auto at = begin; *at != to; path.push_back(*at)) at = at + 1 == loop.end() ? loop.begin() : at + 1;
    return path;
  }

  double radius_, tolerance_;
  std::vector<SeamPart> parts_;
  std::vector<Opening> openings_;
};

}  // namespace

double seam_tolerance(std::span<const Polyhedron> parts) {
  double squared = 0;
  for (const Polyhedron& part : parts) squared = std::max(squared, part.reach_squared);
  return kSeamShare * std::sqrt(squared);
}

std::vector<OpenPart> open_parts(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius) {
  return SeamMaker(parts, shapes, squared_radius).run();
}

}  // namespace bl::geometry
