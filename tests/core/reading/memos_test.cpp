// Figures and problems that follow from state to state are those of a reader who knows nothing of the states before.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/reading/changed_nodes.h"
#include "core/reading/figures_memo.h"
#include "core/reading/problems_memo.h"
#include "core/reading/views/volume.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

void expect_same_figures(const ReportModel& followed, const ReportModel& fresh) {
  EXPECT_EQ(followed.accounts, fresh.accounts);
  EXPECT_EQ(followed.tolerance, fresh.tolerance);
  ASSERT_EQ(followed.volumes.size(), fresh.volumes.size());
  for (std::size_t k = 0; k < fresh.volumes.size(); ++k) {
    const VolumeRow &a = followed.volumes[k], &b = fresh.volumes[k];
    EXPECT_EQ(static_cast<const VolumeAccount&>(a), static_cast<const VolumeAccount&>(b)) << b.id;
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.number, b.number);
  }
  ASSERT_EQ(followed.worst == nullptr, fresh.worst == nullptr);
  if (fresh.worst != nullptr) { EXPECT_EQ(followed.worst - followed.volumes.data(), fresh.worst - fresh.volumes.data()); }
}

std::vector<PlaceProblem> listed(const std::map<std::uint32_t, PlaceProblem>& hanging) {
  std::vector<PlaceProblem> problems;
  for (const auto& [node, problem] : hanging) problems.push_back(problem);
  return problems;
}

void expect_same_problems(const ProblemsMemo& followed, const State& state) {
  EXPECT_EQ(followed.tense(), tense_ports(state));
  EXPECT_EQ(followed.failures(), failures_of(state, links_with_errors(state)));
  EXPECT_EQ(followed.collapsed(), collapsed_volumes(state));
  EXPECT_EQ(listed(followed.hanging()), hanging_volumes(state));
  const std::vector<ProblemRow> failures = followed.failures();
  for (std::size_t n = 0; n < state.nodes.size(); ++n)
    for (const TypeState& type : state.nodes[n].types) {
      const std::string& id = state.plan->nodes[n].id;
      const auto says = [&](const ProblemRow& row) { return row.node == id && row.message == type.error->text(); };
      EXPECT_TRUE(!type.error || std::any_of(failures.begin(), failures.end(), says)) << id;
    }
}

std::string any_node(const Scene& scene, Random& random) {
  return std::next(scene.nodes.begin(), static_cast<std::ptrdiff_t>(random.below(scene.nodes.size())))->first;
}

Command placed(const std::string& node, const Point3& at) {
  return command<SetPort>(
      {node, {"node.position"}, {"[" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) + "]"}});
}

// Something that fails, comes too near to another one, or asks for much more.
Command trouble(const State& state, Random& random) {
  const Scene& scene = state.plan->scene;
  const std::string node = any_node(scene, random);
  switch (random.below(4)) {
    case 0:
      if (const auto other = row_of<VolumePlace>(state, state.plan->node_index(any_node(scene, random))))
        return placed(node, other->position);
      return placed(node, {random.uniform(0, 50), random.uniform(0, 50), 60});
    case 1: return command<SetPort>({node, {"smart_volume.demand"}, {std::to_string(random.uniform(0, 30000))}});
    case 2: return command<SetPort>({node, {"smart_volume.demand_limit"}, {std::to_string(random.uniform(0, 2000))}});
    default: return command<SetPort>({node, {"boundary.height"}, {std::to_string(random.uniform(-5, 40))}});
  }
}

class Memos : public ::testing::TestWithParam<const char*> {};

