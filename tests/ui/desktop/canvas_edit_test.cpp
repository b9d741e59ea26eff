// The canvas: copies, deletions, muting, frames, comments, dots, cuts, arrangement, and views of any shape.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/arrangement.h"

namespace bl::desktop {
namespace {

class CanvasEditTest : public CanvasFixture {
 protected:
  CanvasEditTest() { desktop.move_to({300, 200}); }
  Json view() { return scene().view.empty() ? Json::object() : Json::parse(scene().view); }
  void look_at(const std::set<std::string>& nodes) {
    choose(nodes);
    canvas().fit(false);
    desktop.frames(30);
  }
  void expect_undone(int steps = 1) {
    for (int k = 0; k < steps; ++k) desktop.key(GLFW_KEY_Z, true);
    EXPECT_EQ(desktop.scene_text(), before);
  }

  const std::string before = desktop.scene_text();
};

TEST_F(CanvasEditTest, PasteKeepsInnerLinksUnderNewIds) {
  choose({"library", "cafe", "school"});  // library_cafe and school_library are inner, market_cafe is not
  const std::size_t nodes = scene().nodes.size(), links = scene().links.size();
  desktop.key(GLFW_KEY_C, true);
  desktop.key(GLFW_KEY_V, true);
  EXPECT_EQ(scene().nodes.size(), nodes + 3);
  EXPECT_EQ(scene().links.size(), links + 2);
  EXPECT_EQ(editor().picks.nodes, (std::set<std::string>{"library-2", "cafe-2", "school-2"}));
  const LinkRecord& copy = scene().links.at("library_cafe-2");
  EXPECT_EQ(copy.from.ids, std::vector<std::string>{"library-2"});
  EXPECT_EQ(copy.to.ids, std::vector<std::string>{"cafe-2"});
  EXPECT_EQ(copy.parameters, scene().links.at("library_cafe").parameters);
  EXPECT_EQ(editor().document->history().size(), 1u);
  expect_undone();
}

TEST_F(CanvasEditTest, PasteIntoAnotherWindow) {
  choose({"library", "cafe"});
  desktop.key(GLFW_KEY_C, true);
  const std::string clip = ImGui::GetClipboardText();
  EXPECT_NE(clip.find("\"behaviourlinks\": \"clip\""), std::string::npos);
  NullDesktop other("scenes/nodes/smart_volume.json");
  other.frames(1);
  other.move_to({300, 300});
  ImGui::SetClipboardText(clip.c_str());
  other.key(GLFW_KEY_V, true);
  EXPECT_TRUE(other.editor().scene().nodes.contains("library"));
  EXPECT_TRUE(other.editor().scene().links.contains("library_cafe"));
}

TEST_F(CanvasEditTest, ForeignTextIsRefusedWithASentence) {
  for (const char* text :
       {"", "a shopping list", "{}", "[1, 2]", R"({"behaviourlinks": 7})", R"({"behaviourlinks": "clip", "nodes": 4})",
        R"({"behaviourlinks": "clip", "nodes": [{}]})", R"({"behaviourlinks": "clip", "nodes": [{"id": "x", "types": 3}]})",
        R"({"behaviourlinks": "clip", "links": [{"id": "l", "kind": "attract", "from": "nobody", "to": "none"}]})"}) {
    ImGui::SetClipboardText(text);
    desktop.key(GLFW_KEY_V, true);
    EXPECT_EQ(desktop.scene_text(), before) << text;
  }
  EXPECT_FALSE(editor().notices.empty());
}

TEST_F(CanvasEditTest, CutAndPasteBack) {
  choose({"library", "cafe"});
  desktop.key(GLFW_KEY_X, true);
  EXPECT_FALSE(scene().nodes.contains("library"));
  desktop.key(GLFW_KEY_V, true);
  EXPECT_TRUE(scene().nodes.contains("library"));
  EXPECT_TRUE(scene().links.contains("library_cafe"));
  expect_undone(2);
}

TEST_F(CanvasEditTest, DuplicateAndAltDrag) {
  choose({"library"});
  desktop.key(GLFW_KEY_D, true);
  EXPECT_TRUE(scene().nodes.contains("library-2"));
  expect_undone();
  desktop.frames(1);
  const ImVec2 from = at("theatre");
  desktop.hold(false, false, true);
  desktop.drag(from, {from.x + 20, from.y + 90});
  desktop.hold(false, false, false);
  ASSERT_TRUE(scene().nodes.contains("theatre-2"));
  desktop.frames(1);
  EXPECT_NEAR(at("theatre").x, from.x, 1e-2);
  EXPECT_NEAR(at("theatre-2").y, from.y + 90, 8);
  expect_undone();
}

TEST_F(CanvasEditTest, DeleteTakesLinksAndUndoBringsThemBack) {
  choose({"library"});
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_FALSE(scene().nodes.contains("library"));
  EXPECT_FALSE(scene().links.contains("library_cafe"));
  EXPECT_TRUE(editor().picks.nodes.empty());
  expect_undone();
}

TEST_F(CanvasEditTest, DeleteReconnectsLinksOfOneKind) {
  choose({"cafe"});
  desktop.key(GLFW_KEY_DELETE, true);
  EXPECT_FALSE(scene().nodes.contains("cafe"));  // its links are of two kinds: nothing to join
  expect_undone();
  ASSERT_TRUE(editor().submit(command<AddLink>({"a1", {R"({"kind": "attract", "from": "cafe", "to": "hotel"})"}})));
  desktop.frames(1);
  choose({"cafe"});
  desktop.key(GLFW_KEY_DELETE, true);
  bool is_joined = false;
  for (const auto& [id, link] : scene().links)
    is_joined |= link.kind == "attract" &&
                 ((link.from.ids == std::vector<std::string>{"library"} && link.to.ids == std::vector<std::string>{"hotel"}) ||
                  (link.from.ids == std::vector<std::string>{"hotel"} && link.to.ids == std::vector<std::string>{"library"}));
  EXPECT_TRUE(is_joined);
  expect_undone(2);
}

TEST_F(CanvasEditTest, MuteAndSolo) {
  editor().picks.only_link("hotel_market");
  desktop.key(GLFW_KEY_M);
  EXPECT_TRUE(scene().links.at("hotel_market").is_muted);
  desktop.key(GLFW_KEY_M);
  EXPECT_FALSE(scene().links.at("hotel_market").is_muted);
  desktop.key(GLFW_KEY_Q);
  EXPECT_FALSE(scene().links.at("hotel_market").is_muted);
  EXPECT_TRUE(scene().links.at("air").is_muted);
  desktop.key(GLFW_KEY_Q);
  EXPECT_EQ(desktop.logic_text(), before);
  expect_undone(4);
}

TEST_F(CanvasEditTest, ClickOnALinkChoosesIt) {
  look_at({"hotel", "market_hall"});
  desktop.click(canvas().screen_of_link("hotel_market").value());
  EXPECT_EQ(editor().picks.links, std::set<std::string>{"hotel_market"});
  EXPECT_TRUE(editor().picks.nodes.empty());
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_FALSE(scene().links.contains("hotel_market"));
  expect_undone();
}

TEST_F(CanvasEditTest, CollapseIsOneStep) {
  choose({"library", "cafe"});
  desktop.key(GLFW_KEY_H);
  desktop.frames(1);
  EXPECT_TRUE(board().model.boxes[board().model.find_box("library")].is_collapsed);
  desktop.key(GLFW_KEY_H);
  desktop.frames(1);
  EXPECT_EQ(desktop.logic_text(), before);
  EXPECT_TRUE(board().model.view.collapsed.empty());
  expect_undone(2);
}

TEST_F(CanvasEditTest, FrameMovesWhatIsInItAndShiftDragLeaves) {
  choose({"theatre", "assisted_living"});
  desktop.key(GLFW_KEY_G, true);
  desktop.frames(3);
  desktop.type("Quiet");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_TRUE(board().model.view.frames.contains("frame"));
  EXPECT_EQ(board().model.view.frames.at("frame").name, "Quiet");
  look_at({"theatre", "assisted_living"});
  canvas::Box box;
  ASSERT_TRUE(board().model.frame_box("frame", box));
  const ImVec2 head = canvas().to_screen({box.centre().x, box.at.y + 8}), theatre = at("theatre"), living = at("assisted_living");
  desktop.drag(head, {head.x, head.y + 50});
  EXPECT_GT(at("theatre").y, theatre.y + 30);
  EXPECT_NEAR(at("theatre").y - theatre.y, at("assisted_living").y - living.y, 0.1);
  choose({});
  const ImVec2 from = at("theatre");
  desktop.hold(false, true);
  desktop.drag(from, {from.x, from.y + 60});
  desktop.hold(false, false);
  desktop.frames(1);
  EXPECT_FALSE(board().model.view.frames.at("frame").nodes.contains("theatre"));
  EXPECT_TRUE(board().model.view.frames.at("frame").nodes.contains("assisted_living"));
  expect_undone(4);
}

TEST_F(CanvasEditTest, FramesNest) {
  choose({"theatre", "assisted_living"});
  desktop.key(GLFW_KEY_G, true);
  desktop.frames(2);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  board().picked_frames = {"frame"};
  choose({"cafe"});
  desktop.key(GLFW_KEY_G, true);
  desktop.frames(3);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_TRUE(board().model.view.frames.contains("frame-2"));
  EXPECT_EQ(board().model.view.frames.at("frame").in, "frame-2");
  canvas::Box outer, inner;
  ASSERT_TRUE(board().model.frame_box("frame-2", outer));
  ASSERT_TRUE(board().model.frame_box("frame", inner));
  EXPECT_TRUE(outer.encloses(inner));
}

TEST_F(CanvasEditTest, CommentIsWrittenWhereTheCursorIs) {
  desktop.key(GLFW_KEY_C, false, true);
  desktop.frames(3);
  desktop.type("Ask the city");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_EQ(board().model.view.comments.size(), 1u);
  EXPECT_EQ(board().model.view.comments.at("comment").text, "Ask the city");
  expect_undone(2);
}

TEST_F(CanvasEditTest, DotsByDoubleClickAreDragged) {
  look_at({"hotel", "market_hall"});
  editor().picks.clear();
  const ImVec2 middle = canvas().screen_of_link("hotel_market").value();
  desktop.double_click(middle);
  desktop.frames(2);
  ASSERT_TRUE(view().contains("dots")) << scene().view;
  EXPECT_EQ(view()["dots"]["hotel_market"].size(), 1u);
  desktop.frames(30);
  desktop.drag(middle, {middle.x, middle.y + 60});
  desktop.frames(1);
  EXPECT_NEAR(canvas().to_screen(board().model.view.dots.at("hotel_market").front()).y, middle.y + 60, 2);
  expect_undone(2);
}

TEST_F(CanvasEditTest, SwipeCutsLinksInOneStep) {
  look_at({"hotel", "market_hall", "cafe"});
  const ImVec2 a = canvas().screen_of_link("hotel_market").value(), b = canvas().screen_of_link("market_cafe").value();
  const ImVec2 begin{a.x - 2, a.y - 30}, turn{a.x + 2, a.y + 30}, end{b.x, b.y - 30};
  desktop.hold(true, false);
  desktop.move_to(begin);
  desktop.press(1);
  desktop.move_to(turn);
  desktop.move_to({b.x, b.y + 30});
  desktop.move_to(end);
  desktop.release(1);
  desktop.hold(false, false);
  EXPECT_FALSE(scene().links.contains("hotel_market"));
  EXPECT_FALSE(scene().links.contains("market_cafe"));
  EXPECT_EQ(editor().document->history().size(), 1u);
  expect_undone();
}

TEST_F(CanvasEditTest, HeldYCutsToo) {
  look_at({"hotel", "market_hall", "cafe"});
  editor().picks.clear();
  const ImVec2 a = canvas().screen_of_link("hotel_market").value();
  ImGui::GetIO().KeysDown[GLFW_KEY_Y] = true;
  desktop.drag({a.x, a.y - 30}, {a.x + 1, a.y + 30});
  ImGui::GetIO().KeysDown[GLFW_KEY_Y] = false;
  desktop.frames(1);
  EXPECT_FALSE(scene().links.contains("hotel_market"));
  expect_undone();
}

TEST_F(CanvasEditTest, MiddleClickPinsTheCard) {
  desktop.click(at("theatre"), 2);
  EXPECT_EQ(board().pinned, std::vector<std::string>{"theatre"});
  desktop.click(at("theatre"), 2);
  EXPECT_TRUE(board().pinned.empty());
}

TEST_F(CanvasEditTest, PointingAtALinkLightsItInAllPanels) {
  look_at({"hotel", "market_hall"});
  desktop.move_to(canvas().screen_of_link("hotel_market").value());
  EXPECT_EQ(editor().picks.lit_link, "hotel_market");
  desktop.move_to(at("hotel"));
  EXPECT_EQ(editor().picks.lit_node, "hotel");
}

TEST_F(CanvasEditTest, CtrlShiftDragMovesAllLinks) {
  look_at({"hotel", "office-1", "market_hall"});
  editor().picks.clear();
  desktop.hold(true, true);
  desktop.drag(at("hotel"), at("office-1"));
  desktop.hold(false, false);
  EXPECT_EQ(scene().links.at("hotel_market").from.ids, std::vector<std::string>{"office-1"});
  expect_undone();
}

TEST_F(CanvasEditTest, AlignDistributeAndLayOut) {
  choose({"theatre", "cafe", "library"});
  canvas::align_chosen(board(), canvas::Alignment::left);
  desktop.frames(1);
  EXPECT_NEAR(at("theatre").x, at("cafe").x, 1e-2);
  EXPECT_NEAR(at("library").x, at("cafe").x, 1e-2);
  canvas::distribute_chosen(board(), false);
  desktop.frames(1);
  canvas::lay_out_chosen(board());
  desktop.frames(1);
  EXPECT_EQ(editor().document->history().size(), 3u);
  expect_undone(3);
}

TEST_F(CanvasEditTest, MinimapCentres) {
  desktop.frames(1);
  const canvas::Box map = board().minimap;
  ASSERT_GT(map.size.x, 0);
  desktop.wheel(6);
  const ImVec2 before_move = board().camera.sight().centre();
  desktop.click({map.low().x + 20, map.high().y - 20});
  const ImVec2 after = board().camera.sight().centre();
  EXPECT_LT(after.x, before_move.x);
  EXPECT_GT(after.y, before_move.y);
}

TEST_F(CanvasEditTest, FamiliesCanBeHidden) {
  ASSERT_FALSE(board().chips.empty());
  const auto [label, chip] = board().chips.front();
  desktop.click(chip.centre());
  EXPECT_TRUE(board().hidden_families.contains(label));
  desktop.click(chip.centre());
  EXPECT_FALSE(board().hidden_families.contains(label));
}

TEST_F(CanvasEditTest, BoxesNeverOverlapInTheAutomaticLayout) {
  for (const char* file :
       {"scenes/start/quarter.json", "scenes/studies/sixty_volumes.json", "scenes/studies/thousand_volumes.json"}) {
    ASSERT_TRUE(editor().open(test::source_folder() + "/" + file));
    desktop.frames(2);
    const auto& boxes = board().model.boxes;
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = a + 1; b < boxes.size(); ++b)
        ASSERT_FALSE(boxes[a].box.touches(boxes[b].box)) << boxes[a].id << " " << boxes[b].id;
  }
}

TEST_F(CanvasEditTest, ViewsOfAnyShapeDoNoHarm) {
  for (const char* text : {R"({"boxes": 5})", R"({"boxes": {"library": "left"}})", R"({"boxes": {"library": [1]}})",
                           R"({"boxes": {"library": [1e300, -1e300]}})", R"({"boxes": {"library": [null, {}]}})",
                           R"({"collapsed": [1, 2], "frames": [], "comments": 3, "dots": "x", "sets": null})",
                           R"({"frames": {"a": {"in": "b"}, "b": {"in": "a", "nodes": {"library": true, "nobody": true}}}})",
                           R"({"frames": {"a": {"in": "a", "colour": -7}}})",
                           R"({"frames": {"a": {"name": 3, "colour": 1e99, "nodes": ["library"]}}})",
                           R"({"comments": {"c": {"at": [1, 2], "size": [-5, 1e12], "text": 4}}})",
                           R"({"dots": {"hotel_market": [[1, 2], 3, [4], ["a", "b"]], "nobody": [[1, 2]]}})",
                           R"({"sets": {"smart_volume": [0, 0]}, "collapsed": {"library": 1}})"}) {
    ASSERT_TRUE(editor().submit(command<SetView>({{text}, true}))) << text;
    desktop.frames(2);
    canvas().fit(true);
    desktop.frames(3);
    choose({"library"});
    desktop.key(GLFW_KEY_G, true);
    desktop.frames(2);
    desktop.key(GLFW_KEY_ESCAPE);
    desktop.frames(2);
    EXPECT_TRUE(canvas().screen_of("library").has_value());
  }
}

TEST_F(CanvasEditTest, EmptySceneAndGhosts) {
  std::vector<Problem> problems;
  auto document = Document::from_text(full_registry(), R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"teapot": {"x": 1}}}, {"id": "b"}], "links": [{"id": "l", "kind": "magic", "from": "a", "to": "b"},
    {"id": "m", "kind": "spell", "from": 3}]})",
                                      "", 1, problems);
  ASSERT_NE(document, nullptr);
  editor().take(std::move(document));
  desktop.frames(3);
  EXPECT_TRUE(board().model.boxes.front().is_ghost());
  EXPECT_EQ(board().model.lines.size(), 1u);
  EXPECT_EQ(board().model.undrawn, 1u);
  editor().take(Document::from_text(full_registry(), R"({"format": "behaviourlinks", "version": 1})", "", 1, problems));
  desktop.frames(3);
  EXPECT_TRUE(board().model.boxes.empty());
}

}  // namespace
}  // namespace bl::desktop
