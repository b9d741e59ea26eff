// The polygon is cut into trapezoids with horizontal sides; a sample picks one by area and a place in it by its width.
#include "core/making/prism_samples.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace bl::making {

namespace {

// Between the heights y0 and y1, from the left side to the right one; the sides are straight.
struct Trapezoid {
  double y0, y1, left0, left1, right0, right1;
  double area() const { return (y1 - y0) * ((right0 - left0) + (right1 - left1)) / 2; }
};

double x_at(const Point3& a, const Point3& b, double y) { return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x); }

std::vector<Trapezoid> trapezoids(std::span<const geometry::Ring> rings) {
  struct Side {
    Point3 low, high;
  };
  std::vector<Side> sides;
  std::vector<double> heights;
  for (const geometry::Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      heights.push_back(a.y);
      if (a.y != b.y) sides.push_back(a.y < b.y ? Side{a, b} : Side{b, a});
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.low.y < b.low.y; });
  std::vector<Trapezoid> out;
  std::vector<Side> active;
  std::size_t next = 0;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double y0 = heights[k], y1 = heights[k + 1], middle = y0 / 2 + y1 / 2;
    std::erase_if(active, [&](const Side& side) { return side.high.y <= y0; });
    for (; next < sides.size() && sides[next].low.y <= y0; ++next) active.push_back(sides[next]);
    std::sort(active.begin(), active.end(),
              [&](const Side& a, const Side& b) { return x_at(a.low, a.high, middle) < x_at(b.low, b.high, middle); });
    for (std::size_t i = 0; i + 1 < active.size(); i += 2) {
      const Side &left = active[i], &right = active[i + 1];
      const Trapezoid part{y0,
                           y1,
                           x_at(left.low, left.high, y0),
                           x_at(left.low, left.high, y1),
                           x_at(right.low, right.high, y0),
                           x_at(right.low, right.high, y1)};
      if (part.area() > 0) out.push_back(part);
    }
  }
  return out;
}

// The share of the height below which lies the share `u` of the area: widths grow linearly from w0 to w1.
double height_share(double w0, double w1, double u) {
  if (std::abs(w1 - w0) < 1e-9 * (w0 + w1)) return u;
  return (std::sqrt(w0 * w0 + u * (w1 * w1 - w0 * w0)) - w0) / (w1 - w0);
}

// Keeps a share away from 0 and 1, so that samples lie strictly inside.
double inner(double share) { return 1e-6 + (1 - 2e-6) * share; }

}  // namespace

std::vector<Point3> prism_samples(std::span<const geometry::Ring> rings, double bottom, double top, std::size_t count,
                                  std::uint64_t seed) {
  const std::vector<Trapezoid> parts = trapezoids(rings);
  if (parts.empty()) return {};
  std::vector<double> below{0};
  for (const Trapezoid& part : parts) below.push_back(below.back() + part.area());
  // Additive recurrence with the powers of 1/g, where g is the real root of g^4 = g + 1 (Roberts 2018).
  constexpr double kSteps[3] = {0.81917251339616444, 0.67104360670378921, 0.54970047790197026};
  Random random(seed, 0x5a);
  double at[3] = {random.uniform(), random.uniform(), random.uniform()};
  std::vector<Point3> samples;
  samples.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    for (int k = 0; k < 3; ++k) at[k] = at[k] + kSteps[k] >= 1 ? at[k] + kSteps[k] - 1 : at[k] + kSteps[k];
    const double wanted = at[0] * below.back();
    const auto above = std::upper_bound(below.begin() + 1, below.end() - 1, wanted);
    const auto k = static_cast<std::size_t>(above - below.begin()) - 1;
    const Trapezoid& part = parts[k];
    const double share = std::clamp((wanted - below[k]) / (below[k + 1] - below[k]), 0.0, 1.0);
    const double v = inner(height_share(part.right0 - part.left0, part.right1 - part.left1, share));
    const double left = part.left0 + v * (part.left1 - part.left0), right = part.right0 + v * (part.right1 - part.right0);
    samples.push_back(
        {left + inner(at[1]) * (right - left), part.y0 + v * (part.y1 - part.y0), bottom + inner(at[2]) * (top - bottom)});
  }
  return samples;
}

}  // namespace bl::making
