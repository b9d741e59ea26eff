// What hands do between two frames, handed on so that nothing of it is lost: a tap shorter than a frame is still a tap.
#pragma once

#include <deque>
#include <set>

#include <imgui.h>

namespace bl::desktop {

/// What is typed into a field needs no frames of its own, and what has waited for seconds is not acted on any more: nobody means
/// it by then. What is held and where the mouse is stays true in either case.
///
/// Dear ImGui 1.86 looks at keys and buttons once per frame; what went down and up again in between, it would not see, and a
/// press it would see where the mouse is by then. Here each change waits for a frame in which it can be seen.
class InputQueue {
 public:
  void key(int key, bool is_down) { add(Kind::key, key, is_down, {}); }
  void text(unsigned int letter) { add(Kind::text, static_cast<int>(letter), true, {}); }
  void button(int button, bool is_down) { add(Kind::button, button, is_down, {}); }
  void wheel(ImVec2 steps);
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
    double time;  ///< on the queue's clock [s]
    long frame;
  };
  /// What the frame that is being made has got so far.
  struct Frame {
    bool has_press = false, has_plain_press = false, has_text = false, has_button = false, has_wheel = false;
    bool has_move = false;   ///< the mouse is where no frame has seen it yet
    bool has_order = false;  ///< a key, while people type, that is no part of a text: Enter, Backspace, a chord
  };
  void add(Kind kind, int code, bool is_down, ImVec2 at) { events_.push_back({kind, code, is_down, at, clock_, frame_}); }
  bool waits(const Event& event, const Frame& frame, bool is_typing) const;
  void apply(const Event& event, Frame& frame, ImGuiIO& io);
  bool is_written(const Event& event, const ImGuiIO& io) const;
  void drop_stale(ImGuiIO& io);

  std::deque<Event> events_;
  ImVec2 mouse_{kNowhere, kNowhere};
  bool buttons_[5] = {};
  std::set<int> dropped_keys_, dropped_buttons_;  ///< whose press was dropped, and whose release will be
  int frames_since_press_ = 1000;                 ///< of a key, while nobody typed
  int frames_since_order_ = 1000;                 ///< of a key that is no letter, or a button: it may have closed the field
  double clock_ = 0;                              ///< the sum of all frames' times [s]
  long frame_ = 0;
};

}  // namespace bl::desktop
