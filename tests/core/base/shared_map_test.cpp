// Maps that share: they read as std::map does, and what a change leaves alone is the same object.
#include "core/base/shared_map.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/random.h"

namespace bl {
namespace {

using Numbers = SharedMap<int>;

std::string name_of_number(std::uint64_t n) { return "n" + std::to_string(n); }

void expect_equal(const Numbers& map, const std::map<std::string, int>& known) {
  ASSERT_EQ(map.size(), known.size());
  EXPECT_EQ(map.empty(), known.empty());
  auto it = map.begin();
  for (const auto& [name, number] : known) {
    ASSERT_NE(it, map.end());
    EXPECT_EQ(it->first, name);
    EXPECT_EQ(it->second, number);
    EXPECT_EQ(map.at(name), number);
    ++it;
  }
  EXPECT_EQ(it, map.end());
  auto back = map.rbegin();
  for (auto last = known.rbegin(); last != known.rend(); ++last, ++back) EXPECT_EQ(back->first, last->first);
}

TEST(SharedMap, IsAMapThroughRandomChanges) {
  for (const std::uint64_t most : {5u, 200u, 2000u}) {
    Random random(most);
    Numbers map;
    std::map<std::string, int> known;
    for (int step = 0; step < 3000; ++step) {
      const std::string name = name_of_number(random.below(most));
      const int number = static_cast<int>(random.below(1000));
      switch (random.below(4)) {
        case 0: EXPECT_EQ(map.emplace(name, number), known.emplace(name, number).second); break;
        case 1: EXPECT_EQ(map.erase(name), known.erase(name)); break;
        case 2: map[name] = known[name] = number; break;
        default: EXPECT_EQ(map.contains(name), known.contains(name));
      }
      const auto at = map.lower_bound(name);
      const auto known_at = known.lower_bound(name);
      ASSERT_EQ(at == map.end(), known_at == known.end());
      if (at != map.end()) { EXPECT_EQ(at->first, known_at->first); }
      EXPECT_EQ(map.find(name) == map.end(), known.find(name) == known.end());
    }
    expect_equal(map, known);
  }
}

TEST(SharedMap, ACopyStaysAsItWas) {
  Numbers map;
  for (std::uint64_t n = 0; n < 500; ++n) map[name_of_number(n)] = static_cast<int>(n);
  const Numbers before = map;
  const int& old = before.at("n7");
  map.edit("n7") = -1;
  map.erase("n8");
  map["more"] = 3;
  EXPECT_EQ(old, 7);
  EXPECT_EQ(before.size(), 500u);
  EXPECT_TRUE(before.contains("n8"));
  EXPECT_EQ(map.at("n7"), -1);
  EXPECT_EQ(&before.at("n300"), &map.at("n300")) << "a record that nobody changed is shared";
  EXPECT_THROW(map.edit("n8"), std::out_of_range);
  EXPECT_THROW((void)map.at("n8"), std::out_of_range);
}

TEST(SharedMap, DifferencesAreThoseRecordsThatDiffer) {
  Numbers map;
  for (std::uint64_t n = 0; n < 300; ++n) map[name_of_number(n)] = static_cast<int>(n);
  Numbers after = map;
  EXPECT_EQ(map, after);
  after.edit("n17") = 1;
  after.edit("n200") = 2;
  after.edit("n201") = 201;  // to the same content
  std::vector<std::string> seen;
  const auto see = [&](const auto* old, const auto* now) {
    seen.push_back((old == nullptr ? "+" : now == nullptr ? "-" : "") + (now == nullptr ? old : now)->first);
    return true;
  };
  EXPECT_TRUE(map.each_difference(after, see));
  EXPECT_EQ(seen, (std::vector<std::string>{"n17", "n200"}));
  EXPECT_NE(map, after);
  EXPECT_FALSE(map.each_difference(after, [](const auto*, const auto*) { return false; }));
  // Records come and go, at the ends too; leaves are split on the way.
  for (int n = 0; n < 60; ++n) after["n150_" + std::to_string(1000 + n)] = n;
  after.erase("n0");
  after["z"] = 1;
  seen.clear();
  EXPECT_TRUE(map.each_difference(after, see));
  ASSERT_EQ(seen.size(), 64u);
  EXPECT_EQ(seen.front(), "-n0");
  EXPECT_EQ(seen[1], "+n150_1000");
  EXPECT_EQ(seen.back(), "+z");
  // One added and one removed: other names at the same ranks.
  after = map;
  after.erase("n100");
  after["n1000"] = 1;
  EXPECT_NE(map, after);
}

TEST(SharedMap, AnIteratorGoesOnOverTheMapAsItWas) {
  Numbers map;
  for (std::uint64_t n = 0; n < 200; ++n) map[name_of_number(n)] = 1;
  int sum = 0;
  for (const auto& [name, number] : map) {
    sum += number;
    map.edit(name) = 0;
  }
  EXPECT_EQ(sum, 200);
  for (const auto& [name, number] : map) EXPECT_EQ(number, 0);
}

}  // namespace
}  // namespace bl
