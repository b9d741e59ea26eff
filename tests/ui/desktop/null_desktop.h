// The whole desktop without a window: frames, mouse and keys are given by the test; nothing is drawn on a screen.
#pragma once

#include <string>
#include <string_view>

#include <imgui.h>

#include "ui/desktop/shell/desktop.h"
#include "ui/desktop/view/renderer.h"

namespace bl::desktop {

class NullDesktop {
 public:
  /// `scene`: path below the source directory, or empty for the start page. The clock stands still: tests tick by hand.
  explicit NullDesktop(const std::string& scene = "", ImVec2 size = {1440, 900});
  ~NullDesktop();
  NullDesktop(const NullDesktop&) = delete;
  NullDesktop& operator=(const NullDesktop&) = delete;

  Workbench& editor() { return desktop_->editor(); }
  Desktop& desktop() { return *desktop_; }
  /// Draws so many frames with the input as it is.
  void frames(int count = 1);
  /// Draws one frame at that time of the window's clock [s], however long after the last one.
  void frame_at(double now);
  double now() const { return now_; }
  /// Ticks, and the frame that shows them.
  void ticks(int count);

  // Input: each goes through the frames that a person's would take.
  void move_to(ImVec2 at);
  void press(int button = 0);
  void release(int button = 0);
  void click(ImVec2 at, int button = 0);
  void double_click(ImVec2 at);
  /// Presses at `from`, moves in steps, lets go at `to`.
  void drag(ImVec2 from, ImVec2 to, int button = 0, int steps = 6);
  void wheel(float steps);
  /// A GLFW key, with modifiers held as they are set.
  void key(int key, bool ctrl = false, bool shift = false, bool alt = false);
  void hold(bool ctrl, bool shift, bool alt = false);
  void type(std::string_view text);

  /// The scene's text, as it would be saved.
  std::string scene_text();
  /// The same without the view: where boxes lie, and what else nothing that is computed depends on.
  std::string logic_text();

 private:
  PersonSettings person_;
  NullRenderer renderer_;
  ImGuiContext* context_;
  std::unique_ptr<Desktop> desktop_;
  double now_ = 0;
};

}  // namespace bl::desktop
