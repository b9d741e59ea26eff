// Handles of a standing volume in the 3D view: storeys, angle and aspect by the hand, each drag one step.
#include <algorithm>
#include <cmath>
#include <optional>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/reading/views/volume.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

using Handle = SceneView::Handle;

class ViewReshape : public ::testing::Test {
 protected:
  void SetUp() override {
    desktop.ticks(80);
    desktop.frames(40);
    desktop.choose(kVolume);
    editor().area = Area::view;
  }
  Workbench& editor() { return desktop.editor(); }
  std::optional<ImVec2> handle(Handle which) {
    for (const auto& [one, place] : editor().view->handles())
      if (one == which) return place;
    return {};
  }
  double port(const std::string& port) { return desktop.number(kVolume, "footprint", port); }
  ImVec2 pixels_above(const Point3& from, double metres) {
    const Seen a = editor().view->place_in_window(from), b = editor().view->place_in_window(from + Vector3{0, 0, metres});
    return {static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y)};
  }
  static constexpr const char* kVolume = "housing-1";
  PanelDesktop desktop{"scenes/start/standing.json"};
};

TEST_F(ViewReshape, PullingAtTheRoofAddsWholeStoreysAsOneStep) {
  const auto grip = handle(Handle::storeys);
  ASSERT_TRUE(grip);
  const double before = port("storeys");
  const VolumeFacts& volume = *editor().view->facts()->volume_of(editor().index_of(kVolume));
  const Point3 roof = volume.figures.position + Vector3{0, 0, volume.figures.height};
  const ImVec2 up = pixels_above(roof, 3.2 * volume.figures.storey_height);
  const std::size_t steps = desktop.steps();
  desktop.drag(*grip, {grip->x + up.x, grip->y + up.y});
  EXPECT_EQ(port("storeys"), before + 3);
  EXPECT_EQ(desktop.steps(), steps + 1);
  desktop.ticks(5);
  EXPECT_EQ(reading::row_of<reading::FootprintFigures>(editor().state(), editor().index_of(kVolume))->storeys_built, before + 3);
  editor().undo();
  desktop.frames(2);
  EXPECT_EQ(port("storeys"), before);
}

TEST_F(ViewReshape, TheRoundHandleTurnsTheBlockAndSnapsWithControl) {
  editor().view->look_from(SceneView::Side::plan);
  desktop.frames(40);
  const auto grip = handle(Handle::angle);
  ASSERT_TRUE(grip);
  const Seen middle =
      editor().view->place_in_window(editor().view->facts()->volume_of(editor().index_of(kVolume))->figures.position);
  // By twenty degrees counter-clockwise; the picture's y points down.
  const double turn = -20 * 3.14159265358979 / 180, dx = grip->x - middle.x, dy = grip->y - middle.y;
  const ImVec2 to{static_cast<float>(middle.x + std::cos(turn) * dx - std::sin(turn) * dy),
                  static_cast<float>(middle.y + std::sin(turn) * dx + std::cos(turn) * dy)};
  const double before = port("angle");
  const std::size_t steps = desktop.steps();
  desktop.drag(*grip, to);
  EXPECT_NEAR(port("angle"), before + 20, 0.5);
  EXPECT_EQ(desktop.steps(), steps + 1);
  EXPECT_FALSE(editor().view->is_moving());
  editor().undo();
  desktop.frames(2);
  EXPECT_EQ(port("angle"), before);
  desktop.move_to(*grip);
  desktop.press();
  desktop.hold(true, false);
  desktop.move_to(to);
  desktop.frames(2);
  EXPECT_EQ(std::fmod(port("angle"), 15), 0);
  desktop.hold(false, false);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.release();
  desktop.frames(2);
  EXPECT_EQ(port("angle"), before) << "Esc takes it back";
  EXPECT_EQ(desktop.steps(), steps);
}

TEST_F(ViewReshape, TheSquareHandleChangesTheSidesAndKeepsTheArea) {
  editor().view->look_from(SceneView::Side::plan);
  desktop.frames(40);
  const auto grip = handle(Handle::aspect);
  ASSERT_TRUE(grip);
  const Seen middle =
      editor().view->place_in_window(editor().view->facts()->volume_of(editor().index_of(kVolume))->figures.position);
  const double before = port("aspect");
  const ImVec2 to{static_cast<float>(middle.x + 1.25 * (grip->x - middle.x)),
                  static_cast<float>(middle.y + 1.25 * (grip->y - middle.y))};
  desktop.drag(*grip, to);
  EXPECT_NEAR(port("aspect"), before / (1.25 * 1.25), 0.03 * before);
  editor().undo();
  desktop.frames(2);
  EXPECT_EQ(port("aspect"), before);
}

TEST_F(ViewReshape, ALockedPortSaysSoAndHandlesAreThoseOfTheForm) {
  ASSERT_TRUE(editor().submit(command<SetPort>({kVolume, {"footprint.form"}, {"\"round\""}})));
  desktop.ticks(5);
  desktop.frames(3);
  EXPECT_FALSE(handle(Handle::angle));
  EXPECT_FALSE(handle(Handle::aspect));
  ASSERT_TRUE(editor().submit(command<LockPort>({kVolume, {"footprint.storeys"}})));
  desktop.frames(3);
  const auto grip = handle(Handle::storeys);
  ASSERT_TRUE(grip);
  const double before = port("storeys");
  desktop.drag(*grip, {grip->x, grip->y - 120});
  EXPECT_EQ(port("storeys"), before);
  ASSERT_FALSE(editor().notices.empty());
  EXPECT_NE(editor().notices.back().text.find("is locked"), std::string::npos);
}

}  // namespace
}  // namespace bl::desktop
