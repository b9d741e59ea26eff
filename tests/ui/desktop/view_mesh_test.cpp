// What the window reads of the meshes of volumes: the coarse ones alone; and a ball where one cannot be made.
#include <new>

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
