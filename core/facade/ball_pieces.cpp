// The corners of a triangle's parts are moved onto the ball once, although up to six parts meet in each.
#include "core/facade/ball_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/facade/vector_pair.h"

namespace bl::facade {

namespace {

// Rows of small triangles in each coarse one: the area comes out within some parts in a thousand before scaling.
constexpr int kParts = 6;

// Vectors by coordinate.
template <std::size_t kCount>
struct Vectors {
  std::array<double, kCount> x{}, y{}, z{};

  Vector3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  VectorPair from(std::size_t i) const { return {pair_at(&x[i]), pair_at(&y[i]), pair_at(&z[i])}; }
  void put(std::size_t i, const VectorPair& pair) {
    put_pair(&x[i], pair.x);
    put_pair(&y[i], pair.y);
    put_pair(&z[i], pair.z);
  }
};

// What of a small triangle lies beyond the ball, moved onto it: as make_mesh does it.
struct Projection {
  Point3 centre, from;  // of the ball, and what vertices move towards
  double squared = 0;

  double beyond(const Point3& p) const { return squared_norm(p - centre) - squared; }
  Pair beyond(const VectorPair& p) const {
    const VectorPair way = p - both(centre);
    return dot(way, way) - Pair{squared, squared};
  }
  VectorPair on_ball(const VectorPair& p) const {
    const Vector3 start = from - centre;
    const double room = std::max(0.0, squared - squared_norm(start));
    const VectorPair way = p - both(from);
    const Pair rest{room, room}, one{1, 1}, zero{}, a = dot(way, way), b = dot(way, both(start)),
                                                    root = root_of(b * b + a * rest);
    const Pair t = (b > zero ? rest : root - b) / (b > zero ? b + root : a);
    return both(from) + (t < one ? t : one) * way;
  }
  // Where the ball's surface crosses an edge with one end on each side; `c` is how far `a` lies beyond it.
  Point3 crossing(const Point3& a, const Point3& b, double c) const {
    const Vector3 way = b - a, start = a - centre;
    const double p = squared_norm(way), q = dot(way, start), root = std::sqrt(std::max(0.0, q * q - p * c));
    const double t = c < 0 ? (-q + root) / p : (-q - root) / p;
    return a + std::clamp(t, 0.0, 1.0) * way;
  }
};

// The points of a divided triangle, row by row; those who meet in one share what is known of it. Pairs may reach beyond the end.
constexpr std::uint32_t kPoints = (kParts + 1) * (kParts + 2) / 2, kRoom = kPoints + 2;

struct Grid {
  Vectors<kRoom> places;
  std::array<double, kRoom> beyond{};  // squared, of the ball; the other two count where it is not negative
  Vectors<kRoom> on_ball;
  Vectors<kRoom> outward;  // from the ball's centre to there
};

// How much of each side of the triangle leads to a point.
struct Shares {
  std::array<double, kRoom> along{}, across{};
  Shares() {
    for (int row = 0, k = 0; row <= kParts; ++row)
      for (int i = 0; i <= row; ++i, ++k) {
        along[static_cast<std::size_t>(k)] = static_cast<double>(row - i) / kParts;
        across[static_cast<std::size_t>(k)] = static_cast<double>(i) / kParts;
      }
  }
};

// The small triangles of one row that stand on it, or of those that hang from it, as if all their corners were on the ball.
struct RowOfParts {
  static constexpr std::size_t kMost = kParts + 2;
  Vectors<kMost> normals, outward;
  std::array<double, kMost> sizes{}, areas{};

  void measure(const Grid& grid, std::size_t count, const std::array<std::uint32_t, 3>& corners) {
    for (std::size_t k = 0; k < count; k += 2) {
      const std::size_t i = corners[0] + k, j = corners[1] + k, l = corners[2] + k;
      const VectorPair a = grid.on_ball.from(i), doubled = cross(grid.on_ball.from(j) - a, grid.on_ball.from(l) - a);
      const Pair size = root_of(dot(doubled, doubled)), half{0.5, 0.5}, zero{};
      const VectorPair normal = doubled / size;
      const Pair area = half * dot(normal, doubled);
      normals.put(k, normal);
      outward.put(k, grid.outward.from(i) + grid.outward.from(j) + grid.outward.from(l));
      put_pair(&sizes[k], size);
      put_pair(&areas[k], zero < area ? area : zero);
    }
  }
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
      standing_.measure(grid_, row + 1, {above, below, below + 1});
      hanging_.measure(grid_, row, {above, below + 1, above + 1});
      for (std::uint32_t k = 0; k <= row; ++k) {
        add_part({above + k, below + k, below + k + 1}, standing_, k);
        if (k < row) add_part({above + k, below + k + 1, above + k + 1}, hanging_, k);
      }
    }
  }

