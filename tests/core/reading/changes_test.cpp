// What changed between two states is told by node and port, and nothing else is.
#include "core/reading/changes.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/reading/views/node.h"
#include "core/reading/views/volume.h"
#include "core/session/commands.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

using reading::Changes;
using reading::changes_between;

constexpr const char* kPair = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "one", "position": [0, 0, 0], "types": {"control": {"value": 3}}},
  {"id": "two", "position": [5, 0, 0], "types": {"control": {"value": 4}}}],
  "links": [{"id": "pair", "kind": "keep_distance", "from": "one", "to": "two", "muted": true}]})";

std::vector<std::string> paths(const State& state, const Changes& changes) {
  std::vector<std::string> all;
  for (const PortRef port : changes.ports) all.push_back(state.plan->nodes[port.node].id + "/" + state.plan->path_text(port));
  return all;
}

TEST(Changes, AStateDiffersFromItselfInNothing) {
  World world = World::from_text(kPair);
  world.tick(3);
  EXPECT_TRUE(changes_between(world.state(), world.state()).is_empty());
}

TEST(Changes, PortsThatHoldSomethingElseAreNamed) {
  World world = World::from_text(kPair);
  world.tick();
  const auto before = world.session().state();
  ASSERT_EQ(world.submit(command<SetPort>({"two", {"control.value"}, {"7"}})), "");
  world.tick();
  const Changes changes = changes_between(*before, world.state());
  EXPECT_EQ(paths(world.state(), changes), (std::vector<std::string>{"two/control.value", "two/control.output"}));
  EXPECT_TRUE(changes.retyped_nodes.empty() && changes.added_nodes.empty() && changes.removed_links.empty());
}

TEST(Changes, WhoComesAndGoesIsTold) {
  World world = World::from_text(kPair);
  world.tick();
  const auto before = world.session().state();
  ASSERT_EQ(world.submit(command<RemoveLink>({"pair"})), "");
  ASSERT_EQ(world.submit(command<RemoveNode>({"one"})), "");
  ASSERT_EQ(world.submit(command<AddNode>({"zero", {R"({"types": {}})"}})), "");
  ASSERT_EQ(world.submit(command<Typify>({"two", "plot", {"{}"}})), "");
  world.tick();
  const Changes changes = changes_between(*before, world.state());
  EXPECT_EQ(changes.added_nodes, std::vector<std::string>{"zero"});
  EXPECT_EQ(changes.removed_nodes, std::vector<std::string>{"one"});
  EXPECT_EQ(changes.removed_links, std::vector<std::string>{"pair"});
  EXPECT_EQ(changes.retyped_nodes, std::vector<std::string>{"two"});
  // All ports of the new role, and none of the old one.
  const std::vector<std::string> ports = paths(world.state(), changes);
  EXPECT_FALSE(ports.empty());
  for (const std::string& path : ports) EXPECT_TRUE(path.starts_with("two/plot.")) << path;
  const Changes back = changes_between(world.state(), *before);
  EXPECT_EQ(back.added_nodes, changes.removed_nodes);
  EXPECT_EQ(back.removed_nodes, changes.added_nodes);
}

TEST(Changes, MeshesAreComparedByIdentity) {
  World world = World::from_file("scenes/nodes/smart_volume.json");
  world.tick(5);
  const auto before = world.session().state();
  StateDraft draft(*before);
  const auto volumes = reading::rows<reading::VolumeFigures>(*before);
  ASSERT_FALSE(volumes.empty());
  const PortRef mesh = *reading::port_of<&reading::VolumeFigures::mesh>(*before->plan, volumes.front().node);
  ASSERT_NE(volumes.front().figures.mesh, nullptr);
  EXPECT_TRUE(changes_between(*before, StateDraft(*before).publish()).is_empty());
  draft.edit(mesh) = std::make_shared<const Mesh>(*volumes.front().figures.mesh);
  EXPECT_EQ(changes_between(*before, std::move(draft).publish()).ports, std::vector<PortRef>{mesh});
}

}  // namespace
}  // namespace bl::reading
