// Views: of a scene with volumes, votes and a role card; and the law that differences add up to the whole.
#include "core/wire/views.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/json_text.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"

namespace bl::wire {
namespace {

// A page's own table, kept by messages alone.
void apply(View& view, const std::string& message) {
  const Json json = *parse_json(message);
  for (const auto& [key, content] : json["set"].get_ref<const Json::object_t&>()) view[key] = write_json_line(content);
  if (json.contains("drop"))
    for (const Json& key : json["drop"]) view.erase(key.get<std::string>());
}

TEST(Views, DifferencesAddUpToTheWhole) {
  World world = World::from_file("scenes/start/quarter.json");
  room::Room room(world.session().ledger(), {});
  const auto admitted = room.admit({.role = Role::facilitator}, {0, 0});
  ASSERT_TRUE(std::holds_alternative<room::Admission>(admitted));
  Random random(3);
  std::map<std::string, View> before, told;
  int sent = 0;
  for (int k = 0; k < 120; ++k) {
    (void)world.session().submit(random_command(world.session().scene(), random, k), "anna");
    world.tick(1 + static_cast<int>(random.below(3)));
    const ViewSources sources{world.state(), room, "CODE", "Title"};
    for (const std::string_view view : kViewNames) {
      const std::string name(view);
      const View now = make_view(name, sources, 1);
      const auto changes = changes_of(name, before.contains(name) ? &before[name] : nullptr, now, k, k);
      if (changes) {
        apply(told[name], *changes);
        ++sent;
      }
      ASSERT_EQ(told[name], now) << name << ", step " << k;
      ASSERT_FALSE(changes_of(name, &now, now, k, k).has_value());
      before[name] = now;
    }
  }
  EXPECT_GT(sent, 100);
}

TEST(Views, ThePlanHasEveryVolumeAndItsBoxHoldsThem) {
  World world = World::from_file("scenes/start/quarter.json");
  world.settle();
  room::Room room(world.session().ledger(), {});
  const View plan = make_view("plan", {world.state(), room, "", ""}, 0);
  std::size_t volumes = 0;
  for (const auto& [key, content] : plan) {
    const Json node = *parse_json(content);
    if (key == "box" || node["kind"] != "volume") continue;
    ++volumes;
    EXPECT_EQ(node["d"].get<std::string>().substr(0, 1), "M");
    EXPECT_TRUE(node["d"].get<std::string>().ends_with("z"));
    EXPECT_EQ(node["figures"].size(), 4u);
  }
  std::size_t carried = 0;
  for (const auto& [id, node] : world.session().scene().nodes) carried += node.types.contains("smart_volume") ? 1 : 0;
  EXPECT_EQ(volumes, carried);
  EXPECT_EQ(parse_json(plan.at("box"))->size(), 4u);
}

TEST(Views, AnUnknownViewIsEmpty) {
  EXPECT_FALSE(is_view("secrets"));
  EXPECT_TRUE(is_view("plan"));
  EXPECT_TRUE(is_of_seat("card"));
}

}  // namespace
}  // namespace bl::wire
