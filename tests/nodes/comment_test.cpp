// The comment: what it lacks, and that what it is about goes with its node.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string what_it_lacks(const std::string& ports) {
  World world = World::from_text(one_node("comment", ports));
  world.tick();
  return world.text("it", "comment.message");
}

TEST(Comment, AnAnswerIsOwedToWhoIsRejected) {
  EXPECT_EQ(what_it_lacks(R"("text": "Too high.")"), "");
  EXPECT_EQ(what_it_lacks(""), "the comment has no text");
  EXPECT_EQ(what_it_lacks(R"("text": "Too high.", "state": "rejected")"), "the comment is rejected without an answer: say why");
  EXPECT_EQ(what_it_lacks(R"("text": "Too high.", "state": "rejected", "answer": "The plan allows it.")"), "");
}

TEST(Comment, ForgetsANodeThatIsRemovedAndKnowsItAgainAfterAnUndo) {
  World world = World::from_text(scene_text(
      R"({"id": "house", "types": {"control": {}}}, {"id": "it", "types": {"comment": {"text": "Too high.", "about": "house"}}})"));
  const Scene before = world.session().scene();
  ASSERT_EQ(world.submit(command<RemoveNode>({"house"})), "");
  EXPECT_FALSE(world.session().scene().nodes.at("it").types.at("comment").contains("about"));
  ASSERT_TRUE(world.session().undo("test").ok());
  EXPECT_TRUE(world.session().scene() == before);
}

TEST(Comment, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/comment.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.text("on_height", "comment.message"), "");
  EXPECT_NE(world.text("on_low", "comment.message"), "");
  EXPECT_TRUE(world.state().due.is_nothing()) << "no tick acts on it";
}

}  // namespace
}  // namespace bl
