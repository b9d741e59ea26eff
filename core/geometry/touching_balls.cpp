// Balls less a spherical cap, solved for their radius by Newton's method.
#include "core/geometry/touching_balls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bl::geometry {

namespace {

constexpr double kBallPi = std::numbers::pi;
constexpr double kDeepestCut = 0.5;  // least distance of a centre from its facet, as a share of the radius

// The root of a convex function that rises, from a start at or beyond it: Newton's steps then only fall, until rounding ends it.
template <class Function, class Slope>
double root_from_above(double start, Function value, Slope slope) {
  double root = start;
  for (int step = 0; step < 200; ++step) {
    const double next = root - value(root) / slope(root);
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

// A ball of radius r less the cap beyond a plane at the distance t from its centre holds pi (2 r³/3 + t r² - t³/3).
double cut_ball_volume(double radius, double distance) {
  return kBallPi * (2 * radius * radius * radius / 3 + distance * (radius * radius - distance * distance / 3));
}

// The radius of a ball of this volume that is cut as deeply as is allowed.
double radius_cut_deepest(double volume) { return ball_radius(volume * (4 * kBallPi / 3) / cut_ball_volume(1, kDeepestCut)); }

double largest_facet_radius(double volume) { return std::sqrt(1 - kDeepestCut * kDeepestCut) * radius_cut_deepest(volume); }

// How far the centre stands from its facet, a circle of this radius that is no larger than the largest.
double distance_to_facet(double volume, double facet_radius) {
  const double square = facet_radius * facet_radius;
  const auto distance = [&](double radius) { return std::sqrt(std::max(0.0, radius * radius - square)); };
  const auto error = [&](double radius) { return cut_ball_volume(radius, distance(radius)) - volume; };
  const auto slope = [&](double radius) {
    const double t = distance(radius);
    return kBallPi * (2 * radius * radius + 2 * radius * t + square * radius / t);
  };
  if (!(volume > 0)) return 0;
  return distance(root_from_above(radius_cut_deepest(volume), error, slope));
}

}  // namespace

double ball_radius(double volume) {
  const double cube = volume / (4 * kBallPi / 3);
  if (!(cube > 0)) return 0;
  return root_from_above(
      std::max(1.0, cube), [&](double r) { return r * r * r - cube; }, [](double r) { return 3 * r * r; });
}

double touching_distance(double volume, double other_volume, double area) {
  const double wanted = std::sqrt(std::max(0.0, area) / kBallPi);
  const double facet = std::min({wanted, largest_facet_radius(volume), largest_facet_radius(other_volume)});
  return distance_to_facet(volume, facet) + distance_to_facet(other_volume, facet);
}

}  // namespace bl::geometry
