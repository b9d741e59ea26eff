// Settled means still: of every shipped scene that settles, nothing changes any more that anybody could see.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Ticks in which a scene may settle, and those in which it has to stay settled. Large studies cost seconds for each tick.
constexpr int kToSettle = 400, kStill = 500, kStillLarge = 60;
// The sum of all volumes stays within this share of itself: what the solver calls met.
constexpr double kBand = 0.005;

// Every number of every volume that people look at, one after the other.
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

TEST_P(SettledLaws, ASettledSceneStandsStill) {
  World world = World::from_file(GetParam());
  const auto small = small_scenes();
  const bool is_large = std::find(small.begin(), small.end(), GetParam()) == small.end();
  if (!world.settle(is_large ? kToSettle / 2 : kToSettle)) GTEST_SKIP() << "does not settle so soon";
  const double total = total_volume(world.state());
  const std::vector<Value> first = shown(world.state());
  for (int i = 0; i < (is_large ? kStillLarge : kStill); ++i) {
    world.tick();
    ASSERT_TRUE(world.state().is_settled()) << "tick " << world.state().tick;
    ASSERT_LE(std::abs(total_volume(world.state()) - total), kBand * total) << "tick " << world.state().tick;
    ASSERT_EQ(world.state().largest_move, 0) << "tick " << world.state().tick;
    ASSERT_TRUE(shown(world.state()) == first) << "tick " << world.state().tick;
  }
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
