// The one door to SLEEF: nothing else in the program sees its header, which brings the intrinsics of the processor along.
#include "core/base/mathematics.h"

#include <sleef.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bl::mathematics {

namespace {

// SLEEF squares arguments, and gives infinities from the root of the largest double on; nothing below changes by these formulas.
constexpr double kLongWay = 0x1p500, kSteep = 709;

// ln(2x) of a large x, also where 2x is beyond all numbers: an error of the root's last place counts nothing beside its
// logarithm.
double logarithm_of_twice(double x) { return 2 * logarithm(std::numbers::sqrt2 * std::sqrt(x)); }

// e^x / 2, where e^x may be beyond all numbers and its half is none the less a double: e^(x - 512) times e^512 / 2, which is the
// sum of two doubles here. From 711 on the half is infinite as well.
double half_exponential(double x) {
  constexpr double kHigh = 0x1.9476504ba852ep+737, kLow = 0x1.b0272159f0071p+683;
  const double rest = exponential(std::min(x, 711.0) - 512);
  return std::fma(rest, kHigh, rest * kLow);
}

}  // namespace

double sine(double radians) { return Sleef_cinz_sind1_u10purec(radians); }
double cosine(double radians) { return Sleef_cinz_cosd1_u10purec(radians); }
double tangent(double radians) { return Sleef_cinz_tand1_u10purec(radians); }
double arc_sine(double x) { return Sleef_cinz_asind1_u10purec(x); }
double arc_cosine(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double arc_tangent(double x) { return Sleef_cinz_atand1_u10purec(x); }
double arc_tangent(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }

double hyperbolic_sine(double x) {
  return std::abs(x) >= kSteep ? std::copysign(half_exponential(std::abs(x)), x) : Sleef_cinz_sinhd1_u10purec(x);
}
double hyperbolic_cosine(double x) {
  return std::abs(x) >= kSteep ? half_exponential(std::abs(x)) : Sleef_cinz_coshd1_u10purec(x);
}
double hyperbolic_tangent(double x) { return Sleef_cinz_tanhd1_u10purec(x); }
double inverse_hyperbolic_sine(double x) {
  return std::abs(x) >= kLongWay ? std::copysign(logarithm_of_twice(std::abs(x)), x) : Sleef_cinz_asinhd1_u10purec(x);
}
double inverse_hyperbolic_cosine(double x) { return x >= kLongWay ? logarithm_of_twice(x) : Sleef_cinz_acoshd1_u10purec(x); }
double inverse_hyperbolic_tangent(double x) { return Sleef_cinz_atanhd1_u10purec(x); }

double exponential(double x) { return Sleef_cinz_expd1_u10purec(x); }
double exponential_of_two(double x) { return Sleef_cinz_exp2d1_u10purec(x); }
double exponential_less_one(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
double logarithm(double x) { return Sleef_cinz_logd1_u10purec(x); }
double logarithm_of_two(double x) { return Sleef_cinz_log2d1_u10purec(x); }
double logarithm_of_ten(double x) { return Sleef_cinz_log10d1_u10purec(x); }
double logarithm_of_one_more(double x) { return x >= kLongWay ? logarithm(x) : Sleef_cinz_log1pd1_u10purec(x); }

// Squares are what scripts and formulas ask for most; one product is exact to half a last place, and quicker.
double power(double base, double exponent) { return exponent == 2 ? base * base : Sleef_cinz_powd1_u10purec(base, exponent); }
double cube_root(double x) { return Sleef_cinz_cbrtd1_u10purec(x); }
double hypotenuse(double x, double y) { return Sleef_cinz_hypotd1_u05purec(x, y); }

// The two shorter sides first, so that the order of the arguments does not matter.
double hypotenuse(double x, double y, double z) {
  const double a = std::abs(x), b = std::abs(y), c = std::abs(z);
  const double longest = std::max({a, b, c}), shortest = std::min({a, b, c});
  const double middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
  return hypotenuse(hypotenuse(shortest, middle), longest);
}

}  // namespace bl::mathematics
