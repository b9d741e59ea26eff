// The outline of a garden that is added: its corners as people type them, and the rectangle that a shadow receiver is.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::making {

/// Corners such as "10,20" [m]; an error where they are no outline. Its place is `--corners`.
Result<std::vector<Point3>> read_corners(const std::vector<std::string>& texts);

/// The rectangle along the longest side that holds all corners.
struct Rectangle {
  Point3 middle;
  double width = 0, depth = 0;  ///< [m]
  double rotation = 0;          ///< [degree]
  double beyond = 0;            ///< [ratio] of it that lies outside of the corners
};
Rectangle around(const std::vector<Point3>& corners);

}  // namespace bl::making
