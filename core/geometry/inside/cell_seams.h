// The parts of one cell in the pieces of its domain, opened towards each other where the ball reaches from one into the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/tessellate.h"

namespace bl::geometry {

/// What is to be divided and wrapped of one part: its faces without the openings. A part without openings is closed. Along an
/// opening two parts have the same corners but for rounding, and both wrap its rim onto the same circle, so that together they
/// are closed as well.
struct OpenPart {
  std::vector<Point3> corners;  ///< relative to the site; the part's own ones first
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<std::uint32_t> marks;  ///< per corner, as in WrapTargets
  std::vector<Point3> seams;         ///< one for each opening: the point of it that is nearest to the site

  std::vector<FaceLoop> faces() const { return {loops.begin(), loops.end()}; }
};

/// Corners of parts that are no farther apart than this [m] are one place.
double seam_tolerance(std::span<const Polyhedron> parts);

/// One for each part; nothing for those that the ball does not reach. A face between two parts stays as it is where the ball does
/// not reach it (the way to what lies behind it leads through the ball's surface). Where it does, the ball's disc in it opens:
/// what is left of the face around the disc is cut into triangles whose inner edges lie outside the disc and are marked, so that
/// wrapping moves them onto the circle.
std::vector<OpenPart> open_parts(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius);

}  // namespace bl::geometry
