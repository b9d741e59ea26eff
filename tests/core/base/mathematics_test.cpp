// The functions of the door: within their bounds of the C library's long numbers, exact where a result is a double, and at the
// edges.
#include "core/base/mathematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"

namespace bl {
namespace {

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();

// How far apart in units of the last place of the true result.
double ulps(double found, long double wanted) {
  const double size = std::abs(static_cast<double>(wanted));
  const long double unit = std::nextafter(size, kBeyondAll) - size;
  return static_cast<double>(std::abs(found - wanted) / unit);
}

struct FunctionPair {
  const char* name;
  double (*ours)(double);
  long double (*theirs)(long double);
  double low, high;
};

TEST(Mathematics, StaysWithinOneUnitOfTheLastPlace) {
  using namespace mathematics;
  const FunctionPair pairs[] = {{"sine", sine, std::sin, -200, 200},
                                {"cosine", cosine, std::cos, -200, 200},
                                {"tangent", tangent, std::tan, -200, 200},
                                {"arc_sine", arc_sine, std::asin, -1, 1},
                                {"arc_cosine", arc_cosine, std::acos, -1, 1},
                                {"arc_tangent", arc_tangent, std::atan, -50, 50},
                                {"hyperbolic_sine", hyperbolic_sine, std::sinh, -30, 30},
                                {"hyperbolic_cosine", hyperbolic_cosine, std::cosh, -30, 30},
                                {"hyperbolic_tangent", hyperbolic_tangent, std::tanh, -5, 5},
                                {"inverse_hyperbolic_sine", inverse_hyperbolic_sine, std::asinh, -50, 50},
                                {"inverse_hyperbolic_cosine", inverse_hyperbolic_cosine, std::acosh, 1, 50},
                                {"inverse_hyperbolic_tangent", inverse_hyperbolic_tangent, std::atanh, -1, 1},
                                {"exponential", exponential, std::exp, -300, 300},
                                {"exponential_of_two", exponential_of_two, std::exp2, -300, 300},
                                {"exponential_less_one", exponential_less_one, std::expm1, -2, 2},
                                {"logarithm", logarithm, std::log, 0, 1e6},
                                {"logarithm_of_two", logarithm_of_two, std::log2, 0, 1e6},
                                {"logarithm_of_ten", logarithm_of_ten, std::log10, 0, 1e6},
                                {"logarithm_of_one_more", logarithm_of_one_more, std::log1p, -0.9, 2},
                                {"cube_root", cube_root, std::cbrt, -1e6, 1e6}};
  Random random(1);
  for (const FunctionPair& pair : pairs)
    for (int i = 0; i < 20000; ++i) {
      const double x = random.uniform(pair.low, pair.high);
      ASSERT_LE(ulps(pair.ours(x), pair.theirs(x)), 1.0) << pair.name << " of " << x;
    }
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-100, 100), y = random.uniform(-100, 100), z = random.uniform(-100, 100);
    const long double wide = x, other = y;
    ASSERT_LE(ulps(arc_tangent(y, x), std::atan2(other, wide)), 1.0) << y << " " << x;
    ASSERT_LE(ulps(power(std::abs(x), y / 10), std::pow(std::abs(wide), static_cast<long double>(y / 10))), 1.0) << x << " " << y;
    ASSERT_LE(ulps(hypotenuse(x, y), std::hypot(wide, other)), 0.51) << x << " " << y;
    ASSERT_LE(ulps(hypotenuse(x, y, z), std::sqrt(wide * wide + other * other + static_cast<long double>(z) * z)), 2.0);
    ASSERT_EQ(hypotenuse(x, y, z), hypotenuse(z, x, y));
    ASSERT_EQ(hypotenuse(x, y, z), hypotenuse(y, x, z));
  }
}

