// Horizontal cuts through faces and through small pieces of the ball.
#include "core/facade/facade_survey.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace bl {

namespace {

using Polygon = std::vector<Point3>;

// The few corners of a small piece, without memory of their own: there are thousands of pieces.
class Piece {
 public:
  void push_back(const Point3& p) {
    if (count_ < at_.size()) at_[count_++] = p;
  }
  std::size_t size() const { return count_; }
  const Point3& operator[](std::size_t k) const { return at_[k]; }
  const Point3* begin() const { return at_.data(); }
  const Point3* end() const { return at_.data() + count_; }

 private:
  std::array<Point3, 8> at_;  // a clipped triangle has at most six, and a level cut adds one
  std::size_t count_ = 0;
};

using Plane2 = std::array<double, 2>;

// Steeper than 45 degrees is façade: |n.z| <= cos 45°.
constexpr double kSteep = 0.70710678118654757;
// Rows of small triangles in each coarse one, for what lies on the ball: its area comes out within some parts in a thousand
// before scaling.
constexpr int kParts = 6;
constexpr double kMostStoreys = 10000;

template <class Corners>
Corners below(const Corners& polygon, double height) {
  Corners out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.z <= height) out.push_back(a);
    if ((a.z < height && b.z > height) || (a.z > height && b.z < height)) out.push_back(a + ((height - a.z) / (b.z - a.z)) * (b - a));
  }
  return out;
}

double flat_area(const auto& polygon, const Vector3& normal) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    doubled += dot(normal, cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  return std::max(0.0, 0.5 * doubled);
}

// A face in its plane, with the disc that the ball cuts out of it.
struct Disc {
  Point3 foot;
  Vector3 along, across;
  double squared = 0;

  static Disc of(const MeshWrap& wrap, const Vector3& normal, const Point3& on_plane) {
    Disc disc;
    const double height = dot(normal, on_plane - wrap.ball_centre);
    disc.foot = wrap.ball_centre + height * normal;
    disc.squared = wrap.radius * wrap.radius - height * height;
    const Vector3 other = std::abs(normal.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
    disc.along = cross(other, normal) / norm(cross(other, normal));
    disc.across = cross(normal, disc.along);
    return disc;
  }
  double area(const Polygon& polygon) const {
    if (!(squared > 0)) return 0;
    std::vector<Plane2> corners;
    for (const Point3& p : polygon) corners.push_back({dot(along, p - foot), dot(across, p - foot)});
    return polygon_disc_area(corners, squared);
  }
};

class Surveyor {
 public:
  explicit Surveyor(const SurveyOptions& options) : options_(options) {}

  /// Adds the polygon; `area` gives that of any part of it.
  template <class Corners, class Area>
  void add(const Corners& polygon, const Vector3& normal, double scale, const Area& area) {
    const double whole = scale * area(polygon);
    if (!(whole > 0)) return;
    double low = polygon[0].z, high = low;
    for (const Point3& p : polygon) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
    if (normal.z > kSteep) out_.roof += whole;
    else if (normal.z < -kSteep) (high <= options_.ground + kOnGround ? out_.ground : out_.underside) += whole;
    else add_facade(polygon, low, high, orientation_of(normal, options_.true_north), whole, scale, area);
  }

  FacadeSurvey take() {
    for (const auto& [place, row] : rows_) {
      out_.rows.push_back(row);
      out_.facade += row.area();
    }
    return std::move(out_);
  }
  FacadeSurvey& out() { return out_; }

 private:
  static constexpr double kOnGround = 1e-6;  // [m]

