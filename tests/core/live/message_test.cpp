// The number in a message: what is read, and what is said of everything else.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/live/message.h"

namespace bl::live {
namespace {

double number(std::string_view payload, std::string_view field = "") {
  const auto read = number_in(payload, field);
  EXPECT_TRUE(read.ok()) << payload << ": " << read.error().text();
  return read ? *read : -999;
}

std::string refusal(std::string_view payload, std::string_view field = "") {
  const auto read = number_in(payload, field);
  return read ? "read" : read.error().message;
}

TEST(Message, HoldsANumberAsTextOrInJson) {
  EXPECT_EQ(number("21.5"), 21.5);
  EXPECT_EQ(number(" -3e2\r\n"), -300);
  EXPECT_EQ(number("true"), 1);
  EXPECT_EQ(number(R"({"temp": 7.25})", "temp"), 7.25);
  EXPECT_EQ(number(R"({"a/b": {"m~n": [1, 2, "3.5"]}})", "/a~1b/m~0n/2"), 3.5);
  EXPECT_EQ(number(R"([4, false])", "/1"), 0);
}

TEST(Message, SaysWhatIsWrong) {
  EXPECT_EQ(refusal(""), "the message is empty");
  EXPECT_EQ(refusal("warm"), "`warm` is no number");
  EXPECT_EQ(refusal("1,5"), "`1,5` is no number");
  EXPECT_EQ(refusal("nan"), "`nan` is no number");
  EXPECT_EQ(refusal(R"({"t": 1})"), "the message is JSON: name the field of it that holds the number");
  EXPECT_EQ(refusal(R"({"t": 1})", "u"), "the message has no field `u`");
  EXPECT_EQ(refusal(R"({"t": [1]})", "/t/1"), "the message has no field `/t/1`: `1` is not there");
  EXPECT_EQ(refusal(R"({"t": null})", "t"), "`t` holds nothing (null)");
  EXPECT_EQ(refusal(R"({"t": {}})", "t"), "`t` holds no number but a whole object");
  EXPECT_EQ(refusal("{", "t"), "the message is no JSON, in which the field `t` could stand");
  EXPECT_EQ(refusal(std::string("1\0", 2)), "the message is binary, no text");
  EXPECT_EQ(refusal(std::string(70000, '1')), "the message has 70000 bytes, and at most 65536 are read");
  EXPECT_EQ(refusal(std::string(60000, 'x')), "`" + std::string(40, 'x') + "...` is no number");
  EXPECT_EQ(refusal("`\xff`"), "`???` is no number");
}

TEST(Message, NoiseAndDepthAreRefusedAndNothingElse) {
  EXPECT_NE(refusal(std::string(60000, '['), "/0"), "read");
  Random random(5, 1);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    const std::uint64_t length = random.below(40);
    for (std::uint64_t k = 0; k < length; ++k) bytes += static_cast<char>(random.below(256));
    const auto read = number_in(bytes, i % 2 == 0 ? "" : "/a/0");
    if (!read) { EXPECT_FALSE(read.error().message.empty()); }
  }
}

}  // namespace
}  // namespace bl::live
