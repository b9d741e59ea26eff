// Closed-form measures of (convex polyhedron ∩ ball around the origin): the formulas of "facet by facet" integration.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/geometry/inside/polyhedron.h"

namespace bl::geometry {

/// Measures of the shape, relative to the ball's centre, which is the polyhedron's origin. Lengths in metres.
struct ShapeMeasure {
  double volume = 0, spherical_area = 0;
  Point3 centroid;
  std::vector<double> areas;  ///< per face of the polyhedron: its area inside the ball
  double lowest = 0, highest = 0;
  double own_section = 0;  ///< area of the horizontal section at the centre's height [m²]
  bool is_empty = true;
  /// A point of the shape, inside or on its surface: the weighted mean of the centroids of its facets.
  Point3 point_inside;
};

/// Is the centre so far from the planes of all faces that faces beyond the ball (offset >= radius) need not be there?
bool is_centre_apart(const Polyhedron& cell, double radius);

/// What is known of a whole polyhedron before its ball is looked at; infinite where nothing is.
struct WholeMeasure {
  double volume = std::numeric_limits<double>::infinity();  ///< [m³]
  Point3 centroid;
};
WholeMeasure measure_whole(const Polyhedron& cell);

/// `squared_radius` [m²] positive. Without `with_centroid` the centroid and the point inside are not worked out.
void measure_shape(const Polyhedron& cell, double squared_radius, const WholeMeasure& whole, bool with_centroid,
                   ShapeMeasure& out);

/// Exact vertical extent: fills `lowest` and `highest`. After measure_shape, for a shape that is not empty.
void measure_extent(const Polyhedron& cell, double squared_radius, ShapeMeasure& shape);

/// Sum of sections at mid-storey heights, from `lowest` on. What is left above the last whole storey counts with the section at
/// its own middle and by its share of a storey; a shape lower than a storey has one section, at mid-height. So the sum is
/// continuous in the shape. Fills `own_section`. After measure_extent.
double floor_area(const Polyhedron& cell, double squared_radius, double storey_height, ShapeMeasure& shape);

/// Exact area of the projection onto the plan: the section at the centre's height, plus the projections of upward facets
/// below it and of downward facets above it (all other surface is covered by these, seen from above). After floor_area.
double footprint_area(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape);

}  // namespace bl::geometry
