// Cleans and judges the rings of plans; one set of checks for convex and other plans.
#include "core/geometry/inside/plan_corners.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/geometry/inside/domain_parts.h"
#include "core/geometry/plan_ring.h"

namespace bl::geometry {

namespace {

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

// Without repeated corners and without corners on a straight line between their neighbours.
std::vector<PlanCorner> simplified(std::span<const Point3> plan, double tolerance) {
  std::vector<PlanCorner> corners;
  const auto is_same = [&](const PlanCorner& a, const PlanCorner& b) { return length_of(a.x - b.x, a.y - b.y) <= tolerance; };
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const PlanCorner corner{plan[i].x + 0.0, plan[i].y + 0.0, i};
    if (corners.empty() || !is_same(corners.back(), corner)) corners.push_back(corner);
  }
  while (corners.size() > 1 && is_same(corners.front(), corners.back())) corners.pop_back();
  for (std::size_t i = 0; corners.size() > 3 && i < corners.size();) {
    const std::size_t n = corners.size();
    const PlanCorner &before = corners[(i + n - 1) % n], &at = corners[i], &after = corners[(i + 1) % n];
    const double length = length_of(after.x - before.x, after.y - before.y);
    const double along = (at.x - before.x) * (after.x - before.x) + (at.y - before.y) * (after.y - before.y);
    const bool between = along > 0 && along < length * length;
    if (between && std::abs(turn(before, at, after)) <= tolerance * length) {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  return corners;
}

double doubled_area(const std::vector<PlanCorner>& plan) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < plan.size(); ++i) sum += turn(plan[0], plan[i], plan[i + 1]);
  return sum;
}

// Where the ring meets itself, as a sentence; empty where it does not.
std::string crossing_text(const std::vector<PlanCorner>& corners, const std::string& what) {
  Ring ring;
  for (const PlanCorner& corner : corners) ring.push_back({corner.x, corner.y, 0});
  const auto crossing = find_self_crossing(ring);
  if (!crossing) return {};
  return "the " + what + " crosses itself: side " + std::to_string(corners[crossing->first_edge].given) + " and side " +
         std::to_string(corners[crossing->second_edge].given) + " meet at " + place_of(crossing->where.x, crossing->where.y);
}

}  // namespace

std::string place_of(double x, double y) { return std::string("(") + fixed(x, 3) + ", " + fixed(y, 3) + ")"; }

Result<std::vector<PlanCorner>> plan_corners(std::span<const Point3> ring, const std::string& what, Turning turning) {
  std::vector<Point3> flat;
  for (const Point3& p : ring) flat.push_back({p.x, p.y, 0});
  if (auto checked = check_points(flat, what.starts_with("plan") ? "plan corner" : what + " corner"); !checked)
    return checked.error();
  double extent = 0;
  for (const Point3& p : flat) extent = std::max(extent, distance(p, flat.front()));
  const std::vector<PlanCorner> all = simplified(flat, 0);
  if (all.size() < 3) {
    return Error{ErrorCode::geometry, "",
                 "a " + what + " needs at least 3 corners at different places, " + std::to_string(all.size()) + " found"};
  }
  std::vector<PlanCorner> corners = simplified(flat, 1e-12 * extent);
  const double doubled = doubled_area(corners);
  const bool is_line = std::all_of(corners.begin(), corners.end(), [&](const PlanCorner& c) {
    return std::abs(turn(corners[0], corners[1], c)) <= 1e-12 * extent * extent;
  });
  // A self-crossing ring may have no signed area (a figure of eight), so crossings are looked for first; a ring without any
  // extent meets itself everywhere, and that is not what is wrong with it.
  if (!is_line) {
    if (const std::string crossing = crossing_text(corners, what); !crossing.empty())
      return Error{ErrorCode::geometry, "", crossing};
  }
  if (corners.size() < 3 || !(std::abs(doubled) > 1e-12 * extent * extent))
    return Error{ErrorCode::geometry, "", "the " + what + " has no area: its corners lie on one line"};
  if ((doubled < 0) == (turning == Turning::counter_clockwise)) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

std::size_t first_reflex(const std::vector<PlanCorner>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]) <= 0) return i;
  return n;
}

Result<void> check_heights(double bottom, double top) {
  if (!std::isfinite(bottom) || !std::isfinite(top))
    return Error{ErrorCode::not_finite, "", "a height of the boundary is not a number"};
  if (!(top > bottom)) {
    return Error{ErrorCode::geometry, "",
                 "the top of the boundary (" + shortest(top) + " m) has to lie above its bottom (" + shortest(bottom) + " m)"};
  }
  if (std::max(std::abs(top), std::abs(bottom)) > kLargestCoordinate)
    return Error{ErrorCode::out_of_range, "", "the heights of the boundary lie beyond 1e8 m"};
  return {};
}

ConvexDomain prism(const std::vector<PlanCorner>& plan, double bottom, double top) {
  const std::uint32_t n = static_cast<std::uint32_t>(plan.size());
  ConvexDomain domain;
  domain.planes = {{{0, 0, -1}, -bottom}, {{0, 0, 1}, top}};
  domain.faces.resize(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    domain.faces[0].push_back(n - 1 - i);
    domain.faces[1].push_back(n + i);
    domain.vertices.push_back({plan[i].x, plan[i].y, bottom});
  }
  for (std::uint32_t i = 0; i < n; ++i) domain.vertices.push_back({plan[i].x, plan[i].y, top});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const double dx = plan[j].x - plan[i].x, dy = plan[j].y - plan[i].y, length = length_of(dx, dy);
    const Vector3 normal = Vector3{dy / length, -dx / length, 0} + Vector3{};
    domain.planes.push_back({normal, dot(normal, domain.vertices[i])});
    domain.faces.push_back({i, j, n + j, n + i});
  }
  return domain;
}

}  // namespace bl::geometry
