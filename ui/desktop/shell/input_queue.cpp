// Which events share a frame.
#include "ui/desktop/shell/input_queue.h"

#include <algorithm>
#include <cfloat>

#include <GLFW/glfw3.h>

namespace bl::desktop {

namespace {

// A key may open a field to type into; it takes so many frames until letters reach it.
constexpr int kOpeningFrames = 3;

// Older than this nothing is acted on any more: frames that take so long are many more than a chord needs.
constexpr double kStaleSeconds = 2;
constexpr long kStaleFrames = 20;
constexpr double kLongestFrame = 0.5;  // [s]

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }
bool is_shift(int key) { return key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT; }
bool is_letter(int key) { return key >= GLFW_KEY_SPACE && key < GLFW_KEY_ESCAPE; }

}  // namespace

// Of many movements in a row only the last one counts.
void InputQueue::move(ImVec2 to) {
  if (!events_.empty() && events_.back().kind == Kind::move) events_.back().at = to;
  else add(Kind::move, 0, true, to);
}

// Steps in a row are one turn.
void InputQueue::wheel(ImVec2 steps) {
  if (events_.empty() || events_.back().kind != Kind::wheel) return add(Kind::wheel, 0, true, steps);
  ImVec2& turn = events_.back().at;
  turn = {turn.x + steps.x, turn.y + steps.y};
}

// Keys whose letters go into the open field: only the letters count there.
bool InputQueue::is_written(const Event& event, const ImGuiIO& io) const {
  if (event.kind != Kind::key || !io.WantTextInput || frames_since_order_ < kOpeningFrames) return false;
  const auto is_held = [&](int key) { return io.KeysDown[key]; };
  const bool is_chord = is_held(GLFW_KEY_LEFT_CONTROL) || is_held(GLFW_KEY_RIGHT_CONTROL) || is_held(GLFW_KEY_LEFT_ALT) ||
                        is_held(GLFW_KEY_RIGHT_ALT) || is_held(GLFW_KEY_LEFT_SUPER) || is_held(GLFW_KEY_RIGHT_SUPER);
  return !is_chord && (is_letter(event.code) || is_shift(event.code));
}

// Of a backlog only what is still so: modifiers, the mouse's place, and that what was pressed is let go.
void InputQueue::drop_stale(ImGuiIO& io) {
  const auto is_stale = [&](const Event& e) { return clock_ - e.time > kStaleSeconds && frame_ - e.frame > kStaleFrames; };
  Frame nothing;
  for (; !events_.empty() && is_stale(events_.front()); events_.pop_front()) {
    const Event& event = events_.front();
    const bool is_state = event.kind == Kind::move || (event.kind == Kind::key && is_modifier(event.code));
    if (is_state || !event.is_down) apply(event, nothing, io);
    else if (event.kind == Kind::key) dropped_keys_.insert(event.code);
    else if (event.kind == Kind::button) dropped_buttons_.insert(event.code);
  }
}

bool InputQueue::waits(const Event& event, const Frame& frame, bool is_typing) const {
  const bool has_mouse = frame.has_button || frame.has_wheel;
  switch (event.kind) {
    case Kind::move: return has_mouse || frame.has_press;
    // A tab takes a press only where the frame before has seen the mouse on it, or on nothing.
    case Kind::button: return has_mouse || frame.has_press || frame.has_text || (event.is_down && frame.has_move);
    case Kind::wheel: return has_mouse || frame.has_press || frame.has_text;
    case Kind::text: return has_mouse || (is_typing && frame.has_order) || (!is_typing && frames_since_press_ < kOpeningFrames);
    case Kind::key: break;
  }
  // A chord is its modifiers first and then one key: whatever else comes in one frame would make another chord of it.
  if (!event.is_down) return has_mouse || frame.has_press || frame.has_text;
  if (has_mouse || frame.has_plain_press || frame.has_text) return true;
  return !is_modifier(event.code) && !is_typing && frames_since_press_ < kOpeningFrames;
}

void InputQueue::apply(const Event& event, Frame& frame, ImGuiIO& io) {
  switch (event.kind) {
    case Kind::move:
      frame.has_move = frame.has_move || event.at.x != mouse_.x || event.at.y != mouse_.y;
      mouse_ = event.at;
      break;
    case Kind::button:
      if (!event.is_down && dropped_buttons_.erase(event.code) != 0) break;
      if (event.code >= 0 && event.code < IM_ARRAYSIZE(buttons_)) buttons_[event.code] = event.is_down;
      frame.has_button = true;
      break;
    case Kind::wheel:
      io.MouseWheelH += event.at.x;
      io.MouseWheel += event.at.y;
      frame.has_wheel = true;
      break;
    case Kind::text:
      io.AddInputCharacter(static_cast<unsigned int>(event.code));
      frame.has_text = true;
      break;
    case Kind::key:
      if (!event.is_down && dropped_keys_.erase(event.code) != 0) break;
      if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[event.code] = event.is_down;
      frame.has_press = frame.has_press || event.is_down;
      frame.has_plain_press = frame.has_plain_press || (event.is_down && !is_modifier(event.code));
      break;
  }
}

void InputQueue::hand_over(ImGuiIO& io) {
  Frame frame;
  const bool is_typing = io.WantTextInput;
  // Before this frame the window may have stood still for hours: that has kept nobody's hands waiting.
  clock_ += std::min(static_cast<double>(io.DeltaTime), kLongestFrame);
  ++frame_;
  ++frames_since_press_;
  ++frames_since_order_;
  drop_stale(io);
  while (!events_.empty()) {
    const Event event = events_.front();
    if (is_written(event, io)) {
      if (frame.has_order || frame.has_button || frame.has_wheel) break;
      Frame unseen;  // down and up again in one frame, if it comes so
      apply(event, unseen, io);
    } else {
      if (waits(event, frame, is_typing)) break;
      apply(event, frame, io);
      frame.has_order = frame.has_plain_press && is_typing;
    }
    events_.pop_front();
  }
  if (frame.has_plain_press && !is_typing) frames_since_press_ = 0;
  if (frame.has_order || frame.has_button) frames_since_order_ = 0;
  const auto is_down = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
  io.KeyCtrl = is_down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
  io.KeyShift = is_down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
  io.KeyAlt = is_down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
  io.KeySuper = is_down(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
  for (int k = 0; k < IM_ARRAYSIZE(buttons_); ++k) io.MouseDown[k] = buttons_[k];
  io.MousePos = mouse_.x <= kNowhere ? ImVec2{-FLT_MAX, -FLT_MAX} : mouse_;
}

}  // namespace bl::desktop
