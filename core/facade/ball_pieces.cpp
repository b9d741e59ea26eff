// The corners of a triangle's parts are moved onto the ball once, although up to six parts meet in each.
#include "core/facade/ball_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace bl::facade {

namespace {

// Rows of small triangles in each coarse one: the area comes out within some parts in a thousand before scaling.
constexpr int kParts = 6;

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
  // Where the ball's surface crosses an edge with one end on each side; `c` is how far `a` lies beyond it.
  Point3 crossing(const Point3& a, const Point3& b, double c) const {
    const Vector3 way = b - a, start = a - centre;
    const double p = squared_norm(way), q = dot(way, start), root = std::sqrt(std::max(0.0, q * q - p * c));
    const double t = c < 0 ? (-q + root) / p : (-q - root) / p;
    return a + std::clamp(t, 0.0, 1.0) * way;
  }
};

// Those who meet in a corner share what is known of it.
struct GridPoint {
  Point3 place;
  double beyond = 0;  // squared, of the ball; the other two count where it is not negative
  Point3 on_ball;
  Vector3 outward;  // from the ball's centre to there
};

class PieceMaker {
 public:
  PieceMaker(const Projection& projection, const Compass& compass, BallPieces& out)
      : projection_(projection), compass_(compass), far_enough_(kFarEnough * squared_norm(projection.centre)), out_(out) {}

  void add(const std::array<Point3, 3>& corners) {
    if (std::all_of(corners.begin(), corners.end(), [&](const Point3& p) { return projection_.beyond(p) < 0; })) return;
    divide(corners);
    for (std::uint32_t row = 0; row < kParts; ++row) {
      const std::uint32_t above = row * (row + 1) / 2, below = above + row + 1;
      for (std::uint32_t k = 0; k <= row; ++k) {
        add_part({above + k, below + k, below + k + 1});
        if (k < row) add_part({above + k, below + k + 1, above + k + 1});
      }
    }
  }

 private:
  using Part = std::array<std::uint32_t, 3>;  // corners in the grid
  // Squared: at 1e-4 of the coordinates rounding is 1e-11 of the direction.
  static constexpr double kFarEnough = 1e-8;

  void divide(const std::array<Point3, 3>& corners) {
    const Vector3 along = corners[1] - corners[0], across = corners[2] - corners[0];
    first_ = static_cast<std::uint32_t>(out_.points.size());
    GridPoint* point = grid_.data();
    for (int row = 0; row <= kParts; ++row)
      for (int i = 0; i <= row; ++i, ++point) {
        const double a = static_cast<double>(row - i) / kParts, b = static_cast<double>(i) / kParts;
        point->place = corners[0] + a * along + b * across;
        point->beyond = projection_.beyond(point->place);
        if (point->beyond >= 0) {
          point->on_ball = projection_.on_ball(point->place);
          point->outward = point->on_ball - projection_.centre;
        }
        out_.points.push_back(point->on_ball);
      }
  }

  void add_part(const Part& part) {
    const GridPoint &a = grid_[part[0]], &b = grid_[part[1]], &c = grid_[part[2]];
    if (a.beyond >= 0 && b.beyond >= 0 && c.beyond >= 0) add_whole(part, a, b, c);
    else if (a.beyond >= 0 || b.beyond >= 0 || c.beyond >= 0) add_cut(part);
  }

  void add_whole(const Part& part, const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    const Vector3 doubled = cross(b.on_ball - a.on_ball, c.on_ball - a.on_ball);
    const double size = norm(doubled);
    if (!(size > 0)) return;
    auto facing = facing_about(a.outward + b.outward + c.outward);
    if (!facing) facing = facing_in_doubt(std::array{a.on_ball, b.on_ball, c.on_ball});
    if (!facing) return;
    const Vector3 normal = doubled / size;
    out_.area += 0.5 * size;
    out_.pieces.push_back({{first_ + part[0], first_ + part[1], first_ + part[2], 0},
                           3,
                           *facing,
                           normal,
                           std::max(0.0, 0.5 * dot(normal, doubled))});
  }

