// The 3D view as people use it, without a window: choosing, moving, kept views, layers, beamer mode.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/picking.h"

namespace bl::desktop {
namespace {

class ViewPanel : public ::testing::Test {
 protected:
  void SetUp() override {
    desktop.ticks(60);
    desktop.frames(30);
    look_from_above();
  }
  void look_from_above() {
    move_into_view();
    desktop.key(GLFW_KEY_1);
    desktop.frames(30);
  }
  void move_into_view() { desktop.move_to(empty_place()); }
  ImVec2 on_screen(const Point3& p) const {
    const Seen at = desktop_editor().view->place_in_window(p);
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
  }
  // Below the tools, beside the site.
  ImVec2 empty_place() { return {1440 - 330 - 30, 130}; }
  Workbench& editor() { return desktop.editor(); }
  const Workbench& desktop_editor() const { return const_cast<ViewPanel*>(this)->desktop.editor(); }
  Point3 place(const std::string& id) {
    return std::get<Vector3>(
        editor().state().value(*editor().state().plan->find(editor().index_of(id), {"node", "position", ""})));
  }
  Point3 set_place(const std::string& id) {
    return std::get<Vector3>(editor().scene().nodes.at(id).types.at("node").at("position"));
  }
  // A place in the picture that belongs to the node alone, seen from above.
  ImVec2 spot_of(const std::string& id) { return on_screen(place(id)); }

  NullDesktop desktop{"scenes/start/quarter.json"};
};

TEST_F(ViewPanel, DrawsEveryVolumeWithItsCell) {
  const auto facts = read_facts(editor().moment->state, nullptr);
  EXPECT_EQ(facts->volumes.size(), 17u);
  for (const VolumeFacts& volume : facts->volumes) {
    ASSERT_NE(volume.cell, nullptr) << volume.id;
    EXPECT_FALSE(volume.is_ball) << volume.id;
  }
  EXPECT_EQ(facts->boundaries.size(), 1u);
  EXPECT_FALSE(facts->boundaries[0].edges.empty());
  const Colouring colouring = colour_volumes(*facts, "use", editor().theme);
  const ViewScene scene = build_view(*facts, colouring, {}, editor().picks, editor().person, editor().theme);
  EXPECT_EQ(scene.volumes.size(), 17u);
  EXPECT_EQ(scene.surfaces.size(), 1u);
}

TEST_F(ViewPanel, ClicksChooseAddAndToggle) {
  desktop.click(spot_of("theatre"));
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"theatre"});
  desktop.hold(false, true);
  desktop.click(spot_of("housing-2"));
  EXPECT_EQ(editor().picks.nodes, (std::set<std::string>{"theatre", "housing-2"}));
  desktop.hold(true, false);
  desktop.click(spot_of("theatre"));
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"housing-2"});
  desktop.hold(false, false);
  desktop.frames(30);  // no double click
  desktop.click(empty_place());
  EXPECT_TRUE(editor().picks.nodes.empty());
}

TEST_F(ViewPanel, DelRemovesWhatWasChosenHere) {
  desktop.click(spot_of("theatre"));
  ASSERT_EQ(editor().picks.nodes, std::set<std::string>{"theatre"});
  ASSERT_EQ(editor().area, Area::view);
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_FALSE(editor().scene().nodes.contains("theatre"));
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_TRUE(editor().scene().nodes.contains("theatre"));
}

// The clock goes on between the look and the press, and between the press and its release.
class ViewPanelGoesOn : public ViewPanel, public ::testing::WithParamInterface<bool> {};

TEST_P(ViewPanelGoesOn, AClickTakesWhatWasShown) {
  const ImVec2 spot = spot_of("theatre");
  desktop.move_to(spot);
  ASSERT_EQ(editor().view->pointed_at(), "theatre");
  const bool moves_while_pressed = GetParam();
  if (moves_while_pressed) desktop.press();
  ASSERT_TRUE(editor().submit(command<SetPort>({"theatre", {"node.position"}, {"[900, 900, 10]"}})));
  editor().document->session().step(20);
  editor().document->session().settle();
  if (!moves_while_pressed) desktop.press();
  desktop.release();
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"theatre"});
  editor().picks.clear();
  desktop.frames(2);
  EXPECT_NE(editor().view->pointed_at(), "theatre") << "somebody else is there by now";
}

