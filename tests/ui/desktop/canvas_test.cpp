// The canvas with mouse and keys: pointing, choosing, moving, zooming, adding and linking.

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/support/processor_time.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/look/fuzzy.h"
#include "ui/desktop/panels/canvas/fits.h"

namespace bl::desktop {
namespace {

constexpr const char* kQuarter = "scenes/start/quarter.json";

class CanvasTest : public CanvasFixture {
 protected:
  /// Where nothing lies.
  ImVec2 empty() {
    const canvas::Box& pane = board().camera.pane();
    for (float y = pane.low().y + 90; y < pane.high().y - 130; y += 7)
      for (float x = pane.low().x + 20; x < pane.high().x - 20; x += 7)
        if (canvas::hit_at(board(), {x, y}).thing == canvas::Thing::nothing &&
            canvas::hit_at(board(), {x + 12, y + 12}).thing == canvas::Thing::nothing)
          return {x, y};
    ADD_FAILURE() << "no empty place";
    return pane.centre();
  }
  /// Two nodes and room around them.
  void look_at(const std::set<std::string>& nodes) {
    editor().picks.clear();
    editor().picks.nodes = nodes;
    canvas().fit(false);
    desktop.frames(30);
    editor().picks.clear();
  }
  std::size_t steps() { return editor().document->history().size(); }
};

TEST_F(CanvasTest, ClickChoosesAndShiftAddsAndCtrlToggles) {
  desktop.click(at("library"));
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
  desktop.hold(false, true);
  desktop.click(at("cafe"));
  EXPECT_EQ(editor().picks.nodes, (std::set<std::string>{"cafe", "library"}));
  desktop.hold(true, false);
  desktop.click(at("library"));
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"cafe"});
  desktop.hold(false, false);
  desktop.click(empty());
  EXPECT_TRUE(editor().picks.nodes.empty());
}

TEST_F(CanvasTest, BoxToTheRightEnclosesAndToTheLeftTouches) {
  look_at({"hotel"});
  const canvas::Box& box = board().model.boxes[board().model.find_box("hotel")].box;
  const ImVec2 low = canvas().to_screen({box.low().x - 16, box.low().y - 16}),
               high = canvas().to_screen({box.high().x + 16, box.high().y + 16});
  const ImVec2 inside = canvas().to_screen(box.centre());
  desktop.drag(low, high);
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"hotel"});
  desktop.drag(low, inside);
  EXPECT_TRUE(editor().picks.nodes.empty());
  const ImVec2 right_below = canvas().to_screen({box.centre().x + 30, box.high().y + 16});
  desktop.drag(right_below, {inside.x - 4, inside.y});
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"hotel"});
}

TEST_F(CanvasTest, DragIsOneStepAndUndoRestoresTheText) {
  const std::string before = desktop.scene_text();
  const ImVec2 from = at("theatre");
  desktop.drag(from, {from.x + 40, from.y + 60});
  EXPECT_EQ(steps(), 1u);
  EXPECT_NE(desktop.scene_text(), before);
  EXPECT_NEAR(at("theatre").x, from.x + 40, 8);
  EXPECT_NEAR(at("theatre").y, from.y + 60, 8);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
  desktop.frames(1);
  EXPECT_NEAR(at("theatre").x, from.x, 1e-3);
}

TEST_F(CanvasTest, EscapeEndsADragWithoutATrace) {
  const ImVec2 from = at("theatre");
  desktop.move_to(from);
  desktop.press();
  desktop.move_to({from.x + 50, from.y + 50});
  EXPECT_GT(at("theatre").x, from.x + 30);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.release();
  EXPECT_NEAR(at("theatre").x, from.x, 1e-3);
  EXPECT_EQ(steps(), 0u);
}

