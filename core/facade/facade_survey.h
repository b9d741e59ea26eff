// Measures the surface of a shape as façade, roof, underside and ground, its façade by storey and orientation.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/facade/orientation.h"
#include "core/facade/shape_faces.h"

namespace bl::facade {

/// Where each storey's windows begin and end, above its floor [m].
struct WindowBand {
  double sill = 0.9, head = 2.8;
  bool operator==(const WindowBand&) const = default;
};

struct SurveyOptions {
  double base = 0, storey_height = 3.2;         ///< height of the lowest floor, and from floor to floor [m]
  double ground = 0;                            ///< what lies below is no façade [m]
  double true_north = 0;                        ///< clockwise from the scene's y axis [degree]
  double spherical_area = -1;                   ///< known area on the ball [m²]; negative: as measured here
  std::array<WindowBand, kOrientations> bands;  ///< by orientation
  bool operator==(const SurveyOptions&) const = default;
};

/// The façade of one storey towards one orientation [m²].
struct FacadeRow {
  int storey = 0;  ///< from 0
  Orientation orientation = Orientation::north;
  double below = 0, band = 0, above = 0;  ///< under the sill, between sill and head, over the head
  double area() const { return below + band + above; }
};

/// All surface of a shape [m²]; the five add up to it.
struct FacadeSurvey {
  double facade = 0, roof = 0, underside = 0;
  double shared = 0;            ///< with neighbours
  double ground = 0;            ///< on the ground or under it
  std::vector<FacadeRow> rows;  ///< ascending storey, then orientation; they add up to `facade`
};

/// What is steeper than 45 degrees is façade; what is flatter and looks up is roof, what looks down underside, or ground where
/// it lies on the ground. Flat faces are measured in closed form, cut to their disc in the ball. What lies on the ball is
/// measured in small pieces, scaled so that they add up to `spherical_area`. A mesh that is not coarse counts as it is.
/// `faces` are those of `mesh`.
FacadeSurvey survey_facade(const Mesh& mesh, std::span<const ShapeFace> faces, const SurveyOptions& options);

/// Area of a plane convex polygon inside the disc of squared radius `squared` around the origin: each edge adds the triangle or
/// the sector that it spans with the origin. Corners as pairs, counter-clockwise.
double polygon_disc_area(std::span<const std::array<double, 2>> corners, double squared);

}  // namespace bl::facade
