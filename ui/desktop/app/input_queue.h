// What hands do between two frames, handed on so that nothing of it is lost: a tap shorter than a frame is still a tap.
#pragma once

#include <deque>

#include <imgui.h>

namespace bl::desktop {

/// Dear ImGui 1.86 looks at keys and buttons once per frame; what went down and up again in between, it would not see, and a
/// press it would see where the mouse is by then. Here each change waits for a frame in which it can be seen.
class InputQueue {
 public:
  void key(int key, bool is_down) { events_.push_back({Kind::key, key, is_down, {}}); }
  void text(unsigned int letter) { events_.push_back({Kind::text, static_cast<int>(letter), true, {}}); }
  void button(int button, bool is_down) { events_.push_back({Kind::button, button, is_down, {}}); }
  void wheel(ImVec2 steps) { events_.push_back({Kind::wheel, 0, true, steps}); }
  /// Pixels of the window.
  void move(ImVec2 to);
  void leave() { move({kNowhere, kNowhere}); }

  /// Before each frame: as much as one frame can tell apart, in the order in which it happened.
  void hand_over(ImGuiIO& io);
  bool is_empty() const { return events_.empty(); }

 private:
  static constexpr float kNowhere = -1e30f;
  enum class Kind { key, text, button, wheel, move };
  struct Event {
    Kind kind;
    int code;
    bool is_down;
    ImVec2 at;
  };
  /// What the frame that is being made has got so far.
  struct Frame {
    bool has_press = false, has_plain_press = false, has_text = false, has_button = false, has_wheel = false;
  };
  bool waits(const Event& event, const Frame& frame, bool is_typing) const;
  void apply(const Event& event, Frame& frame, ImGuiIO& io);

  std::deque<Event> events_;
  ImVec2 mouse_{kNowhere, kNowhere};
  bool buttons_[5] = {};
  int frames_since_press_ = 1000;  ///< of a key, while nobody typed
};

}  // namespace bl::desktop
