// Expressions: results by hand, units that fit and units that do not, and what is wrong with a formula.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/base/mathematics.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World ticked(const std::string& formula, const std::string& ports) {
  World world =
      World::from_text(one_node("expression", R"("formula": ")" + formula + "\"" + (ports.empty() ? "" : ", " + ports)));
  world.tick();
  return world;
}
double result_of(const std::string& formula, const std::string& ports = "") {
  const World world = ticked(formula, ports);
  EXPECT_EQ(world.node_error("it", "expression"), "") << formula;
  return world.number("it", "expression.result");
}
std::string error_of(const std::string& formula, const std::string& ports = "") {
  return ticked(formula, ports).node_error("it", "expression");
}

constexpr const char* kPlace = "nodes/it/expression/formula: ";
constexpr const char* kMixed =
    "nodes/it/expression/formula: quantities of different units are added or compared: give plain numbers a unit, as in `3*m`";

TEST(Expression, ComputesPlainNumbers) {
  EXPECT_EQ(result_of("a*b + c/d", R"("a": 2, "b": 3, "c": 8, "d": 4)"), 8);
  EXPECT_EQ(result_of("max(a, b, c) - min(a, b)", R"("a": 2, "b": 3, "c": 8)"), 6);
  EXPECT_EQ(result_of("a > b ? 1 : 2", R"("a": 2, "b": 3)"), 2);
  EXPECT_EQ(result_of("a == 2 && b != 2 && c >= 0 && d <= 0", R"("a": 2, "b": 3)"), 1);
  EXPECT_DOUBLE_EQ(result_of("sqrt(a) + 2^3", R"("a": 9)"), 11);
  EXPECT_EQ(result_of("(a+b)-a", R"("a": 1e6, "b": 0.5)"), 0.5);
}

// `^` binds to the right, closer than a sign before it, and takes a sign after it; functions are those of core/base.
TEST(Expression, PowersAndFunctionsAreThoseOfTheDoor) {
  EXPECT_EQ(result_of("2^3^2"), 512);
  EXPECT_EQ(result_of("-2^2"), -4);
  EXPECT_EQ(result_of("2^-2"), 0.25);
  EXPECT_EQ(result_of("2*3^2*2"), 36);
  EXPECT_EQ(result_of("(1+1)^(1+1)"), 4);
  EXPECT_EQ(result_of("min(2^2, 3) + max(1, 2^1)"), 5);
  Random random(5);
  using namespace mathematics;
  for (int i = 0; i < 20; ++i) {
    const double a = random.uniform(0.1, 0.9), b = random.uniform(-3, 3);
    const std::string ports = "\"a\": " + shortest(a) + ", \"b\": " + shortest(b);
    EXPECT_EQ(result_of("a^b", ports), power(a, b)) << ports;
    const std::pair<const char*, double (*)(double)> functions[] = {{"sin", sine},
                                                                    {"cos", cosine},
                                                                    {"tan", tangent},
                                                                    {"asin", arc_sine},
                                                                    {"acos", arc_cosine},
                                                                    {"atan", arc_tangent},
                                                                    {"exp", exponential},
                                                                    {"ln", logarithm},
                                                                    {"log", logarithm},
                                                                    {"log10", logarithm_of_ten},
                                                                    {"log2", logarithm_of_two},
                                                                    {"sinh", hyperbolic_sine},
                                                                    {"cosh", hyperbolic_cosine},
                                                                    {"tanh", hyperbolic_tangent},
                                                                    {"asinh", inverse_hyperbolic_sine},
                                                                    {"atanh", inverse_hyperbolic_tangent}};
    for (const auto& [name, function] : functions) EXPECT_EQ(result_of(std::string(name) + "(a)", ports), function(a)) << name;
    EXPECT_EQ(result_of("acosh(1 + a)", ports), inverse_hyperbolic_cosine(1 + a));
    EXPECT_EQ(result_of("atan2(b, a)", ports), arc_tangent(b, a));
  }
  EXPECT_EQ(error_of("a ^* b"), std::string(kPlace) + "the sign `*` at character 4 needs a value before it");
  EXPECT_EQ(error_of("^ b"), std::string(kPlace) + "the sign `^` at character 1 needs a value before it");
  EXPECT_EQ(error_of("a\\u007fb"), std::string(kPlace) + "the sign at character 2 cannot be seen: take it out");
  EXPECT_NE(error_of("min()"), "");
  EXPECT_NE(error_of("sum()"), "");
}