TEST_P(Memos, WhatFollowsIsWhatIsReadAnew) {
  World world = World::from_file(GetParam());
  FiguresMemo figures;
  ProblemsMemo problems;
  Random random(31);
  std::size_t followed = 0, compared = 0;
  for (int step = 0; step < 80; ++step) {
    if (random.below(2) == 0) (void)world.submit(random_command(world.session().scene(), random, step));
    if (random.below(2) == 0) (void)world.submit(trouble(world.state(), random));
    world.tick(1 + static_cast<int>(random.below(3)));
    const auto state = world.session().state();
    followed += figures.state() && changed_nodes(*figures.state(), *state) ? 1 : 0;
    ReportModel fresh;
    read_figures(*state, fresh);
    expect_same_figures(figures.of(state), fresh);
    problems.read(state);
    expect_same_problems(problems, *state);
    compared += problems.tense().size() + problems.failures().size() + problems.collapsed().size() + problems.hanging().size();
    if (HasFailure()) FAIL() << "step " << step;
  }
  EXPECT_GT(followed, 10u) << "else nothing was tried";
  EXPECT_GT(compared, 10u) << "else nothing was compared";
}

// A volume counts by floor area where a brief names its use: an edit of the brief changes volumes that have not changed.
TEST(Memos, AUseThatABriefStartsToNameCountsByFloorArea) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "brief", "types": {"programme": {"rows": [{"use": "shop", "floor_area": 100}]}}},
      {"id": "one", "types": {"smart_volume": {"demand": 300, "use": "office"}}}],
    "links": [{"id": "deal", "kind": "demand", "from": "brief", "to": "one", "strength": 0}]})");
  FiguresMemo figures;
  world.tick(2);
  EXPECT_FALSE(figures.of(world.session().state()).volumes.front().is_by_area);
  ASSERT_EQ(world.submit(command<AddRow>({"brief", {"programme.rows"}, {R"({"use": "office", "floor_area": 100})"}, -1})), "");
  for (int tick = 0; tick < 4; ++tick) {
    world.tick();
    ReportModel fresh;
    read_figures(world.state(), fresh);
    expect_same_figures(figures.of(world.session().state()), fresh);
  }
  EXPECT_TRUE(figures.last().volumes.front().is_by_area);
}

// Volumes that come to lie on one point and leave it again, a few at a time and many at once.
TEST(Memos, GroupsOnOnePointAreThoseThatAreFoundAnew) {
  constexpr int kVolumes = 200;
  std::string nodes;
  for (int k = 0; k < kVolumes; ++k)
    nodes += (k == 0 ? "" : ",") + (R"({"id": "v)" + std::to_string(1000 + k) + R"(", "types": {"smart_volume": {"demand": )") +
             std::to_string(k % 7 == 0 ? 0 : 200 + 40 * k) + "}}}";
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + R"(,
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[80,0,0],[80,80,0],[0,80,0]], "height": 80}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}}]})");
  VolumePlaces places;
  Random random(5);
  std::shared_ptr<const State> before;
  std::size_t groups = 0;
  for (int step = 0; step < 40; ++step) {
    std::vector<Command> moves;
    for (auto count = step % 8 == 7 ? std::uint64_t{150} : 1 + random.below(12); count > 0; --count) {
      // Corners of a grid, and now and then a little beside them: chains of neighbours join groups.
      const auto along = [&] { return 20.0 + 8.0 * static_cast<double>(random.below(4)) + random.uniform(0, 0.8); };
      moves.push_back(placed("v" + std::to_string(1000 + random.below(kVolumes)), {along(), along(), 20}));
    }
    ASSERT_EQ(world.submit(command<Batch>({moves})), "");
    world.tick();
    const auto state = world.session().state();
    const auto changed = before ? changed_nodes(*before, *state) : std::nullopt;
    EXPECT_EQ(changed.has_value(), step > 0);
    places.read(*state, changed);
    EXPECT_EQ(places.collapsed(*state), collapsed_volumes(*state)) << "step " << step;
    EXPECT_EQ(listed(places.hanging()), hanging_volumes(*state)) << "step " << step;
    groups += places.collapsed(*state).size();
    before = state;
  }
  EXPECT_GT(groups, 40u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Memos,
                         ::testing::Values("scenes/start/quarter.json", "scenes/studies/sixty_volumes.json",
                                           "scenes/studies/urban_mode.json", "scenes/links/demand.json"));

}  // namespace
}  // namespace bl::reading
