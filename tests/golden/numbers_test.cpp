// The bits of the functions of mathematics, for ever: golden traces rest on them, on every processor.
#include <gtest/gtest.h>

#include "core/base/hash.h"
#include "core/base/mathematics.h"
#include "core/base/random.h"
#include "core/base/text.h"

namespace bl {
namespace {

// Many results as one number.
template <class Function>
std::string digest(double low, double high, Function&& function) {
  Hash hash;
  Random random(3);
  for (int i = 0; i < 20000; ++i) hash.add(function(random.uniform(low, high)));
  return hex_digits(hash.value());
}

// Where only these constants are red, the mathematics library is another: traces and logs of other machines will not agree.
TEST(GoldenNumbers, FunctionsOfMathematicsKeepTheirBits) {
  using namespace mathematics;
  EXPECT_EQ(digest(-1000, 1000, [](double x) { return sine(x); }), "fc6c8264f9cf8d67");
  EXPECT_EQ(digest(-1000, 1000, [](double x) { return cosine(x); }), "abfe5328f6bc1915");
  EXPECT_EQ(digest(-1000, 1000, [](double x) { return tangent(x); }), "c6dedf9a8917532a");
  EXPECT_EQ(digest(-1, 1, [](double x) { return arc_sine(x); }), "84cf5c483384f4e8");
  EXPECT_EQ(digest(-1, 1, [](double x) { return arc_cosine(x); }), "8648ac4a178b088d");
  EXPECT_EQ(digest(-9, 9, [](double x) { return arc_tangent(x); }), "accddba9d73e0e73");
  EXPECT_EQ(digest(-9, 9, [](double x) { return arc_tangent(x, 0.7 * x - 1); }), "18e5a17d6ed4a986");
  EXPECT_EQ(digest(-20, 20, [](double x) { return hyperbolic_sine(x) + hyperbolic_cosine(x) + hyperbolic_tangent(x); }),
            "34c773845b93d5d1");
  EXPECT_EQ(digest(0, 1,
                   [](double x) {
                     return inverse_hyperbolic_sine(x) + inverse_hyperbolic_cosine(1 + x) + inverse_hyperbolic_tangent(x);
                   }),
            "900bd9abb3233252");
  EXPECT_EQ(digest(-600, 600, [](double x) { return exponential(x); }), "582a5e266a5a2801");
  EXPECT_EQ(digest(-600, 600, [](double x) { return exponential_of_two(x); }), "9a3682e93cbd67fd");
  EXPECT_EQ(digest(-1, 1, [](double x) { return exponential_less_one(x); }), "fe5e15ac46a59422");
  EXPECT_EQ(digest(0, 1e9, [](double x) { return logarithm(x); }), "f039c188b42a7052");
  EXPECT_EQ(digest(0, 1e9, [](double x) { return logarithm_of_two(x) + logarithm_of_ten(x); }), "0a892e145287f82b");
  EXPECT_EQ(digest(-1, 1, [](double x) { return logarithm_of_one_more(x); }), "8d7d7bcb4dd808da");
  EXPECT_EQ(digest(0, 50, [](double x) { return power(x, 7.3 - x); }), "e58e25fd2254c900");
  EXPECT_EQ(digest(-1e9, 1e9, [](double x) { return cube_root(x); }), "0516794f8285163f");
  EXPECT_EQ(digest(-9, 9, [](double x) { return hypotenuse(x, x * x - 7); }), "b5ef9ce7267dab0a");
}

}  // namespace
}  // namespace bl