TEST_F(CanvasTest, SeveralMoveTogether) {
  desktop.click(at("theatre"));
  desktop.hold(false, true);
  desktop.click(at("cafe"));
  desktop.hold(false, false);
  const ImVec2 a = at("theatre"), b = at("cafe");
  desktop.drag(b, {b.x + 30, b.y + 44});
  EXPECT_NEAR(at("theatre").x - a.x, at("cafe").x - b.x, 1e-2);
  EXPECT_NEAR(at("theatre").y - a.y, at("cafe").y - b.y, 1e-2);
  EXPECT_EQ(steps(), 1u);
}

TEST_F(CanvasTest, ZoomKeepsThePointUnderTheCursor) {
  const ImVec2 cursor{311, 405};
  desktop.move_to(cursor);
  for (const float step : {1.0f, 1.0f, 3.0f, -2.0f, 5.0f, 1.0f, -9.0f, 4.0f}) {
    const ImVec2 plane = canvas().to_plane(cursor);
    const double before = canvas().zoom();
    desktop.wheel(step);
    EXPECT_NE(canvas().zoom(), before);
    EXPECT_NEAR(canvas().to_screen(plane).x, cursor.x, 1e-3);
    EXPECT_NEAR(canvas().to_screen(plane).y, cursor.y, 1e-3);
  }
}

TEST_F(CanvasTest, PansWithMiddleAndRightButtonAndWithSpace) {
  for (const int button : {1, 2}) {
    const ImVec2 before = at("cafe"), from = empty();
    desktop.drag(from, {from.x + 20, from.y + 30}, button);
    EXPECT_NEAR(at("cafe").x, before.x + 20, 8);
  }
  const ImVec2 before = at("cafe"), from = empty();
  desktop.move_to(from);
  ImGui::GetIO().KeysDown[GLFW_KEY_SPACE] = true;
  desktop.frames(1);
  desktop.drag(from, {from.x - 30, from.y});
  ImGui::GetIO().KeysDown[GLFW_KEY_SPACE] = false;
  desktop.frames(2);
  EXPECT_LT(at("cafe").x, before.x - 15);
  EXPECT_FALSE(board().picker.is_open);
  EXPECT_EQ(steps(), 0u);
}

TEST_F(CanvasTest, KeysZoomAndFit) {
  desktop.move_to(empty());
  desktop.key(GLFW_KEY_0, true);
  desktop.frames(30);
  EXPECT_NEAR(canvas().zoom(), 1, 1e-9);
  desktop.key(GLFW_KEY_EQUAL, true);
  desktop.frames(30);
  EXPECT_GT(canvas().zoom(), 1.2);
  desktop.key(GLFW_KEY_HOME);
  desktop.frames(30);
  EXPECT_LT(canvas().zoom(), 0.6);
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_F);
  desktop.frames(30);
  EXPECT_NEAR(canvas().zoom(), 1, 1e-6);
}

TEST_F(CanvasTest, AddsByTypingInTheSearchBox) {
  for (const int key : {GLFW_KEY_TAB, GLFW_KEY_SPACE}) {
    const std::string before = desktop.scene_text();
    const std::size_t count = editor().scene().nodes.size();
    desktop.move_to(empty());
    desktop.key(key);
    desktop.frames(3);
    ASSERT_TRUE(board().picker.is_open);
    desktop.type("smartvol");
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(2);
    ASSERT_EQ(editor().scene().nodes.size(), count + 1);
    ASSERT_TRUE(editor().scene().nodes.contains("smartvolume"));
    EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"smartvolume"});
    EXPECT_EQ(editor().person.recent_additions.front(), "smart_volume");
    const auto* place = std::get_if<Vector3>(&editor().scene().nodes.at("smartvolume").types.at("node").at("position"));
    ASSERT_NE(place, nullptr);
    EXPECT_GT(place->x, 0);
    EXPECT_LT(place->x, 137);
    EXPECT_GT(place->y, 0);
    EXPECT_LT(place->y, 96);
    desktop.key(GLFW_KEY_Z, true);
    EXPECT_EQ(desktop.scene_text(), before);
  }
}