TEST(Expression, UnitsThatFit) {
  const std::string metres = R"("a_unit": "m", "b_unit": "m", "a": 3, "b": 4, )";
  EXPECT_EQ(result_of("a + 3*m", metres + R"("unit": "m")"), 6);
  EXPECT_EQ(result_of("a*b + 1*ha", metres + R"("unit": "m2")"), 10012);
  EXPECT_DOUBLE_EQ(result_of("sqrt(a^2 + b^2)", metres + R"("unit": "m")"), 5);
  EXPECT_EQ(result_of("(a+b)-a", metres + R"("unit": "m")"), 4);
  EXPECT_EQ(result_of("a/b > 1 ? a : b", metres + R"("unit": "m")"), 4);
  EXPECT_EQ(result_of("a > 100*m ? 1 : 0", metres + R"("unit": "")"), 0);
  EXPECT_EQ(result_of("a > 0 ? a : 0", metres + R"("unit": "m")"), 3);
  EXPECT_EQ(result_of("a/(2*s)", metres + R"("unit": "m/s")"), 1.5);
  EXPECT_EQ(result_of("6/h", R"("unit": "1/h")"), 6.0 / 3600);
  EXPECT_NEAR(result_of("sin(a/deg*_pi/180)", R"("a": 30, "a_unit": "deg")"), 0.5, 1e-15);
  EXPECT_NEAR(result_of("(a^3)^(1/3)", metres + R"("unit": "m")"), 3, 1e-12);
  EXPECT_EQ(result_of("0", R"("unit": "m")"), 0);
}

TEST(Expression, UnitsThatDoNotFit) {
  const std::string metres = R"("a_unit": "m", "b_unit": "m2", "a": 3, "b": 4, )";
  EXPECT_EQ(error_of("a + 3", metres + R"("unit": "m")"), kMixed);
  EXPECT_EQ(error_of("a + b", metres + R"("unit": "m")"), kMixed);
  EXPECT_EQ(error_of("a > 3 ? a : 2*a", metres + R"("unit": "m")"), kMixed);
  EXPECT_EQ(error_of("sin(a)", metres + R"("unit": "")"), kMixed);
  EXPECT_EQ(error_of("a + 1e-6*b", metres + R"("unit": "m")"), kMixed);
  EXPECT_EQ(error_of("a * b", metres + R"("unit": "m2")"),
            "nodes/it/expression/unit: the formula gives `m3`, but the result is to be in `m2`: change the formula or the unit");
  EXPECT_EQ(error_of("a / b", metres + R"("unit": "")"),
            "nodes/it/expression/unit: the formula gives `m-1`, but the result is to be a plain number: change the formula or "
            "the unit");
  EXPECT_EQ(
      error_of("a / s^2", metres + R"("unit": "m")"),
      "nodes/it/expression/unit: the formula gives `m·s-2`, but the result is to be in `m`: change the formula or the unit");
  EXPECT_EQ(error_of("5", R"("unit": "EUR")"),
            "nodes/it/expression/unit: the formula gives a plain number, but the result is to be in `EUR`: change the formula or "
            "the unit");
  EXPECT_EQ(error_of("a", R"("a_unit": "meter")"),
            "nodes/it/expression/a_unit: `meter` is no unit that is known; known are `ratio`, `count`, `m`, `m2`, `m3`, `1/m`, "
            "`deg`, `s`, `m/s`, `1/h`, `EUR`");
  EXPECT_EQ(error_of("a", R"("a_unit": "km", "unit": "m")"),
            "nodes/it/expression/a_unit: values are not kept in `km`: write `m`, and the numbers in it");
}

