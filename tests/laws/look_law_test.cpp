// Law: what a saved scene shows before its next tick is what the running one showed: bodies of surroundings, and what links say.
#include <gtest/gtest.h>

#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

class ALookAtASavedScene : public testing::TestWithParam<std::string> {};

TEST_P(ALookAtASavedScene, ShowsWhatTheRunningOneShows) {
  World running = World::from_file(GetParam());
  running.tick(12);
  const std::shared_ptr<const State> was = running.session().state();
  const SavedState saved = save(*was);
  auto session = Session::start(full_registry(), running.session().scene(), &saved, 1);
  ASSERT_TRUE(session.ok()) << session.error().text();
  const std::shared_ptr<const State> seen = (*session)->look();
  EXPECT_EQ(seen->tick, was->tick);
  EXPECT_EQ(seen->hash, was->hash);
  for (std::uint32_t n = 0; n < was->nodes.size(); ++n)
    for (std::size_t t = 0; t < was->nodes[n].types.size(); ++t) {
      const TypeState &before = was->nodes[n].types[t], &now = seen->nodes[n].types[t];
      const auto& definition = *was->plan->nodes[n].types[t].definition;
      EXPECT_EQ(now.error, before.error) << was->plan->nodes[n].id << " " << definition.id;
      for (std::size_t p = 0; p < before.values.size(); ++p) {
        const auto *old = std::get_if<MeshPointer>(&before.values[p]), *mesh = std::get_if<MeshPointer>(&now.values[p]);
        if (old == nullptr || !*old) continue;
        const std::string place = was->plan->nodes[n].id + "/" + definition.id + "." + definition.ports[p].id;
        ASSERT_TRUE(mesh != nullptr && *mesh) << place;
        EXPECT_EQ((*mesh)->triangles, (*old)->triangles) << place;
      }
    }
  running.tick();
  for (std::uint32_t l = 0; l < was->links.size(); ++l) {
    EXPECT_EQ(seen->links[l].error, running.state().links[l].error) << was->plan->links[l].id;
    EXPECT_EQ(seen->links[l].work, running.state().links[l].work) << was->plan->links[l].id;
    EXPECT_EQ(seen->links[l].voices, running.state().links[l].voices) << was->plan->links[l].id;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ALookAtASavedScene, testing::ValuesIn(small_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

}  // namespace
}  // namespace bl
