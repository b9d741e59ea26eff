// Each end of a curve gets a place of its own on the side of its body that faces the other end.
#include "ui/desktop/panels/canvas/link_paths.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace bl::desktop::canvas {

namespace {

constexpr float kSpacing = 17, kUsableSide = 0.8f, kLeastBend = 18, kMostBend = 150, kBend = 0.45f, kAcross = 0.1f;
constexpr int kSteps = 24;

enum Side { right, left, below, above };
const std::array<ImVec2, 4> kNormals = {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)};

// The side of a body that looks at a point.
Side side_towards(const Box& body, ImVec2 point) {
  const ImVec2 way = point - body.centre();
  const bool is_across = std::abs(way.x) * body.size.y > std::abs(way.y) * body.size.x;
  if (is_across) return way.x > 0 ? right : left;
  return way.y > 0 ? below : above;
}

// The side that an end at a body leaves from. Boxes that overlap in their height are joined across, whatever their middles say.
Side side_of(const Box& body, const Box& other) {
  if (other.at.x > body.high().x + 24) return right;
  if (other.high().x < body.at.x - 24) return left;
  return side_towards(body, other.centre());
}

struct RouteEnd {
  std::size_t route = 0, body = 0;
  int end = 0;
  Side side = right;
  float order = 0;  // along the side
  ImVec2 at;
};

bool is_loop(const Route& route) { return route.from == route.to && route.dots.empty(); }

std::vector<RouteEnd> mouths_of(const std::vector<Box>& bodies, const std::vector<Route>& routes) {
  std::vector<RouteEnd> mouths;
  for (std::size_t r = 0; r < routes.size(); ++r) {
    const Route& route = routes[r];
    for (int end = 0; end < 2; ++end) {
      const std::size_t body = end == 0 ? route.from : route.to, other = end == 0 ? route.to : route.from;
      RouteEnd mouth{r, body, end, right, 0, {}};
      ImVec2 towards = bodies[other].centre();
      if (!route.dots.empty()) towards = end == 0 ? route.dots.front() : route.dots.back();
      mouth.side = route.dots.empty() ? side_of(bodies[body], bodies[other]) : side_towards(bodies[body], towards);
      const bool is_upright = mouth.side == right || mouth.side == left;
      mouth.order = is_upright ? towards.y : towards.x;
      mouths.push_back(mouth);
    }
  }
  return mouths;
}

// Spreads the mouths of each side along it, in the order of what they lead to.
void spread(const std::vector<Box>& bodies, const std::vector<Route>& routes, std::vector<RouteEnd>& mouths) {
  std::vector<std::size_t> order(mouths.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const RouteEnd &x = mouths[a], &y = mouths[b];
    return std::tie(x.body, x.side, x.order, x.route, x.end) < std::tie(y.body, y.side, y.order, y.route, y.end);
  });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    const RouteEnd& first = mouths[order[begin]];
    if (is_loop(routes[first.route])) {  // have a place of their own
      ++begin;
      continue;
    }
    while (end < order.size() && mouths[order[end]].body == first.body && mouths[order[end]].side == first.side &&
           !is_loop(routes[mouths[order[end]].route]))
      ++end;
    const Box& body = bodies[first.body];
    const bool is_upright = first.side == right || first.side == left;
    const float room = (is_upright ? body.size.y : body.size.x) * kUsableSide;
    const float spacing = std::min(kSpacing, room / static_cast<float>(end - begin));
    for (std::size_t k = begin; k < end; ++k) {
      RouteEnd& mouth = mouths[order[k]];
      const float shift = (static_cast<float>(k - begin) - static_cast<float>(end - begin - 1) / 2) * spacing;
      const ImVec2 normal = kNormals[mouth.side];
      const ImVec2 middle = body.centre() + ImVec2(normal.x * body.size.x / 2, normal.y * body.size.y / 2);
      mouth.at = middle + (is_upright ? ImVec2(0, shift) : ImVec2(shift, 0));
    }
    begin = end;
  }
}

void add_bezier(std::vector<ImVec2>& points, ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d) {
  if (points.empty()) points.push_back(a);
  for (int step = 1; step <= kSteps; ++step) {
    const float t = static_cast<float>(step) / kSteps, s = 1 - t;
    points.push_back(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
  }
}

// A curve swings out as far as its ends lie apart along the way that it leaves, and only a little for what lies across.
float bend_for(ImVec2 a, ImVec2 b, ImVec2 way) {
  const ImVec2 apart = b - a;
  return std::clamp(kBend * std::abs(dot(apart, way)) + kAcross * std::abs(cross(apart, way)), kLeastBend, kMostBend);
}

std::vector<ImVec2> curve(ImVec2 begin, ImVec2 begin_normal, ImVec2 end, ImVec2 end_normal, const std::vector<ImVec2>& dots) {
  std::vector<ImVec2> points;
  ImVec2 from = begin, tangent = begin_normal;
  for (std::size_t k = 0; k <= dots.size(); ++k) {
    const bool is_last = k == dots.size();
    const ImVec2 to = is_last ? end : dots[k];
    // At a dot the curve runs as from the place before it to the place after it.
    const ImVec2 after = is_last ? end : k + 1 == dots.size() ? end : dots[k + 1];
    const ImVec2 arrival = is_last ? end_normal * -1 : unit_vector(after - from);
    add_bezier(points, from, from + tangent * bend_for(from, to, tangent), to - arrival * bend_for(from, to, arrival), to);
    from = to;
    tangent = arrival;
  }
  return points;
}

// Around the upper right corner, the later ones outside.
std::vector<ImVec2> loop(const Box& body, std::size_t number) {
  const float out = static_cast<float>(number);
  const ImVec2 corner{body.high().x, body.at.y};
  const ImVec2 begin = corner + ImVec2(-std::min(22 + 20 * out, 0.8f * body.size.x), 0);
  const ImVec2 end = corner + ImVec2(0, std::min(9 + 6 * out, 0.8f * body.size.y));
  const float reach = 44 + 24 * out;
  std::vector<ImVec2> points;
  add_bezier(points, begin, begin + ImVec2(-0.2f * reach, -reach * 1.35f), end + ImVec2(reach * 1.7f, -0.4f * reach), end);
  return points;
}

}  // namespace

std::vector<std::vector<ImVec2>> trace(const std::vector<Box>& bodies, const std::vector<Route>& routes) {
  std::vector<RouteEnd> mouths = mouths_of(bodies, routes);
  spread(bodies, routes, mouths);
  std::vector<std::vector<ImVec2>> curves;
  std::map<std::size_t, std::size_t> loops;
  curves.reserve(routes.size());
  for (std::size_t r = 0; r < routes.size(); ++r) {
    const RouteEnd &begin = mouths[2 * r], &end = mouths[2 * r + 1];
    curves.push_back(is_loop(routes[r]) ? loop(bodies[begin.body], loops[begin.body]++)
                                        : curve(begin.at, kNormals[begin.side], end.at, kNormals[end.side], routes[r].dots));
  }
  return curves;
}

std::vector<ImVec2> trace_to_point(const Box& from, ImVec2 to) {
  const Side side = side_towards(from, to);
  const ImVec2 normal = kNormals[side];
  const ImVec2 begin = from.centre() + ImVec2(normal.x * from.size.x / 2, normal.y * from.size.y / 2);
  std::vector<ImVec2> points;
  const float bend = bend_for(begin, to, normal);
  add_bezier(points, begin, begin + normal * bend, to - unit_vector(to - begin) * (bend / 2), to);
  return points;
}

}  // namespace bl::desktop::canvas
