// Plans amended for new values are those that compiling gives, and so are the states that go on with them.
#include "core/graph/amend.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/file/scene_file.h"
#include "core/graph/carry.h"
#include "core/graph/simulation.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/random_values.h"
#include "tests/support/world.h"

namespace bl {
namespace {

void expect_same(const Plan& a, const Plan& b, const std::string& where) {
  EXPECT_EQ(a.scene, b.scene) << where;
  ASSERT_EQ(a.nodes.size(), b.nodes.size()) << where;
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    EXPECT_EQ(a.nodes[n].name, b.nodes[n].name) << where;
    ASSERT_EQ(a.nodes[n].types.size(), b.nodes[n].types.size()) << where;
    for (std::size_t t = 0; t < a.nodes[n].types.size(); ++t) {
      const TypePlan &x = a.nodes[n].types[t], &y = b.nodes[n].types[t];
      EXPECT_TRUE(x.definition == y.definition && x.set_values == y.set_values && x.is_set == y.is_set &&
                  x.is_locked == y.is_locked && x.is_served == y.is_served)
          << where << " " << a.nodes[n].id;
    }
  }
  ASSERT_EQ(a.links.size(), b.links.size()) << where;
  for (std::size_t l = 0; l < a.links.size(); ++l) {
    const LinkPlan &x = a.links[l], &y = b.links[l];
    EXPECT_TRUE(x.definition == y.definition && x.strength == y.strength && x.nodes[0] == y.nodes[0] &&
                x.nodes[1] == y.nodes[1] && x.reads == y.reads && x.targets == y.targets && x.writes == y.writes &&
                x.error.has_value() == y.error.has_value())
        << where << " " << x.id;
  }
  ASSERT_EQ(a.sets.size(), b.sets.size()) << where;
  for (std::size_t s = 0; s < a.sets.size(); ++s)
    EXPECT_TRUE(a.sets[s].members == b.sets[s].members && a.sets[s].reads == b.sets[s].reads &&
                a.sets[s].writes == b.sets[s].writes)
        << where;
}

// What a scene holds of the value, as commands leave it: nothing where it is the default.
void put(Scene& scene, const std::string& node, const TypificationDefinition& type, const PortDefinition& port,
         const Value& value) {
  PortValues& values = scene.nodes.edit(node).types.at(type.id);
  if (value == port.default_value) values.erase(port.id);
  else values[port.id] = value;
}

TEST(Amend, GivesWhatCompilingGivesForAnyValueOfAnyScene) {
  int amended = 0;
  for (const char* folder : {"scenes/nodes", "scenes/links", "scenes/studies"})
    for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(test::source_folder()) / folder)) {
      if (file.path().extension() != ".json" || file.path().stem() == "thousand_volumes") continue;
      const std::string where = file.path().stem().string();
      SceneReading reading =
          read_scene(project_file(std::string(folder) + "/" + file.path().filename().string()), full_registry());
      ASSERT_TRUE(reading.is_usable()) << where;
      Simulation simulation(full_registry(), 1);
      simulation.set_scene(reading.scene);
      simulation.step();
      Scene scene = reading.scene;
      Random random(3, scene.nodes.size());
      for (int round = 0; round < 25; ++round) {
        const std::uint64_t which = random.below(scene.nodes.size());
        const auto node = std::next(scene.nodes.begin(), static_cast<std::ptrdiff_t>(which));
        const auto& plans = simulation.state()->plan->nodes[which].types;
        const TypificationDefinition& type = *plans[random.below(plans.size())].definition;
        const PortDefinition& port = type.ports[random.below(type.ports.size())];
        if (port.is_computed || port.kind == ValueKind::selection) continue;
        Scene changed = scene;
        put(changed, node->first, type, port, random.below(4) == 0 ? port.default_value : random_value(port, random));
        const std::set<std::pair<std::string, std::string>> placed{{node->first, type.id + "." + port.id}};
        const auto plan = compile(changed, full_registry());
        const auto quick = amend(*simulation.state()->plan, changed, full_registry());
        ASSERT_TRUE(quick.has_value());
        ++amended;
        expect_same(*quick->plan, *plan, where + " " + node->first + "." + type.id + "." + port.id);
        const State expected = carry(*simulation.state(), plan, placed);
        const auto found = simulation.with_scene(changed, placed);
        ASSERT_EQ(found->hash, expected.hash) << where << " " << type.id << "." << port.id;
        for (std::size_t n = 0; n < found->nodes.size(); ++n)
          for (std::size_t t = 0; t < found->nodes[n].types.size(); ++t)
            EXPECT_EQ(found->nodes[n].types[t].is_evaluated, expected.nodes[n].types[t].is_evaluated) << where;
        if (round % 3 == 0) scene = std::move(changed), simulation.set_scene(scene, placed);
      }
    }
  EXPECT_GT(amended, 300);
}

TEST(Amend, OtherTypificationsAndSettingsAreCompiled) {
  const std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"sensor": {"unit": "m"}}}, {"id": "b", "types": {"control": {}}},
    {"id": "s", "types": {"statistics": {}}}], "links": []})";
  const World world = World::from_text(text);
  const Plan& plan = *world.state().plan;
  const auto with = [&](const std::string& node, const std::string& type, const std::string& port, const Value& value) {
    Scene scene = plan.scene;
    scene.nodes.edit(node).types.at(type)[port] = value;
    return amend(plan, scene, full_registry()).has_value();
  };
  EXPECT_TRUE(with("a", "sensor", "reading", 4.5));
  EXPECT_TRUE(with("a", "sensor", "connection", std::string("gone")));
  EXPECT_TRUE(with("a", "sensor", "unit", std::string("dB")));
  EXPECT_TRUE(with("s", "statistics", "port", std::string("control.value")));
  EXPECT_TRUE(with("a", "node", "tags", Shared<std::vector<std::string>>({"wet"})));
  Scene more = plan.scene, retyped = plan.scene, renamed = plan.scene, locked = plan.scene, settings = plan.scene;
  more.nodes["c"].types["node"];
  retyped.nodes.edit("b").types["sensor"];
  renamed.nodes.edit("a").name = "Gauge";
  locked.nodes.edit("b").locked.insert("control.value");
  settings.settings["calm_ticks"] = std::int64_t{9};
  for (const Scene& scene : {retyped, settings}) EXPECT_FALSE(amend(plan, scene, full_registry()).has_value());
  for (const Scene& scene : {more, renamed, locked}) EXPECT_TRUE(amend(plan, scene, full_registry()).has_value());
  EXPECT_TRUE(amend(plan, plan.scene, full_registry()).has_value());
}

}  // namespace
}  // namespace bl
