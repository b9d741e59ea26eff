// Frames in frames, by box selection and Ctrl+G, as people make them; none is left behind without content.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/ui/desktop/canvas_support.h"

namespace bl::desktop {
namespace {

class FramesTest : public CanvasFixture {
 protected:
  FramesTest() { desktop.move_to({300, 200}); }
  const canvas::ViewData& view() { return board().model.view; }
  void frame() {
    desktop.key(GLFW_KEY_G, true);
    desktop.frames(3);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(2);
  }
  // The canvas frame by frame, so that nothing but these nodes lies around.
  void lay_apart(const std::vector<std::string>& nodes) {
    Json patch = Json::object();
    float x = 6000;
    for (const std::string& node : nodes) patch["boxes"][node] = {x, 6000}, x += 260;
    EXPECT_TRUE(editor().arrange(write_json_line(patch)));
    choose_alone({nodes.begin(), nodes.end()});
    desktop.frames(2);
    canvas().fit(false);
    desktop.frames(30);
    board().camera.zoom_at(board().camera.pane().centre(), 0.6);
    desktop.frames(2);
  }
  void box_around(const canvas::Box& box) {
    desktop.drag(canvas().to_screen(box.grown(20).low()), canvas().to_screen(box.grown(20).high()));
    desktop.frames(1);
  }
  canvas::Box outline(const std::string& frame) {
    canvas::Box box;
    EXPECT_TRUE(board().model.frame_box(frame, box));
    return box;
  }
  void expect_undone(int steps) {
    for (int k = 0; k < steps; ++k) desktop.key(GLFW_KEY_Z, true);
    EXPECT_EQ(desktop.scene_text(), before);
  }

  const std::string before = desktop.scene_text();
};

TEST_F(FramesTest, ABoxAroundAFrameChoosesItAndItNestsWhole) {
  lay_apart({"theatre", "library", "cafe"});
  choose_alone({"theatre", "library"});
  frame();
  canvas::Box all = outline("frame").with(board().model.boxes[board().model.find_box("cafe")].box);
  choose_alone({});
  box_around(all);
  EXPECT_EQ(board().picked_frames, std::set<std::string>{"frame"});
  EXPECT_EQ(editor().picks.nodes, (std::set<std::string>{"theatre", "library", "cafe"}));
  frame();
  EXPECT_EQ(view().frames.at("frame").in, "frame-2");
  EXPECT_EQ(view().frames.at("frame").nodes, (std::set<std::string>{"theatre", "library"}));
  EXPECT_EQ(view().frames.at("frame-2").nodes, std::set<std::string>{"cafe"});
  EXPECT_TRUE(outline("frame-2").encloses(outline("frame")));
  expect_undone(3);
}

TEST_F(FramesTest, ABoxInsideAFrameLeavesItAlone) {
  lay_apart({"theatre", "library"});
  frame();
  choose_alone({});
  const canvas::Box theatre = board().model.boxes[board().model.find_box("theatre")].box;
  desktop.drag(canvas().to_screen(theatre.grown(6).low()), canvas().to_screen(theatre.grown(6).high()));
  EXPECT_TRUE(board().picked_frames.empty());
}

TEST_F(FramesTest, AFrameAllOfWhoseNodesAreChosenNestsWhole) {
  choose_alone({"theatre", "library"});
  frame();
  choose_alone({"theatre", "library", "cafe"});
  frame();
  EXPECT_EQ(view().frames.at("frame").in, "frame-2");
  EXPECT_EQ(view().frames.at("frame").nodes.size(), 2u);
  choose_alone({"theatre", "library", "cafe", "garage"});
  frame();
  EXPECT_EQ(view().frames.at("frame-2").in, "frame-3");
  EXPECT_EQ(view().frames.at("frame").in, "frame-2") << "it lies in a frame that moves as a whole";
  EXPECT_EQ(view().frames.at("frame-3").nodes, std::set<std::string>{"garage"});
  expect_undone(3);
}

TEST_F(FramesTest, APartOfAFrameGetsAFrameInIt) {
  choose_alone({"theatre", "library"});
  frame();
  choose_alone({"theatre"});
  frame();
  EXPECT_EQ(view().frames.at("frame-2").in, "frame");
  EXPECT_EQ(view().frames.at("frame").nodes, std::set<std::string>{"library"});
  expect_undone(2);
}

TEST_F(FramesTest, AFrameThatIsEmptiedGoesInTheSameStep) {
  choose_alone({"theatre"});
  frame();
  choose_alone({"theatre"});
  desktop.key(GLFW_KEY_DELETE);
  desktop.frames(2);
  EXPECT_TRUE(view().frames.empty());
  expect_undone(2);
  // With all that was in the frame around it.
  desktop.frames(2);
  ASSERT_TRUE(editor().arrange(R"({"frames": {"a": {"name": "A"}, "b": {"name": "B", "in": "a", "nodes": {"cafe": true}}}})"));
  desktop.frames(2);
  choose_alone({"cafe"});
  desktop.key(GLFW_KEY_DELETE);
  desktop.frames(2);
  EXPECT_TRUE(view().frames.empty());
  expect_undone(2);
}

TEST_F(FramesTest, ShiftDragOfTheLastNodeTakesTheFrameAlong) {
  lay_apart({"theatre", "library"});
  choose_alone({"theatre"});
  frame();
  choose_alone({});
  const ImVec2 from = canvas().screen_of("theatre").value();
  desktop.hold(false, true);
  desktop.drag(from, {from.x, from.y + 90});
  desktop.hold(false, false);
  desktop.frames(2);
  EXPECT_TRUE(view().frames.empty());
  expect_undone(3);
}

TEST_F(FramesTest, FramesInARingDoNoHarm) {
  ASSERT_TRUE(editor().arrange(R"({"frames": {"a": {"in": "b", "nodes": {"cafe": true}}, "b": {"in": "a"}}})"));
  desktop.frames(2);
  choose_alone({"cafe", "garage"});
  frame();
  choose_alone({"cafe"});
  desktop.key(GLFW_KEY_DELETE);
  expect_undone(3);
}

}  // namespace
}  // namespace bl::desktop
