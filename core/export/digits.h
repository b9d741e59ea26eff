// How many digits tables and maps write: none that nobody could measure.
#pragma once

#include <cmath>

namespace bl::exporting {

/// To thousandths: lengths in metres.
inline double to_millimetres(double metres) { return std::round(metres * 1e3) / 1e3 + 0.0; }
/// To millionths: areas, volumes and ratios.
inline double to_millionths(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }
/// To a hundredth of a millimetre on the ground: areas that are measured in degrees keep six digits.
inline double to_map_digits(double degrees) { return std::round(degrees * 1e10) / 1e10 + 0.0; }

}  // namespace bl::exporting
