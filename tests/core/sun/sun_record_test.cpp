// What a receiver is short of, on all of its area or on the share of it with the most sun.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/sun/sun_study.h"

namespace bl::sun {
namespace {

SunRecord judged(std::vector<double> seconds, double required, double share) {
  SunRecord record;
  record.hours.seconds = std::move(seconds);
  SunReceiver receiver;
  receiver.required = required;
  receiver.required_share = share;
  record.judge(receiver);
  return record;
}

TEST(SunRecords, LawTheSunniestPointsOfTheShareCount) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    std::vector<double> sun(1 + random.below(40));
    // Many points have exactly the same, as behind one wall.
    for (double& seconds : sun) seconds = 1800.0 * static_cast<double>(random.below(12));
    const double required = 1800.0 * static_cast<double>(1 + random.below(10));
    std::vector<double> most_first = sun;
    std::sort(most_first.begin(), most_first.end(), std::greater());
    double last = -1;
    for (std::size_t counted = 1; counted <= sun.size(); ++counted) {
      const SunRecord record = judged(sun, required, static_cast<double>(counted) / static_cast<double>(sun.size()));
      double deficit = 0;
      for (std::size_t i = 0; i < counted; ++i) deficit += std::max(0.0, required - most_first[i]) / static_cast<double>(counted);
      EXPECT_NEAR(record.deficit, deficit, 1e-9) << seed << " " << counted;
      EXPECT_EQ(record.of_share, most_first[counted - 1]);
      EXPECT_GE(record.deficit, last - 1e-9) << "who asks for more lacks no less";
      last = record.deficit;
      EXPECT_EQ(record.least, most_first.back());
      EXPECT_EQ(record.most, most_first.front());
    }
  }
}

TEST(SunRecords, HalfOfAGardenMayLieInTheShade) {
  const std::vector<double> sun = {0, 0, 7200, 9000};
  EXPECT_EQ(judged(sun, 7200, 0.5).deficit, 0);
  EXPECT_EQ(judged(sun, 7200, 0.5).of_share, 7200);
  EXPECT_EQ(judged(sun, 7200, 1).deficit, 3600);
  EXPECT_EQ(judged(sun, 7200, 0.75).deficit, 2400);
  EXPECT_EQ(judged(sun, 7200, 0.01).of_share, 9000) << "one point at the least";
}

}  // namespace
}  // namespace bl::sun
