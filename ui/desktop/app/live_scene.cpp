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
    if (number != 0)
      connections_ = std::make_unique<Connections>(
          LiveOptions{std::filesystem::path(editor.document->path()).parent_path().string(), is_live_, {}});
  }
  if (!connections_ || !editor.moment || !editor.moment->is_playing || editor.moment->state->tick == tick_) return;
  tick_ = editor.moment->state->tick;
  LiveSession& session = editor.document->session();
  connections_->follow(session.scene());
  for (const Report& report : connections_->take(tick_)) {
    LogEntry entry;
    entry.gesture = session.new_gesture();
    entry.author = report.author;
    entry.command = report.command;
    if (auto done = session.replay(std::move(entry)); !done) editor.tell(NoticeKind::warning, done.error().text());
  }
  connections_->send(*editor.moment->state);
}

}  // namespace bl::desktop