  // One corner or two lie within the ball.
  void add_cut(const Part& part) {
    std::array<Point3, 4> polygon;
    BallPiece piece;
    Vector3 outward;
    const auto new_points = static_cast<std::uint32_t>(out_.points.size());
    const auto add_corner = [&](const Point3& place, std::uint32_t index) {
      polygon[piece.count] = place;
      piece.corners[piece.count++] = index;
      outward += place - projection_.centre;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPoint &corner = grid_[part[i]], &next = grid_[part[i == 2 ? 0 : i + 1]];
      if (corner.beyond >= 0) add_corner(corner.on_ball, first_ + part[i]);
      if ((corner.beyond < 0) == (next.beyond < 0)) continue;
      const Point3 crossing = projection_.crossing(corner.place, next.place, corner.beyond);
      add_corner(crossing, static_cast<std::uint32_t>(out_.points.size()));
      out_.points.push_back(crossing);
    }
    const std::span<const Point3> corners = std::span(polygon).first(piece.count);
    if (!finish(corners, outward, piece)) out_.points.resize(new_points);
  }

  bool finish(std::span<const Point3> polygon, const Vector3& outward, BallPiece& piece) {
    Vector3 doubled;
    for (std::size_t c = 2; c < polygon.size(); ++c) doubled += cross(polygon[c - 1] - polygon[0], polygon[c] - polygon[0]);
    const double size = norm(doubled);
    if (!(size > 0)) return false;
    auto facing = facing_about(outward);
    if (!facing) facing = facing_in_doubt(polygon);
    if (!facing) return false;
    piece.facing = *facing;
    piece.flat_normal = doubled / size;
    double seen = 0;
    for (std::size_t c = 2; c < polygon.size(); ++c)
      seen += dot(piece.flat_normal, cross(polygon[c - 1] - polygon[0], polygon[c] - polygon[0]));
    piece.flat_area = std::max(0.0, 0.5 * seen);
    out_.area += 0.5 * size;
    out_.pieces.push_back(piece);
    return true;
  }

  // By comparing squares where these leave no doubt, without roots and divisions. `about`: from the ball's centre to the middle
  // of the piece, several times as long, to within rounding.
  std::optional<Facing> facing_about(const Vector3& about) const {
    const double squared = squared_norm(about), steepness = about.z * about.z - kSteep * kSteep * squared;
    constexpr double kDoubtful = 1e-8;
    if (!(squared > far_enough_)) return std::nullopt;
    if (steepness > kDoubtful * squared) return Facing{about.z > 0 ? Facing::Side::roof : Facing::Side::underside};
    if (!(steepness < -kDoubtful * squared)) return std::nullopt;
    const auto orientation = compass_.of_about(about);
    if (!orientation) return std::nullopt;
    return Facing{Facing::Side::facade, *orientation};
  }

  // By the direction itself; nothing where the middle is the ball's centre.
  std::optional<Facing> facing_in_doubt(std::span<const Point3> polygon) const {
    Point3 middle;
    for (const Point3& corner : polygon) middle += corner / static_cast<double>(polygon.size());
    const Vector3 outward = middle - projection_.centre;
    if (!(norm(outward) > 0)) return std::nullopt;
    return facing_of(outward / norm(outward), compass_);
  }

  const Projection projection_;
  const Compass& compass_;
  double far_enough_;
  BallPieces& out_;
  std::uint32_t first_ = 0;  // of the grid's points among all points
  std::array<GridPoint, (kParts + 1) * (kParts + 2) / 2> grid_;
};

}  // namespace

BallPieces ball_pieces(const Mesh& mesh, const Compass& compass) {
  const MeshWrap& wrap = *mesh.wrap;
  BallPieces out;
  out.pieces.reserve(mesh.triangles.size() * kParts * kParts);
  out.points.reserve(mesh.triangles.size() * (kParts + 1) * (kParts + 2) / 2);
  std::size_t t = 0;
  for (const MeshWrap::Part& part : wrap.parts) {
    PieceMaker maker({wrap.ball_centre, part.centre, wrap.radius * wrap.radius}, compass, out);
    for (std::uint32_t k = 0; k < part.triangles && t < mesh.triangles.size(); ++k, ++t) {
      const auto& triangle = mesh.triangles[t];
      maker.add({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]});
    }
  }
  return out;
}

}  // namespace bl::facade