INSTANTIATE_TEST_SUITE_P(BeforeAndWhilePressed, ViewPanelGoesOn, ::testing::Values(false, true));

TEST_F(ViewPanel, PointingLightsTheNode) {
  desktop.move_to(spot_of("theatre"));
  EXPECT_EQ(editor().picks.hovered_node, "theatre");
  EXPECT_EQ(editor().view->pointed_at(), "theatre");
}

TEST_F(ViewPanel, BoxesToTheRightEncloseAndToTheLeftTouch) {
  const ImVec2 p = spot_of("theatre");
  const ImVec2 low{p.x - 8, p.y - 8}, high{p.x + 8, p.y + 8};
  // Over a volume, Shift makes it a box: pulling alone moves the volume.
  desktop.hold(false, true);
  desktop.drag(low, high);
  EXPECT_FALSE(editor().picks.nodes.contains("theatre")) << "too small to hold it";
  desktop.drag(high, low);
  desktop.hold(false, false);
  EXPECT_TRUE(editor().picks.nodes.contains("theatre"));
}

TEST_F(ViewPanel, MovesByAxisAndTypedLengthAsOneStep) {
  const std::string before = desktop.scene_text();
  desktop.click(spot_of("theatre"));
  const Point3 start = place("theatre");
  desktop.move_to(empty_place());
  desktop.key(GLFW_KEY_G);
  ASSERT_TRUE(editor().view->is_moving());
  desktop.key(GLFW_KEY_Y);
  desktop.type("250 cm");
  desktop.key(GLFW_KEY_ENTER);
  EXPECT_FALSE(editor().view->is_moving());
  const Point3 now = set_place("theatre");
  EXPECT_NEAR(now.x, start.x, 1e-3);
  EXPECT_NEAR(now.y, start.y + 2.5, 1e-3);
  EXPECT_NEAR(now.z, start.z, 1e-3);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(ViewPanel, EscapeTakesAMoveBack) {
  const std::string before = desktop.scene_text();
  desktop.click(spot_of("theatre"));
  desktop.key(GLFW_KEY_G);
  desktop.move_to({empty_place().x - 60, empty_place().y + 90});
  EXPECT_NE(desktop.scene_text(), before);
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_TRUE(editor().document->history().empty());
}

TEST_F(ViewPanel, DraggingWhatIsChosenMovesItLevelAndSnapsWithControl) {
  const std::string before = desktop.scene_text();
  desktop.click(spot_of("theatre"));
  desktop.frames(30);
  const ImVec2 grip{spot_of("theatre").x - 14, spot_of("theatre").y + 14};  // beside the gizmo
  const Point3 was = place("theatre");
  desktop.drag(grip, {grip.x + 40, grip.y});
  const Point3 moved = set_place("theatre");
  EXPECT_GT(moved.x, was.x + 2);
  EXPECT_EQ(place("theatre"), moved) << "seen at once, though the clock stands";
  EXPECT_NE(desktop.scene_text(), before);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before) << "one drag is one step";
}

TEST_F(ViewPanel, PullingAtAVolumeMovesItWithoutChoosingItFirst) {
  const std::string before = desktop.scene_text();
  ASSERT_TRUE(editor().picks.nodes.empty());
  const ImVec2 grip = spot_of("theatre");
  const Point3 was = place("theatre");
  desktop.drag(grip, {grip.x + 40, grip.y});
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"theatre"});
  EXPECT_GT(set_place("theatre").x, was.x + 2);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(ViewPanel, TheGizmosArmMovesAlongItsAxisAlone) {
  desktop.click(spot_of("theatre"));
  desktop.frames(30);
  const Point3 start = place("theatre");
  const ImVec2 middle = spot_of("theatre"), arm{middle.x + 60, middle.y};
  desktop.drag(arm, {arm.x + 50, arm.y + 30});
  const Point3 now = set_place("theatre");
  EXPECT_GT(now.x, start.x + 1);
  EXPECT_NEAR(now.y, start.y, 1e-3);
  EXPECT_NEAR(now.z, start.z, 1e-3);
}

