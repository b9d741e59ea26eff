// Frames that are entered: what is shown, the doors, the ways in and out, and what joins the frame.
#include <random>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/inspector.h"

namespace bl::desktop {
namespace {

// The library and the café in a frame, and the hotel in another one inside of it; the school and the market hall stay outside.
constexpr const char* kFrames = R"({"frames": {
  "culture": {"name": "Culture", "nodes": {"library": true, "cafe": true}, "comments": {"note": true}},
  "beds": {"name": "Beds", "in": "culture", "nodes": {"hotel": true}}},
  "comments": {"note": {"at": [900, -200], "size": [200, 60], "text": "near the square"},
               "other": {"at": [-600, -200], "size": [200, 60], "text": "elsewhere"}}})";

using canvas::operator+, canvas::operator-;

class EnteredTest : public ::testing::Test {
 protected:
  EnteredTest() : desktop("scenes/start/quarter.json") {
    desktop.ticks(1);
    desktop.move_to({300, 300});
    EXPECT_TRUE(editor().arrange(kFrames));
    desktop.frames(2);
    before = desktop.scene_text();
    steps_before = steps();
  }
  Workbench& editor() { return desktop.editor(); }
  Canvas& canvas() { return *editor().canvas; }
  canvas::Board& board() { return canvas().board(); }
  canvas::Model& model() { return board().model; }
  const Scene& scene() { return editor().scene(); }
  std::size_t steps() { return editor().document->history().size(); }
  void enter(const std::string& frame) {
    canvas::enter_frame(board(), frame);
    desktop.frames(30);
  }
  std::set<std::string> shown() {
    std::set<std::string> ids;
    for (const canvas::NodeBox& box : model().boxes) ids.insert(box.id);
    return ids;
  }
  const canvas::Door* door_to(const std::string& id) {
    for (const canvas::Door& door : model().doors)
      if (door.id == id) return &door;
    return nullptr;
  }
  bool is_in(const std::string& frame, const std::string& node) { return model().view.holds_node(frame, node); }

  NullDesktop desktop;
  std::string before;
  std::size_t steps_before = 0;
};

TEST_F(EnteredTest, KeysEnterAndLeave) {
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_I);
  EXPECT_EQ(model().entered, "culture");
  EXPECT_EQ(shown(), (std::set<std::string>{"cafe", "hotel", "library"}));
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
  editor().picks.only_node("hotel");
  desktop.key(GLFW_KEY_I);
  EXPECT_EQ(model().entered, "beds");
  EXPECT_EQ(shown(), std::set<std::string>{"hotel"});
  EXPECT_EQ(board().crumbs.size(), 3u);
  desktop.key(GLFW_KEY_U);
  EXPECT_EQ(model().entered, "culture");
  EXPECT_EQ(board().picked_frames, std::set<std::string>{"beds"});
  desktop.key(GLFW_KEY_I);
  EXPECT_EQ(model().entered, "beds");
  desktop.key(GLFW_KEY_U);
  desktop.key(GLFW_KEY_U);
  desktop.key(GLFW_KEY_U);
  EXPECT_EQ(model().entered, "");
  EXPECT_EQ(shown().size(), scene().nodes.size());
  EXPECT_EQ(steps(), steps_before) << "which frame is entered is the person's own";
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(EnteredTest, DoubleClickOnTheHeadEntersAndF2Renames) {
  board().picked_frames = {"culture"};
  canvas().fit(false);
  desktop.frames(30);
  canvas::Box box;
  ASSERT_TRUE(model().frame_box("culture", box));
  const ImVec2 head = canvas().to_screen({box.centre().x, box.at.y + 8});
  desktop.click(head);
  desktop.key(GLFW_KEY_F2);
  desktop.frames(2);
  desktop.type("Art");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(30);
  EXPECT_EQ(model().view.frames.at("culture").name, "Art");
  desktop.double_click(head);
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture");
  EXPECT_EQ(board().edit.thing, canvas::Thing::nothing);
}

TEST_F(EnteredTest, CrumbsLeadUp) {
  enter("beds");
  ASSERT_EQ(board().crumbs.size(), 3u);
  EXPECT_EQ(board().crumbs[1].label, "Culture");
  EXPECT_EQ(board().crumbs[2].label, "Beds");
  EXPECT_GT(board().chips.front().second.low().y, board().crumbs[2].box.low().y);
  desktop.click(board().crumbs[1].box.centre());
  EXPECT_EQ(model().entered, "culture");
  desktop.click(board().crumbs[0].box.centre());
  EXPECT_EQ(model().entered, "");
  EXPECT_TRUE(board().crumbs.empty());
}