 private:
  using Part = std::array<std::uint32_t, 3>;  // corners in the grid
  // Squared: at 1e-4 of the coordinates rounding is 1e-11 of the direction.
  static constexpr double kFarEnough = 1e-8;

  void divide(const std::array<Point3, 3>& corners) {
    static const Shares shares;
    const VectorPair origin = both(corners[0]), along = both(corners[1] - corners[0]), across = both(corners[2] - corners[0]);
    for (std::size_t k = 0; k < kPoints; k += 2) {
      const VectorPair place = origin + pair_at(&shares.along[k]) * along + pair_at(&shares.across[k]) * across;
      const VectorPair on_ball = projection_.on_ball(place);
      grid_.places.put(k, place);
      put_pair(&grid_.beyond[k], projection_.beyond(place));
      grid_.on_ball.put(k, on_ball);
      grid_.outward.put(k, on_ball - both(projection_.centre));
    }
    first_ = static_cast<std::uint32_t>(out_.points.size());
    for (std::size_t k = 0; k < kPoints; ++k) out_.points.push_back(grid_.on_ball[k]);
  }

  bool is_out(std::uint32_t point) const { return grid_.beyond[point] >= 0; }

  void add_part(const Part& part, const RowOfParts& row, std::size_t k) {
    const bool a = is_out(part[0]), b = is_out(part[1]), c = is_out(part[2]);
    if (a && b && c) add_whole(part, row, k);
    else if (a || b || c) add_cut(part);
  }

  void add_whole(const Part& part, const RowOfParts& row, std::size_t k) {
    if (!(row.sizes[k] > 0)) return;
    auto facing = facing_about(row.outward[k]);
    if (!facing) facing = facing_in_doubt(std::array{grid_.on_ball[part[0]], grid_.on_ball[part[1]], grid_.on_ball[part[2]]});
    if (!facing) return;
    out_.area += 0.5 * row.sizes[k];
    out_.pieces.push_back({{first_ + part[0], first_ + part[1], first_ + part[2], 0}, 3, *facing, row.normals[k], row.areas[k]});
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
      const std::uint32_t corner = part[i], next = part[i == 2 ? 0 : i + 1];
      if (is_out(corner)) add_corner(grid_.on_ball[corner], first_ + corner);
      if ((grid_.beyond[corner] < 0) == (grid_.beyond[next] < 0)) continue;
      const Point3 crossing = projection_.crossing(grid_.places[corner], grid_.places[next], grid_.beyond[corner]);
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

  Projection projection_;
  const Compass& compass_;
  double far_enough_;
  BallPieces& out_;
  std::uint32_t first_ = 0;  // of the grid's points among all points
  Grid grid_;
  RowOfParts standing_, hanging_;
};

}  // namespace

void find_ball_pieces(const Mesh& mesh, const Compass& compass, BallPieces& out) {
  const MeshWrap& wrap = *mesh.wrap;
  out.points.clear();
  out.pieces.clear();
  out.area = 0;
  out.pieces.reserve(mesh.triangles.size() * kParts * kParts);
  out.points.reserve(mesh.triangles.size() * kPoints);
  std::size_t t = 0;
  for (const MeshWrap::Part& part : wrap.parts) {
    PieceMaker maker({wrap.ball_centre, part.centre, wrap.radius * wrap.radius}, compass, out);
    for (std::uint32_t k = 0; k < part.triangles && t < mesh.triangles.size(); ++k, ++t) {
      const auto& triangle = mesh.triangles[t];
      maker.add({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]});
    }
  }
}

}  // namespace bl::facade