// Where arguments or results come near the largest and smallest numbers.
TEST(Mathematics, HoldsItsBoundsAtTheFarEnds) {
  using namespace mathematics;
  const FunctionPair pairs[] = {{"inverse_hyperbolic_sine", inverse_hyperbolic_sine, std::asinh, -308, 308.25},
                                {"inverse_hyperbolic_cosine", inverse_hyperbolic_cosine, std::acosh, 0, 308.25},
                                {"logarithm_of_one_more", logarithm_of_one_more, std::log1p, -300, 308.25},
                                {"logarithm", logarithm, std::log, -307, 308.25},
                                {"logarithm_of_two", logarithm_of_two, std::log2, -307, 308.25},
                                {"logarithm_of_ten", logarithm_of_ten, std::log10, -307, 308.25},
                                {"arc_tangent", arc_tangent, std::atan, -300, 308.25},
                                {"hyperbolic_tangent", hyperbolic_tangent, std::tanh, -300, 308.25},
                                {"cube_root", cube_root, std::cbrt, -307, 308.25}};
  Random random(2);
  for (const FunctionPair& pair : pairs)
    for (int i = 0; i < 20000; ++i) {
      const double x = std::pow(10, random.uniform(pair.low, pair.high));
      ASSERT_LE(ulps(pair.ours(x), pair.theirs(x)), 1.0) << pair.name << " of " << x;
    }
  const FunctionPair steep[] = {{"hyperbolic_sine", hyperbolic_sine, std::sinh, 0, 0},
                                {"hyperbolic_cosine", hyperbolic_cosine, std::cosh, 0, 0}};
  for (const FunctionPair& pair : steep)
    for (int i = 0; i < 20000; ++i) {
      const double x = random.uniform(700, 710.4758);
      ASSERT_LE(ulps(pair.ours(x), pair.theirs(x)), x < 709 ? 1.0 : 1.5) << pair.name << " of " << x;
    }
  constexpr double kLargest = std::numeric_limits<double>::max();
  EXPECT_LT(hyperbolic_cosine(710.4758), kBeyondAll);
  EXPECT_NEAR(inverse_hyperbolic_sine(kLargest), 710.4758600739439, 1e-12);
  EXPECT_NEAR(inverse_hyperbolic_sine(-kLargest), -710.4758600739439, 1e-12);
  EXPECT_NEAR(inverse_hyperbolic_cosine(kLargest), 710.4758600739439, 1e-12);
  EXPECT_NEAR(logarithm_of_one_more(kLargest), 709.782712893384, 1e-12);
  EXPECT_EQ(inverse_hyperbolic_sine(kBeyondAll), kBeyondAll);
  EXPECT_EQ(inverse_hyperbolic_sine(-kBeyondAll), -kBeyondAll);
  EXPECT_EQ(inverse_hyperbolic_cosine(kBeyondAll), kBeyondAll);
  EXPECT_EQ(logarithm_of_one_more(kBeyondAll), kBeyondAll);
  EXPECT_TRUE(std::isnan(inverse_hyperbolic_cosine(-kLargest)));
  EXPECT_TRUE(std::isnan(logarithm_of_one_more(-kLargest)));
  for (double (*const function)(double) :
       {hyperbolic_sine, hyperbolic_cosine, inverse_hyperbolic_sine, inverse_hyperbolic_cosine, logarithm_of_one_more})
    EXPECT_TRUE(std::isnan(function(std::nan(""))));
  for (const double x : {710.5, 711.0, 1000.0, 1e300, kBeyondAll}) {
    EXPECT_EQ(hyperbolic_cosine(x), kBeyondAll) << x;
    EXPECT_EQ(hyperbolic_cosine(-x), kBeyondAll) << x;
    EXPECT_EQ(hyperbolic_sine(x), kBeyondAll) << x;
    EXPECT_EQ(hyperbolic_sine(-x), -kBeyondAll) << x;
  }
  EXPECT_EQ(hyperbolic_sine(-710), -hyperbolic_sine(710));
}

TEST(Mathematics, IsExactWhereTheResultIsADouble) {
  using namespace mathematics;
  for (int base = 1; base <= 1000; ++base) {
    double product = base;
    for (int exponent = 2; product * base <= 0x1p53 && exponent < 60; ++exponent) {
      product *= base;
      ASSERT_EQ(power(base, exponent), product) << base << "^" << exponent;
      ASSERT_EQ(power(-base, exponent), exponent % 2 == 0 ? product : -product);
    }
    ASSERT_EQ(cube_root(1.0 * base * base * base), base);
    ASSERT_EQ(power(1.0 * base * base, 0.5), base);
    ASSERT_EQ(hypotenuse(3.0 * base, 4.0 * base), 5.0 * base);
  }
  for (int exponent = -1000; exponent <= 1000; ++exponent) {
    ASSERT_EQ(exponential_of_two(exponent), std::ldexp(1, exponent));
    ASSERT_EQ(logarithm_of_two(std::ldexp(1, exponent)), exponent);
  }
  double ten = 1;
  for (int exponent = 0; exponent <= 22; ++exponent, ten *= 10) {
    EXPECT_EQ(logarithm_of_ten(ten), exponent);
    EXPECT_EQ(power(10, exponent), ten);
  }
}

TEST(Mathematics, EdgesAreThoseOfTheStandard) {
  using namespace mathematics;
  EXPECT_EQ(sine(0), 0);
  EXPECT_TRUE(std::signbit(sine(-0.0)));
  EXPECT_EQ(cosine(0), 1);
  EXPECT_TRUE(std::isnan(sine(kBeyondAll)));
  EXPECT_TRUE(std::isnan(arc_sine(1.5)));
  EXPECT_EQ(arc_tangent(0, -1), std::numbers::pi);
  EXPECT_EQ(arc_tangent(-0.0, -1), -std::numbers::pi);
  EXPECT_EQ(arc_tangent(0, 0), 0);
  EXPECT_EQ(exponential(-kBeyondAll), 0);
  EXPECT_EQ(exponential(1000), kBeyondAll);
  EXPECT_EQ(logarithm(0), -kBeyondAll);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
  EXPECT_EQ(power(0, 0), 1);
  EXPECT_EQ(power(1, std::nan("")), 1);
  EXPECT_EQ(power(0, -1), kBeyondAll);
  EXPECT_EQ(power(2, 2000), kBeyondAll);
  EXPECT_TRUE(std::isnan(power(-8, 1.0 / 3)));
  EXPECT_EQ(hypotenuse(kBeyondAll, std::nan("")), kBeyondAll);
  EXPECT_GT(hypotenuse(1e308, 1e308), 1e308);
}

}  // namespace
}  // namespace bl
