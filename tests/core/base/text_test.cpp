// Numbers and names as text: exact, the same in every locale, and kind to typing errors.
#include "core/base/text.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace bl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Text, ShortestIsShort) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(12), "12");
  EXPECT_EQ(shortest(-0.5), "-0.5");
  EXPECT_EQ(shortest(1e21), "1e+21");
  EXPECT_EQ(shortest(kInfinity), "inf");
  EXPECT_EQ(shortest(std::numeric_limits<double>::lowest()), "-1.7976931348623157e+308");
}

TEST(Text, ShortestReadsBackAsTheSameBits) {
  Random random(1);
  int tried = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random.bits();
    const double number = std::bit_cast<double>(bits);
    if (!std::isfinite(number)) continue;
    const auto back = parse_number(shortest(number));
    ASSERT_TRUE(back.has_value()) << shortest(number);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*back), bits) << shortest(number);
    ++tried;
  }
  EXPECT_GT(tried, 19000);
  // A zero is written without its sign, in sentences as in files.
  for (const double zero : {0.0, -0.0}) EXPECT_EQ(shortest(zero), "0");
  for (const double edge : {5e-324, -5e-324, 2.2250738585072014e-308, 1.7976931348623157e308})
    EXPECT_EQ(*parse_number(shortest(edge)), edge) << edge;
}

TEST(Text, FixedRoundsAndNeverShowsMinusZero) {
  EXPECT_EQ(fixed(1.005, 1), "1.0");
  EXPECT_EQ(fixed(2.675, 3), "2.675");
  EXPECT_EQ(fixed(-1.5, 0), "-2");
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(fixed(-0.0, 0), "0");
  EXPECT_EQ(fixed(-0.01, 2), "-0.01");
  EXPECT_EQ(fixed(1234567.891, 2), "1234567.89");
  EXPECT_EQ(fixed(kInfinity, 2), "inf");
  EXPECT_EQ(fixed(-kInfinity, 2), "-inf");
  EXPECT_EQ(fixed(1e308, 6).size(), 309u + 7u);
}

TEST(Text, ParsesWholeNumbersOnly) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number("-3e-2"), -0.03);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* none :
       {"", "+", "-", "e5", "1,5", "1.5 ", " 1.5", "1.5m", "1.2.3", "0x10", "1e", "1e400", "--1", "+-1", "inf", "nan", "one"})
    EXPECT_FALSE(parse_number(none).has_value()) << none;
}

// Switches the C locale and the global C++ locale to ones with a decimal comma, and back.
class CommaLocale {
 public:
  CommaLocale() : cpp_(std::locale::global(std::locale(std::locale::classic(), new Comma))), c_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "nl_NL.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~CommaLocale() {
    std::locale::global(cpp_);
    std::setlocale(LC_ALL, c_.c_str());
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale cpp_;
  std::string c_;
};

TEST(Text, DoesNotFollowTheLocale) {
  const CommaLocale german;
  EXPECT_EQ(shortest(1234.5), "1234.5");
  EXPECT_EQ(fixed(1234.5, 2), "1234.50");
  EXPECT_EQ(parse_number("1234.5"), 1234.5);
  EXPECT_FALSE(parse_number("1234,5").has_value());
  EXPECT_EQ(to_identifier("Grüße I"), "gr_e_i");
}

TEST(Text, NearestNameForgivesFewEdits) {
  const std::vector<std::string> names = {"demand", "weight", "position", "floor_area"};
  EXPECT_EQ(nearest_name("demnad", names), "demand");
  EXPECT_EQ(nearest_name("wieght", names), "weight");
  EXPECT_EQ(nearest_name("floorarea", names), "floor_area");
  EXPECT_EQ(nearest_name("demand", names), "demand");
  EXPECT_EQ(nearest_name("colour", names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name(std::string(100, 'a'), names), "");
}

TEST(Text, NearestNameTakesTheFirstOfEquallyNearOnes) {
  const std::vector<std::string> names = {"cat", "bat"};
  EXPECT_EQ(nearest_name("rat", names), "cat");
}

TEST(Text, DidYouMeanIsAPartOfASentence) {
  const std::vector<std::string> names = {"demand"};
  EXPECT_EQ(did_you_mean("demnd", names), ", did you mean `demand`?");
  EXPECT_EQ(did_you_mean("colour", names), "");
}

TEST(Text, KnowsIdentifiers) {
  for (const char* good : {"a", "7", "tower_2", "a-b.c#4", "0"}) EXPECT_TRUE(is_identifier(good)) << good;
  for (const char* bad : {"", "_a", "-a", "#1", "Tower", "a b", "a/b", "ä"}) EXPECT_FALSE(is_identifier(bad)) << bad;
  EXPECT_TRUE(is_identifier(std::string(64, 'a')));
  EXPECT_FALSE(is_identifier(std::string(65, 'a')));
}

TEST(Text, FoldsTextIntoAnIdentifier) {
  EXPECT_EQ(to_identifier("North Tower"), "north_tower");
  EXPECT_EQ(to_identifier("  --Café 12!  "), "caf_12");
  EXPECT_EQ(to_identifier("???"), "item");
  EXPECT_EQ(to_identifier(""), "item");
  EXPECT_EQ(to_identifier(std::string(100, 'x')).size(), 48u);
}

TEST(Text, WhatIsFoldedIsAnIdentifier) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (std::uint64_t n = random.below(80); n > 0; --n) text += static_cast<char>(random.below(256));
    const std::string id = to_identifier(text);
    ASSERT_TRUE(is_identifier(id)) << id;
    ASSERT_EQ(to_identifier(id), id);
  }
}

}  // namespace
}  // namespace bl
