// The hash: constants that must never change, since files, logs and golden traces hold them.
#include "core/base/hash.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <set>
#include <string>

namespace bl {
namespace {

template <class... Values>
std::uint64_t hash_of(const Values&... values) {
  Hash hash;
  (hash.add(values), ...);
  return hash.value();
}

// The constants were computed by a second implementation, not by this one.
TEST(Hash, KeepsItsConstants) {
  EXPECT_EQ(Hash().value(), 0x243f6a8885a308d3ull);
  EXPECT_EQ(hash_of(std::uint64_t{1}), 0x5943d4b63c0a09ceull);
  EXPECT_EQ(hash_of(1.5), 0xfd2c4d82a54f5350ull);
  EXPECT_EQ(hash_of(0.0), 0x61f4a1de98e2f0e9ull);
  EXPECT_EQ(hash_of(std::string_view("")), 0x61f4a1de98e2f0e9ull);
  EXPECT_EQ(hash_of(std::string_view("12345678")), 0xb4b53d0dd4f6218bull);
  EXPECT_EQ(hash_of(std::string_view("behaviour links")), 0xadc4830a67c04508ull);
  EXPECT_EQ(hash_of(Vector3{1, 2, -3}), 0xed4d1f36dec74e2dull);
  EXPECT_EQ(hash_of(std::uint64_t{7}, 0.1, std::string_view("Größe"), Vector3{1, 2, 3}), 0x0db21aee7c615e37ull);
}

TEST(Hash, IsComputedByTheCompilerToo) {
  static_assert(Hash::mix(0) == 0);
  static_assert(Hash::mix(1) == 0x5692161d100b05e5ull);
  EXPECT_EQ(Hash::mix(1), 0x5692161d100b05e5ull);
}

TEST(Hash, SeesOrderAndBorders) {
  EXPECT_NE(hash_of(1.0, 2.0), hash_of(2.0, 1.0));
  EXPECT_NE(hash_of(std::string_view("ab"), std::string_view("c")), hash_of(std::string_view("a"), std::string_view("bc")));
  EXPECT_NE(hash_of(std::string_view("a")), hash_of(std::string_view(std::string("a\0", 2))));
  EXPECT_EQ(hash_of(Vector3{1, 2, 3}), hash_of(1.0, 2.0, 3.0));
}

TEST(Hash, TakesBothZerosForTheSame) {
  EXPECT_EQ(hash_of(0.0), hash_of(-0.0));
  EXPECT_EQ(hash_of(Vector3{0, -0.0, 0}), hash_of(Vector3{-0.0, 0, -0.0}));
  EXPECT_NE(hash_of(0.0), hash_of(5e-324));
}

TEST(Hash, SpreadsNearbyInputs) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 50000; ++i) seen.insert(hash_of(i));
  EXPECT_EQ(seen.size(), 50000u);
  // One changed bit of the input changes about half of the bits of the output.
  double changed = 0;
  for (int bit = 0; bit < 64; ++bit)
    changed += std::popcount(hash_of(std::uint64_t{12345}) ^ hash_of(std::uint64_t{12345} ^ (std::uint64_t{1} << bit)));
  EXPECT_NEAR(changed / 64, 32, 3);
}

TEST(Hash, PrintsSixteenDigits) {
  EXPECT_EQ(hex_digits(0), "0000000000000000");
  EXPECT_EQ(hex_digits(0xabcdef0123456789ull), "abcdef0123456789");
  EXPECT_EQ(Hash().hex(), "243f6a8885a308d3");
}

}  // namespace
}  // namespace bl
