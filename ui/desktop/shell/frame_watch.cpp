// Compares what is known with what was drawn last.
#include "ui/desktop/shell/frame_watch.h"

#include <algorithm>
#include <utility>

namespace bl::desktop {

namespace {

// After input, Dear ImGui needs some frames until all of it is seen: a list opens in one, knows its size in the next, is lit in
// the one after that.
constexpr int kInputFrames = 4;
// After the last thing that has happened, once more: what takes its place from the frame before it is right then.
constexpr double kLateSeconds = 0.1;
constexpr int kLateFrames = 2;

}  // namespace

FrameWatch::FrameWatch(Desktop& desktop, std::function<void()> wake) : desktop_(&desktop), sleep_(std::make_shared<Sleep>()) {
  sleep_->wake = std::move(wake);
  touch();
}

FrameWatch::~FrameWatch() {
  if (document_ != 0 && document_ == document()) desktop_->editor().document->running().unsubscribe_moments(listener_);
}

std::uint64_t FrameWatch::document() const {
  const Editor& editor = desktop_->editor();
  return editor.document ? editor.document->id() : 0;
}

// The listeners of a session that is gone went with it.
void FrameWatch::follow_document() {
  if (document_ == document()) return;
  document_ = document();
  touch();
  if (document_ == 0) return;
  listener_ = desktop_->editor().document->running().subscribe_moments([sleep = sleep_](const auto&) {
    if (sleep->is_asleep.exchange(false)) sleep->wake();
  });
}

bool FrameWatch::has_news() const {
  if (document_ == 0) return false;
  const host::Running& running = desktop_->editor().document->running();
  return running.moment() != drawn_ || running.has_news();
}

void FrameWatch::touch() {
  settling_ = kInputFrames;
  is_touched_ = true;
}

bool FrameWatch::is_due(double now) {
  Workbench& editor = desktop_->editor();
  follow_document();
  editor.now = now;
  if (editor.script_watch.poll(editor)) touch();
  if (now >= late_) {
    settling_ = std::max(settling_, kLateFrames);
    late_ = kNoFrame;
  }
  return settling_ > 0 || now >= editor.next_frame || has_news();
}

double FrameWatch::next_look() const {
  const Editor& editor = desktop_->editor();
  const double files = editor.document && editor.script_watch.size() > 0 ? editor.script_watch.next_look() : kNoFrame;
  return std::min({editor.next_frame, late_, files});
}

void FrameWatch::drawn(double now) {
  settling_ = std::max(0, settling_ - 1);
  if (drawn_ != desktop_->editor().moment || is_touched_) late_ = now + kLateSeconds;
  drawn_ = desktop_->editor().moment;
  is_touched_ = false;
}

bool FrameWatch::wait(const std::function<void()>& work) {
  sleep_->is_asleep = true;
  const bool has_time = !has_news();
  if (has_time) work();
  sleep_->is_asleep = false;
  return has_time;
}

}  // namespace bl::desktop
