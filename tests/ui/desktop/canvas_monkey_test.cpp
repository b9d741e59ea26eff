// The canvas under random input: nothing breaks, and undo leads back to the first byte.
#include <random>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {
namespace {

constexpr int kDeeds = 500;

class Monkey {
 public:
  explicit Monkey(unsigned seed) : random_(seed), desktop_("scenes/start/quarter.json") {
    for (const Action& action : actions())
      if (action.area == Area::canvas || action.targets != 0) keys_.push_back(action.chord);
    desktop_.ticks(1);
  }
  NullDesktop& desktop() { return desktop_; }

  void act() {
    switch (draw(9)) {
      case 0: desktop_.click(draw(2) == 0 ? place() : at_node(), draw(2)); break;
      case 1: desktop_.double_click(place()); break;
      case 2: desktop_.drag(place(), place(), draw(3), 4); break;
      case 3: desktop_.wheel(static_cast<float>(draw(7)) - 3); break;
      case 4: drag_with_keys(); break;
      case 5: desktop_.type(std::string(1, static_cast<char>('a' + draw(26)))); break;
      case 6: {
        constexpr int kKeys[] = {GLFW_KEY_ENTER, GLFW_KEY_ESCAPE, GLFW_KEY_DOWN};
        desktop_.key(kKeys[draw(3)]);
        break;
      }
      case 7: desktop_.drag(at_node(), at_node(), 0, 3); break;
      default: {
        const Chord chord = keys_[static_cast<std::size_t>(draw(static_cast<int>(keys_.size())))];
        if (chord.key != 0) desktop_.key(chord.key, chord.ctrl, chord.shift, chord.alt);
      }
    }
    if (draw(20) == 0) desktop_.ticks(1);
  }

 private:
  int draw(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  ImVec2 place() {
    const canvas::Box& pane = desktop_.editor().canvas->board().camera.pane();
    return {pane.at.x + static_cast<float>(draw(static_cast<int>(pane.size.x))),
            pane.at.y + static_cast<float>(draw(static_cast<int>(pane.size.y)))};
  }
  ImVec2 at_node() {
    const auto& model = desktop_.editor().canvas->board().model;
    if (model.boxes.empty()) return place();
    const auto& id = model.boxes[static_cast<std::size_t>(draw(static_cast<int>(model.boxes.size())))].id;
    const ImVec2 at = (draw(2) == 0 ? desktop_.editor().canvas->handle_of(id) : desktop_.editor().canvas->screen_of(id)).value();
    return desktop_.editor().canvas->board().camera.pane().holds(at) ? at : place();
  }
  void drag_with_keys() {
    desktop_.hold(draw(2) == 0, draw(2) == 0, draw(3) == 0);
    desktop_.drag(at_node(), place(), draw(2), 4);
    desktop_.hold(false, false, false);
  }

  std::minstd_rand random_;
  NullDesktop desktop_;
  std::vector<Chord> keys_;
};

class CanvasMonkey : public ::testing::TestWithParam<unsigned> {};

TEST_P(CanvasMonkey, EndsWhereItBegan) {
  Monkey monkey(GetParam());
  NullDesktop& desktop = monkey.desktop();
  const std::string before = desktop.scene_text();
  for (int k = 0; k < kDeeds; ++k) monkey.act();
  const std::size_t entries = desktop.editor().document->session().log().size();
  EXPECT_GT(entries, 10u);
  for (std::size_t k = 0; k < entries && desktop.editor().document->session().undo(); ++k) continue;
  desktop.frames(2);
  EXPECT_EQ(desktop.scene_text(), before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CanvasMonkey, ::testing::Values(1u, 2u, 3u, 4u, 54u));

}  // namespace
}  // namespace bl::desktop
