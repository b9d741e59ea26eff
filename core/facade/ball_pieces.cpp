// The corners of a triangle's parts are moved onto the ball once, although up to six parts meet in each.
#include "core/facade/ball_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

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

struct GridPoint {
  Point3 place;
  double beyond = 0;
  bool is_moved = false;
  Point3 on_ball;
};

class PieceMaker {
 public:
  PieceMaker(const Projection& projection, BallPieces& out) : projection_(projection), out_(out) {}

  void add(const std::array<Point3, 3>& corners) {
    if (std::all_of(corners.begin(), corners.end(), [&](const Point3& p) { return projection_.beyond(p) < 0; })) return;
    for (int row = 0; row <= kParts; ++row)
      for (int i = 0; i <= row; ++i) {
        const double a = static_cast<double>(row - i) / kParts, b = static_cast<double>(i) / kParts;
        GridPoint& point = at(row, i);
        point.place = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
        point.beyond = projection_.beyond(point.place);
        point.is_moved = false;
      }
    for (int row = 0; row < kParts; ++row)
      for (int k = 0; k <= row; ++k) {
        add_part({&at(row, k), &at(row + 1, k), &at(row + 1, k + 1)});
        if (k < row) add_part({&at(row, k), &at(row + 1, k + 1), &at(row, k + 1)});
      }
  }

 private:
  GridPoint& at(int row, int i) { return grid_[static_cast<std::size_t>(row * (row + 1) / 2 + i)]; }

  const Point3& moved(GridPoint& point) const {
    if (!point.is_moved) point.on_ball = projection_.on_ball(point.place);
    point.is_moved = true;
    return point.on_ball;
  }

  void add_part(const std::array<GridPoint*, 3>& part) {
    const bool is_out[3] = {part[0]->beyond >= 0, part[1]->beyond >= 0, part[2]->beyond >= 0};
    if (is_out[0] && is_out[1] && is_out[2]) return add_whole(moved(*part[0]), moved(*part[1]), moved(*part[2]));
    std::array<Point3, 6> polygon;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = i == 2 ? 0 : i + 1;
      const bool is_in = part[i]->beyond < 0;
      if (is_out[i]) polygon[count++] = moved(*part[i]);
      if (is_in != (part[next]->beyond < 0))
        polygon[count++] = projection_.crossing(part[i]->place, part[next]->place, part[i]->beyond);
    }
    if (count < 3) return;
    Vector3 doubled;
    for (std::size_t c = 2; c < count; ++c) doubled += cross(polygon[c - 1] - polygon[0], polygon[c] - polygon[0]);
    if (BallPiece* piece = keep(std::span(polygon).first(count), doubled))
      piece->flat_area = std::max(0.0, 0.5 * doubled_area(out_.of(*piece), piece->flat_normal));
  }

  void add_whole(const Point3& a, const Point3& b, const Point3& c) {
    const std::array<Point3, 3> polygon{a, b, c};
    const Vector3 doubled = cross(b - a, c - a);
    if (BallPiece* piece = keep(polygon, doubled)) piece->flat_area = std::max(0.0, 0.5 * dot(piece->flat_normal, doubled));
  }

  BallPiece* keep(std::span<const Point3> polygon, const Vector3& doubled) {
    const double size = norm(doubled);
    if (!(size > 0)) return nullptr;
    const Vector3 about = about_outward(polygon);
    if (about == Vector3{} && !(norm(out_.outward(polygon)) > 0)) return nullptr;
    const auto first = static_cast<std::uint32_t>(out_.corners.size());
    out_.corners.insert(out_.corners.end(), polygon.begin(), polygon.end());
    out_.area += 0.5 * size;
    return &out_.pieces.emplace_back(BallPiece{first, static_cast<std::uint32_t>(polygon.size()), doubled / size, about, 0});
  }

  Vector3 about_outward(std::span<const Point3> polygon) const {
    Vector3 sum;
    for (const Point3& corner : polygon) sum += corner - out_.centre;
    constexpr double kFarEnough = 1e-8;  // squared: at 1e-4 of the coordinates rounding is 1e-11 of the direction
    return squared_norm(sum) > kFarEnough * squared_norm(out_.centre) ? sum : Vector3{};
  }

  Projection projection_;
  BallPieces& out_;
  std::array<GridPoint, (kParts + 1) * (kParts + 2) / 2> grid_;
};

}  // namespace

Vector3 BallPieces::outward(std::span<const Point3> polygon) const {
  Point3 middle;
  for (const Point3& corner : polygon) middle += corner / static_cast<double>(polygon.size());
  return middle - centre;
}

BallPieces ball_pieces(const Mesh& mesh) {
  const MeshWrap& wrap = *mesh.wrap;
  BallPieces out;
  out.centre = wrap.ball_centre;
  out.pieces.reserve(mesh.triangles.size() * kParts * kParts);
  out.corners.reserve(3 * mesh.triangles.size() * kParts * kParts);
  std::size_t t = 0;
  for (const MeshWrap::Part& part : wrap.parts) {
    PieceMaker maker({wrap.ball_centre, part.centre, wrap.radius * wrap.radius}, out);
    for (std::uint32_t k = 0; k < part.triangles && t < mesh.triangles.size(); ++k, ++t) {
      const auto& triangle = mesh.triangles[t];
      maker.add({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]});
    }
  }
  return out;
}

}  // namespace bl::facade