TEST_F(EnteredTest, TheCameraComesBackToWhereItWas) {
  desktop.wheel(3);
  desktop.frames(30);
  const ImVec2 place = board().camera.sight().centre();
  const double zoom = canvas().zoom();
  enter("culture");
  EXPECT_GT(std::abs(canvas().zoom() - zoom), 1e-6);
  desktop.key(GLFW_KEY_U);
  desktop.frames(30);
  EXPECT_NEAR(canvas().zoom(), zoom, 1e-9);
  EXPECT_NEAR(board().camera.sight().centre().x, place.x, 0.1);
}

TEST_F(EnteredTest, DoorsStandForWhatIsOutside) {
  enter("culture");
  ASSERT_NE(door_to("market_hall"), nullptr);
  EXPECT_EQ(door_to("market_hall")->label, editor().name_of("market_hall"));
  const std::size_t crossing = model().find_line("hotel_market"), inner = model().find_line("library_cafe");
  ASSERT_LT(crossing, model().lines.size());
  ASSERT_LT(inner, model().lines.size());
  EXPECT_TRUE(model().lines[crossing].is_crossing);
  EXPECT_FALSE(model().lines[inner].is_crossing);
  for (const canvas::Door& door : model().doors)
    for (const canvas::NodeBox& box : model().boxes) EXPECT_FALSE(door.box.touches(box.box)) << door.id << " " << box.id;
  desktop.click(canvas().to_screen(door_to("market_hall")->box.centre()));
  desktop.frames(30);
  EXPECT_EQ(model().entered, "");
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"market_hall"});
  EXPECT_TRUE(board().camera.pane().holds(canvas().screen_of("market_hall").value()));
}

TEST_F(EnteredTest, ADoorOfAnOuterFrameLeadsOnlyThatFar) {
  ASSERT_TRUE(editor().submit(command<AddLink>({"bridge", {R"({"kind": "attract", "from": "hotel", "to": "library"})"}})));
  desktop.frames(1);
  enter("beds");
  ASSERT_NE(door_to("library"), nullptr);
  desktop.click(canvas().to_screen(door_to("library")->box.centre()));
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture");
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
}

TEST_F(EnteredTest, ALinkCanBeLaidToADoor) {
  enter("culture");
  const std::size_t links = scene().links.size();
  desktop.drag(canvas().handle_of("library").value(), canvas().to_screen(door_to("market_hall")->box.centre()));
  desktop.frames(2);
  ASSERT_TRUE(board().picker.is_open);
  desktop.type("repel");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_EQ(scene().links.size(), links + 1);
  EXPECT_EQ(scene().links.at("library_market_hall").to.ids, std::vector<std::string>{"market_hall"});
  EXPECT_EQ(model().entered, "culture");
}

TEST_F(EnteredTest, AFrameThatGoesIsLeft) {
  editor().picks.nodes = {"library", "cafe"};
  desktop.key(GLFW_KEY_G, true);
  desktop.frames(2);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_EQ(model().view.frames.at("frame").in, "culture");
  enter("frame");
  EXPECT_EQ(shown(), (std::set<std::string>{"cafe", "library"}));
  desktop.key(GLFW_KEY_Z, true);
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture");
  desktop.key(GLFW_KEY_Z, true);
  desktop.frames(2);
  EXPECT_EQ(model().entered, "");
}

TEST_F(EnteredTest, WhatIsChosenElsewhereLeavesTheFrame) {
  enter("beds");
  editor().picks.only_node("hotel");
  desktop.frames(2);
  EXPECT_EQ(model().entered, "beds");
  editor().picks.only_node("library");
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture");
  editor().picks.only_link("hotel_market");
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture") << "a link that crosses the edge is seen";
  editor().picks.only_node("theatre");
  desktop.frames(30);
  EXPECT_EQ(model().entered, "");
  EXPECT_TRUE(board().camera.pane().holds(canvas().screen_of("theatre").value()));
  enter("culture");
  canvas().show("school");
  EXPECT_EQ(model().entered, "");
  enter("culture");
  editor().picks.only_node("theatre");
  canvas().fit(false);
  EXPECT_EQ(model().entered, "");
}

TEST_F(EnteredTest, FindLeavesTheFrame) {
  enter("culture");
  desktop.key(GLFW_KEY_F, true);
  desktop.frames(3);
  desktop.type("theatre");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(30);
  EXPECT_EQ(model().entered, "");
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"theatre"});
}

TEST_F(EnteredTest, WhatIsAddedJoinsTheFrameInOneStep) {
  enter("culture");
  const std::string text = desktop.scene_text();
  const auto add = [&](const char* what) {
    desktop.key(GLFW_KEY_TAB);
    desktop.frames(3);
    desktop.type(what);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(2);
  };
  editor().picks.clear();
  add("smartvol");
  EXPECT_TRUE(is_in("culture", "smartvolume"));
  EXPECT_EQ(model().entered, "culture");
  EXPECT_EQ(steps(), steps_before + 1);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), text);
  desktop.frames(1);
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_C, true);
  desktop.key(GLFW_KEY_V, true);
  EXPECT_TRUE(is_in("culture", "library-2"));
  EXPECT_EQ(steps(), steps_before + 1);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), text);
  desktop.key(GLFW_KEY_C, false, true);
  desktop.frames(2);
  EXPECT_TRUE(model().view.frames.at("culture").comments.contains("comment"));
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), text);
}

