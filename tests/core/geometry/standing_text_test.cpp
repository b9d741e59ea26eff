// Sentences about volumes that stand.
#include "core/geometry/standing_text.h"

#include <gtest/gtest.h>

namespace bl::geometry {
namespace {

TEST(StandingText, ThoseThatLackMostAreNamed) {
  const std::vector<std::string> names{"a", "b", "c", "d", "e"};
  const std::vector<FloorLoss> losses{{0, 100, 99}, {1, 100, 40}, {2, 500, 100}, {3, 100, 40}, {4, 100, 90}};
  EXPECT_EQ(floor_losses_text(losses, names),
            "; c has 100 of 500 m²; b has 40 of 100 m²; d has 40 of 100 m² and 2 more have too little");
  EXPECT_EQ(floor_losses_text(std::vector<FloorLoss>{{4, 100, 90}}, names), "; e has 90 of 100 m²");
  EXPECT_EQ(floor_losses_text({}, names), "");
}

}  // namespace
}  // namespace bl::geometry
