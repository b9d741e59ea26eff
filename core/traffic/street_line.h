// The line that a street takes: from its start by the points of its course to its end.
#pragma once

#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl::traffic {

/// From `start` by the points of the course to `end`. The course counts in plan; the line rises evenly along it from end to end.
std::vector<Point3> street_line(const Point3& start, std::span<const Point3> course, const Point3& end);

/// Its length [m]; without a course bit for bit the distance of the ends.
double street_length(const Point3& start, std::span<const Point3> course, const Point3& end);

/// What of a line lies between two shares of its length, with all points in between; 0 <= begin <= end <= 1.
std::vector<Point3> part_of_line(std::span<const Point3> line, double begin, double end);

/// The point at a share of its length.
Point3 point_on_line(std::span<const Point3> line, double share);

}  // namespace bl::traffic
