// Random numbers: constants that must never change, and evenness.
#include "core/base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace bl {
namespace {

// The constants were computed by a second implementation, not by this one.
TEST(Random, KeepsItsConstants) {
  Random zero(0), seeded(42), other(42, 1);
  for (const std::uint64_t bits : {0x3cf11a8c42acbfb8ull, 0xb89b5d5330b03b54ull, 0x366753a99bf5b1caull})
    EXPECT_EQ(zero.bits(), bits);
  for (const std::uint64_t bits : {0x3c4602a84b6afa20ull, 0xc361dc9b58af486full, 0xc84429380f8937efull})
    EXPECT_EQ(seeded.bits(), bits);
  for (const std::uint64_t bits : {0x66fa99d6de20248dull, 0xde4e44348b36d654ull, 0xda5e61765903d5edull})
    EXPECT_EQ(other.bits(), bits);
  Random numbers(42);
  for (const double number : {0.23544327362780482, 0.7632120017303211, 0.7822900544993316}) EXPECT_EQ(numbers.uniform(), number);
  Random counts(42);
  for (const std::uint64_t count : {23u, 76u, 78u, 64u, 92u}) EXPECT_EQ(counts.below(100), count);
}

TEST(Random, SameSeedSameNumbers) {
  Random a(7, 3), b(7, 3);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a.bits(), b.bits());
  Random copy = a;
  EXPECT_EQ(copy.bits(), a.bits());
}

TEST(Random, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (std::uint64_t stream = 0; stream < 100; ++stream) first.insert(Random(seed, stream).bits());
  EXPECT_EQ(first.size(), 10000u);
}

TEST(Random, UniformIsEven) {
  Random random(1);
  constexpr int kNumbers = 200000;
  std::array<int, 20> bins{};
  double sum = 0, squares = 0, products = 0, previous = 0.5;
  for (int i = 0; i < kNumbers; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++bins[static_cast<std::size_t>(u * 20)];
    sum += u;
    squares += u * u;
    products += (u - 0.5) * (previous - 0.5);
    previous = u;
  }
  EXPECT_NEAR(sum / kNumbers, 1.0 / 2, 0.003);
  EXPECT_NEAR(squares / kNumbers, 1.0 / 3, 0.003);
  EXPECT_NEAR(products / kNumbers * 12, 0, 0.01);  // neighbours do not know of each other
  double chi_squared = 0;
  for (const int count : bins) chi_squared += std::pow(count - kNumbers / 20.0, 2) / (kNumbers / 20.0);
  EXPECT_LT(chi_squared, 43.8);  // 19 degrees of freedom: exceeded once in a thousand seeds
}

TEST(Random, UniformStaysBetweenItsBounds) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-3, 5);
    ASSERT_GE(u, -3);
    ASSERT_LT(u, 5);
  }
  EXPECT_EQ(random.uniform(4, 4), 4);
}

TEST(Random, BelowReachesEveryNumberEvenly) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) {
    const std::uint64_t n = random.below(7);
    ASSERT_LT(n, 7u);
    ++counts[n];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(random.below(1), 0u);
}

}  // namespace
}  // namespace bl