TEST(Expression, SaysWhatIsWrongWithAFormula) {
  const std::string place = kPlace;
  EXPECT_EQ(error_of(""), place + "the formula is empty: write one, such as `a + b`");
  EXPECT_EQ(error_of("a + "), place + "the formula ends too early: complete it, and close its brackets");
  EXPECT_EQ(error_of("a*(b"), place + "the formula ends too early: complete it, and close its brackets");
  EXPECT_EQ(error_of("1 + sqr(a)"), place + "`sqr` at character 5 is no name or sign that is known, did you mean `sqrt`?");
  EXPECT_EQ(error_of("a + x1"), place + "`x1` at character 5 is no name or sign that is known, did you mean `a`?");
  EXPECT_EQ(error_of("a # b"), place + "`#` at character 3 is no name or sign that is known, did you mean `a`?");
  EXPECT_EQ(error_of("a b"), place + "`b` at character 3 follows another value: put a sign such as `*` between the two");
  EXPECT_EQ(error_of("a ** b"), place + "the sign `*` at character 4 needs a value before it");
  EXPECT_EQ(error_of("sqrt"), place + "the function `sqrt` at character 1 needs its arguments in brackets");
  EXPECT_EQ(error_of("sqrt(a, b)"), place + "the function `sqrt` takes another number of arguments");
  EXPECT_EQ(error_of("a = 3"), place + "a formula changes nothing, so the `=` at character 3 has no place; compare with `==`");
  EXPECT_EQ(error_of("(b=3) + b"),
            place + "a formula changes nothing, so the `=` at character 3 has no place; compare with `==`");
  EXPECT_EQ(error_of("a, b"), place + "a formula gives one number: take away the comma outside of brackets");
  EXPECT_EQ(error_of("a ? b"), place + "the formula cannot be read: check its signs, brackets and commas");
  EXPECT_EQ(error_of("a)"), place + "the formula cannot be read at character 2: check its signs, brackets and commas");
  EXPECT_EQ(error_of(std::string(501, 'a')), place + "the formula has 501 characters: shorten it to 500");
}

TEST(Expression, AResultHasToBeFinite) {
  const std::string sentence =
      std::string(kPlace) + "the formula gives no finite number: guard divisions and roots, as in `b > 0 ? a/b : 0`";
  EXPECT_EQ(error_of("a/b", R"("a": 1)"), sentence);
  EXPECT_EQ(error_of("sqrt(a)", R"("a": -1)"), sentence);
  EXPECT_EQ(error_of("ln(-a^2 - 1)"),
            std::string(kPlace) + "no numbers that were tried give a finite result: guard divisions and roots");
  EXPECT_EQ(result_of("b > 0 ? a/b : 0", R"("a": 1)"), 0);
}

TEST(Expression, OddTextNeverCrashes) {
  for (const char* text :
       {"a=",        "==",      "=",    "<=>", "?:",    "a?:",    "a?b:c?d", "((((((", "))))", ",,,",      "sum()", "sum(,)",
        "max(a,,b)", "_",       "_pi(", "1e",  "1e400", "0x10",   "-",       "--a",    "!a",   "a^^b",     "a\\tb", "²",
        "a*²",       "\\u0001", "a;b",  "min", "m(",    "(a)(b)", "1 2",     "a&&",    "||a",  "\\\"a\\\""}) {
    const World world = ticked(text, "");
    const std::string error = world.node_error("it", "expression");
    if (error.empty()) EXPECT_TRUE(std::isfinite(world.number("it", "expression.result"))) << text;
    else EXPECT_TRUE(error.starts_with(kPlace)) << text << ": " << error;
  }
}

TEST(Expression, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/expression.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("allowed", "expression.result"), 2500);
  EXPECT_EQ(world.number("rent", "expression.result"), 150 * 14.5 * 12);
}

}  // namespace
}  // namespace bl
