// Laws of ends that are read whole: what is kept of them from tick to tick comes to what reading all of them anew comes to.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/session/commands.h"
#include "tests/support/every_tick.h"
#include "tests/support/sanitized.h"

namespace bl {
namespace {

constexpr std::uint64_t kWholeEndVolumes = 30;

std::string volume_at(std::uint64_t number) { return "v" + std::to_string(100 + number); }

// Two sums that both cap all volumes, and zones that look for the nearest of junctions.
std::string capped(std::uint64_t seed) {
  Random random(seed);
  Json nodes = Json::array(), links = Json::array();
  const Json volumes = {{"typification", "smart_volume"}};
  for (std::uint64_t v = 0; v < kWholeEndVolumes; ++v)
    nodes.push_back({{"id", volume_at(v)},
                     {"position", {random.uniform(0, 100), random.uniform(0, 100), 0}},
                     {"types", {{"smart_volume", {{"demand", random.uniform(50, 500)}}}, {"junction", Json::object()}}}});
  for (const char* id : {"sum_a", "sum_b"})
    nodes.push_back(
        {{"id", id}, {"tags", {"sums"}}, {"types", {{"statistics", {{"port", "smart_volume.demand"}, {"nodes", volumes}}}}}});
  for (const char* id : {"zone_a", "zone_b"})
    nodes.push_back({{"id", id}, {"position", {random.uniform(0, 100), 50, 0}}, {"types", {{"traffic_zone", Json::object()}}}});
  links.push_back(
      {{"id", "cap"}, {"kind", "set_cap"}, {"from", {{"tag", "sums"}}}, {"to", volumes}, {"parameters", {{"cap", 4000}}}});
  links.push_back({{"id", "walk"},
                   {"kind", "access_route"},
                   {"from", {{"typification", "traffic_zone"}}},
                   {"to", {{"typification", "junction"}}},
                   {"parameters", {{"count", 3}}}});
  return Json{{"format", "behaviourlinks"}, {"version", 1}, {"settings", Json::object()}, {"nodes", nodes}, {"links", links}}
      .dump();
}

void change(World& world, std::uint64_t seed, int tick) {
  Random random(seed, static_cast<std::uint64_t>(tick));
  const std::string volume = volume_at(random.below(kWholeEndVolumes));
  const auto submit = [&](const Command& command) { (void)world.submit(command); };
  switch (random.below(16)) {
    case 0: return submit(command<LockPort>({volume, {"smart_volume.demand_limit"}}));
    case 1: return submit(command<RemoveNode>({volume}));
    case 2: return (void)world.session().undo(Author{"test"});
    // A statistic without a port fails, and what it computes is out of date.
    case 3: return submit(command<SetPort>({"sum_b", {"statistics.port"}, JsonValue::of(Json("smart_volume.nothing"))}));
    case 4: return submit(command<SetPort>({"sum_b", {"statistics.port"}, JsonValue::of(Json("smart_volume.demand"))}));
    case 5: return submit(command<SetLinkParameter>({"cap", "cap", JsonValue::of(Json(random.uniform(1000, 9000)))}));
    case 6: return;
    case 7:
    case 8:
    case 9:
      return submit(command<SetPort>(
          {volume, {"node.position"}, JsonValue::of(Json::array({random.uniform(0, 100), random.uniform(0, 100), 0}))}));
    default: return submit(command<SetPort>({volume, {"smart_volume.demand"}, JsonValue::of(Json(random.uniform(50, 500)))}));
  }
}

TEST(WholeEndLaws, EveryTickIsAsIfAllHadBeenReadAnew) {
  const std::uint64_t scenes = test::kIsSanitized ? 8 : 40;
  for (std::uint64_t seed = 0; seed < scenes && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    expect_the_same_states(capped(seed), 40, 1 + static_cast<int>(seed % 3),
                           [&](World& world, int tick) { change(world, seed, tick); });
  }
}

// What is kept belongs to the state that was evaluated last, and people go back to others.
TEST(WholeEndLaws, SoItIsAfterGoingBack) {
  World changed = World::from_text(capped(3)), everything = World::from_text(capped(3));
  everything.session().evaluate_everything(true);
  for (World* world : {&changed, &everything}) world->session().keep_states({6});
  for (int tick = 0; tick < 40 && !testing::Test::HasFatalFailure(); ++tick) {
    for (World* world : {&changed, &everything}) {
      // At first under the same plan, then under another one.
      if (tick == 12 || tick == 30) {
        ASSERT_TRUE(world->session().rewind(6, Author{"test"}).ok());
      } else if (tick < 6 || tick > 20) {
        change(*world, 5, tick);
      }
      world->tick();
    }
    expect_same(changed.state(), everything.state());
  }
}

}  // namespace
}  // namespace bl
