// Horizontal cuts through faces and through small pieces of the ball.
#include "core/facade/facade_survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/mathematics.h"
#include "core/facade/ball_pieces.h"

namespace bl::facade {

namespace {

using Polygon = std::vector<Point3>;
using Corners = std::span<const Point3>;

using Plane2 = std::array<double, 2>;

constexpr double kMostStoreys = 10000;

bool is_lower(const Point3& a, const Point3& b) { return a.z < b.z; }

// Hands the corners of what lies below a height to `out`, in their order.
template <class Out>
void cut_below(Corners polygon, double height, const Out& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    if (a.z <= height) out(a);
    if ((a.z < height && b.z > height) || (a.z > height && b.z < height)) out(a + ((height - a.z) / (b.z - a.z)) * (b - a));
  }
}

double flat_area(Corners polygon, const Vector3& normal) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    doubled += dot(normal, cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  return std::max(0.0, 0.5 * doubled);
}

// As flat_area() of what lies below a height, triangle by triangle, without keeping its corners: there are thousands of pieces.
double flat_area_below(Corners polygon, const Vector3& normal, double height) {
  Point3 first, last;
  int count = 0;
  double doubled = 0;
  cut_below(polygon, height, [&](const Point3& corner) {
    if (count == 0) first = corner;
    else if (count > 1) doubled += dot(normal, cross(last - first, corner - first));
    last = corner;
    ++count;
  });
  return std::max(0.0, 0.5 * doubled);
}

// The same of a triangle with corners on both sides of the height, of which none is at it.
double triangle_below(const Point3& a, const Point3& b, const Point3& c, const Vector3& normal, double height) {
  const auto cut = [&](const Point3& from, const Point3& to) {
    return from + ((height - from.z) / (to.z - from.z)) * (to - from);
  };
  const auto of_three = [&](const Point3& p, const Point3& q, const Point3& r) { return dot(normal, cross(q - p, r - p)); };
  const auto of_four = [&](const Point3& p, const Point3& q, const Point3& r, const Point3& s) {
    return of_three(p, q, r) + of_three(p, r, s);
  };
  const auto doubled = [&] {
    switch ((a.z > height ? 1 : 0) | (b.z > height ? 2 : 0) | (c.z > height ? 4 : 0)) {
      case 1: return of_four(cut(a, b), b, c, cut(c, a));
      case 2: return of_four(a, cut(a, b), cut(b, c), c);
      case 3: return of_three(cut(b, c), c, cut(c, a));
      case 4: return of_four(a, b, cut(b, c), cut(c, a));
      case 5: return of_three(cut(a, b), b, cut(b, c));
      default: return of_three(a, cut(a, b), cut(c, a));
    }
  };
  return std::max(0.0, 0.5 * doubled());
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
  // `corners` is room for those of the polygon.
  double area(Corners polygon, std::vector<Plane2>& corners) const {
    if (!(squared > 0)) return 0;
    corners.clear();
    for (const Point3& p : polygon) corners.push_back({dot(along, p - foot), dot(across, p - foot)});
    return polygon_disc_area(corners, squared);
  }
};

class Surveyor {
 public:
  explicit Surveyor(const SurveyOptions& options)
      : options_(options),
        compass_(options.true_north),
        height_(options.storey_height > 0 ? options.storey_height : 1e300),
        bands_(options.bands) {
    for (WindowBand& band : bands_) band = {std::clamp(band.sill, 0.0, height_), std::clamp(band.head, 0.0, height_)};
  }
  const Compass& compass() const { return compass_; }

  /// Adds a polygon between the heights `low` and `high`, whose whole area is given; `area_below` gives that of what lies below a
  /// height.
  template <class AreaBelow>
  void add(double low, double high, const Facing& facing, double whole, const AreaBelow& area_below) {
    if (!(whole > 0)) return;
    if (facing.side == Facing::Side::facade) add_facade(low, high, facing.orientation, whole, area_below);
    else if (facing.side == Facing::Side::roof) out_.roof += whole;
    else (high <= options_.ground + kOnGround ? out_.ground : out_.underside) += whole;
  }

  FacadeSurvey take() {
    for (const Row& row : rows_) {
      if (!row.is_there) continue;
      out_.rows.push_back(row.content);
      out_.facade += row.content.area();
    }
    return std::move(out_);
  }
  FacadeSurvey& out() { return out_; }

 private:
  static constexpr double kOnGround = 1e-6;  // [m]

