// Result and Error: values, errors, places and the names of codes.
#include "core/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

namespace bl {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{ErrorCode::wrong_kind, "number", "is odd"};
  return number / 2;
}

Result<void> positive(int number) {
  if (number <= 0) return Error{ErrorCode::out_of_range, "", "must be positive"};
  return {};
}

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = half(8), bad = half(7);
  ASSERT_TRUE(good.ok());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_EQ(good.value(), 4);
  EXPECT_EQ(*good, 4);
  ASSERT_FALSE(bad.ok());
  EXPECT_FALSE(static_cast<bool>(bad));
  EXPECT_EQ(bad.error(), (Error{ErrorCode::wrong_kind, "number", "is odd"}));
}

// What is quoted comes from data, and data can be 20 MB long.
TEST(Error, QuotationsAreCut) {
  const std::string name(20'000'000, 'x'), accents = [] {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "é";
    return text;
  }();
  const Result<int> bad =
      Error{ErrorCode::not_found, "nodes/" + name, "there is no `" + name + "`, did you mean \"" + name + "\"?"};
  EXPECT_LT(bad.error().text().size(), 1200u);
  EXPECT_TRUE(bad.error().message.starts_with("there is no `xxx"));
  EXPECT_TRUE(bad.error().message.ends_with("xxx\"?"));
  EXPECT_NE(bad.error().message.find(" ... (20000000 bytes) ... "), std::string::npos);
  EXPECT_TRUE(bad.error().place.starts_with("nodes/xxx"));
  const std::string sentence(1000, 'y');
  EXPECT_EQ(bounded({ErrorCode::parse, "", sentence}).message, sentence) << "only quotations are cut at that length";
  EXPECT_LT(bounded({ErrorCode::parse, "", name}).message.size(), kLongestMessage);
  EXPECT_EQ((Error{ErrorCode::parse, "a", "`b` is no c"}).text(), "a: `b` is no c");
  const std::string cut = bounded({ErrorCode::parse, "", "`" + accents + "` is long"}).message;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const bool begins = static_cast<unsigned char>(cut[i]) == 0xc3, ends = static_cast<unsigned char>(cut[i + 1]) == 0xa9;
    EXPECT_EQ(begins, ends) << "whole characters";
  }
  EXPECT_EQ(bounded(bounded(bad.error())), bounded(bad.error())) << "once is enough";
}

// A mark without its partner quotes nothing: an inch, an apostrophe, a text that data have cut.
TEST(Error, OneLoneMarkIsNoQuotation) {
  const std::string rest(500, 'y');
  const auto said = [](const std::string& message) { return bounded({ErrorCode::parse, "", message}).message; };
  EXPECT_EQ(said("a pipe of 3\" is too wide " + rest), "a pipe of 3\" is too wide " + rest);
  EXPECT_EQ(said("a lone ` stands here " + rest), "a lone ` stands here " + rest);
  const std::string cut = said("a pipe of 3\" is no `" + rest + "`, did you mean `pipe`?");
  EXPECT_TRUE(cut.starts_with("a pipe of 3\" is no `yyy")) << cut;
  EXPECT_NE(cut.find(" ... (500 bytes) ... "), std::string::npos) << cut;
  EXPECT_TRUE(cut.ends_with("yyy`, did you mean `pipe`?")) << cut;
  EXPECT_LT(cut.size(), 400u);
}

TEST(Result, OfNothingIsSuccessOrAnError) {
  EXPECT_TRUE(positive(1).ok());
  EXPECT_TRUE(static_cast<bool>(positive(1)));
  const Result<void> bad = positive(0);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::out_of_range);
}

TEST(Result, ValueCanBeChangedInPlace) {
  Result<std::string> text = std::string("ab");
  text->push_back('c');
  *text += "d";
  text.value() += "e";
  EXPECT_EQ(*text, "abcde");
  const Result<std::string>& seen = text;
  EXPECT_EQ(seen->size(), 5u);
}

TEST(Result, MovesWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(3);
  const std::unique_ptr<int> taken = std::move(made).value();
  EXPECT_EQ(*taken, 3);
  Result<std::unique_ptr<int>> again = std::make_unique<int>(4);
  const std::unique_ptr<int> taken_too = *std::move(again);
  EXPECT_EQ(*taken_too, 4);
}

TEST(Result, AnEmptyTextIsAValue) {
  const Result<std::string> empty = std::string();
  EXPECT_TRUE(empty.ok());
}

TEST(Error, TextHasThePlaceInFront) {
  EXPECT_EQ((Error{ErrorCode::missing, "nodes/tower", "has no name"}.text()), "nodes/tower: has no name");
  EXPECT_EQ((Error{ErrorCode::missing, "", "has no name"}.text()), "has no name");
}

TEST(Error, WithinPutsAPlaceInFront) {
  const Error inner{ErrorCode::missing, "demand", "is missing"};
  EXPECT_EQ(inner.within("tower").within("nodes").place, "nodes/tower/demand");
  EXPECT_EQ(inner.within("").place, "demand");
  EXPECT_EQ((Error{ErrorCode::io, "", "x"}.within("file").place), "file");
  EXPECT_EQ(inner.within("tower").code, ErrorCode::missing);
  EXPECT_EQ(inner.within("tower").message, "is missing");
  EXPECT_EQ(inner.place, "demand");
}

TEST(Error, EveryCodeHasANameOfItsOwn) {
  std::set<std::string_view> names;
  const int last = static_cast<int>(ErrorCode::internal);
  for (int code = 0; code <= last; ++code) names.insert(name_of(static_cast<ErrorCode>(code)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_EQ(name_of(ErrorCode::unknown_field), "unknown_field");
  EXPECT_EQ(name_of(ErrorCode::internal), "internal");
  for (const std::string_view name : names) EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), name.npos);
}

}  // namespace
}  // namespace bl
