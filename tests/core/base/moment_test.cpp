// Moments as text: laws of zones, then examples.
#include "core/base/moment.h"

#include <gtest/gtest.h>

namespace bl {
namespace {

constexpr std::int64_t kMorning = 1772357400000;  // 2026-03-01 09:30 UTC

TEST(Moments, AZoneIsReadAsItIsWritten) {
  for (int minutes = -14 * 60; minutes <= 14 * 60; ++minutes) {
    EXPECT_EQ(read_zone(zone_text(minutes)), minutes);
    const std::string text = moment_text(kMorning, minutes), moved = moment_text(kMorning + minutes * std::int64_t{60000});
    EXPECT_EQ(text.substr(0, 16), moved.substr(0, 16)) << "clocks that are ahead show a later time";
    EXPECT_EQ(text.substr(17), zone_text(minutes));
  }
}

TEST(Moments, WhatIsNoZoneIsNone) {
  for (const char* text :
       {"", "utc", "Z", "+1:00", "+01:60", "+14:01", "-15:00", "+01.00", "01:00", "+0100", "+01:00 ", "Europe/Berlin"})
    EXPECT_FALSE(read_zone(text)) << text;
}

TEST(Moments, Examples) {
  EXPECT_EQ(moment_text(kMorning), "2026-03-01 09:30 UTC");
  EXPECT_EQ(moment_text(kMorning, 60), "2026-03-01 10:30 +01:00");
  EXPECT_EQ(moment_text(kMorning, -600 - 30), "2026-02-28 23:00 -10:30");
}

}  // namespace
}  // namespace bl
