// Hashes of values: every character of a long text counts, and equal contents count alike.
#include "core/define/value.h"

#include <set>

#include <gtest/gtest.h>

namespace bl {
namespace {

std::uint64_t hash_of_row(const std::string& text) {
  Hash hash;
  add_to(hash, Value(Shared<Table>(Table{{"heights"}, {{text}}})));
  return hash.value();
}

TEST(ValueHash, EveryCharacterOfALongTextCounts) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>('A' + i % 26);
  std::set<std::uint64_t> seen{hash_of_row(text)};
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string other = text;
    other[at] ^= 1;
    EXPECT_TRUE(seen.insert(hash_of_row(other)).second) << at;
  }
  EXPECT_EQ(hash_of_row(text), hash_of_row(std::string(text.data(), text.size())));
}

TEST(ValueHash, LengthAndPlaceCount) {
  std::set<std::uint64_t> seen;
  for (std::size_t length = 250; length < 400; ++length) EXPECT_TRUE(seen.insert(hash_of_row(std::string(length, 'A'))).second);
  std::string one(320, 'A'), two = one;  // the same characters in another of the words side by side
  one[0] = 'B';
  two[8] = 'B';
  EXPECT_NE(hash_of_row(one), hash_of_row(two));
}

}  // namespace
}  // namespace bl
