// What lies over the canvas and how large it is written: switches, minimap, pinned cards, names, comments and labels.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/canvas/draw.h"

namespace bl::desktop {
namespace {

class SightTest : public ::testing::Test {
 protected:
  SightTest() : SightTest(ImVec2(1440, 900)) {}
  explicit SightTest(ImVec2 size) : desktop("scenes/start/quarter.json", size) {
    desktop.ticks(1);
    canvas().fit(true);
    desktop.frames(30);
  }
  Workbench& editor() { return desktop.editor(); }
  Canvas& canvas() { return *editor().canvas; }
  canvas::Board& board() { return canvas().board(); }
  const canvas::NodeBox& box(const std::string& id) { return board().model.boxes[board().model.find_box(id)]; }

  NullDesktop desktop;
};

class SmallSightTest : public SightTest {
 protected:
  SmallSightTest() : SightTest(ImVec2(640, 420)) {}
};

TEST_F(SmallSightTest, SwitchesFoldIntoOneButtonWithAList) {
  ASSERT_TRUE(board().families.is_folded) << board().camera.pane().size.x << " x " << board().camera.pane().size.y;
  ASSERT_EQ(board().chips.size(), 1u);
  const ImVec2 button = board().chips.front().second.centre();
  EXPECT_LT(board().chips.front().second.high().y - board().camera.pane().low().y, 40);
  desktop.click(button);
  desktop.frames(3);
  ASSERT_TRUE(board().families.is_open);
  ASSERT_GT(board().families.rows.size(), 1u);
  const auto [label, row] = board().families.rows.front();
  desktop.click(row.centre());
  desktop.frames(2);
  EXPECT_TRUE(board().hidden_families.contains(label));
  EXPECT_TRUE(board().families.is_open) << "several can be switched";
  desktop.click(row.centre());
  desktop.frames(2);
  EXPECT_FALSE(board().hidden_families.contains(label));
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  EXPECT_FALSE(board().families.is_open);
  EXPECT_TRUE(editor().picks.nodes.contains("library")) << "the key closes the list, and no more";
}

TEST_F(SmallSightTest, FitUsesMostOfASmallPane) {
  const canvas::Box all = board().camera.to_screen(board().model.bounds()), pane = board().camera.pane();
  EXPECT_EQ(board().minimap.size.x, 0) << "no minimap where there is no room for it";
  EXPECT_TRUE(pane.encloses(all));
  EXPECT_GT(std::max(all.size.x / pane.size.x, all.size.y / pane.size.y), 0.6f);
}

TEST_F(SightTest, NothingLiesUnderTheMinimapAfterFit) {
  for (const char* scene : {"scenes/start/quarter.json", "scenes/studies/sixty_volumes.json"}) {
    ASSERT_TRUE(editor().open(test::source_folder() + "/" + scene));
    desktop.frames(3);
    canvas().fit(true);
    desktop.frames(30);
    ASSERT_GT(board().minimap.size.x, 0);
    for (std::size_t k = 0; k < board().model.anchors(); ++k)
      EXPECT_FALSE(board().minimap.touches(board().camera.to_screen(board().model.anchor(k)))) << scene << " " << k;
    for (const auto& [label, chip] : board().chips)
      EXPECT_FALSE(chip.touches(board().camera.to_screen(board().model.bounds()))) << scene;
  }
}

TEST(Camera, FitStaysClearOfTheCornerOnlyWhereThatIsCheap) {
  canvas::Camera camera;
  camera.set_pane({{0, 0}, {800, 600}}, 1, 0);
  camera.set_corner({160, 120});
  const canvas::Box all{{0, 0}, {2000, 1500}};
  camera.fit(all, false);
  const canvas::Box corner{{0, 480}, {160, 120}};
  EXPECT_FALSE(corner.touches(camera.to_screen(all)));
  camera.fit(all, false, {{{1500, 0}, {100, 100}}});
  EXPECT_TRUE(corner.touches(camera.to_screen(all))) << "its corner is empty: there is nothing to keep clear";
  camera.set_corner({500, 500});
  camera.fit(all, false);
  EXPECT_GT(camera.zoom(), 0.3) << "as large as without";
}

TEST_F(SightTest, PinnedCardsAreClosedByTheirCrossAndByEscape) {
  for (const char* id : {"theatre", "cafe"}) desktop.click(canvas().screen_of(id).value(), 2);
  desktop.move_to(board().camera.pane().low());
  desktop.frames(2);
  ASSERT_EQ(board().crosses.size(), 2u);
  const canvas::Box pane = board().camera.pane();
  for (const auto& [id, cross] : board().crosses) EXPECT_TRUE(pane.encloses(cross)) << id;
  const auto [id, cross] = board().crosses.back();
  desktop.click(cross.centre());
  desktop.frames(2);
  EXPECT_EQ(board().pinned, std::vector<std::string>{"theatre"});
  EXPECT_EQ(board().crosses.size(), 1u);
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_EQ(board().pinned.size(), 1u) << "first what is chosen";
  EXPECT_TRUE(editor().picks.nodes.empty());
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_TRUE(board().pinned.empty());
}

TEST_F(SightTest, APinnedCardStaysInThePaneWhenItsNodeLeavesIt) {
  board().pinned = {"theatre"};
  board().camera.pan({-5000, 3000});
  desktop.frames(2);
  ASSERT_EQ(board().crosses.size(), 1u);
  EXPECT_TRUE(board().camera.pane().encloses(board().crosses.front().second));
}

TEST_F(SightTest, ACollapsedNodeKeepsItsNameAtTheZoomOfTheWhole) {
  editor().picks.only_node("library");
  desktop.key(GLFW_KEY_H);
  desktop.frames(2);
  for (const double zoom : {0.4, 0.35, 0.3, 0.25}) {
    board().camera.go_to({0, 0, zoom}, false);
    const float height = canvas::name_height(board(), box("library")), bar = box("library").box.size.y * board().camera.factor();
    EXPECT_LE(height, bar);
    EXPECT_GT(height, 0.75f * std::min(bar, 8.0f)) << zoom;
  }
}

TEST_F(SightTest, CommentsAreReadableFromAfar) {
  const canvas::Comment comment{"Ask the city", {{0, 0}, {220, 70}}};
  for (const double zoom : {0.4, 0.35, 0.3}) {
    board().camera.go_to({0, 0, zoom}, false);
    EXPECT_GE(canvas::comment_height(board(), comment), 8) << zoom;
  }
  board().camera.go_to({0, 0, 0.05}, false);
  EXPECT_LT(canvas::comment_height(board(), comment), 4) << "no larger than the paper";
  board().camera.go_to({0, 0, 2}, false);
  EXPECT_FLOAT_EQ(canvas::comment_height(board(), comment), 25);
}

TEST_F(SightTest, AShortLineHasNoLabelOverIt) {
  canvas::Line line;
  line.points = {{0, 0}, {30, 0}, {60, 0}};
  board().camera.go_to({0, 0, 1}, false);
  EXPECT_TRUE(canvas::is_longer_than(board(), line, 59));
  EXPECT_FALSE(canvas::is_longer_than(board(), line, 61));
  board().camera.go_to({0, 0, 0.5}, false);
  EXPECT_FALSE(canvas::is_longer_than(board(), line, 31));
  line.points.clear();
  EXPECT_FALSE(canvas::is_longer_than(board(), line, 1));
}

}  // namespace
}  // namespace bl::desktop
