// What the history says of what was done on the canvas, and that solo lets through whatever reaches the chosen node.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/arrangement.h"

namespace bl::desktop {
namespace {

class CanvasHistory : public CanvasFixture {
 protected:
  CanvasHistory() { desktop.move_to({300, 200}); }
  // With plain spaces between numbers and nouns.
  std::string said() {
    desktop.frames(2);
    const auto& steps = editor().document->history();
    std::string text = steps.empty() ? "" : steps.back().label;
    for (std::size_t at = text.find("\xc2\xa0"); at != std::string::npos; at = text.find("\xc2\xa0")) text.replace(at, 2, " ");
    return text;
  }
};

TEST_F(CanvasHistory, SoloKeepsLinksThatReachTheNodeThroughASet) {
  ASSERT_TRUE(editor().submit(
      command<AddLink>({"all_to_hotel", {R"({"kind": "attract", "from": {"typification": "smart_volume"}, "to": "hotel"})"}})));
  desktop.frames(2);
  choose_alone({"library"});
  desktop.key(GLFW_KEY_Q);
  EXPECT_FALSE(scene().links.at("all_to_hotel").is_muted) << "the library is one of all volumes";
  EXPECT_FALSE(scene().links.at("library_cafe").is_muted);
  EXPECT_TRUE(scene().links.at("hotel_market").is_muted);
  EXPECT_EQ(said(), "Solo · Library");
  desktop.key(GLFW_KEY_Q);
  EXPECT_FALSE(scene().links.at("hotel_market").is_muted);
  EXPECT_TRUE(said().starts_with("Unmute ")) << said();
  EXPECT_TRUE(said().ends_with(" links")) << said();
}

TEST_F(CanvasHistory, MutingSaysWhichWay) {
  editor().picks.only_link("hotel_market");
  desktop.key(GLFW_KEY_M);
  EXPECT_EQ(said(), "Mute · hotel_market");
  desktop.key(GLFW_KEY_M);
  EXPECT_EQ(said(), "Unmute · hotel_market");
  choose_alone({"cafe"});
  desktop.key(GLFW_KEY_M);
  EXPECT_EQ(said(), "Mute 2 links");
}

TEST_F(CanvasHistory, ChangesOfTheViewAreNamedAfterWhatTheyDo) {
  choose_alone({"library"});
  desktop.key(GLFW_KEY_H);
  EXPECT_EQ(said(), "Collapse Library");
  desktop.key(GLFW_KEY_H);
  EXPECT_EQ(said(), "Expand Library");
  choose_alone({"library", "cafe", "theatre"});
  desktop.key(GLFW_KEY_H);
  EXPECT_EQ(said(), "Collapse 3 nodes");
  canvas::align_chosen(board(), canvas::Alignment::left);
  EXPECT_EQ(said(), "Align 3 nodes");
  desktop.key(GLFW_KEY_H, false, true);
  EXPECT_EQ(said(), "Hide 3 nodes");
  desktop.key(GLFW_KEY_G, true);
  desktop.frames(3);
  EXPECT_EQ(said(), "Frame 3 nodes");
  desktop.type("Wohnen");
  desktop.key(GLFW_KEY_ENTER);
  EXPECT_EQ(said(), "Rename frame · Wohnen");
}

TEST_F(CanvasHistory, ViewPatchesOfAnyShapeHaveAName) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"boxes": {"library": [1, 2]}})", "Move Library"},
      {R"({"boxes": {"library": [1, 2], "cafe": [3, 4], "nobody": [5, 6]}})", "Move 3 boxes"},
      {R"({"dots": {"hotel_market": [[1, 2]]}})", "Dot on hotel_market"},
      {R"({"dots": {"hotel_market": null}})", "Remove dots of hotel_market"},
      {R"({"comments": {"c": {"at": [1, 2], "size": [40, 40], "text": ""}}})", "Comment"},
      {R"({"comments": {"c": {"text": "Ask the city\nnow"}}})", "Comment · Ask the city"},
      {R"({"comments": {"c": {"size": [90, 90]}}})", "Resize comment"},
      {R"({"comments": {"c": {"at": [9, 9]}}})", "Move 1 comment"},
      {R"({"comments": {"c": null}})", "Remove 1 comment"},
      {R"({"frames": {"f": {"name": "Wohnen", "colour": 1, "nodes": {"cafe": true}}}})", "Frame · Wohnen"},
      {R"({"frames": {"f": {"in": "g"}}})", "Change frames"},
      {R"({"frames": {"f": null}})", "Remove 1 frame"},
      {R"({"cameras": {"3": {"x": 1}}})", "Keep view 3"},
      {R"({"frames": 7, "comments": [], "boxes": "x"})", "Arrange"}};
  for (const auto& [patch, label] : cases) {
    ASSERT_TRUE(editor().arrange(patch, editor().new_gesture())) << patch;
    EXPECT_EQ(said(), label) << patch;
  }
}

TEST_F(CanvasHistory, AddingAndPastingShowNoJson) {
  ASSERT_TRUE(editor().submit(command<AddNode>({"inn", {R"({"name": "Inn", "types": {"smart_volume": {}}})"}})));
  EXPECT_EQ(said(), "Add Inn");
  ASSERT_TRUE(editor().submit(command<AddNode>({"inn-2", {R"({"types": {"smart_volume": {}}})"}})));
  EXPECT_EQ(said(), "Add inn-2");
  choose_alone({"library"});
  desktop.key(GLFW_KEY_C, true);
  desktop.key(GLFW_KEY_V, true);
  EXPECT_EQ(said(), "Paste 1 node");
  choose_alone({"library", "cafe"});
  desktop.key(GLFW_KEY_D, true);
  EXPECT_EQ(said(), "Duplicate 2 nodes");
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_EQ(said(), "Remove 2 nodes");
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(said(), "Remove 2 nodes") << "an undone step keeps its name";
}

}  // namespace
}  // namespace bl::desktop
