// Settled means still: of every shipped scene that settles, nothing changes any more that anybody could see.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Ticks in which a scene may settle, those in which it has to stay settled, and after which it stands still to the last bit.
// Large studies cost seconds for each tick.
constexpr int kToSettle = 400, kSettled = 500, kStill = 1100, kSettledLarge = 60;
// The sum of all volumes stays within this share of itself: twice what a solver calls met.
constexpr double kBand = 0.01;

// Where everything is and what every volume is given, one after the other.
std::vector<Value> shown(const State& state) {
  std::vector<Value> values;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (const char* path : {"node.position", "smart_volume.demand", "smart_volume.demand_limit", "smart_volume.wanted"}) {
      const auto parsed = parse_port_path(path);
      if (const auto ref = state.plan->find(n, *parsed)) values.push_back(state.value(*ref));
    }
  return values;
}

double total_volume(const State& state) {
  double total = 0;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, PortPath{"smart_volume", "volume", ""})) total += as_number(state.value(*ref));
  return total;
}

class SettledLaws : public testing::TestWithParam<std::string> {};

TEST_P(SettledLaws, ASettledSceneStaysSettledAndComesToAStandstill) {
  World world = World::from_file(GetParam());
  const auto small = small_scenes();
  const bool is_large = std::find(small.begin(), small.end(), GetParam()) == small.end();
  world.tick(10);  // files of older versions say by their own rules that they have settled
  ASSERT_TRUE(world.settle(is_large ? kToSettle / 2 : kToSettle));
  const double total = total_volume(world.state());
  for (int i = 0; i < (is_large ? kSettledLarge : kStill); ++i) {
    world.tick();
    ASSERT_TRUE(world.state().is_settled()) << "tick " << world.state().tick;
    if (i >= kSettled) continue;
    ASSERT_LE(std::abs(total_volume(world.state()) - total), kBand * total) << "tick " << world.state().tick;
  }
  if (is_large) return;
  const std::vector<Value> last = shown(world.state());
  world.tick(20);
  EXPECT_EQ(world.state().largest_move, 0);
  EXPECT_TRUE(shown(world.state()) == last);
}

std::string settled_test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SettledLaws, testing::ValuesIn(shipped_scenes()), settled_test_name);

}  // namespace
}  // namespace bl
