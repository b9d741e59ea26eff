// Lines of sight against coarse cells and their balls.
#include "ui/desktop/view/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bl::desktop {

namespace {

struct Span {
  double from, to;
};

std::optional<Span> through_ball(const Ray& ray, const Point3& centre, double radius) {
  const Vector3 to = ray.origin - centre;
  const double b = dot(to, ray.direction), c = squared_norm(to) - radius * radius, d = b * b - c;
  if (!(d >= 0)) return {};
  const double root = std::sqrt(d);
  if (-b + root < 0) return {};
  return Span{std::max(0.0, -b - root), -b + root};
}

// Where the line crosses the triangle, and in which direction: +1 into the body, -1 out of it, 0 not at all (Möller and Trumbore
// 1997). Most triangles are missed: nothing is divided before it is known that this one is not.
int crossing(const Ray& ray, const Point3& a, const Point3& b, const Point3& c, double& t) {
  const Vector3 u = b - a, v = c - a, from = ray.origin - a, across_v = cross(ray.direction, v);
  const double signed_size = dot(u, across_v), way = signed_size < 0 ? -1 : 1, size = way * signed_size;
  if (size == 0) return 0;
  constexpr double kRim = 1e-9;
  const double along_u = way * dot(from, across_v), least = -kRim * size, most = (1 + kRim) * size;
  if (!(along_u >= least && along_u <= most)) return 0;
  const Vector3 across_u = cross(from, u);
  const double along_v = way * dot(ray.direction, across_u);
  if (!(along_v >= least && along_u + along_v <= most)) return 0;
  t = dot(v, across_u) / signed_size;
  return way > 0 ? 1 : -1;
}

// Is all of it on the hidden side? Its shape is inside the ball and inside the cell.
bool is_cut_away(const Mesh& cell, const ViewSection& section) {
  if (!section.is_on) return false;
  if (dot(section.normal, cell.wrap->ball_centre) - cell.wrap->radius > section.offset) return true;
  return std::all_of(cell.vertices.begin(), cell.vertices.end(),
                     [&](const Point3& vertex) { return dot(section.normal, vertex) > section.offset; });
}

}  // namespace

std::optional<double> meet(const Ray& ray, const Mesh& cell, const ViewSection& section) {
  if (!cell.wrap) return {};
  auto span = through_ball(ray, cell.wrap->ball_centre, cell.wrap->radius);
  if (!span) return {};
  if (section.is_on) {
    const double across = dot(section.normal, ray.direction), above = dot(section.normal, ray.origin) - section.offset;
    if (across == 0 && above > 0) return {};
    if (across > 0) span->to = std::min(span->to, -above / across);
    if (across < 0) span->from = std::max(span->from, -above / across);
  }
  // Ways in and out of the cell, in order: the first stretch inside both the cell and the ball counts.
  std::vector<std::pair<double, int>> crossings;
  for (const auto& t : cell.triangles) {
    double at = 0;
    const int way = crossing(ray, cell.vertices[t[0]], cell.vertices[t[1]], cell.vertices[t[2]], at);
    if (way != 0 && std::isfinite(at)) crossings.emplace_back(at, way);
  }
  std::sort(crossings.begin(), crossings.end());
  double entered = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [at, way] : crossings) {
    if (way > 0) {
      if (std::isnan(entered)) entered = at;
      continue;
    }
    const double from = std::max(entered, span->from), to = std::min(at, span->to);
    if (from <= to) return from;
    entered = std::numeric_limits<double>::quiet_NaN();
  }
  return {};
}

namespace {

// A ball that the line of sight goes through, and where it goes in.
struct BallOnTheWay {
  double from = 0;
  std::size_t row = 0;
  auto operator<=>(const BallOnTheWay&) const = default;
};

std::vector<BallOnTheWay> balls_on_the_way(const Ray& ray, const SightBalls& balls) {
  std::vector<BallOnTheWay> found;
  for (const std::uint32_t k : balls.rows_along(ray)) {
    const Vector3 to = ray.origin - Point3{balls.x[k], balls.y[k], balls.z[k]};
    const double along = dot(to, ray.direction), inside = along * along - (squared_norm(to) - balls.squared_radius[k]);
    if (!(inside >= 0) || balls.squared_radius[k] < 0) continue;
    const double root = std::sqrt(inside);
    if (-along + root >= 0) found.push_back({std::max(0.0, -along - root), k});
  }
  return found;
}

// Of two at one place the first one of the list is met.
bool is_nearer(double at, std::uint32_t node, double other_at, std::uint32_t other) {
  return at < other_at || (at == other_at && node < other);
}

}  // namespace

