// Which events share a frame.
#include "ui/desktop/app/input_queue.h"

#include <cfloat>

#include <GLFW/glfw3.h>

namespace bl::desktop {

namespace {

// A key may open a field to type into; it takes so many frames until letters reach it.
constexpr int kOpeningFrames = 3;

bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }

}  // namespace

// Of many movements in a row only the last one counts.
void InputQueue::move(ImVec2 to) {
  if (!events_.empty() && events_.back().kind == Kind::move) events_.back().at = to;
  else events_.push_back({Kind::move, 0, true, to});
}

bool InputQueue::waits(const Event& event, const Frame& frame, bool is_typing) const {
  const bool has_mouse = frame.has_button || frame.has_wheel;
  switch (event.kind) {
    case Kind::move: return has_mouse || frame.has_press;
    case Kind::button: return has_mouse || frame.has_press || frame.has_text;
    case Kind::wheel: return has_mouse || frame.has_press || frame.has_text;
    case Kind::text: return has_mouse || (!is_typing && frames_since_press_ < kOpeningFrames);
    case Kind::key: break;
  }
  // A chord is its modifiers first and then one key: whatever else comes in one frame would make another chord of it.
  if (!event.is_down) return has_mouse || frame.has_press || frame.has_text;
  if (has_mouse || frame.has_plain_press || frame.has_text) return true;
  return !is_modifier(event.code) && !is_typing && frames_since_press_ < kOpeningFrames;
}

void InputQueue::apply(const Event& event, Frame& frame, ImGuiIO& io) {
  switch (event.kind) {
    case Kind::move: mouse_ = event.at; break;
    case Kind::button:
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
      if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[event.code] = event.is_down;
      frame.has_press = frame.has_press || event.is_down;
      frame.has_plain_press = frame.has_plain_press || (event.is_down && !is_modifier(event.code));
      break;
  }
}

void InputQueue::hand_over(ImGuiIO& io) {
  Frame frame;
  const bool is_typing = io.WantTextInput;
  ++frames_since_press_;
  while (!events_.empty() && !waits(events_.front(), frame, is_typing)) {
    apply(events_.front(), frame, io);
    events_.pop_front();
  }
  if (frame.has_plain_press && !is_typing) frames_since_press_ = 0;
  const auto is_down = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
  io.KeyCtrl = is_down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
  io.KeyShift = is_down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
  io.KeyAlt = is_down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
  io.KeySuper = is_down(GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
  for (int k = 0; k < IM_ARRAYSIZE(buttons_); ++k) io.MouseDown[k] = buttons_[k];
  io.MousePos = mouse_.x <= kNowhere ? ImVec2{-FLT_MAX, -FLT_MAX} : mouse_;
}

}  // namespace bl::desktop
