// Which of several sites owns which stretch of a line: exact along the line, for every metric.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/geometry/inside/site_metric.h"

namespace bl::geometry {

/// A site as a line sees it.
struct SiteOnLine {
  double along = 0;   ///< coordinate of the site's foot on the line [m]
  double aside = 0;   ///< squared distance of the site from the line [m²]
  double weight = 0;  ///< [m²]
  double radius = 0;  ///< [m]
};

template <Metric M>
double closeness_at(const SiteOnLine& site, double t) {
  return closeness<M>((t - site.along) * (t - site.along) + site.aside, site.weight, site.radius);
}

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where `other` becomes closer than `owner` on the way up the line; kNever (or a place long past) where it does not. There is
/// one such place at most: along a line the difference of two of these distances has one extremum at most.
template <Metric M>
double takeover(const SiteOnLine& owner, const SiteOnLine& other) {
  // In coordinates from the owner's foot: other's foot at b, squared distances t² + aside and (t - b)² + aside.
  const double b = other.along - owner.along;
  if constexpr (M == Metric::power) {
    const double rest = b * b + (other.aside - owner.aside) - (other.weight - owner.weight);
    return b > 0 ? owner.along + rest / (2 * b) : kNever;
  } else if constexpr (M == Metric::multiplicative) {
    // owner.weight · ((t - b)² + other.aside) = other.weight · (t² + owner.aside): a t² + 2 h t + c = 0, falling.
    const double a = owner.weight - other.weight, h = -owner.weight * b;
    const double c = owner.weight * (b * b + other.aside) - other.weight * owner.aside;
    const double square = h * h - a * c;
    if (!(square >= 0)) return kNever;
    const double root = std::sqrt(square);
    if (h > 0) return a == 0 ? kNever : owner.along - (h + root) / a;
    return root - h > 0 ? owner.along + c / (root - h) : kNever;
  } else {
    // d_other - d_owner = s, the difference of the radii. Squared: k - 2 b t = 2 s d_owner, squared again: a quadratic whose
    // roots are those of ±s.
    const double s = other.radius - owner.radius, k = b * b + (other.aside - owner.aside) - s * s;
    if (s == 0) return b > 0 ? owner.along + k / (2 * b) : kNever;
    const double a = 4 * (b * b - s * s), square = k * k + a * owner.aside;
    if (!(square >= 0)) return kNever;
    const double root = std::sqrt(square), c = k * k - 4 * s * s * owner.aside;
    for (const double part : {2 * s * root, -2 * s * root}) {
      // t = (2 b k + part) / a, or c / (2 b k - part): the one that does not cancel.
      const double sum = 2 * b * k + part, rest = 2 * b * k - part;
      if (sum == 0 && rest == 0) continue;
      const bool is_direct = std::abs(sum) >= std::abs(rest);
      if (is_direct && a == 0) continue;
      const double t = is_direct ? sum / a : c / rest;
      const double own = std::sqrt(t * t + owner.aside), its = std::sqrt((t - b) * (t - b) + other.aside);
      const double slack = 1e-6 * (own + its);
      if (std::abs(its - own - s) > slack) continue;  // the root of -s, or of the other branch
      if ((t - b) * own < t * its) return owner.along + t;
    }
    return kNever;
  }
}

/// Calls visit(site, from, to, next) for each stretch of one owner, upwards; `next` is the site beyond it, or sites.size() at
/// the end of the line. `sites` must not be empty.
template <Metric M, class Visit>
void walk_line(std::span<const SiteOnLine> sites, double from, double to, double tiny, Visit&& visit) {
  const std::size_t count = sites.size();
  const auto closest_at = [&](double t) {
    std::size_t best = 0;
    double least = closeness_at<M>(sites[0], t);
    for (std::size_t k = 1; k < count; ++k) {
      const double value = closeness_at<M>(sites[k], t);
      if (value < least) best = k, least = value;
    }
    return best;
  };
  std::size_t owner = count == 1 ? 0 : closest_at(from);
  double t = from;
  // Where several sites meet in one place, rounding may pass through all of them, some twice, but not for ever.
  for (std::size_t turns = 2 * count + 8; count > 1; --turns) {
    double place = kNever;
    std::size_t next = count;
    for (std::size_t k = 0; k < count; ++k) {
      if (k == owner) continue;
      const double at = takeover<M>(sites[owner], sites[k]);
      if (at < t - tiny || !(at < place)) continue;
      place = at;
      next = k;
    }
    if (!(place < to)) break;
    if (turns == 0) {
      owner = closest_at(0.5 * (t + to));
      break;
    }
    place = std::max(place, t);
    visit(owner, t, place, next);
    t = place;
    owner = next;
  }
  visit(owner, t, to, count);
}

}  // namespace bl::geometry
