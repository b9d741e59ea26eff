// Values compared, copied and hashed, and rows of tables of any length.
#include "core/define/value.h"

#include <limits>
#include <set>
#include <utility>
#include <vector>

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

// One of each kind, and another one of the same kind where there is one.
std::vector<Value> some_values() {
  return {false,
          true,
          std::int64_t{1},
          std::int64_t{2},
          1.0,
          2.0,
          std::string("1"),
          std::string("a text too long to lie in the string itself"),
          Vector3{1, 2, 3},
          Vector3{1, 2, 4},
          Shared(std::vector<Point3>{{1, 2, 3}}),
          Shared(std::vector<std::string>{"a"}),
          Shared(Selection{{}, "smart_volume", {}}),
          Shared(Table{{"a", "b"}, {{std::string("x"), 1.0}}}),
          Shared(Table{{"a", "b"}, {{std::string("x"), 2.0}}}),
          MeshPointer(),
          Numbers(std::vector<double>{1, 2}),
          Made(),
          JsonValue(),
          CommandList()};
}

TEST(Values, CompareAsVariantsDo) {
  const std::vector<Value> values = some_values(), again = some_values();
  for (std::size_t a = 0; a < values.size(); ++a)
    for (std::size_t b = 0; b < values.size(); ++b) {
      EXPECT_EQ(values[a] == again[b], a == b) << a << " and " << b;
      EXPECT_EQ(values[a] == again[b], std::operator==(values[a], again[b])) << a << " and " << b;
      EXPECT_NE(values[a] == again[b], values[a] != again[b]) << a << " and " << b;
    }
  const Value none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(none == none);
  EXPECT_TRUE(Value(0.0) == Value(-0.0));
}

TEST(Values, CopiesAreEqual) { EXPECT_TRUE(copied(some_values()) == some_values()); }

TEST(TableRow, TakesAFieldOfItsOwn) {
  TableRow row{std::string("a name that needs a block of its own"), 2.0};
  row.emplace_back(row[0]);
  EXPECT_EQ(row, (TableRow{row[0], 2.0, std::string("a name that needs a block of its own")}));
}

TEST(TableRow, HoldsWhatAVectorHolds) {
  for (std::size_t size = 0; size < 7; ++size) {
    TableRow row;
    std::vector<Scalar> fields;
    for (std::size_t i = 0; i < size; ++i) {
      const Scalar field = i % 2 == 0 ? Scalar("the field number " + std::to_string(i)) : Scalar(static_cast<double>(i));
      row.push_back(field);
      fields.push_back(field);
    }
    const TableRow copy = row;
    TableRow moved = std::move(row);
    for (const TableRow& one : {copy, moved}) {
      EXPECT_EQ(one.size(), size);
      EXPECT_EQ(one.empty(), size == 0);
      EXPECT_TRUE(std::equal(one.begin(), one.end(), fields.begin(), fields.end())) << size;
      EXPECT_TRUE(one == copy);
    }
    moved.emplace_back(1.0);
    EXPECT_FALSE(moved == copy) << size;
    EXPECT_EQ(moved.size(), size + 1);
    if (size > 0) moved[0] = 7.0;
    EXPECT_TRUE(std::equal(copy.begin(), copy.end(), fields.begin(), fields.end())) << "a copy is its own";
  }
}

}  // namespace
}  // namespace bl
