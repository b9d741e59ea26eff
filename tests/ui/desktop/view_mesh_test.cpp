// What the window reads of the meshes of volumes: the coarse ones alone; and a ball where one cannot be made.
#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/world.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {
namespace {

class FailingRecipe : public MeshRecipe {
 public:
  std::shared_ptr<const Mesh> make_coarse() override { throw std::bad_alloc(); }
  Mesh make() override { throw std::bad_alloc(); }
  int depth() const override { return 1; }
};

TEST(ViewMesh, ThePictureIsMadeOfCoarseMeshesAlone) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(5);
  const auto facts = read_facts(world.session().state(), nullptr);
  std::size_t shapes = 0;
  for (const VolumeFacts& volume : facts->volumes) {
    const MeshPointer& mesh = volume.figures.mesh;
    if (!mesh) continue;
    EXPECT_EQ(volume.cell, mesh.coarse()) << volume.id;
    EXPECT_FALSE(mesh.is_made() || volume.is_ball) << volume.id;
    ++shapes;
  }
  EXPECT_GT(shapes, 10u);
  // Read again it is the very same, so that nothing is sent twice.
  const auto again = read_facts(world.session().state(), facts.get());
  for (std::size_t k = 0; k < facts->volumes.size(); ++k) EXPECT_EQ(facts->volumes[k].cell, again->volumes[k].cell);
}

TEST(ViewMesh, ManyShapesAreMadeInTurnAndInTheEndAreAllThere) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(5);
  const auto state = world.session().state();
  auto facts = read_facts(state, nullptr, 4);
  const std::size_t all = facts->volumes.size();
  ASSERT_GT(all, 12u);
  EXPECT_EQ(facts->awaited.size(), all - 4);
  for (const VolumeFacts& volume : facts->volumes) {
    const bool is_awaited = std::binary_search(facts->awaited.begin(), facts->awaited.end(), volume.node);
    EXPECT_EQ(volume.is_ball, is_awaited) << volume.id;
    EXPECT_EQ(volume.figures.mesh.is_coarse_made(), !is_awaited) << volume.id;
  }
  for (std::size_t picture = 1; picture < (all + 3) / 4; ++picture) {
    EXPECT_FALSE(facts->awaited.empty());
    facts = read_facts(state, facts.get(), 4);
  }
  EXPECT_TRUE(facts->awaited.empty());
  for (const VolumeFacts& volume : facts->volumes) EXPECT_EQ(volume.cell, volume.figures.mesh.coarse()) << volume.id;
}

// Where all of them change in every tick, the last in the list have their turn as the first do.
TEST(ViewMesh, NobodyWaitsForEverWhileAllMove) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(2);
  auto facts = read_facts(world.session().state(), nullptr);
  const std::size_t all = facts->volumes.size();
  std::vector<std::size_t> renewed(all, 0);
  for (std::size_t tick = 0; tick < 3 * ((all + 3) / 4); ++tick) {
    for (const VolumeFacts& volume : facts->volumes)
      ASSERT_EQ(world.submit(command<SetPort>(
                    {volume.id, {"smart_volume.storey_height"}, {std::to_string(3 + 0.01 * static_cast<double>(tick))}})),
                "");
    ASSERT_EQ(
        world.submit(command<SetPort>({facts->volumes.front().id, {"node.position"}, {"[" + std::to_string(tick) + ", 9, 9]"}})),
        "");
    world.tick();
    auto next = read_facts(world.session().state(), facts.get(), 4);
    for (std::size_t k = 0; k < all; ++k) {
      if (next->volumes[k].cell != facts->volumes[k].cell) ++renewed[k];
      EXPECT_NE(next->volumes[k].cell, nullptr);
      EXPECT_FALSE(next->volumes[k].is_ball) << "the last shape stays until there is a new one";
    }
    facts = std::move(next);
  }
  for (const std::size_t times : renewed) EXPECT_GE(times, 2u);
}

TEST(ViewMesh, AVolumeWhoseShapeFindsNoMemoryIsABall) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(5);
  StateDraft draft(world.state());
  const auto before = read_facts(world.session().state(), nullptr);
  const VolumeFacts& volume = before->volumes.front();
  draft.edit(*world.state().plan->find(volume.node, {"smart_volume", "mesh", ""})) =
      MeshPointer(std::make_unique<FailingRecipe>());
  const auto after = read_facts(std::make_shared<const State>(std::move(draft).publish()), before.get());
  EXPECT_FALSE(before->volumes.front().is_ball);
  EXPECT_TRUE(after->volumes.front().is_ball);
  EXPECT_NE(after->volumes.front().cell, nullptr);
  EXPECT_FALSE(after->volumes.back().is_ball);
}

}  // namespace
}  // namespace bl::desktop
