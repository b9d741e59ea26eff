// Lists of numbers: equal contents count alike, and their hash is that of the digits by which older files held them.
#include "core/base/number_list.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace bl {
namespace {

template <class T>
std::uint64_t hash_of(const NumberList<T>& list) {
  Hash hash;
  list.add_to(hash);
  return hash.value();
}

std::uint64_t hash_of_text(const std::string& text) {
  Hash hash;
  add_table_text(hash, text);
  return hash.value();
}

TEST(NumberList, IsHashedAsTheDigitsOfOlderFiles) {
  Random random(3);
  for (std::size_t count = 0; count < 200; ++count) {
    std::vector<double> numbers(count);
    std::vector<std::uint32_t> indices(count);
    for (double& number : numbers) number = random.uniform(-1e6, 1e6);
    for (std::uint32_t& index : indices) index = static_cast<std::uint32_t>(random.below(kLargestIndex + 1));
    EXPECT_EQ(hash_of(Numbers(numbers)), hash_of_text(digits_of(numbers))) << count;
    EXPECT_EQ(hash_of(Indices(indices)), hash_of_text(digits_of(indices))) << count;
  }
}

TEST(NumberList, ComparesByContentAndHasNoSignedZeros) {
  EXPECT_EQ(Numbers({1, 2}), Numbers({1, 2}));
  EXPECT_FALSE(Numbers({1, 2}) == Numbers({1, 3}));
  EXPECT_EQ(Numbers(), Numbers(std::vector<double>{}));
  EXPECT_EQ(hash_of(Numbers({0.0})), hash_of(Numbers({-0.0})));
  EXPECT_FALSE(std::signbit(Numbers({-0.0})->front()));
}

TEST(NumberList, KnowsWhetherAllOfItIsFinite) {
  EXPECT_TRUE(Numbers({1e300}).is_finite());
  EXPECT_FALSE(Numbers({1, std::numeric_limits<double>::infinity()}).is_finite());
  EXPECT_FALSE(Numbers({std::numeric_limits<double>::quiet_NaN(), 1}).is_finite());
}

TEST(NumberDigits, ComeBackBitForBit) {
  const std::vector<double> numbers{0, -0.0, 1, 1.0 / 3, -1e15, 5e-324, 123456.789};
  const auto back = numbers_of_digits(digits_of(numbers));
  ASSERT_TRUE(back);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>((*back)[i]), std::bit_cast<std::uint64_t>(numbers[i]));
  const std::vector<std::uint32_t> indices{0, 1, 63, 64, kLargestIndex};
  EXPECT_EQ(indices_of_digits(digits_of(indices)), indices);
  EXPECT_EQ(digits_of(std::vector<double>{0}), "AAAAAAAAAAA");
  EXPECT_EQ(digits_of(std::vector<std::uint32_t>{65}), "BBAA");
}

TEST(NumberDigits, WhatIsNoSuchListIsNothing) {
  EXPECT_TRUE(numbers_of_digits("")->empty());
  EXPECT_FALSE(numbers_of_digits("AAAA"));
  EXPECT_FALSE(numbers_of_digits("AAAAAAAAAA!"));
  EXPECT_FALSE(indices_of_digits("AAA"));
  EXPECT_FALSE(indices_of_digits(std::string("AA\xff") + "A"));
}

}  // namespace
}  // namespace bl
