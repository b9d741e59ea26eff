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

// Steeper than 45 degrees is façade: |n.z| <= cos 45°.
constexpr double kSteep = 0.70710678118654757;
constexpr double kMostStoreys = 10000;

// Hands the corners of what lies below a height to `out`, in their order.
template <class Out>
void cut_below(Corners polygon, double height, const Out& out) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    if (a.z <= height) out(a);
    if ((a.z < height && b.z > height) || (a.z > height && b.z < height)) out(a + ((height - a.z) / (b.z - a.z)) * (b - a));
  }
}

double flat_area(Corners polygon, const Vector3& normal) { return std::max(0.0, 0.5 * doubled_area(polygon, normal)); }

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

// What a piece of surface counts as, and where it looks to if it is façade.
struct Facing {
  enum class Side { facade, roof, underside } side = Side::facade;
  Orientation orientation = Orientation::north;
};

Facing facing_of(const Vector3& normal, const Compass& compass) {
  if (normal.z > kSteep) return {Facing::Side::roof};
  if (normal.z < -kSteep) return {Facing::Side::underside};
  return {Facing::Side::facade, compass.of(normal)};
}

// Of a piece of the ball: by comparing squares where these leave no doubt, without roots and divisions.
Facing facing_of(const BallPieces& round, const BallPiece& piece, const Compass& compass) {
  const Vector3& about = piece.about_outward;
  const double squared = squared_norm(about), steepness = about.z * about.z - kSteep * kSteep * squared;
  constexpr double kDoubtful = 1e-8;
  if (steepness > kDoubtful * squared) return {about.z > 0 ? Facing::Side::roof : Facing::Side::underside};
  if (steepness < -kDoubtful * squared)
    if (const auto orientation = compass.of_about(about)) return {Facing::Side::facade, *orientation};
  const Vector3 outward = round.outward(round.of(piece));
  return facing_of(outward / norm(outward), compass);
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
  double area(Corners polygon) const {
    if (!(squared > 0)) return 0;
    std::vector<Plane2> corners;
    for (const Point3& p : polygon) corners.push_back({dot(along, p - foot), dot(across, p - foot)});
    return polygon_disc_area(corners, squared);
  }
};

class Surveyor {
 public:
  explicit Surveyor(const SurveyOptions& options) : options_(options), compass_(options.true_north) {}
  const Compass& compass() const { return compass_; }

  /// Adds the polygon, whose whole area is given; `area_below` gives that of what lies below a height.
  template <class AreaBelow>
  void add(Corners polygon, const Facing& facing, double whole, const AreaBelow& area_below) {
    if (!(whole > 0)) return;
    double low = polygon[0].z, high = low;
    for (const Point3& p : polygon) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
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
    const WindowBand& band = options_.bands[static_cast<std::size_t>(orientation)];
    const double height = options_.storey_height > 0 ? options_.storey_height : 1e300;
    const double begin = std::max(low, std::min(options_.ground, high));
    double storey = std::max(0.0, std::floor((begin - options_.base) / height));
    for (; done < whole && storey < kMostStoreys; ++storey) {
      const double floor = options_.base + storey * height;
      FacadeRow& row = row_of(static_cast<int>(storey), orientation);
      row.below += up_to(floor + std::clamp(band.sill, 0.0, height));
      if (done >= whole) return;
      row.band += up_to(floor + std::clamp(band.head, 0.0, height));
      if (done >= whole) return;
      row.above += up_to(storey + 1 < kMostStoreys ? options_.base + (storey + 1) * height : high);
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
  std::vector<Row> rows_;  // storey by storey, with a place for each orientation
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
    const auto area = [&](Corners part) { return mesh.wrap ? disc.area(part) : flat_area(part, face.normal); };
    if (face.is_shared) {
      surveyor.out().shared += area(polygon);
      continue;
    }
    surveyor.add(polygon, facing_of(face.normal, surveyor.compass()), area(polygon), [&](double height) {
      Polygon part;
      cut_below(polygon, height, [&](const Point3& corner) { part.push_back(corner); });
      return area(part);
    });
  }
}

void survey_round(const Mesh& mesh, const SurveyOptions& options, Surveyor& surveyor) {
  const BallPieces round = ball_pieces(mesh);
  const double scale = options.spherical_area >= 0 && round.area > 0 ? options.spherical_area / round.area : 1;
  for (const BallPiece& piece : round.pieces) {
    const Corners polygon = round.of(piece);
    surveyor.add(polygon, facing_of(round, piece, surveyor.compass()), scale * piece.flat_area,
                 [&](double height) { return scale * flat_area_below(polygon, piece.flat_normal, height); });
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
