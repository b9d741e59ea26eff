// A clock that stands: what the scene says of itself is seen before any tick, and no tick begins with it.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/host/journal.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {
namespace {

constexpr const char* kPausedScene = "scenes/start/quarter.json";

std::size_t boundaries_seen(NullDesktop& desktop) {
  return read_facts(desktop.editor().moment->state, nullptr)->boundaries.size();
}

TEST(Paused, AFreshSceneShowsItsBoundary) {
  NullDesktop desktop(kPausedScene);
  EXPECT_EQ(desktop.editor().state().tick, 0);
  EXPECT_EQ(boundaries_seen(desktop), 1u);
  // The ticks hear nothing of it.
  EXPECT_EQ(desktop.editor().state().hash, desktop.editor().moment->ticked->hash);
  EXPECT_EQ(read_facts(desktop.editor().moment->ticked, nullptr)->boundaries.size(), 0u);
}

TEST(Paused, ASavedSceneShowsItsBoundaryWhenItIsOpenedAgain) {
  NullDesktop desktop(kPausedScene);
  desktop.ticks(5);
  const std::string path = ::testing::TempDir() + "paused.json";
  ASSERT_TRUE(desktop.editor().save(path).ok());
  desktop.frames(2);
  EXPECT_EQ(boundaries_seen(desktop), 1u) << "after saving";
  const std::uint64_t hash = desktop.editor().state().hash;
  ASSERT_TRUE(desktop.editor().open(path));
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().state().tick, 5);
  EXPECT_EQ(boundaries_seen(desktop), 1u) << "after opening";
  EXPECT_EQ(desktop.editor().state().hash, hash);
}

TEST(Paused, SavingAndRewindingBeforeTheFirstTickKeepItInSight) {
  NullDesktop desktop(kPausedScene);
  ASSERT_TRUE(desktop.editor().save(::testing::TempDir() + "paused_fresh.json").ok());
  desktop.frames(2);
  EXPECT_EQ(boundaries_seen(desktop), 1u) << "after saving";
  desktop.ticks(3);
  desktop.editor().document->session().rewind(3);
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().state().tick, 0);
  EXPECT_EQ(boundaries_seen(desktop), 1u) << "after rewinding";
}

TEST(Paused, ARecoveredSceneShowsItsBoundary) {
  NullDesktop desktop(kPausedScene);
  host::Journal::UnsavedJournal remains;
  remains.log.scene = desktop.scene_text();
  std::vector<Problem> problems;
  desktop.editor().take(Document::recover(full_registry(), remains, 1, problems));
  desktop.frames(2);
  EXPECT_EQ(boundaries_seen(desktop), 1u);
}

TEST(Paused, AnEditOfTheBoundaryIsSeenAtOnce) {
  NullDesktop desktop(kPausedScene);
  const auto height = [&] {
    const auto facts = read_facts(desktop.editor().moment->state, nullptr);
    double top = -1e9;
    for (const BoundaryFacts& boundary : facts->boundaries)
      for (const Point3& vertex : boundary.shape->vertices) top = std::max(top, vertex.z);
    return top;
  };
  std::string node;
  for (const auto& [id, record] : desktop.editor().scene().nodes)
    if (record.types.contains("boundary")) node = id;
  ASSERT_FALSE(node.empty());
  const double before = height();
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({node, {"boundary.height"}, {"77"}})));
  desktop.frames(2);
  EXPECT_NE(height(), before);
  EXPECT_EQ(height(), 77);
  EXPECT_EQ(desktop.editor().state().tick, 0);
  // A boundary that cannot be: said at once.
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({node, {"boundary.plan"}, {"[[0,0,0],[1,1,0]]"}})));
  desktop.frames(2);
  EXPECT_TRUE(has_failure(desktop.editor().state()));
}

// What is looked at before a tick changes nothing of what the ticks make.
TEST(Paused, LookingChangesNoTick) {
  for (const char* scene : {"scenes/start/quarter.json", "scenes/studies/urban_mode.json"}) {
    NullDesktop looked(scene);
    looked.frames(5);
    looked.ticks(6);
    const std::uint64_t hash = looked.editor().state().hash;
    NullDesktop at_once(scene);
    at_once.editor().document->session().step(6);
    at_once.frames(1);
    EXPECT_EQ(at_once.editor().state().hash, hash) << scene;
  }
}

}  // namespace
}  // namespace bl::desktop