  template <class AreaBelow>
  void add_facade(double low, double high, Orientation orientation, double whole, const AreaBelow& area_below) {
    // The area below each height; what lies between two heights is the difference, so that all of them add up to the whole.
    double done = 0;
    const auto up_to = [&](double height) {
      if (height <= low && height < high) return 0.0;
      const double reached = height >= high ? whole : std::min(whole, area_below(height));
      return std::max(0.0, reached - std::exchange(done, std::max(done, reached)));
    };
    out_.ground += up_to(options_.ground);
    if (done >= whole) return;
    const WindowBand& band = bands_[static_cast<std::size_t>(orientation)];
    const double begin = std::max(low, std::min(options_.ground, high));
    double storey = std::max(0.0, std::floor((begin - options_.base) / height_));
    for (; done < whole && storey < kMostStoreys; ++storey) {
      const double floor = options_.base + storey * height_;
      FacadeRow& row = row_of(static_cast<int>(storey), orientation);
      row.below += up_to(floor + band.sill);
      if (done >= whole) return;
      row.band += up_to(floor + band.head);
      if (done >= whole) return;
      row.above += up_to(storey + 1 < kMostStoreys ? options_.base + (storey + 1) * height_ : high);
    }
  }

  FacadeRow& row_of(int storey, Orientation orientation) {
    const std::size_t index = static_cast<std::size_t>(storey) * kOrientations + static_cast<std::size_t>(orientation);
    if (rows_.size() <= index) rows_.resize((static_cast<std::size_t>(storey) + 1) * kOrientations);
    Row& row = rows_[index];
    if (!row.is_there) row = {true, {storey, orientation}};
    return row.content;
  }

  struct Row {
    bool is_there = false;
    FacadeRow content;
  };
  const SurveyOptions& options_;
  Compass compass_;
  double height_;                                // of a storey
  std::array<WindowBand, kOrientations> bands_;  // within a storey
  std::vector<Row> rows_;                        // storey by storey, with a place for each orientation
  FacadeSurvey out_;
};

void survey_flat(const Mesh& mesh, std::span<const ShapeFace> faces, Surveyor& surveyor) {
  Polygon polygon, part;
  std::vector<Plane2> corners;
  for (const ShapeFace& face : faces) {
    polygon.clear();
    for (std::size_t t = face.first; t < face.first + face.count; ++t)
      polygon.push_back(mesh.vertices[mesh.triangles[t][mesh.wrap ? 1 : 0]]);
    if (!mesh.wrap)
      for (const std::size_t corner : {1u, 2u}) polygon.push_back(mesh.vertices[mesh.triangles[face.first][corner]]);
    const Disc disc = mesh.wrap ? Disc::of(*mesh.wrap, face.normal, face.middle) : Disc{};
    const auto area = [&](Corners of) { return mesh.wrap ? disc.area(of, corners) : flat_area(of, face.normal); };
    if (face.is_shared) {
      surveyor.out().shared += area(polygon);
      continue;
    }
    const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), is_lower);
    surveyor.add(low->z, high->z, facing_of(face.normal, surveyor.compass()), area(polygon), [&](double height) {
      part.clear();
      cut_below(polygon, height, [&](const Point3& corner) { part.push_back(corner); });
      return area(part);
    });
  }
}

void survey_round(const Mesh& mesh, const SurveyOptions& options, Surveyor& surveyor) {
  thread_local BallPieces round;  // some hundred kilobytes, which would else be asked for and given back for each shape
  find_ball_pieces(mesh, surveyor.compass(), round);
  const double scale = options.spherical_area >= 0 && round.area > 0 ? options.spherical_area / round.area : 1;
  for (const BallPiece& piece : round.pieces) {
    const double whole = scale * piece.flat_area;
    const Point3 &a = round.points[piece.corners[0]], &b = round.points[piece.corners[1]], &c = round.points[piece.corners[2]];
    if (piece.count == 3) {
      const double low = std::min({a.z, b.z, c.z}), high = std::max({a.z, b.z, c.z});
      surveyor.add(low, high, piece.facing, whole, [&](double height) {
        const bool is_between = a.z != height && b.z != height && c.z != height;
        return scale * (is_between ? triangle_below(a, b, c, piece.flat_normal, height)
                                   : flat_area_below(std::array{a, b, c}, piece.flat_normal, height));
      });
    } else {
      const std::array<Point3, 4> polygon{a, b, c, round.points[piece.corners[3]]};
      const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(), is_lower);
      surveyor.add(low->z, high->z, piece.facing, whole,
                   [&](double height) { return scale * flat_area_below(polygon, piece.flat_normal, height); });
    }
  }
}

}  // namespace

double polygon_disc_area(std::span<const std::array<double, 2>> corners, double squared) {
  const auto turned = [](const Plane2& a, const Plane2& b) { return a[0] * b[1] - a[1] * b[0]; };
  const auto level = [](const Plane2& a, const Plane2& b) { return a[0] * b[0] + a[1] * b[1]; };
  const auto sector = [&](const Plane2& a, const Plane2& b) {
    return squared * mathematics::arc_tangent(turned(a, b), level(a, b));
  };
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

}  // namespace bl::facade