std::optional<Hit> pick(const Ray& ray, const SceneFacts& facts, const ViewSection& section, bool with_bodies) {
  std::optional<Hit> nearest;
  const auto take = [&](std::uint32_t node, const Mesh& cell) {
    const auto at = meet(ray, cell, section);
    if (at && (!nearest || is_nearer(*at, node, nearest->distance, nearest->node)))
      nearest = Hit{node, *at, ray.origin + *at * ray.direction};
  };
  std::vector<BallOnTheWay> balls = balls_on_the_way(ray, facts.balls);
  std::sort(balls.begin(), balls.end());
  for (const BallOnTheWay& ball : balls) {
    if (nearest && ball.from > nearest->distance) break;
    take(facts.volumes[ball.row].node, *facts.volumes[ball.row].cell);
  }
  for (const CellarFacts& cellar : facts.cellars)
    if (cellar.cell) take(cellar.node, *cellar.cell);
  for (const BodyFacts& body : facts.urban.bodies)
    if (with_bodies) take(body.node, *body.cell);
  return nearest;
}

bool is_met_first(const Ray& ray, const VolumeFacts& volume, const SceneFacts& facts, const ViewSection& section,
                  bool with_bodies) {
  if (!volume.cell) return false;
  const auto at = meet(ray, *volume.cell, section);
  if (!at) return false;
  const auto is_before = [&](std::uint32_t node, const Mesh& cell) {
    const auto other = meet(ray, cell, section);
    return other && is_nearer(*other, node, *at, volume.node);
  };
  for (const BallOnTheWay& ball : balls_on_the_way(ray, facts.balls)) {
    const VolumeFacts& other = facts.volumes[ball.row];
    if (ball.from <= *at && other.node != volume.node && is_before(other.node, *other.cell)) return false;
  }
  return !with_bodies ||
         std::ranges::none_of(facts.urban.bodies, [&](const BodyFacts& body) { return is_before(body.node, *body.cell); });
}

std::vector<std::uint32_t> pick_box(const Box& box, bool touches, const SceneFacts& facts, const Sight& sight) {
  std::vector<std::uint32_t> found;
  const auto take = [&](std::uint32_t node, const Point3& centre, double radius) {
    const Seen seen = sight.camera.project(centre, sight.width, sight.height);
    if (!seen.is_in_front) return;
    const double reach = radius / std::max(1e-9, sight.camera.metres_per_pixel(centre, sight.height));
    const double x = std::clamp(seen.x, box.left, box.right), y = std::clamp(seen.y, box.top, box.bottom);
    const bool is_touched = std::hypot(seen.x - x, seen.y - y) <= reach;
    const bool is_held = box.holds(seen.x - reach, seen.y - reach) && box.holds(seen.x + reach, seen.y + reach);
    if (touches ? is_touched : is_held) found.push_back(node);
  };
  for (const VolumeFacts& volume : facts.volumes) {
    if (!volume.cell) {
      take(volume.node, volume.figures.position, 0);
      continue;
    }
    if (is_cut_away(*volume.cell, sight.section)) continue;
    // The shape is inside both the ball and the cell's own extent: the smaller of the two speaks for it.
    const Point3& centre = volume.cell->wrap->ball_centre;
    double far = 0;
    for (const Point3& vertex : volume.cell->vertices) far = std::max(far, distance(vertex, centre));
    take(volume.node, centre, 0.9 * std::min(far, volume.cell->wrap->radius));
  }
  if (sight.with_marks)
    for (const MarkFacts& mark : facts.marks) take(mark.node, mark.position, 0);
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<Point3> nearest_on_axis(const Ray& ray, const Point3& through, const Vector3& axis) {
  const Vector3 between = through - ray.origin;
  const double aa = squared_norm(axis), ad = dot(axis, ray.direction), across = aa - ad * ad;
  if (!(across > 1e-6 * aa)) return {};
  const double t = (ad * dot(between, ray.direction) - dot(between, axis)) / across;
  return through + t * axis;
}

std::optional<Point3> meet_plane(const Ray& ray, const Point3& through, const Vector3& normal) {
  const double across = dot(normal, ray.direction);
  if (std::abs(across) < 1e-6) return {};
  const double t = dot(normal, through - ray.origin) / across;
  if (!(t > 0) || !std::isfinite(t)) return {};
  return ray.origin + t * ray.direction;
}

}  // namespace bl::desktop