  template <class Corners, class Area>
  void add_facade(const Corners& polygon, double low, double high, Orientation orientation, double whole, double scale,
                  const Area& area) {
    // The area below each height; what lies between two heights is the difference, so that all of them add up to the whole.
    double done = 0;
    const auto up_to = [&](double height) {
      const double reached = height >= high ? whole : height <= low ? 0 : std::min(whole, scale * area(below(polygon, height)));
      return std::max(0.0, reached - std::exchange(done, std::max(done, reached)));
    };
    out_.ground += up_to(options_.ground);
    if (done >= whole) return;
    const WindowBand& band = options_.bands[static_cast<std::size_t>(orientation)];
    const double height = options_.storey_height > 0 ? options_.storey_height : 1e300;
    const double begin = std::max(low, std::min(options_.ground, high));
    double storey = std::max(0.0, std::floor((begin - options_.base) / height));
    for (; done < whole && storey < kMostStoreys; ++storey) {
      const double floor = options_.base + storey * height;
      FacadeRow& row = rows_[{static_cast<int>(storey), orientation}];
      row.storey = static_cast<int>(storey);
      row.orientation = orientation;
      row.below += up_to(floor + std::clamp(band.sill, 0.0, height));
      row.band += up_to(floor + std::clamp(band.head, 0.0, height));
      row.above += up_to(storey + 1 < kMostStoreys ? options_.base + (storey + 1) * height : high);
    }
  }

  const SurveyOptions& options_;
  std::map<std::pair<int, Orientation>, FacadeRow> rows_;
  FacadeSurvey out_;
};

void survey_flat(const Mesh& mesh, std::span<const ShapeFace> faces, Surveyor& surveyor) {
  for (const ShapeFace& face : faces) {
    Polygon polygon;
    for (std::size_t t = face.first; t < face.first + face.count; ++t)
      polygon.push_back(mesh.vertices[mesh.triangles[t][mesh.wrap ? 1 : 0]]);
    if (!mesh.wrap)
      for (const std::size_t corner : {1u, 2u}) polygon.push_back(mesh.vertices[mesh.triangles[face.first][corner]]);
    const Disc disc = mesh.wrap ? Disc::of(*mesh.wrap, face.normal, face.middle) : Disc{};
    const auto area = [&](const Polygon& part) { return mesh.wrap ? disc.area(part) : flat_area(part, face.normal); };
    if (face.is_shared) surveyor.out().shared += area(polygon);
    else surveyor.add(polygon, face.normal, 1, area);
  }
}

// What of a small triangle lies beyond the ball, moved onto it: as make_mesh does it.
struct Projection {
  Point3 centre, from;  // of the ball, and what vertices move towards
  double squared = 0;

  double beyond(const Point3& p) const { return squared_norm(p - centre) - squared; }
  Point3 on_ball(const Point3& p) const {
    const Vector3 way = p - from, start = from - centre;
    const double a = squared_norm(way), b = dot(way, start), rest = std::max(0.0, squared - squared_norm(start));
    const double root = std::sqrt(b * b + a * rest), t = b > 0 ? rest / (b + root) : (root - b) / a;
    return from + std::min(1.0, t) * way;
  }
  // Where the ball's surface crosses an edge with one end on each side.
  Point3 crossing(const Point3& a, const Point3& b) const {
    const Vector3 way = b - a, start = a - centre;
    const double p = squared_norm(way), q = dot(way, start), c = beyond(a), root = std::sqrt(std::max(0.0, q * q - p * c));
    const double t = c < 0 ? (-q + root) / p : (-q - root) / p;
    return a + std::clamp(t, 0.0, 1.0) * way;
  }
  Piece piece(const std::array<Point3, 3>& corners) const {
    Piece out;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point3 &a = corners[i], &b = corners[(i + 1) % 3];
      const double here = beyond(a), there = beyond(b);
      if (here >= 0) out.push_back(on_ball(a));
      if ((here < 0) != (there < 0)) out.push_back(crossing(a, b));
    }
    return out;
  }
};

struct RoundPiece {
  Piece polygon;
  Vector3 flat_normal, ball_normal;
  double area = 0;
};

