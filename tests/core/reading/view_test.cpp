// Views give what the ports of a state hold, row by row, and what people have set where nothing has run.
#include "core/reading/view.h"

#include <gtest/gtest.h>

#include "core/reading/views/node.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/programme.h"
#include "core/reading/views/volume.h"
#include "core/session/commands.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

using reading::NodePlace;
using reading::VolumeFigures;

constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "site", "types": {"boundary": {}}},
  {"id": "solver", "types": {"smart_volumes_solver": {}}},
  {"id": "a", "position": [-5, 0, 5], "types": {"smart_volume": {"use": "housing", "demand": 500}}},
  {"id": "b", "name": "Hall", "position": [5, 0, 5], "types": {"plot": {}, "smart_volume": {"demand": 300}}}],
  "links": [{"id": "brief", "kind": "demand", "from": "site", "to": "a", "parameters": {"use": "office"}},
            {"id": "pair", "kind": "keep_distance", "from": "a", "to": "b", "parameters": {"minimum": 15}}]})";

TEST(Views, RowsAreTheNodesOfTheTypificationInOrder) {
  World world = World::from_text(kScene);
  world.tick(20);
  const State& state = world.state();
  const auto rows = reading::rows<VolumeFigures>(state);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(state.plan->nodes[rows[0].node].id, "a");
  EXPECT_EQ(state.plan->nodes[rows[1].node].id, "b");
  EXPECT_EQ(rows[0].figures.use, "housing");
  EXPECT_EQ(rows[0].figures.state, "alive");
  EXPECT_EQ(rows[0].figures.volume, world.number("a", "smart_volume.volume"));
  EXPECT_EQ(rows[1].figures.demand, 300);
  EXPECT_EQ(rows[1].figures.mesh, world.mesh("b", "smart_volume.mesh"));
  EXPECT_EQ(rows[1].figures.position, world.point("b", "node.position"));
  EXPECT_EQ(&*rows[1].figures.neighbours, &world.table("b", "smart_volume.neighbours")) << "tables are shared, not copied";
}

TEST(Views, OneRowOrOneMemberCanBeRead) {
  World world = World::from_text(kScene);
  world.tick(5);
  const State& state = world.state();
  const std::uint32_t a = state.plan->node_index("a"), site = state.plan->node_index("site");
  ASSERT_TRUE(reading::row_of<VolumeFigures>(state, a).has_value());
  EXPECT_EQ(reading::row_of<VolumeFigures>(state, a)->weight, world.number("a", "smart_volume.weight"));
  EXPECT_EQ(reading::read<&VolumeFigures::weight>(state, a), world.number("a", "smart_volume.weight"));
  EXPECT_FALSE(reading::row_of<VolumeFigures>(state, site).has_value());
  EXPECT_EQ(reading::read<&VolumeFigures::weight>(state, site), 0);
  EXPECT_FALSE(reading::row_of<VolumeFigures>(state, 99).has_value());
  EXPECT_TRUE(reading::is_a<VolumeFigures>(state, a));
  EXPECT_FALSE(reading::is_a<VolumeFigures>(state, site));
  EXPECT_TRUE(reading::is_a<NodePlace>(state, site));
  EXPECT_EQ(reading::path_of<&VolumeFigures::position>(), "node.position");
  const auto port = reading::port_of<&VolumeFigures::demand>(*state.plan, a);
  ASSERT_TRUE(port.has_value());
  EXPECT_EQ(state.plan->path_text(*port), "smart_volume.demand");
}

TEST(Views, TensionIsThatOfThePort) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<LockPort>({"a", {"node.position"}})), "");
  world.tick(3);
  const std::uint32_t a = world.state().plan->node_index("a");
  ASSERT_GT(world.tension("a", "node.position"), 0);
  EXPECT_EQ(reading::row_of<NodePlace>(world.state(), a)->tension, world.tension("a", "node.position"));
}

// The ports of a view are looked for once in a plan, and once more only where its structure is another one.
TEST(Views, PortsAreKeptWithThePlan) {
  World world = World::from_text(kScene);
  world.tick();
  const auto first = reading::ports_of(VolumeFigures::view(), *world.state().plan);
  ASSERT_EQ(world.submit(command<SetPort>({"a", {"smart_volume.demand"}, {"400"}})), "");
  world.tick();
  EXPECT_EQ(reading::ports_of(VolumeFigures::view(), *world.state().plan), first);
  ASSERT_EQ(world.submit(command<RemoveNode>({"a"})), "");
  world.tick();
  EXPECT_NE(reading::ports_of(VolumeFigures::view(), *world.state().plan), first);
  ASSERT_EQ(reading::rows<VolumeFigures>(world.state()).size(), 1u);
  EXPECT_EQ(reading::rows<VolumeFigures>(world.state()).front().figures.demand, 300);
}

TEST(Views, SettingsAreWhatPeopleSaidAndDefaultsElsewhere) {
  World world = World::from_text(kScene);
  const Scene& scene = world.session().scene();
  const auto a = reading::settings_of<VolumeFigures>(scene, full_registry(), scene.nodes.at("a"));
  ASSERT_TRUE(a.has_value());
  EXPECT_EQ(a->use, "housing");
  EXPECT_EQ(a->position, (Point3{-5, 0, 5}));
  EXPECT_EQ(a->storey_height, as_number(full_registry().typification("smart_volume")->find_port("storey_height")->default_value));
  EXPECT_FALSE(reading::settings_of<VolumeFigures>(scene, full_registry(), scene.nodes.at("site")).has_value());
  EXPECT_EQ(reading::setting<&VolumeFigures::demand>(scene, full_registry(), scene.nodes.at("b")), 300.0);
  EXPECT_FALSE(reading::setting<&VolumeFigures::demand>(scene, full_registry(), scene.nodes.at("site")).has_value());
  EXPECT_TRUE(reading::is_a<reading::PlotFigures>(scene.nodes.at("b")));
}

TEST(Views, ParametersOfLinksHaveTheirDefaults) {
  World world = World::from_text(kScene);
  const Plan& plan = *world.state().plan;
  const Scene& scene = world.session().scene();
  for (const LinkPlan& link : plan.links) {
    const auto demand = reading::parameters_of<reading::DemandParameters>(link);
    EXPECT_EQ(demand.has_value(), link.id == "brief");
    if (demand) { EXPECT_EQ(demand->use, "office"); }
  }
  const auto said = reading::parameters_of<reading::DemandParameters>(scene.links.at("brief"), full_registry());
  ASSERT_TRUE(said.has_value());
  EXPECT_EQ(said->use, "office");
  LinkRecord rules;
  rules.kind = "plot_rules";
  rules.parameters["hold_gsi"] = false;
  const auto held = reading::parameters_of<reading::PlotRuleParameters>(rules, full_registry());
  ASSERT_TRUE(held.has_value());
  EXPECT_TRUE(held->hold_fsi);
  EXPECT_FALSE(held->hold_gsi);
}

}  // namespace
}  // namespace bl::reading