TEST_F(ViewPanel, ALockedPlaceSaysSo) {
  ASSERT_TRUE(editor().submit(command<LockPort>({"theatre", {"node.position"}})));
  desktop.ticks(1);
  const std::string before = desktop.scene_text();
  desktop.click(spot_of("theatre"));
  desktop.key(GLFW_KEY_G);
  EXPECT_FALSE(editor().view->is_moving());
  EXPECT_EQ(desktop.scene_text(), before);
  ASSERT_FALSE(editor().notices.empty());
  EXPECT_NE(editor().notices.back().text.find("locked"), std::string::npos);
}

TEST_F(ViewPanel, KeepsViewsInTheSceneAndGoesBackToThemInBeamerMode) {
  desktop.move_to(empty_place());
  desktop.key(GLFW_KEY_4);
  desktop.frames(30);
  const Camera kept = editor().view->camera();
  desktop.key(GLFW_KEY_2, true);
  EXPECT_NE(editor().scene().view.find("cameras"), std::string::npos);
  desktop.key(GLFW_KEY_1);
  desktop.frames(30);
  EXPECT_GT(std::abs(editor().view->camera().elevation - kept.elevation), 0.1);
  desktop.key(GLFW_KEY_F1);
  ASSERT_TRUE(editor().is_beamer);
  desktop.key(GLFW_KEY_2);
  desktop.frames(30);
  EXPECT_NEAR(editor().view->camera().elevation, kept.elevation, 1e-6);
  EXPECT_NEAR(editor().view->camera().distance, kept.distance, 1e-6);
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(editor().is_beamer);
}

TEST_F(ViewPanel, WheelZoomsAndShiftWheelMovesTheSection) {
  desktop.move_to(spot_of("theatre"));
  const double before = editor().view->camera().distance;
  desktop.wheel(2);
  EXPECT_LT(editor().view->camera().distance, before);
  desktop.hold(false, true);
  desktop.wheel(1);
  EXPECT_TRUE(editor().view->section().is_on);
  const double at = editor().view->section().offset;
  desktop.wheel(-1);
  EXPECT_LT(editor().view->section().offset, at);
  desktop.hold(false, false);
}

TEST_F(ViewPanel, WalkingHoldsTheKeysUntilEscape) {
  desktop.move_to(empty_place());
  desktop.key(GLFW_KEY_6);
  ASSERT_TRUE(editor().view->is_walking());
  desktop.frames(30);
  const Point3 before = editor().view->camera().eye();
  ImGui::GetIO().KeysDown[GLFW_KEY_W] = true;
  desktop.frames(20);
  ImGui::GetIO().KeysDown[GLFW_KEY_W] = false;
  EXPECT_GT(distance(before, editor().view->camera().eye()), 0.5);
  EXPECT_NEAR(editor().view->camera().eye().z, before.z, 1e-6);
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(editor().view->is_walking());
}

TEST_F(ViewPanel, AfterWalkingEverythingIsInSightAgain) {
  desktop.move_to(empty_place());
  const Camera before = editor().view->camera();
  desktop.key(GLFW_KEY_6);
  desktop.frames(60);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(60);
  EXPECT_NEAR(editor().view->camera().distance, before.distance, 1e-6 * before.distance);
  desktop.key(GLFW_KEY_6);
  desktop.frames(60);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.key(GLFW_KEY_4);
  desktop.frames(60);
  EXPECT_NEAR(editor().view->camera().distance, before.distance, 1e-6 * before.distance);
}

TEST_F(ViewPanel, LayersAddTheirLines) {
  const auto facts = read_facts(editor().moment->state, nullptr);
  const Colouring colouring = colour_volumes(*facts, "error", editor().theme);
  const auto lines = [&] {
    return build_view(*facts, colouring, {}, editor().picks, editor().person, editor().theme).lines.size();
  };
  const std::size_t plain = lines();
  for (const char* layer : {"links", "weights", "neighbours", "cells"}) {
    set_layer(editor().person, layer, true);
    EXPECT_GT(lines(), plain) << layer;
    set_layer(editor().person, layer, false);
    EXPECT_EQ(lines(), plain) << layer;
  }
  EXPECT_TRUE(editor().person.layers.empty()) << "only what differs is kept";
}

