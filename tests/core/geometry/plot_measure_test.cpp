// Heights on a plot: from the ground of what stands on it, also for what stands upon that.
#include "core/geometry/plot_measure.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace bl::test {
namespace {

// A slope from 10 m to 30 m above a plot at 12 m: a podium at 14 m carries flats, and these a tower.
TEST(PlotMeasure, HeightsCountFromTheGroundOfWhatCarriesAVolume) {
  const std::vector<geometry::HeightBase> volumes = {{"tower", "flats", 28},
                                                     {"podium", geometry::kTheGround, 14},
                                                     {"flats", "podium", 20},
                                                     {"uphill", geometry::kTheGround, 30},
                                                     {"downhill", geometry::kTheGround, 10},
                                                     {"ball", "podium", std::nullopt}};
  EXPECT_EQ(geometry::height_bases(volumes, 12), (std::vector<double>{14, 14, 14, 30, 12, 14}));
}

// Who stands upon itself, or upon nobody of the plot, ends the way.
TEST(PlotMeasure, CirclesEnd) {
  const std::vector<geometry::HeightBase> volumes = {{"a", "b", 5}, {"b", "a", 5}, {"c", "elsewhere", 7}};
  EXPECT_EQ(geometry::height_bases(volumes, 0), (std::vector<double>{5, 5, 7}));
}

}  // namespace
}  // namespace bl::test
