// What tests of the canvas share: the desktop with a scene that has ticked once, and short ways to its parts.
#pragma once

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {

class CanvasFixture : public ::testing::Test {
 protected:
  explicit CanvasFixture(const std::string& scene = "scenes/start/quarter.json") : desktop(scene) { desktop.ticks(1); }
  Workbench& editor() { return desktop.editor(); }
  Canvas& canvas() { return *editor().canvas; }
  canvas::Board& board() { return canvas().board(); }
  const Scene& scene() { return editor().scene(); }
  ImVec2 at(const std::string& node) { return canvas().screen_of(node).value(); }
  /// Of nodes and links these nodes alone; frames that are picked stay so.
  void choose(const std::set<std::string>& nodes) {
    editor().picks.clear();
    editor().picks.nodes = nodes;
  }
  void choose_alone(const std::set<std::string>& nodes) {
    board().picked_frames.clear();
    board().picked_comments.clear();
    choose(nodes);
  }

  NullDesktop desktop;
};

}  // namespace bl::desktop
