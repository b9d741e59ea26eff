// How lengths of made nodes are rounded, so that files stay readable.
#pragma once

#include <cmath>

namespace bl::making {

/// To a tenth of a millimetre, far finer than any survey; never a negative zero.
inline double tidy_length(double length) { return std::round(length * 1e4) / 1e4 + 0.0; }

}  // namespace bl::making
