// Weights to start from, such that no site begins without a cell.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/demand_fit.h"
#include "core/geometry/inside/fit_numbers.h"

namespace bl::geometry {

namespace {

// A site that is outside by less than this share of the domain's size is on its surface: rounding has put it there.
constexpr double kOnSurface = 1e-9;

// -ln(1 - f) for f in (0, 0.98]: 2 artanh(f / (2 - f)) as a series of correctly rounded operations.
double minus_log_of_rest(double f) {
  const double z = f / (2 - f), square = z * z;
  double sum = 0, power = z;
  for (int k = 1; power / k > 1e-17 * sum; k += 2) {
    sum += power / k;
    power *= square;
  }
  return 2 * sum;
}

// Sites that crowd a part of the domain, or lie outside it, are given the ordinary Voronoi diagram of images of them that
// are spread over the domain: with image x = c + s (p - m), the power diagram of weights (1 - s)|p|² - 2 t·p + K is the
// Voronoi diagram of the images s p + t, whatever K; K is chosen so that every ball reaches its site's image.
struct Spread {
  bool is_needed = false;
  double s = 1;
  Point3 middle;
};

// The box around the sites, of which there is at least one; and whether the domain holds them all.
struct SiteBox {
  Vector3 low, high;
  bool all_inside = true;

  SiteBox(const Domain& domain, std::span<const PowerSite> sites) : low(sites[0].position), high(low) {
    for (const PowerSite& site : sites) {
      const Point3& p = site.position;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      all_inside = all_inside && domain.contains(p, kOnSurface * domain.size());
    }
  }
  double extent() const { return distance(low, high); }
};

Spread spread_of(const Domain& domain, std::span<const PowerSite> sites) {
  Spread spread;
  if (sites.size() < 2) spread.is_needed = !sites.empty() && !domain.contains(sites[0].position, kOnSurface * domain.size());
  const SiteBox box(domain, sites);
  spread.middle = 0.5 * (box.low + box.high);
  const double extent = box.extent();
  if (box.all_inside && (extent > 0.4 * domain.size() || sites.size() < 2)) return spread;
  spread.is_needed = true;
  const ConvexDomain& room = domain.largest_piece();
  spread.s = extent > 1e-6 * domain.size() ? domain.size() / extent : 1;
  for (const PowerSite& site : sites) {
    spread.s = std::min(spread.s, 0.9 * room.share_inside(site.position - spread.middle, spread.s / 0.9));
  }
  return spread;
}

// Nearest point of a polygon in space to p; its corners are counter-clockwise around the normal.
Point3 nearest_on_face(const ConvexDomain& shape, std::size_t k, const Point3& p) {
  const Plane& plane = shape.planes[k];
  const auto& loop = shape.faces[k];
  Point3 best = p + (plane.offset - dot(plane.normal, p)) * plane.normal;
  bool is_inside = true;
  double least = std::numeric_limits<double>::infinity();
  Point3 on_rim = best;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point3 a = shape.vertices[loop[i]], along = shape.vertices[loop[(i + 1) % loop.size()]] - a;
    is_inside = is_inside && dot(plane.normal, cross(along, best - a)) >= 0;
    const Point3 on_edge = a + std::clamp(dot(p - a, along) / std::max(1e-300, squared_norm(along)), 0.0, 1.0) * along;
    if (squared_norm(p - on_edge) < least) {
      least = squared_norm(p - on_edge);
      on_rim = on_edge;
    }
  }
  return is_inside ? best : on_rim;
}

// Squared distance of a point from the nearest of the domain's pieces, each shrunk about its centroid [m²].
double squared_gap(const Domain& domain, const Point3& point) {
  constexpr double kShrink = 0.8;
  double least = std::numeric_limits<double>::infinity();
  for (const Domain::Piece& piece : domain.pieces) {
    const ConvexDomain& shape = piece.shape;
    const Point3 p = shape.centroid + (1 / kShrink) * (point - shape.centroid);
    if (shape.contains(p)) return 0;
    for (std::size_t k = 0; k < shape.planes.size(); ++k) {
      if (dot(shape.planes[k].normal, p) < shape.planes[k].offset) continue;
      least = std::min(least, kShrink * kShrink * squared_norm(p - nearest_on_face(shape, k, p)));
    }
  }
  return least;
}

// Is the domain in several pieces, and are the sites about as wide spread as it is, some of them outside?
bool is_spread_over_pieces(const Domain& domain, std::span<const PowerSite> sites) {
  const SiteBox box(domain, sites);
  const double extent = box.extent();
  return !box.all_inside && !domain.is_convex() && extent > 0.4 * domain.size() && extent < 2 * domain.size();
}

}  // namespace

std::vector<double> initial_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands) {
  double sum = 0;
  for (const double demand : demands) sum += std::max(0.0, demand);
  if (demands.empty() || sites.empty() || !(sum > 0) || !(domain.volume > 0)) return std::vector<double>(sites.size(), 0.0);
  const double fill = std::clamp(sum / domain.volume, 1e-9, 0.98);
  const double volume = sum / static_cast<double>(demands.size()) * (minus_log_of_rest(fill) / fill);
  std::vector<double> weights(sites.size(), weight_of_volume(volume));
  if (is_spread_over_pieces(domain, sites)) {
    // Each site wins the point of the shrunken pieces that is nearest to it: there no other can have less power, since none is
    // nearer to them than its own gap says. So cells begin where their sites are, in all pieces, and not too thin.
    for (std::size_t i = 0; i < sites.size(); ++i) weights[i] += squared_gap(domain, sites[i].position);
    return weights;
  }
  const Spread spread = spread_of(domain, sites);
  if (!spread.is_needed) return weights;
  const Point3& centre = domain.largest_piece().centroid;
  // Relative to the centroid of the piece that holds the images: x = s q + t with q = p - c and t = -s (m - c).
  const Vector3 shift = -spread.s * (spread.middle - centre);
  double lift = 0;
  std::vector<double> slope(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vector3 q = sites[i].position - centre;
    slope[i] = (1 - spread.s) * squared_norm(q) - 2 * dot(shift, q);
    const double needed = squared_norm(spread.s * q + shift - q) - slope[i];
    lift = i == 0 ? needed : std::max(lift, needed);
  }
  for (std::size_t i = 0; i < sites.size(); ++i) weights[i] += slope[i] + lift;
  return weights;
}

}  // namespace bl::geometry
