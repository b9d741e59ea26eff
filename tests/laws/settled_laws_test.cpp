// Settled means still: of every shipped scene that settles, nothing changes any more that anybody could see.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/sanitized.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Ticks in which a scene may settle, those in which it has to stay settled, and after which it stands still to the last bit.
// Large studies cost seconds for each tick.
constexpr int kToSettle = 400, kSettled = 500, kStill = 1100, kSettledLarge = 60;
// The sum of all volumes stays within this share of itself, and each volume in the first ticks within this share of its own: what
// its solver calls met, on either side of what is wanted.
constexpr double kBand = 0.01;
constexpr int kFirst = 200;

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

std::map<std::string, double> volumes(const State& state) {
  std::map<std::string, double> volumes;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, PortPath{"smart_volume", "volume", ""}))
      volumes[state.plan->nodes[n].id] = as_number(state.value(*ref));
  return volumes;
}

// Who differs by more than the solver's tolerance on either side.
std::string changed(const std::map<std::string, double>& before, const std::map<std::string, double>& after) {
  std::string text;
  for (const auto& [id, volume] : before)
    if (const double now = after.at(id); std::abs(now - volume) > kBand * std::max(volume, 1.0))
      text += " " + id + " from " + std::to_string(volume) + " to " + std::to_string(now);
  return text;
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
  ASSERT_TRUE(world.settle(is_large ? 3 * kToSettle / 4 : kToSettle));
  const double total = total_volume(world.state());
  const auto settled = volumes(world.state());
  for (int i = 0; i < (is_large ? kSettledLarge : kStill); ++i) {
    world.tick();
    ASSERT_TRUE(world.state().is_settled()) << "tick " << world.state().tick;
    ASSERT_FALSE(first_work(world.state())) << first_work(world.state())->text();
    if (i < kFirst) { ASSERT_EQ(changed(settled, volumes(world.state())), "") << "tick " << world.state().tick; }
    if (i >= kSettled) continue;
    ASSERT_LE(std::abs(total_volume(world.state()) - total), kBand * total) << "tick " << world.state().tick;
  }
  if (is_large) return;
  const std::vector<Value> last = shown(world.state());
  world.tick(20);
  EXPECT_EQ(world.state().largest_move, 0);
  EXPECT_TRUE(shown(world.state()) == last);
}

// What people may say of a rule so that nobody can follow it: all that could give way is locked.
void lock_all(World& world) {
  const Scene scene = world.state().plan->scene;
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("smart_volume")) continue;
    world.submit(command<LockPort>({.node = id, .port = {"smart_volume.demand_limit"}}));
    world.submit(command<LockPort>({.node = id, .port = {"node.position"}}));
  }
}

// The rules that links of a scene are to hold, and whether one is broken: reckoned here, from figures alone.
std::string broken_rule(const World& world) {
  const State& state = world.state();
  const auto number = [&](std::uint32_t node, const char* path) {
    const auto ref = state.plan->find(node, *parse_port_path(path));
    return ref ? as_number(state.value(*ref)) : 0;
  };
  for (const LinkPlan& link : state.plan->links) {
    const LinkRecord& record = state.plan->scene.links.at(link.id);
    const auto parameter = [&](const char* id, double otherwise) {
      const auto found = record.parameters.find(id);
      return found != record.parameters.end() ? as_number(found->second) : otherwise;
    };
    if (!link.is_enabled || link.is_muted || link.nodes[0].empty()) continue;
    const std::uint32_t from = link.nodes[0].front();
    if (record.kind == "set_cap" && number(from, "statistics.sum") > parameter("cap", 10000)) return link.id;
    if (record.kind == "plot_rules" &&
        (number(from, "plot.fsi") > number(from, "plot.fsi_max") || number(from, "plot.gsi") > number(from, "plot.gsi_max")))
      return link.id;
    if (record.kind != "solar_right") continue;
    const double required = number(from, "shadow_receiver.required_sun");
    const double missing =
        number(from, "shadow_receiver.deficit") - std::max(0.0, required - number(from, "shadow_receiver.sun_possible"));
    if (required > 0 && missing > 1.2 * parameter("tolerance", 0.02) * required) return link.id;
  }
  return "";
}

// A rule that is broken where nothing moves any more is always a problem with a name, and never at work for ever.
TEST_P(SettledLaws, ARuleThatIsBrokenAtRestIsAProblem) {
  World world = World::from_file(GetParam());
  const auto small = small_scenes();
  const bool is_large = std::find(small.begin(), small.end(), GetParam()) == small.end();
  for (const bool is_locked : {false, true}) {
    if (is_locked) lock_all(world);
    world.tick(is_large || test::kIsSanitized ? 120 : 400);
    const std::string broken = broken_rule(world);
    EXPECT_FALSE(world.state().is_settled() && first_work(world.state())) << first_work(world.state())->text();
    if (broken.empty()) continue;
    EXPECT_FALSE(world.state().is_settled()) << broken;
    if (!is_locked) continue;
    const std::string said = world.link_error(broken);
    EXPECT_NE(said.find("cannot be met"), std::string::npos) << broken << " " << said;
  }
}

// Hundreds of ticks of a large study take minutes under sanitizers, and hold nothing that those of the small scenes do not.
INSTANTIATE_TEST_SUITE_P(Scenes, SettledLaws, testing::ValuesIn(test::kIsSanitized ? small_scenes() : shipped_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

}  // namespace
}  // namespace bl
