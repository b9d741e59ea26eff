// Height limits that take storeys and give them back, by hand.
#include "core/demand/storey_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/standing_tick.h"

namespace bl::demand {
namespace {

// A volume with what its solver knows of the last tick.
struct Tower : StandingVolume {
  double least_room = 0;
};
Tower tower(int built, double limit) { return {{built, 8, 2, 3, limit, false}, built < 8 ? limit / 3 : 0}; }

// What a solver of standing volumes makes of it.
void follow(Tower& volume, std::optional<double> limit) {
  geometry::StandingWish wish;
  wish.site.storey_height = volume.storey_height;
  wish.storeys = volume.wished;
  wish.built = volume.built;
  wish.least_room = volume.least_room;
  wish.height_limit = volume.limit = limit.value_or(1e6);
  const geometry::Storeys storeys = geometry::storeys_of(wish, 1000);
  volume.built = storeys.count;
  volume.least_room = storeys.least_room;
}

TEST(StoreyLimit, FallsByAStoreyInTenTicks) {
  Tower volume = tower(8, 1e6);
  int ticks = 0;
  for (; ticks < 100 && volume.built == 8; ++ticks) follow(volume, lower_limit(volume, kStoreyPace, 0.2));
  // From one storey above the roof, where a limit begins to count.
  EXPECT_EQ(ticks, 11);
  EXPECT_EQ(volume.built, 7);
  for (ticks = 0; ticks < 100 && volume.built == 7; ++ticks) follow(volume, lower_limit(volume, kStoreyPace, 0.2));
  EXPECT_EQ(ticks, 10);
}

TEST(StoreyLimit, NeverFallsBelowTheLeast) {
  Tower volume = tower(8, 1e6);
  for (int tick = 0; tick < 200; ++tick) follow(volume, lower_limit(volume, kStoreyPace, 0.2));
  EXPECT_EQ(volume.built, 2);
  EXPECT_TRUE(is_at_least(volume, 0.2));
  EXPECT_EQ(least_storeys(volume, 0.5), 4);
  EXPECT_EQ(held_at_least("tower", volume, 0.2), "held by `tower`, which keeps at least 2 storeys (`storeys_min`)");
  EXPECT_EQ(way_to_fewer(volume, 0.2), "lower `storeys_min` and `least`");
  EXPECT_EQ(way_to_fewer(volume, 0.1), "lower `storeys_min`");
  volume.built = 4;
  EXPECT_EQ(way_to_fewer(volume, 0.4), "lower `least`");
  volume.least = 1;
  EXPECT_EQ(held_at_least("tower", volume, 0.2), "held by `tower`, which keeps at least 2 storeys (`least`: 20 % of 8)");
  EXPECT_EQ(way_to_fewer(volume, 0.1), "lower `storey_height`") << "one storey is the least of all";
}

// A boundary that is lower than the least storeys leaves fewer of them: who has twelve does not keep a hundred.
TEST(StoreyLimit, WhoHasFewerThanTheLeastIsToldWithThese) {
  StandingVolume volume{12, 500, 1, 3.3, 330, false};
  ASSERT_TRUE(is_at_least(volume, 0.2));
  EXPECT_EQ(held_at_least("tower", volume, 0.2),
            "held by `tower`, which has 12 storeys, none of which is taken, because it may keep 100 (`least`: 20 % of 500)");
  EXPECT_EQ(way_to_fewer(volume, 0.2), "lower `storeys` or `least`");
  volume.least = 200;
  EXPECT_EQ(held_at_least("tower", volume, 0.2),
            "held by `tower`, which has 12 storeys, none of which is taken, because it may keep 200 (`storeys_min`)");
  EXPECT_EQ(way_to_fewer(volume, 0.2), "lower `storeys_min`");
  volume.built = 1;
  EXPECT_NE(held_at_least("tower", volume, 0.2).find("which has 1 storey, which is not taken, because"), std::string::npos);
}

TEST(StoreyLimit, RestsWhereItTakesStoreysAndGoesWhereItTakesNone) {
  Tower volume = tower(6, 19.9);
  EXPECT_TRUE(takes_storeys(volume, 19.9));
  EXPECT_DOUBLE_EQ(kept_limit(volume).value(), 19.9);
  EXPECT_FALSE(kept_limit(tower(8, 1e6)).has_value());
  // A little above the roof it is on its way down or up, and nothing holds it there.
  volume = tower(8, 24.6);
  for (int tick = 0; tick < 20; ++tick) follow(volume, kept_limit(volume));
  EXPECT_EQ(volume.limit, 1e6);
}

TEST(StoreyLimit, GivesStoreysBackOneAfterTheOther) {
  Tower volume = tower(6, 18.0);
  int ticks = 0;
  for (; ticks < 100 && volume.built == 6; ++ticks) follow(volume, higher_limit(volume));
  EXPECT_EQ(volume.built, 7);
  EXPECT_GE(ticks, 10);
  for (; ticks < 100; ++ticks) follow(volume, higher_limit(volume));
  EXPECT_EQ(volume.built, 8);
  EXPECT_EQ(volume.limit, 1e6);
}

// A limit that follows from a height trembles with what it follows from; storeys do not.
TEST(StoreyLimit, AHeightThatTremblesTakesAStoreyOnce) {
  Tower volume = tower(8, 1e6);
  int changes = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const int before = volume.built;
    follow(volume, limit_at(volume, 18 + 0.2 * std::sin(tick), 0.2));
    changes += volume.built != before ? 1 : 0;
  }
  EXPECT_LE(changes, 2);
  EXPECT_EQ(volume.built, 5);
  EXPECT_EQ(storeys_left(volume, 17.9), "5 of 8 storeys, because it may be no higher than 17.90 m");
  EXPECT_EQ(storeys_left(volume, 18),
            "5 of 8 storeys, because it may be no higher than 18.00 m (one more comes back from 18.45 m on)");
}

}  // namespace
}  // namespace bl::demand
