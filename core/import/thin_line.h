// A line with fewer points that stays near all of them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/vector.h"

namespace bl::importing {

struct ThinLine {
  std::vector<Point3> points;  ///< the first and the last one, and those in between that count most
  double aside = 0;            ///< how far the points that were left out lie from the line that is left [m]
};

/// The line as it is where it has no more than `most` points between its ends. Else the points that bend it most (Ramer 1972,
/// Douglas and Peucker 1973), one by one, until the rest lie within a centimetre or there are `most` of them.
ThinLine thin_line(const std::vector<Point3>& line, std::size_t most);

}  // namespace bl::importing
