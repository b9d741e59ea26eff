// The distance of two rounded volumes that share a facet of a given size, where nothing else cuts them.
#pragma once

namespace bl::geometry {

/// Radius [m] of the ball of this volume [m³]; 0 for a volume that is not positive. Uses basic operations only, so that it is the
/// same on every machine.
double ball_radius(double volume);

/// Distance [m] of the centres of two balls that are flattened against each other until they share a facet of `area` [m²], each
/// keeping its volume [m³]. A facet that is larger than such bodies can offer counts as the largest: neither is cut deeper than
/// to half of its radius, so that no centre comes near the facet or gets into the other body. Of a volume of 0 only the other's
/// radius is left.
double touching_distance(double volume, double other_volume, double area);

}  // namespace bl::geometry
