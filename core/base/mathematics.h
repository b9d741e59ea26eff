// The functions of mathematics whose results reach the state: the same bits on every x86-64 machine.
#pragma once

namespace bl::mathematics {

// The C library chooses other code for sin, exp and the like by the processor (with or without fused multiply-add), and their
// last bits differ. These are SLEEF's scalar functions of the consistent kind without FMA (`Sleef_cinz_*d1_u10purec`): plain
// double operations in a fixed order, within 1.0 ULP of the true result (sinh and cosh 1.5 from 709 on), the hypotenuse 0.5. What
// IEEE 754 rounds exactly is the same everywhere already and is taken from the standard library: + - * /, sqrt, fma, floor,
// ceil, round, fmod, remainder, ldexp, nextafter. Infinities, zeros and NaN are as in the C standard.

double sine(double radians);
double cosine(double radians);
double tangent(double radians);
double arc_sine(double x);  ///< [rad]; NaN outside of -1 to 1, like the next
double arc_cosine(double x);
double arc_tangent(double x);
double arc_tangent(double y, double x);  ///< the angle of (x, y), from -pi to pi

double hyperbolic_sine(double x);
double hyperbolic_cosine(double x);
double hyperbolic_tangent(double x);
double inverse_hyperbolic_sine(double x);
double inverse_hyperbolic_cosine(double x);
double inverse_hyperbolic_tangent(double x);

double exponential(double x);            ///< e^x
double exponential_of_two(double x);     ///< 2^x
double exponential_less_one(double x);   ///< e^x - 1, exact near 0
double logarithm(double x);              ///< of base e
double logarithm_of_two(double x);       ///< of base 2
double logarithm_of_ten(double x);       ///< of base 10
double logarithm_of_one_more(double x);  ///< of 1 + x, exact near 0

double power(double base, double exponent);  ///< exact wherever a whole power is a double
double cube_root(double x);
double hypotenuse(double x, double y);
double hypotenuse(double x, double y, double z);  ///< within 2 ULP

}  // namespace bl::mathematics
