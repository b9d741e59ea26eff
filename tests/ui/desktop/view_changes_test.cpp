// What is followed from one state to the next is what would be read of it anew.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/reading/changed_nodes.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/picking.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {
namespace {

using Facts = std::shared_ptr<const SceneFacts>;

void expect_same_facts(const SceneFacts& followed, const SceneFacts& fresh) {
  ASSERT_EQ(followed.volumes.size(), fresh.volumes.size());
  for (std::size_t k = 0; k < fresh.volumes.size(); ++k) {
    const VolumeFacts &a = followed.volumes[k], &b = fresh.volumes[k];
    SCOPED_TRACE(b.id);
    EXPECT_EQ(a.node, b.node);
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.figures.position, b.figures.position);
    EXPECT_EQ(a.figures.radius, b.figures.radius);
    EXPECT_EQ(a.figures.use, b.figures.use);
    EXPECT_EQ(a.is_ball, b.is_ball);
    EXPECT_EQ(a.is_dressed, b.is_dressed);
    EXPECT_EQ(a.is_by_area, b.is_by_area);
    for (const auto member : {&reading::Account::asked, &reading::Account::limited, &reading::Account::volume,
                              &reading::Account::asked_area, &reading::Account::limited_area, &reading::Account::floor_area})
      EXPECT_EQ(a.*member, b.*member);
    if (!b.is_ball) { EXPECT_EQ(a.cell, b.cell); }
  }
  for (const auto column : {&SightBalls::x, &SightBalls::y, &SightBalls::z, &SightBalls::squared_radius})
    EXPECT_EQ(followed.balls.*column, fresh.balls.*column);
  EXPECT_EQ(followed.columns.node, fresh.columns.node);
  EXPECT_EQ(followed.columns.radius, fresh.columns.radius);
  EXPECT_EQ(followed.columns.position, fresh.columns.position);
  EXPECT_EQ(followed.places, fresh.places);
  EXPECT_EQ(followed.uses, fresh.uses);
  EXPECT_EQ(followed.links.size(), fresh.links.size());
  EXPECT_EQ(followed.pulls.size(), fresh.pulls.size());
  EXPECT_EQ(followed.boundaries.size(), fresh.boundaries.size());
  ASSERT_EQ(followed.marks.size(), fresh.marks.size());
  for (std::size_t k = 0; k < fresh.marks.size(); ++k) EXPECT_EQ(followed.marks[k].position, fresh.marks[k].position);
}

TEST(ViewChanges, FactsThatFollowAreThoseThatAreReadAnew) {
  for (const char* path : {"scenes/start/quarter.json", "scenes/links/keep_distance.json", "scenes/studies/urban_mode.json"}) {
    SCOPED_TRACE(path);
    World world = World::from_file(path);
    Facts facts;
    UseMemo uses;
    std::size_t followed = 0;
    Random random(7);
    for (int step = 0; step < 40; ++step) {
      // Places, figures and whatever else people say, one after the other.
      if (random.below(2) == 0) (void)world.submit(random_command(world.session().scene(), random, step));
      world.tick();
      const auto state = world.session().state();
      followed += facts && reading::changed_nodes(*facts->state, *state) ? 1 : 0;
      facts = read_facts(state, facts.get());
      expect_same_facts(*facts, *read_facts(state, nullptr));
      const UseNumbers &kept = uses.of(state), fresh(state->plan->scene);
      for (const VolumeFacts& volume : facts->volumes) EXPECT_EQ(kept.of(volume.figures.use), fresh.of(volume.figures.use));
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(followed, 5u) << "else nothing was tried";
  }
}

TEST(ViewChanges, NodesThatStayTheSameAreNotAmongThem) {
  World world = World::from_file("scenes/links/attract.json");
  world.settle();
  world.tick(400);
  const auto before = world.session().state();
  world.tick();
  EXPECT_TRUE(reading::changed_nodes(*before, world.state())->empty());
  const std::string moved = world.session().scene().nodes.begin()->first;
  ASSERT_EQ(world.submit(command<SetPort>({moved, {"node.position"}, {"[1, 2, 3]"}})), "");
  world.tick();
  const auto changed = reading::changed_nodes(*before, world.state());
  ASSERT_TRUE(changed);
  EXPECT_TRUE(std::find(changed->begin(), changed->end(), world.state().plan->node_index(moved)) != changed->end());
  EXPECT_LT(changed->size(), world.state().nodes.size());
  ASSERT_EQ(world.submit(command<RenameNode>({moved, "Another"})), "");
  world.tick();
  EXPECT_FALSE(reading::changed_nodes(*before, world.state())) << "a name is more than a value";
}

TEST(ViewChanges, TheVolumeThatIsPickedIsTheNearestOfAll) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(40);
  const Facts facts = read_facts(world.session().state(), nullptr);
  Camera camera;
  camera.fit(facts->centre, facts->radius, 1.5);
  std::size_t hits = 0;
  for (const bool is_cut : {false, true})
    for (int x = 0; x < 600; x += 12)
      for (int y = 0; y < 400; y += 12) {
        const Ray ray = camera.ray(x, y, 600, 400);
        const ViewSection section{is_cut, {0, 0, 1}, facts->ground + 12};
        std::optional<Hit> nearest;
        for (const VolumeFacts& volume : facts->volumes) {
          const auto at = volume.cell ? meet(ray, *volume.cell, section) : std::nullopt;
          if (at && (!nearest || *at < nearest->distance)) nearest = Hit{volume.node, *at, {}};
        }
        const auto picked = pick(ray, *facts, section, false);
        ASSERT_EQ(picked.has_value(), nearest.has_value()) << x << ", " << y;
        for (const VolumeFacts& volume : facts->volumes)
          EXPECT_EQ(is_met_first(ray, volume, *facts, section, false), picked && picked->node == volume.node) << x << ", " << y;
        if (!picked) continue;
        ++hits;
        EXPECT_EQ(picked->node, nearest->node) << x << ", " << y;
        EXPECT_EQ(picked->distance, nearest->distance);
      }
  EXPECT_GT(hits, 200u);
}

}  // namespace
}  // namespace bl::desktop
