// Serves each tick once; a frame between two ticks has nothing to do.
#include "ui/desktop/app/live_scene.h"

#include <filesystem>

namespace bl::desktop {

void LiveScene::frame(Editor& editor) {
  const std::uint64_t number = editor.document ? editor.document->id() : 0;
  if (number != document_) {
    document_ = number;
    connections_.reset();
    tick_ = -1;
    entries_ = 0;
    if (number != 0)
      connections_ = std::make_unique<Connections>(
          LiveOptions{std::filesystem::path(editor.document->path()).parent_path().string(), is_live_, {}});
  }
  if (!connections_ || !editor.moment) return;
  LiveSession& session = editor.document->session();
  follow(session);
  std::int64_t tick = editor.moment->state->tick;
  if (session.do_ticks_wait()) {
    const auto unserved = session.unserved_tick();
    if (!unserved) return;
    tick = *unserved;
  } else if (!editor.moment->is_playing || tick == tick_) {
    return;
  }
  tick_ = tick;
  for (const Report& report : connections_->take(tick)) {
    LogEntry entry;
    entry.gesture = session.new_gesture();
    entry.author = report.author;
    entry.command = report.command;
    if (auto done = session.replay(std::move(entry)); !done) editor.tell(NoticeKind::warning, done.error().text());
  }
  session.serve(tick);
  connections_->send(*editor.moment->state);
}

void LiveScene::follow(LiveSession& session) {
  if (entries_ == session.log().size() + 1) return;
  entries_ = session.log().size() + 1;
  connections_->follow(session.scene());
  const bool is_waiting = connections_->has_recordings();
  if (is_waiting != session.do_ticks_wait()) session.make_ticks_wait(is_waiting);
}

}  // namespace bl::desktop
