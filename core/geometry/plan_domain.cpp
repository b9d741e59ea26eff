// A convex domain from a plan polygon and two heights.
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/text.h"
#include "core/geometry/domain_parts.h"

namespace bl {

namespace {

struct Corner {
  double x, y;
  std::size_t given;  // index in the plan as given, for messages
};

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

double turn(const Corner& a, const Corner& b, const Corner& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

std::string place_of(double x, double y) { return std::string("(") + fixed(x, 3) + ", " + fixed(y, 3) + ")"; }

// The first two sides that cross, as a sentence; empty where none do.
std::string crossing_sides(const std::vector<Corner>& plan) {
  const std::size_t n = plan.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours around the end
      const Corner &a = plan[i], &b = plan[(i + 1) % n], &c = plan[j], &d = plan[(j + 1) % n];
      const double from = turn(c, d, a), to = turn(c, d, b);
      if (!((turn(a, b, c) > 0) != (turn(a, b, d) > 0) && (from > 0) != (to > 0))) continue;
      const double share = from / (from - to);
      return "the plan polygon crosses itself: side " + std::to_string(a.given) + " and side " + std::to_string(c.given) +
             " meet at " + place_of(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y));
    }
  }
  return {};
}

// Without repeated corners and without corners on a straight line between their neighbours.
std::vector<Corner> simplified(std::span<const Point3> plan, double tolerance) {
  std::vector<Corner> corners;
  const auto is_same = [&](const Corner& a, const Corner& b) { return length_of(a.x - b.x, a.y - b.y) <= tolerance; };
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Corner corner{plan[i].x + 0.0, plan[i].y + 0.0, i};
    if (corners.empty() || !is_same(corners.back(), corner)) corners.push_back(corner);
  }
  while (corners.size() > 1 && is_same(corners.front(), corners.back())) corners.pop_back();
  for (std::size_t i = 0; corners.size() > 3 && i < corners.size();) {
    const std::size_t n = corners.size();
    const Corner &before = corners[(i + n - 1) % n], &at = corners[i], &after = corners[(i + 1) % n];
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

double doubled_area(const std::vector<Corner>& plan) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < plan.size(); ++i) sum += turn(plan[0], plan[i], plan[i + 1]);
  return sum;
}

ConvexDomain prism(const std::vector<Corner>& plan, double bottom, double top) {
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

}  // namespace

Result<ConvexDomain> extrude(std::span<const Point3> plan, double bottom, double top) {
  if (!std::isfinite(bottom) || !std::isfinite(top))
    return Error{ErrorCode::not_finite, "", "a height of the boundary is not a number"};
  if (!(top > bottom)) {
    return Error{ErrorCode::geometry, "",
                 "the top of the boundary (" + shortest(top) + " m) has to lie above its bottom (" + shortest(bottom) + " m)"};
  }
  if (std::max(std::abs(top), std::abs(bottom)) > kLargestCoordinate) {
    return Error{ErrorCode::out_of_range, "", "the heights of the boundary lie beyond 1e8 m"};
  }
  std::vector<Point3> flat;
  for (const Point3& p : plan) flat.push_back({p.x, p.y, 0});
  if (auto checked = check_points(flat, "plan corner"); !checked) return checked.error();
  double extent = 0;
  for (const Point3& p : flat) extent = std::max(extent, distance(p, flat.front()));
  const std::vector<Corner> all = simplified(flat, 0);
  if (all.size() < 3) {
    return Error{ErrorCode::geometry, "",
                 "a plan polygon needs at least 3 corners at different places, " + std::to_string(all.size()) + " found"};
  }
  std::vector<Corner> corners = simplified(flat, 1e-12 * extent);
  const double doubled = doubled_area(corners);
  // A self-crossing plan may have no signed area (a figure of eight), so crossings are looked for first.
  if (const std::string crossing = crossing_sides(corners); !crossing.empty()) return Error{ErrorCode::geometry, "", crossing};
  if (corners.size() < 3 || !(std::abs(doubled) > 1e-12 * extent * extent)) {
    return Error{ErrorCode::geometry, "", "the plan polygon has no area: its corners lie on one line"};
  }
  if (doubled < 0) std::reverse(corners.begin() + 1, corners.end());
  for (std::size_t i = 0, n = corners.size(); i < n; ++i) {
    const Corner& corner = corners[i];
    if (turn(corners[(i + n - 1) % n], corner, corners[(i + 1) % n]) <= 0) {
      return Error{ErrorCode::geometry, "",
                   "the plan polygon is not convex (corner " + std::to_string(corner.given) + " at " +
                       place_of(corner.x, corner.y) +
                       "); non-convex plans come with exact boundaries later: use the hull or simplify"};
    }
  }
  return finish_domain(prism(corners, bottom, top));
}

}  // namespace bl