void add_pieces(const std::array<Point3, 3>& corners, const Projection& projection, std::vector<RoundPiece>& pieces) {
  if (std::all_of(corners.begin(), corners.end(), [&](const Point3& p) { return projection.beyond(p) < 0; })) return;
  const auto at = [&](int row, int i) {
    const double a = static_cast<double>(row - i) / kParts, b = static_cast<double>(i) / kParts;
    return corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
  };
  for (int row = 0; row < kParts; ++row)
    for (int i = 0; i < 2 * row + 1; ++i) {
      const int k = i / 2;
      const std::array<Point3, 3> small = i % 2 == 0
                                              ? std::array<Point3, 3>{at(row, k), at(row + 1, k), at(row + 1, k + 1)}
                                              : std::array<Point3, 3>{at(row, k), at(row + 1, k + 1), at(row, k + 1)};
      RoundPiece piece{projection.piece(small), {}, {}, 0};
      if (piece.polygon.size() < 3) continue;
      Point3 middle;
      Vector3 doubled;
      for (std::size_t c = 0; c < piece.polygon.size(); ++c) {
        middle += piece.polygon[c] / static_cast<double>(piece.polygon.size());
        if (c >= 2) doubled += cross(piece.polygon[c - 1] - piece.polygon[0], piece.polygon[c] - piece.polygon[0]);
      }
      const double size = norm(doubled), reach = distance(middle, projection.centre);
      if (!(size > 0) || !(reach > 0)) continue;
      piece.area = 0.5 * size;
      piece.flat_normal = doubled / size;
      piece.ball_normal = (middle - projection.centre) / reach;
      pieces.push_back(std::move(piece));
    }
}

void survey_round(const Mesh& mesh, const SurveyOptions& options, Surveyor& surveyor) {
  const MeshWrap& wrap = *mesh.wrap;
  std::vector<RoundPiece> pieces;
  std::size_t t = 0;
  for (const MeshWrap::Part& part : wrap.parts)
    for (std::uint32_t k = 0; k < part.triangles && t < mesh.triangles.size(); ++k, ++t) {
      const auto& triangle = mesh.triangles[t];
      add_pieces({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]},
                 {wrap.ball_centre, part.centre, wrap.radius * wrap.radius}, pieces);
    }
  double measured = 0;
  for (const RoundPiece& piece : pieces) measured += piece.area;
  const double scale = options.spherical_area >= 0 && measured > 0 ? options.spherical_area / measured : 1;
  for (const RoundPiece& piece : pieces)
    surveyor.add(piece.polygon, piece.ball_normal, scale, [&](const Piece& p) { return flat_area(p, piece.flat_normal); });
}

}  // namespace

double polygon_disc_area(std::span<const std::array<double, 2>> corners, double squared) {
  const auto turned = [](const Plane2& a, const Plane2& b) { return a[0] * b[1] - a[1] * b[0]; };
  const auto level = [](const Plane2& a, const Plane2& b) { return a[0] * b[0] + a[1] * b[1]; };
  const auto sector = [&](const Plane2& a, const Plane2& b) { return squared * std::atan2(turned(a, b), level(a, b)); };
  double doubled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Plane2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Plane2 way{b[0] - a[0], b[1] - a[1]};
    const double p = level(way, way), q = level(a, way), c = level(a, a) - squared, rest = q * q - p * c;
    if (!(p > 0)) continue;
    const double root = rest > 0 ? std::sqrt(rest) : 0, enter = (-q - root) / p, leave = (-q + root) / p;
    if (!(rest > 0) || enter >= 1 || leave <= 0) {
      doubled += sector(a, b);
      continue;
    }
    const auto at = [&](double share) { return Plane2{a[0] + share * way[0], a[1] + share * way[1]}; };
    const Plane2 first = enter > 0 ? at(enter) : a, last = leave < 1 ? at(leave) : b;
    if (enter > 0) doubled += sector(a, first);
    doubled += turned(first, last);
    if (leave < 1) doubled += sector(last, b);
  }
  return std::max(0.0, 0.5 * doubled);
}

FacadeSurvey survey_facade(const Mesh& mesh, std::span<const ShapeFace> faces, const SurveyOptions& options) {
  Surveyor surveyor(options);
  survey_flat(mesh, faces, surveyor);
  if (mesh.wrap) survey_round(mesh, options, surveyor);
  return surveyor.take();
}

}  // namespace bl