TEST_F(ViewPanel, EveryColourChoiceHasALegend) {
  const auto facts = read_facts(editor().moment->state, nullptr);
  for (const ColourChoice& choice : colour_choices(*facts)) {
    const Colouring colouring = colour_volumes(*facts, choice.id, editor().theme);
    EXPECT_EQ(colouring.colours.size(), facts->volumes.size()) << choice.id;
    EXPECT_FALSE(colouring.legend.title.empty()) << choice.id;
    EXPECT_TRUE(!colouring.legend.rows.empty() || colouring.legend.ramp.size() > 2) << choice.id;
  }
  // Remembered from another scene.
  EXPECT_EQ(colour_volumes(*facts, "no.such_port", editor().theme).legend.title,
            colour_volumes(*facts, "use", editor().theme).legend.title);
}

TEST_F(ViewPanel, VolumesWithoutAShapeAreChosenByTheirMarks) {
  NullDesktop fresh("scenes/start/quarter.json");  // before its first tick no volume has a cell
  fresh.move_to(empty_place());
  fresh.key(GLFW_KEY_1);
  fresh.frames(30);
  Workbench& e = fresh.editor();
  ASSERT_EQ(e.view->facts()->volume_of(e.index_of("theatre"))->cell, nullptr);
  const Seen at = e.view->place_in_window(e.view->facts()->volume_of(e.index_of("theatre"))->figures.position);
  const ImVec2 spot{static_cast<float>(at.x), static_cast<float>(at.y)};
  for (const bool are_marks_on : {true, false}) {
    set_layer(e.person, "marks", are_marks_on);
    fresh.move_to(empty_place());
    fresh.frames(30);
    fresh.move_to(spot);
    EXPECT_EQ(e.view->pointed_at(), "theatre") << are_marks_on;
    fresh.click(spot);
    EXPECT_EQ(e.picks.nodes, std::set<std::string>{"theatre"}) << are_marks_on;
    e.picks.clear();
  }
}

TEST_F(ViewPanel, BoxesTakeWhatIsSeenAlone) {
  const auto facts = read_facts(editor().moment->state, nullptr);
  const Camera from_above = editor().view->camera();
  const Box all{-1e6, -1e6, 1e6, 1e6};
  const auto nodes = [&](const ViewSection& section) {
    return pick_box(all, true, *facts, {from_above, 600, 600, section, false});
  };
  const auto found = [&](const ViewSection& section, bool with_marks) {
    return pick_box(all, true, *facts, {from_above, 600, 600, section, with_marks}).size();
  };
  EXPECT_EQ(found({}, true), facts->volumes.size() + facts->marks.size());
  EXPECT_EQ(found({}, false), facts->volumes.size()) << "the layer of marks is off";
  const ViewSection below_ground{true, {0, 0, 1}, facts->ground - 5};
  EXPECT_EQ(found(below_ground, false), 0u) << "all of it is cut away";
  for (const VolumeFacts& volume : facts->volumes) {
    const auto rest = nodes({true, {0, 0, 1}, volume.figures.bottom + 0.5 * volume.figures.height});
    EXPECT_TRUE(std::binary_search(rest.begin(), rest.end(), volume.node)) << volume.id << " is cut through, and still there";
  }
}

TEST_F(ViewPanel, ADragThatLeavesTheWindowKeepsTheCamera) {
  const Camera before = editor().view->camera();
  const ImVec2 at = empty_place();
  desktop.move_to(at);
  desktop.hold(false, true);  // Shift makes it a pan
  desktop.press(1);
  ImGui::GetIO().MousePos = {at.x - 10, at.y};
  desktop.frames(1);
  EXPECT_GT(distance(editor().view->camera().target, before.target), 0.01) << "it is no drag";
  ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};  // what the backend says where the pointer is nowhere
  desktop.frames(2);
  EXPECT_LT(distance(editor().view->camera().target, before.target), before.distance);
  ImGui::GetIO().MousePos = {at.x - 20, at.y};
  desktop.frames(1);
  desktop.release(1);
  desktop.hold(false, false);
  const Camera& now = editor().view->camera();
  EXPECT_TRUE(is_finite(now.target));
  EXPECT_LT(distance(now.target, before.target), before.distance);
}

