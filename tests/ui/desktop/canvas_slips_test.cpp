// The canvas at awkward moments: a hand that rests where something has just gone, undo in the middle of a drag, odd selections.
#include <algorithm>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/clipboard.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"

namespace bl::desktop {
namespace {

class CanvasSlipsTest : public CanvasFixture {
 protected:
  CanvasSlipsTest() { desktop.move_to({300, 200}); }
  void look_at(const std::set<std::string>& nodes) {
    choose(nodes);
    canvas().fit(false);
    desktop.frames(30);
  }
  // Presses, moves in steps, and rests for half a second before letting go.
  void drag_and_rest(ImVec2 from, ImVec2 to, int button = 0) {
    desktop.move_to(from);
    desktop.press(button);
    for (int k = 1; k <= 10; ++k) {
      const float t = 0.1f * static_cast<float>(k);
      ImGui::GetIO().MousePos = {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
      desktop.frames(1);
    }
    desktop.frames(30);
    desktop.release(button);
  }
  Vector3 place_of(const std::string& node) { return std::get<Vector3>(scene().nodes.at(node).types.at("node").at("position")); }
  bool has_errors() {
    return std::any_of(editor().notices.begin(), editor().notices.end(),
                       [](const Notice& n) { return n.kind == NoticeKind::error; });
  }
  std::size_t muted() {
    return static_cast<std::size_t>(
        std::count_if(scene().links.begin(), scene().links.end(), [](const auto& link) { return link.second.is_muted; }));
  }
  void add_unknown_link() {
    ASSERT_TRUE(editor().submit(command<AddLink>({"alien", {R"({"kind": "alien_kind", "from": "library", "to": "cafe"})"}})));
    desktop.frames(2);
  }
};

TEST_F(CanvasSlipsTest, ACutThatEndsBesideItsLinkLeavesNothingToPointAt) {
  look_at({"hotel", "market_hall"});
  editor().picks.clear();
  const canvas::Line& line = board().model.lines[board().model.find_line("hotel_market")];
  // Not at the middle, which is a corner of the curve's stretches.
  const ImVec2 a = canvas().to_screen(line.at_share(0.53f)), along = canvas().to_screen(line.at_share(0.535f));
  const float dx = along.x - a.x, dy = along.y - a.y, length = std::hypot(dx, dy);
  const ImVec2 across{-dy / length, dx / length};
  desktop.hold(true, false);
  drag_and_rest({a.x - 40 * across.x, a.y - 40 * across.y}, {a.x + 3 * across.x, a.y + 3 * across.y}, 1);
  desktop.hold(false, false);
  EXPECT_FALSE(scene().links.contains("hotel_market"));
  EXPECT_NE(board().hovered.id, "hotel_market");
}

TEST_F(CanvasSlipsTest, ACopyThatIsDroppedOnADoor) {
  ASSERT_TRUE(editor().arrange(R"({"frames": {"culture": {"name": "Culture", "nodes": {"library": true, "cafe": true}}}})"));
  desktop.frames(2);
  canvas::enter_frame(board(), "culture");
  desktop.frames(60);
  ASSERT_FALSE(board().model.doors.empty());
  const ImVec2 door = canvas().to_screen(board().model.doors.front().box.centre());
  desktop.hold(false, false, true);
  drag_and_rest(at("library"), door);
  desktop.frames(30);
  desktop.hold(false, false);
  EXPECT_TRUE(scene().nodes.contains("library-2"));
}

TEST_F(CanvasSlipsTest, LinksOfUnknownKindsHinderNoMuting) {
  add_unknown_link();
  choose({"library"});
  canvas::mute_chosen(board());
  EXPECT_FALSE(has_errors());
  EXPECT_TRUE(scene().links.at("library_cafe").is_muted);
  canvas::mute_chosen(board());
  EXPECT_FALSE(scene().links.at("library_cafe").is_muted);
  choose({"theatre"});
  canvas::solo_chosen(board());
  EXPECT_FALSE(has_errors());
  EXPECT_TRUE(scene().links.at("library_cafe").is_muted);
  EXPECT_FALSE(board().soloed.contains("alien"));
}

TEST_F(CanvasSlipsTest, ASoloThatIsUndoneIsOver) {
  choose({"cafe"});
  desktop.key(GLFW_KEY_Q);
  const std::size_t soloed = muted();
  ASSERT_GT(soloed, 0u);
  desktop.key(GLFW_KEY_Z, true);
  ASSERT_EQ(muted(), 0u);
  desktop.key(GLFW_KEY_Q);
  EXPECT_EQ(muted(), soloed);
}

TEST_F(CanvasSlipsTest, NodesThatNameEachOtherAreCopiedTogether) {
  ASSERT_TRUE(
      editor().submit(command<AddNode>({"a_count", {R"({"types": {"statistics": {"nodes": ["library", "cafe", "hotel"]}}})"}})));
  desktop.frames(2);
  choose({"a_count", "library", "cafe"});
  const std::size_t steps = editor().document->history().size();
  canvas::duplicate_chosen(board(), {30, 30});
  ASSERT_TRUE(scene().nodes.contains("a_count-2"));
  const auto& named = std::get<Shared<Selection>>(scene().nodes.at("a_count-2").types.at("statistics").at("nodes"));
  EXPECT_EQ(named->ids, (std::vector<std::string>{"cafe-2", "hotel", "library-2"}));
  EXPECT_EQ(editor().document->history().size(), steps + 1);
}

TEST_F(CanvasSlipsTest, CopiesOfVolumesKeepTheirPlacesToEachOther) {
  ASSERT_TRUE(editor().submit(command<AddNode>({"v1", {R"({"position": [200, 0, 0], "types": {"smart_volume": {}}})"}})));
  ASSERT_TRUE(editor().submit(command<AddNode>({"v2", {R"({"position": [206, 0, 0], "types": {"smart_volume": {}}})"}})));
  desktop.frames(2);
  choose({"v1", "v2"});
  canvas::duplicate_chosen(board(), {30, 30});
  ASSERT_TRUE(scene().nodes.contains("v1-2"));
  EXPECT_EQ(place_of("v1-2"), (Vector3{212, 0, 0}));
  EXPECT_EQ(place_of("v2-2"), (Vector3{218, 0, 0}));
}

TEST_F(CanvasSlipsTest, WhatLiesInAnInnerFrameThatGoesMovesToTheOuterOne) {
  ASSERT_TRUE(editor().arrange(R"({"frames": {
    "outer": {"name": "Outer"}, "middle": {"name": "Middle", "in": "outer", "nodes": {"hotel": true}},
    "inner": {"name": "Inner", "in": "middle", "nodes": {"library": true}, "comments": {"note": true}},
    "innermost": {"name": "Innermost", "in": "inner", "nodes": {"cafe": true}}},
    "comments": {"note": {"at": [0, 0], "size": [100, 60], "text": "here"}}})"));
  desktop.frames(2);
  editor().picks.clear();
  board().picked_frames = {"middle", "inner"};
  canvas::remove_chosen(board(), false);
  desktop.frames(2);
  const canvas::ViewData& view = board().model.view;
  ASSERT_EQ(view.frames.size(), 2u) << scene().view;
  EXPECT_EQ(view.frames.at("outer").nodes, (std::set<std::string>{"hotel", "library"}));
  EXPECT_EQ(view.frames.at("outer").comments, std::set<std::string>{"note"});
  EXPECT_EQ(view.frames.at("innermost").in, "outer");
}

TEST_F(CanvasSlipsTest, ACommentWhoseDragIsEndedByUndoGoesBack) {
  ASSERT_TRUE(editor().arrange(R"({"comments": {"c": {"at": [-300, -200], "size": [200, 100], "text": "hi"}}})"));
  ASSERT_TRUE(editor().submit(command<RenameNode>({"cafe", "Bar"})));
  desktop.frames(2);
  canvas().fit(true);
  desktop.frames(60);
  const canvas::Box before = board().model.view.comments.at("c").box;
  const ImVec2 middle = canvas().to_screen(before.centre());
  desktop.move_to(middle);
  desktop.press();
  ImGui::GetIO().MousePos = {middle.x + 60, middle.y + 60};
  desktop.frames(3);
  ASSERT_NE(board().model.view.comments.at("c").box.at.x, before.at.x);
  desktop.key(GLFW_KEY_Z, true);
  desktop.release();
  desktop.frames(2);
  EXPECT_EQ(board().model.view.comments.at("c").box.at.x, before.at.x);
}

TEST_F(CanvasSlipsTest, AltDragOfAFrameMovesIt) {
  ASSERT_TRUE(editor().arrange(R"({"frames": {"f": {"name": "Quiet", "nodes": {"library": true, "cafe": true}}}})"));
  desktop.frames(2);
  look_at({"library", "cafe"});
  editor().picks.clear();
  canvas::Box box;
  ASSERT_TRUE(board().model.frame_box("f", box));
  const std::size_t nodes = scene().nodes.size();
  const ImVec2 head = canvas().to_screen({box.centre().x, box.at.y + 8}), library = at("library");
  desktop.hold(false, false, true);
  desktop.drag(head, {head.x, head.y + 50});
  desktop.hold(false, false);
  desktop.frames(1);
  EXPECT_EQ(scene().nodes.size(), nodes);
  EXPECT_GT(at("library").y, library.y + 30);
  EXPECT_FALSE(has_errors());
}

TEST_F(CanvasSlipsTest, ASetKeepsItsPlaceWhenOneOfItsNodesGoes) {
  ASSERT_TRUE(editor().submit(
      command<AddLink>({"three", {R"({"kind": "attract", "from": ["cafe", "hotel", "library"], "to": "theatre"})"}})));
  ASSERT_TRUE(editor().arrange(R"({"sets": {"cafe,hotel,library": [-500, -400]}})"));
  desktop.frames(2);
  choose({"hotel"});
  canvas::remove_chosen(board(), false);
  desktop.frames(2);
  EXPECT_EQ(board().model.view.sets.count("cafe,library"), 1u) << scene().view;
  EXPECT_EQ(board().model.view.sets.count("cafe,hotel,library"), 0u);
  choose({"library"});
  canvas::remove_chosen(board(), false);
  desktop.frames(2);
  for (const char* gone : {"cafe,library", "cafe", "library"})
    EXPECT_EQ(board().model.view.sets.count(gone), 0u) << "of one node there is no set";
}

TEST_F(CanvasSlipsTest, ACommentFromTheSearchBoxComesToLieWhereItWasOpened) {
  const ImVec2 opened{420, 300};
  const ImVec2 wanted = canvas().to_plane(opened);
  canvas::open_addition(board(), opened);
  desktop.frames(2);
  desktop.type("comment on");
  desktop.move_to({700, 600});
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_EQ(board().model.view.comments.size(), 1u);
  const canvas::Box box = board().model.view.comments.begin()->second.box;
  EXPECT_NEAR(box.at.x, wanted.x, 1);
  EXPECT_NEAR(box.at.y, wanted.y, 1);
}

TEST_F(CanvasSlipsTest, AnotherSceneAtTheAddressOfTheLastOneIsAnotherScene) {
  std::vector<Problem> problems;
  for (const std::string id : {"p", "q", "r"}) {
    editor().document = nullptr;
    editor().take(Document::from_text(
        full_registry(), R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": ")" + id + R"("}]})", "", 1, problems));
    desktop.frames(2);
    ASSERT_EQ(board().model.boxes.size(), 1u);
    EXPECT_EQ(board().model.boxes.front().id, id);
  }
}

// Only what is in sight of a long list is drawn, and what one walks to is.
TEST(CanvasLongList, TheLastOfAThousandIsWalkedToAndTaken) {
  NullDesktop desktop("scenes/studies/thousand_volumes.json");
  desktop.ticks(1);
  canvas::Board& board = desktop.editor().canvas->board();
  canvas::open_find(board);
  desktop.frames(3);
  ASSERT_GT(board.picker.shown.size(), 1000u);
  desktop.key(GLFW_KEY_UP);
  desktop.frames(2);
  ASSERT_EQ(board.picker.marked, board.picker.shown.size() - 1);
  const canvas::Choice last = board.picker.choices[board.picker.shown.back()];
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_TRUE(desktop.editor().picks.nodes.contains(last.id) || desktop.editor().picks.links.contains(last.id));
}

}  // namespace
}  // namespace bl::desktop