TEST_F(CanvasTest, DoubleClickOnNothingSearchesAndEscLeaves) {
  desktop.double_click(empty());
  desktop.frames(2);
  EXPECT_TRUE(board().picker.is_open);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  EXPECT_FALSE(board().picker.is_open);
  EXPECT_EQ(steps(), 0u);
}

TEST_F(CanvasTest, GivesTheChosenNodeAFurtherRole) {
  desktop.click(at("library"));
  desktop.key(GLFW_KEY_TAB);
  desktop.frames(3);
  desktop.type("control role");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_TRUE(editor().scene().nodes.at("library").types.contains("control"));
}

TEST_F(CanvasTest, LaysALinkByDraggingAndChoosing) {
  look_at({"theatre", "garage"});
  const std::string before = desktop.scene_text();
  const std::size_t count = editor().scene().links.size();
  desktop.drag(canvas().handle_of("theatre").value(), at("garage"));
  desktop.frames(2);
  ASSERT_TRUE(board().picker.is_open);
  desktop.type("repel");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_EQ(editor().scene().links.size(), count + 1);
  const LinkRecord& link = editor().scene().links.at("theatre_garage");
  EXPECT_EQ(link.kind, "repel");
  EXPECT_EQ(link.from.ids, std::vector<std::string>{"theatre"});
  EXPECT_EQ(link.to.ids, std::vector<std::string>{"garage"});
  desktop.ticks(1);
  EXPECT_TRUE(canvas().screen_of_link("theatre_garage").has_value());
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(CanvasTest, RefusedKindsSayWhy) {
  look_at({"theatre", "garage"});
  desktop.drag(canvas().handle_of("theatre").value(), at("garage"));
  desktop.frames(2);
  ASSERT_TRUE(board().picker.is_open);
  bool has_demand = false;
  for (const canvas::Choice& choice : board().picker.choices) {
    if (choice.id == "attract") { EXPECT_EQ(choice.why_not, ""); }
    if (choice.id != "demand") continue;
    has_demand = true;
    EXPECT_NE(choice.why_not.find("Programme"), std::string::npos) << choice.why_not;
  }
  EXPECT_TRUE(has_demand);
  desktop.type("demand");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_EQ(steps(), 0u);
  EXPECT_FALSE(editor().notices.empty());
}

TEST_F(CanvasTest, DropOnNothingAddsALinkedNodeInOneStep) {
  look_at({"theatre", "garage"});
  const std::string before = desktop.scene_text();
  desktop.drag(canvas().handle_of("theatre").value(), empty());
  desktop.frames(2);
  ASSERT_TRUE(board().picker.is_open);
  desktop.type("attract smartvolume");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  ASSERT_TRUE(editor().scene().nodes.contains("smartvolume"));
  ASSERT_TRUE(editor().scene().links.contains("theatre_smartvolume"));
  EXPECT_EQ(steps(), 1u);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(CanvasTest, TabOffersLinksBetweenTheChosenInTheOrderOfChoosing) {
  const std::string before = desktop.scene_text();
  for (const bool is_turned : {false, true}) {
    desktop.click(at(is_turned ? "theatre" : "garage"));
    desktop.hold(false, true);
    desktop.click(at(is_turned ? "garage" : "theatre"));
    desktop.hold(false, false);
    desktop.key(GLFW_KEY_TAB);
    desktop.frames(3);
    ASSERT_TRUE(board().picker.is_open);
    desktop.type("repel");
    const canvas::Choice marked = board().picker.choices[board().picker.shown[board().picker.marked]];
    EXPECT_NE(marked.label.find(is_turned ? "Theatre  \xe2\x86\x92  Garage" : "Garage  \xe2\x86\x92  Theatre"), std::string::npos)
        << marked.label;
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(2);
    const std::string id = is_turned ? "theatre_garage" : "garage_theatre";
    ASSERT_TRUE(editor().scene().links.contains(id));
    EXPECT_EQ(editor().picks.links, std::set<std::string>{id});
    EXPECT_EQ(steps(), 1u);
    desktop.key(GLFW_KEY_Z, true);
    EXPECT_EQ(desktop.scene_text(), before);
    desktop.frames(2);
  }
}

TEST_F(CanvasTest, TabOffersLinksTheWayThatTheyFitAndToSeveral) {
  const std::string before = desktop.scene_text();
  desktop.move_to(empty());
  editor().picks.only_node("theatre");
  desktop.frames(1);
  editor().picks.nodes = {"theatre", "programme"};
  desktop.frames(1);
  desktop.key(GLFW_KEY_TAB);
  desktop.frames(3);
  std::size_t links = 0;
  for (const canvas::Choice& choice : board().picker.choices) {
    if (!choice.extra.starts_with("link")) continue;
    ++links;
    if (choice.id == "demand") {
      EXPECT_EQ(choice.extra, "link back") << "a programme asks of a volume, never the other way round";
    }
  }
  EXPECT_GT(links, 0u);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  editor().picks.only_node("theatre");
  desktop.frames(1);
  editor().picks.nodes = {"theatre", "cafe", "garage"};
  desktop.frames(1);
  desktop.key(GLFW_KEY_TAB);
  desktop.frames(3);
  desktop.type("repel");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_TRUE(editor().scene().links.contains("theatre_cafe"));
  EXPECT_TRUE(editor().scene().links.contains("theatre_garage"));
  EXPECT_EQ(steps(), 1u);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(CanvasTest, FindGoesThere) {
  desktop.move_to(empty());
  desktop.key(GLFW_KEY_F, true);
  desktop.frames(3);
  ASSERT_TRUE(board().picker.is_open);
  desktop.type("market");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(30);
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"market_hall"});
  EXPECT_TRUE(board().camera.pane().holds(at("market_hall")));
}

TEST_F(CanvasTest, ArrowsGoFromNodeToNode) {
  desktop.move_to(empty());
  editor().picks.only_node("theatre");
  desktop.key(GLFW_KEY_RIGHT);
  ASSERT_EQ(editor().picks.nodes.size(), 1u);
  EXPECT_NE(*editor().picks.nodes.begin(), "theatre");
  const std::string next = *editor().picks.nodes.begin();
  desktop.frames(30);
  EXPECT_GT(at(next).x, at("theatre").x);
}

TEST_F(CanvasTest, EnterEditsTheName) {
  desktop.move_to(empty());
  editor().picks.only_node("theatre");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  desktop.type("Opera");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_EQ(editor().name_of("theatre"), "Opera");
}

TEST(CanvasFits, EveryKindOfTheStartSceneFitsWhereItIs) {
  const NullDesktop desktop(kQuarter);
  const Scene& scene = const_cast<NullDesktop&>(desktop).editor().scene();
  for (const auto& [id, link] : scene.links)
    EXPECT_EQ(canvas::misfit(full_registry(), scene, *full_registry().link(link.kind), link.from, link.to), std::nullopt) << id;
}

TEST(CanvasLarge, AThousandNodesAreDrawnInTime) {
  NullDesktop desktop("scenes/studies/thousand_volumes.json");
  // What matters is that nothing is quadratic, and not what else the machine does.
  EXPECT_LT(test::processor_time([&] { desktop.frames(20); }) / 20, 0.1);
  EXPECT_TRUE(desktop.editor().canvas->screen_of("v0426").has_value());
}

TEST(CanvasFuzzy, LettersInOrderBeginningsFirst) {
  EXPECT_GT(fuzzy_score("lib", "Library"), fuzzy_score("lib", "Calibre"));
  EXPECT_GE(fuzzy_score("svol", "SmartVolume"), 0);
  EXPECT_GE(fuzzy_score("solver smart", "SmartVolumes solver"), 0);
  EXPECT_LT(fuzzy_score("zebra", "SmartVolume"), 0);
  EXPECT_EQ(fuzzy_score("", "anything"), 0);
}

}  // namespace
}  // namespace bl::desktop