TEST_F(ViewPanel, AnotherSceneIsSeenAfresh) {
  // A new document often lies where the old one lay in memory. Each time another file: that of before would bring its section
  // back.
  const char* files[] = {"smart_volume", "boundary", "plot", "street"};
  for (int k = 0; k < 4; ++k) {
    if (!editor().view->section().is_on) editor().view->toggle_section();
    desktop.frames(1);
    ASSERT_TRUE(editor().view->section().is_on);
    editor().document.reset();
    editor().moment.reset();
    ASSERT_TRUE(editor().open(test::source_folder() + "/scenes/nodes/" + files[k] + ".json"));
    desktop.frames(1);
    EXPECT_FALSE(editor().view->section().is_on) << "the cut of the scene before, time " << k;
  }
}

TEST_F(ViewPanel, AMoveBeganWithFreshNodesMovesWhatIsChosen) {
  desktop.click(spot_of("theatre"));
  const Point3 start = place("theatre");
  desktop.move_to(empty_place());
  // The frame of the key is also the first that shows a node whose id comes before all others.
  ASSERT_TRUE(editor().submit(command<AddNode>({"aaa", {R"({"position": [5, 5, 5]})"}})));
  desktop.key(GLFW_KEY_G);
  ASSERT_TRUE(editor().view->is_moving());
  desktop.key(GLFW_KEY_X);
  desktop.type("2");
  desktop.key(GLFW_KEY_ENTER);
  EXPECT_NEAR(set_place("theatre").x, start.x + 2, 1e-3);
  EXPECT_NEAR(set_place("theatre").y, start.y, 1e-3);
}

TEST_F(ViewPanel, TheGizmoStandsInTheMiddleOfWhatCanMove) {
  ASSERT_TRUE(editor().submit(command<LockPort>({"housing-2", {"node.position"}})));
  desktop.ticks(1);
  editor().picks.nodes = {"theatre", "housing-2"};
  desktop.frames(30);
  const Point3 start = place("theatre");
  const ImVec2 middle = spot_of("theatre"), arm{middle.x + 60, middle.y};
  desktop.drag(arm, {arm.x + 50, arm.y + 30});
  const Point3 now = set_place("theatre");
  EXPECT_GT(now.x, start.x + 1);
  EXPECT_NEAR(now.y, start.y, 1e-3);
}

TEST_F(ViewPanel, ALengthThatIsNoneCanBeMended) {
  desktop.click(spot_of("theatre"));
  const Point3 start = place("theatre");
  desktop.move_to(empty_place());
  desktop.key(GLFW_KEY_G);
  desktop.key(GLFW_KEY_Y);
  desktop.type("5x");
  desktop.key(GLFW_KEY_ENTER);
  EXPECT_TRUE(editor().view->is_moving()) << "nobody has said that five metres are meant";
  ASSERT_FALSE(editor().notices.empty());
  EXPECT_NE(editor().notices.back().text.find("no length"), std::string::npos);
  desktop.key(GLFW_KEY_BACKSPACE);
  desktop.type("0");
  desktop.key(GLFW_KEY_ENTER);
  EXPECT_FALSE(editor().view->is_moving());
  EXPECT_NEAR(set_place("theatre").y, start.y + 50, 1e-3);
}

TEST(ViewPicking, MeetsTheBallInsideTheCellOnly) {
  const MeshPointer cell = ball_cell({0, 0, 0}, 10);
  const Ray from_above{{0, 0, 100}, {0, 0, -1}};
  const auto at = meet(from_above, *cell, {});
  ASSERT_TRUE(at);
  EXPECT_NEAR(*at, 90, 1e-9);
  EXPECT_FALSE(meet({{11, 0, 100}, {0, 0, -1}}, *cell, {}));
  // Half of it is cut away.
  const auto cut = meet(from_above, *cell, {true, {0, 0, 1}, 0});
  ASSERT_TRUE(cut);
  EXPECT_NEAR(*cut, 100, 1e-9);
  EXPECT_FALSE(meet({{0, 0, 100}, {0, 0, 1}}, *cell, {}));
}

TEST(ViewPicking, OtherMetricsAreShownAsTheirBalls) {
  NullDesktop desktop("scenes/studies/other_metrics.json");
  desktop.ticks(2);
  const auto facts = read_facts(desktop.editor().moment->state, nullptr);
  std::size_t balls = 0;
  for (const VolumeFacts& volume : facts->volumes) balls += volume.is_ball ? 1 : 0;
  EXPECT_GT(balls, 0u);
}

}  // namespace
}  // namespace bl::desktop
