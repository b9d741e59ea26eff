// Bands of streets by hand, and against times at points along the streets of a grid.
#include "core/traffic/street_reach.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace bl::traffic {
namespace {

using Parts = std::vector<ReachedPart>;

Parts parts_of(const std::vector<ReachStreet>& streets, const std::vector<ReachEntry>& entries,
               const std::vector<double>& times) {
  const auto parts = reached_parts(streets, entries, times);
  EXPECT_TRUE(parts.ok()) << (parts.ok() ? "" : parts.error().message);
  return parts.ok() ? *parts : Parts{};
}

TEST(StreetReach, OneWayAlongAStreetEndsWhereTheTimeEnds) {
  const std::vector<ReachStreet> streets{{"s", "a", "b", 100, 100}};
  EXPECT_EQ(parts_of(streets, {{"a", 10}}, {30, 60}), (Parts{{0, 0, 0, 0.2}, {0, 1, 0.2, 0.5}}));
  EXPECT_EQ(parts_of(streets, {{"b", 10}}, {30, 60}), (Parts{{0, 1, 0.5, 0.8}, {0, 0, 0.8, 1}}));
  EXPECT_EQ(parts_of(streets, {{"a", 10}}, {10}), Parts{}) << "just arrived";
  EXPECT_EQ(parts_of(streets, {{"nowhere", 0}}, {1000}), Parts{});
  EXPECT_EQ(parts_of(streets, {}, {1000}), Parts{});
}

TEST(StreetReach, BothEndsMeetInTheMiddle) {
  // A ring: the far street is come upon from both sides, after 20 s and after 30 s.
  const std::vector<ReachStreet> ring{{"far", "b", "c", 100, 100}, {"left", "a", "b", 20, 20}, {"right", "a", "c", 30, 30}};
  EXPECT_EQ(parts_of(ring, {{"a", 0}}, {50}), (Parts{{0, 0, 0, 0.3}, {0, 0, 0.8, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}}));
  EXPECT_EQ(parts_of(ring, {{"a", 0}}, {50, 75}).size(), 5u) << "the rest of it is the second band";
  EXPECT_EQ(parts_of(ring, {{"a", 0}}, {75}).size(), 3u);
}

TEST(StreetReach, OneWayStreetsAreReachedFromTheirStartOnly) {
  const std::vector<ReachStreet> streets{{"s", "a", "b", 100, kUnreached}};
  EXPECT_EQ(parts_of(streets, {{"a", 0}}, {50}), (Parts{{0, 0, 0, 0.5}}));
  EXPECT_EQ(parts_of(streets, {{"b", 0}}, {50}), Parts{});
}

TEST(StreetReach, ForbiddenTurnsAreNotTaken) {
  const std::vector<ReachStreet> streets{{"in", "a", "b", 100, 100}, {"left", "b", "c", 100, 100}, {"on", "b", "d", 100, 100}};
  const std::vector<ReachEntry> entries{{"a", 0}};
  const std::vector<double> times{150};
  const std::vector<DistrictRules> rules{{"b", {{"in", "left", "no"}}}};
  EXPECT_EQ(*reached_parts(streets, entries, times), (Parts{{0, 0, 0, 1}, {1, 0, 0, 0.5}, {2, 0, 0, 0.5}}));
  EXPECT_EQ(*reached_parts(streets, entries, times, rules), (Parts{{0, 0, 0, 1}, {2, 0, 0, 0.5}}));
  const std::vector<ReachEntry> there{{"b", 0}};
  EXPECT_EQ(reached_parts(streets, there, times, rules)->size(), 3u) << "who sets out there may go anywhere";
}

TEST(StreetReach, ARoundIsBegunFromBothSides) {
  const std::vector<ReachStreet> streets{{"in", "a", "b", 20, 20}, {"round", "b", "b", 100, 100}};
  EXPECT_EQ(parts_of(streets, {{"a", 0}}, {20, 50}), (Parts{{0, 0, 0, 1}, {1, 1, 0, 0.3}, {1, 1, 0.7, 1}}));
  EXPECT_EQ(parts_of(streets, {{"a", 0}}, {80}), (Parts{{0, 0, 0, 1}, {1, 0, 0, 1}})) << "they meet";
  EXPECT_EQ(parts_of({{"round", "b", "b", 100, kUnreached}}, {{"b", 10}}, {60}), (Parts{{0, 0, 0, 0.5}}));
  EXPECT_EQ(parts_of({{"round", "b", "b", kUnreached, kUnreached}}, {{"b", 10}}, {60}), Parts{});
  const auto broken = reached_parts(std::vector<ReachStreet>{{"round", "b", "b", -5, 5}}, std::vector<ReachEntry>{{"b", 0}},
                                    std::vector<double>{50});
  ASSERT_FALSE(broken.ok());
  EXPECT_EQ(broken.error().place, "round:forth");
}

TEST(StreetReach, BrokenNumbersAreAnErrorWithAPlace) {
  const auto parts = reached_parts(std::vector<ReachStreet>{{"s", "a", "b", -5, kUnreached}}, std::vector<ReachEntry>{{"a", 0}},
                                   std::vector<double>{50});
  ASSERT_FALSE(parts.ok());
  EXPECT_EQ(parts.error().place, "s:forth");
}

// Every point of a street is in the band of the sooner of its two ends' times.
TEST(StreetReach, AgreesWithTheTimesAtPointsOfAGrid) {
  constexpr int kSide = 6;
  Random random(11);
  std::vector<ReachStreet> streets;
  const auto name = [](int x, int y) { return "c" + std::to_string(x) + "_" + std::to_string(y); };
  for (int x = 0; x < kSide; ++x)
    for (int y = 0; y < kSide; ++y)
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (x + dx >= kSide || y + dy >= kSide) continue;
        const double back = random.uniform() < 0.2 ? kUnreached : 10 + 90 * random.uniform();
        streets.push_back(
            {name(x, y) + name(x + dx, y + dy), name(x, y), name(x + dx, y + dy), 10 + 90 * random.uniform(), back});
      }
  // Times at the junctions by going round and round until nothing gets shorter.
  std::map<std::string, double> at;
  for (const ReachStreet& s : streets) at[s.start] = at[s.end] = kUnreached;
  at[name(2, 3)] = 15;
  for (int round = 0; round < kSide * kSide; ++round)
    for (const ReachStreet& s : streets) {
      at[s.end] = std::min(at[s.end], at[s.start] + s.forth);
      at[s.start] = std::min(at[s.start], at[s.end] + s.back);
    }
  const std::vector<double> times{60, 120, 180};
  const Parts parts = parts_of(streets, {{name(2, 3), 15}}, times);
  std::size_t looked_at = 0;
  for (std::size_t s = 0; s < streets.size(); ++s)
    for (int k = 0; k < 40; ++k) {
      const double share = (k + 0.5) / 40;
      const double time =
          std::min(at[streets[s].start] + share * streets[s].forth, at[streets[s].end] + (1 - share) * streets[s].back);
      const auto band = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
      if (band < times.size() && std::abs(time - times[band]) < 1e-9) continue;
      std::size_t found = times.size();
      for (const ReachedPart& part : parts)
        if (part.street == s && part.begin <= share && share <= part.end) found = part.band;
      EXPECT_EQ(found, band) << streets[s].id << " at " << share;
      ++looked_at;
    }
  EXPECT_GT(looked_at, 2000u);
}

}  // namespace
}  // namespace bl::traffic