TEST_F(EnteredTest, AnExpressionOfTheInspectorJoinsTheFrame) {
  enter("culture");
  editor().picks.only_node("library");
  desktop.frames(2);
  drive_by_expression(editor(), "library", "smart_volume.demand", 900, Unit::cubic_metre);
  desktop.frames(2);
  EXPECT_EQ(model().entered, "culture");
  ASSERT_EQ(editor().picks.nodes.size(), 1u);
  EXPECT_TRUE(is_in("culture", *editor().picks.nodes.begin()));
}

TEST_F(EnteredTest, ChoosingActsOnWhatIsShown) {
  enter("culture");
  desktop.key(GLFW_KEY_A, true);
  EXPECT_EQ(editor().picks.nodes, shown());
  EXPECT_EQ(board().picked_comments, std::set<std::string>{"note"});
  editor().picks.clear();
  const canvas::Box& pane = board().camera.pane();
  desktop.drag(pane.low() + ImVec2(4, 100), pane.high() - ImVec2(4, 4));
  for (const std::string& id : editor().picks.nodes) EXPECT_TRUE(is_in("culture", id));
  editor().picks.clear();
  const auto stored = model().view.boxes;
  canvas::lay_out_chosen(board());
  desktop.frames(2);
  for (const auto& [id, place] : model().view.boxes) {
    const auto known = stored.find(id);
    if (known != stored.end() && known->second.x == place.x && known->second.y == place.y) continue;
    EXPECT_TRUE(known == stored.end() || is_in("culture", id)) << "only what is shown is laid out";
  }
}

TEST_F(EnteredTest, ShiftDragLeavesAnInnerFrameOnly) {
  enter("culture");
  for (const char* node : {"hotel", "library"}) {
    const ImVec2 from = canvas().screen_of(node).value();
    desktop.hold(false, true);
    desktop.drag(from, from + ImVec2(30, 40));
    desktop.hold(false, false);
    desktop.frames(2);
    EXPECT_EQ(model().view.frame_of_node(node), "culture");
    EXPECT_EQ(model().entered, "culture");
    editor().picks.clear();
  }
}

// Over random nested frames: each shows what lies in it and nothing else, no link is lost, and leaving restores the whole.
TEST_F(EnteredTest, NothingIsLostInAnyFrame) {
  std::minstd_rand random(7);
  const auto draw = [&](std::size_t below) { return static_cast<std::size_t>(random() % below); };
  for (int round = 0; round < 12; ++round) {
    Json view = Json::object();
    const std::size_t count = 2 + draw(5);
    for (std::size_t k = 0; k < count; ++k) {
      view["frames"]["f" + std::to_string(k)]["name"] = "F";
      if (k > 0 && draw(3) > 0) view["frames"]["f" + std::to_string(k)]["in"] = "f" + std::to_string(draw(count));
    }
    for (const auto& [id, node] : scene().nodes)
      if (draw(3) > 0) view["frames"]["f" + std::to_string(draw(count))]["nodes"][id] = true;
    ASSERT_TRUE(editor().submit(command<SetView>({{view.dump()}, true})));
    desktop.frames(1);
    std::map<std::string, ImVec2> places;
    for (const canvas::NodeBox& box : model().boxes) places[box.id] = box.box.at;
    for (std::size_t k = 0; k < count; ++k) {
      const std::string frame = "f" + std::to_string(k);
      enter(frame);
      ASSERT_EQ(model().entered, frame);
      EXPECT_EQ(model().boxes.size() + model().outside_boxes.size(), scene().nodes.size());
      EXPECT_EQ(model().lines.size() + model().outside_lines.size() + model().undrawn, scene().links.size());
      for (const canvas::NodeBox& box : model().boxes) {
        EXPECT_TRUE(is_in(frame, box.id));
        EXPECT_EQ(box.box.at.x, places[box.id].x);
        EXPECT_EQ(box.box.at.y, places[box.id].y);
      }
      for (const canvas::Line& line : model().lines) {
        EXPECT_FALSE(model().is_door(line.from) && model().is_door(line.to));
        EXPECT_EQ(line.is_crossing, model().is_door(line.from) || model().is_door(line.to));
      }
      enter("");
      EXPECT_EQ(model().boxes.size(), places.size());
      EXPECT_TRUE(model().doors.empty());
    }
  }
}

}  // namespace
}  // namespace bl::desktop
