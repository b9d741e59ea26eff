// JSON of people: what is wrong with it is told with its line and column.
#include "core/define/json_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/payload.h"

namespace bl {
namespace {

std::string why_no_json(const std::string& text) {
  const auto json = parse_json(text);
  return json ? "" : json.error().text();
}

TEST(JsonText, AKeyThatStandsTwiceHasItsPlace) {
  EXPECT_EQ(why_no_json("{\"nodes\": [\n {\"id\": \"a\",\n \"id\": \"b\"}]}"),
            "line 3, column 2: the key \"id\" stands twice in one object; keep one of them");
  EXPECT_EQ(why_no_json(R"({"a": {"b": "a", "c": ["b", {"b": 1}]}, "b": "\"{[", "a": 2})"),
            "line 1, column 54: the key \"a\" stands twice in one object; keep one of them");
  EXPECT_EQ(why_no_json(R"({"a\u0062": 1, "ab": 2})"),
            "line 1, column 16: the key \"ab\" stands twice in one object; keep one of them");
  EXPECT_EQ(why_no_json(R"({"k\"": 1, "x": [{}, []], "k\"" : 2})").substr(0, 29), "line 1, column 27: the key \"k");
  EXPECT_EQ(why_no_json(R"({"a": {"a": {"a": "a"}}, "b": [{"a": 1}, {"a": 1}]})"), "");
}

// A number without a point may be larger than any whole number that a program holds.
TEST(JsonText, NumbersOfAnySizeAreTheSameAsTheirText) {
  for (const double number :
       {3.77777775555555555554e20, -3.7e20, 1e19, 9.3e18, -9.3e18, 0x1p63, -0x1p63, 0x1p64, 1e300, 12.0, -0.5}) {
    const JsonValue value = JsonValue::of(Json(number));
    EXPECT_EQ(value, JsonValue(value.text())) << number;
    EXPECT_EQ((*value.read())->get<double>(), number);
  }
}

TEST(JsonText, AnEmptyTextIsNotACutOne) {
  for (const char* text : {"", " \n", "\xEF\xBB\xBF", "\xEF\xBB\xBF\n"})
    EXPECT_EQ(why_no_json(text), "the text is empty; JSON is expected") << text;
  EXPECT_EQ(why_no_json("{"), "line 1, column 2: the text ends in the middle of a JSON value; the file is cut off");
}

}  // namespace
}  // namespace bl
