// Context menus of the canvas: over what they open, what they offer, and that what they run is what keys run.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/canvas/context_menu.h"

namespace bl::desktop {
namespace {

using canvas::Thing;

class MenuTest : public CanvasFixture {
 protected:
  MenuTest() {
    EXPECT_TRUE(editor().arrange(R"({"frames": {"f": {"name": "Old town", "nodes": {"theatre": true}}},
                                     "comments": {"c": {"at": [-500, -300], "size": [200, 80], "text": "why?"}}})"));
    canvas().fit(true);
    desktop.frames(30);
  }
  ImVec2 empty() {
    const canvas::Box& pane = board().camera.pane();
    for (float y = pane.low().y + 120; y < pane.high().y - 130; y += 7)
      for (float x = pane.low().x + 20; x < pane.high().x - 20; x += 7)
        if (canvas::hit_at(board(), {x, y}).thing == Thing::nothing) return {x, y};
    ADD_FAILURE() << "no empty place";
    return pane.centre();
  }
  std::set<std::string> labels() {
    std::set<std::string> all;
    for (const Action* action : canvas::offered(board())) all.insert(action->label);
    return all;
  }
  void right_click(ImVec2 place) {
    desktop.click(place, 1);
    desktop.frames(2);
  }
  // Walks there by arrows, as the mouse would point.
  void take(const std::string& label) {
    const auto items = canvas::offered(board());
    std::size_t place = 0;
    while (place < items.size() && label != items[place]->label) ++place;
    ASSERT_LT(place, items.size()) << label;
    for (std::size_t k = 0; k <= items.size() && board().menu.marked != place; ++k) desktop.key(GLFW_KEY_DOWN);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(3);
  }
  std::size_t steps() { return editor().document->history().size(); }
};

TEST_F(MenuTest, ARightClickOpensItAndChoosesWhatLiesUnderIt) {
  right_click(at("library"));
  ASSERT_TRUE(board().menu.is_open);
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
  EXPECT_TRUE(labels().contains("Rename"));
  EXPECT_TRUE(labels().contains("Mute"));
  EXPECT_FALSE(labels().contains("Comment"));
  EXPECT_FALSE(labels().contains("Align left")) << "there is only one to align";
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  EXPECT_FALSE(board().menu.is_open);
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
  EXPECT_EQ(steps(), 1u);
}

TEST_F(MenuTest, EscapeClosesItAndNoMore) {
  right_click(at("library"));
  ASSERT_TRUE(board().menu.is_open);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  EXPECT_FALSE(board().menu.is_open);
  EXPECT_EQ(editor().picks.nodes, std::set<std::string>{"library"});
  right_click(at("library"));
  take("Collapse");
  EXPECT_TRUE(board().model.view.collapsed.contains("library"));
}

TEST_F(MenuTest, WhatIsChosenStaysChosen) {
  editor().picks.nodes = {"library", "cafe"};
  right_click(at("cafe"));
  EXPECT_EQ(editor().picks.nodes.size(), 2u);
  EXPECT_TRUE(labels().contains("Align left"));
  take("Collapse");
  EXPECT_TRUE(board().model.view.collapsed.contains("library"));
  EXPECT_TRUE(board().model.view.collapsed.contains("cafe"));
  EXPECT_EQ(steps(), 2u);
}

TEST_F(MenuTest, ARightDragPansAndOpensNothing) {
  const ImVec2 before = at("cafe"), from = empty();
  desktop.drag(from, {from.x + 40, from.y + 30}, 1);
  desktop.frames(2);
  EXPECT_FALSE(board().menu.is_open);
  EXPECT_NEAR(at("cafe").x, before.x + 40, 8);
}

TEST_F(MenuTest, WhatItAddsLiesWhereItWasOpened) {
  const ImVec2 place = empty(), plane = canvas().to_plane(place);
  right_click(place);
  ASSERT_TRUE(board().menu.is_open);
  desktop.move_to({place.x + 40, place.y + 60});
  take("Comment");
  ASSERT_TRUE(board().model.view.comments.contains("comment"));
  EXPECT_NEAR(board().model.view.comments.at("comment").box.at.x, plane.x, 1);
  EXPECT_NEAR(board().model.view.comments.at("comment").box.at.y, plane.y, 1);
}

TEST_F(MenuTest, OpensFromTheKeyboard) {
  editor().picks.only_node("hotel");
  desktop.move_to(empty());
  for (const bool is_menu_key : {true, false}) {
    desktop.key(is_menu_key ? GLFW_KEY_MENU : GLFW_KEY_F10, false, !is_menu_key);
    desktop.frames(2);
    ASSERT_TRUE(board().menu.is_open);
    EXPECT_EQ(board().menu.over.id, "hotel");
    desktop.key(GLFW_KEY_ESCAPE);
    desktop.frames(2);
    ASSERT_FALSE(board().menu.is_open);
  }
  desktop.key(GLFW_KEY_MENU);
  desktop.frames(2);
  take("Delete");
  EXPECT_FALSE(editor().scene().nodes.contains("hotel"));
  desktop.key(GLFW_KEY_MENU);
  desktop.frames(2);
  EXPECT_EQ(board().menu.over.thing, Thing::nothing) << "nothing is chosen: the menu of the ground";
}

TEST_F(MenuTest, ASecondRightClickOpensItElsewhere) {
  right_click(empty());
  EXPECT_EQ(board().menu.over.thing, Thing::nothing);
  const ImVec2 far = at("garage");
  right_click(far);
  ASSERT_TRUE(board().menu.is_open);
  EXPECT_EQ(board().menu.over.id, "garage");
}

TEST_F(MenuTest, ASetOffersItsMembers) {
  const auto& pills = board().model.pills;
  ASSERT_FALSE(pills.empty());
  const std::size_t members = pills.front().members.size();
  right_click(board().camera.to_screen(pills.front().box.centre()));
  ASSERT_EQ(board().menu.over.thing, Thing::pill);
  take("Select the members of the set");
  EXPECT_EQ(editor().picks.nodes.size(), members);
}

TEST_F(MenuTest, ALinkGetsADotWhereItWasClicked) {
  editor().picks.nodes = {"hotel", "market_hall"};
  canvas().fit(false);
  desktop.frames(30);
  right_click(canvas().screen_of_link("hotel_market").value());
  EXPECT_EQ(editor().picks.links, std::set<std::string>{"hotel_market"});
  take("Add a dot to the link");
  EXPECT_EQ(board().model.view.dots.at("hotel_market").size(), 1u);
}

TEST_F(MenuTest, AFrameCanBeEnteredAndRenamed) {
  board().picked_frames = {"f"};
  canvas().fit(false);
  desktop.frames(30);
  canvas::Box box;
  ASSERT_TRUE(board().model.frame_box("f", box));
  const ImVec2 head = canvas().to_screen({box.high().x - 20, box.at.y + 8});
  right_click(head);
  ASSERT_EQ(board().menu.over.thing, Thing::frame);
  EXPECT_TRUE(labels().contains("Rename"));
  take("Enter the frame");
  EXPECT_EQ(board().model.entered, "f");
  right_click(empty());
  take("Leave the frame");
  EXPECT_EQ(board().model.entered, "");
}

TEST_F(MenuTest, SwitchesHaveNone) {
  right_click(board().chips.front().second.centre());
  EXPECT_FALSE(board().menu.is_open);
  right_click(board().minimap.centre());
  EXPECT_FALSE(board().menu.is_open);
}

// Whatever it stands over: it offers something, all of it can be done, and each of it says its key as the list of keys does.
TEST_F(MenuTest, EveryMenuOffersOnlyWhatCanBeDone) {
  const canvas::Hit things[] = {{Thing::nothing, "", 0},          {Thing::node, "library", 0},
                                {Thing::link, "hotel_market", 0}, {Thing::frame, "f", 0},
                                {Thing::comment, "c", 0},         {Thing::pill, board().model.pills.front().key, 0}};
  std::set<const Action*> seen;
  for (const canvas::Hit& thing : things) {
    canvas::open_menu(board(), thing, {300, 300});
    desktop.frames(2);
    ASSERT_TRUE(board().menu.is_open);
    const auto items = canvas::offered(board());
    EXPECT_FALSE(items.empty());
    for (const Action* action : items) {
      seen.insert(action);
      EXPECT_TRUE(action->can == nullptr || action->can(editor())) << action->label;
      EXPECT_TRUE(action >= actions().data() && action < actions().data() + actions().size());
    }
    desktop.key(GLFW_KEY_ESCAPE);
    desktop.frames(2);
  }
  EXPECT_GT(seen.size(), 20u);
}

}  // namespace
}  // namespace bl::desktop
