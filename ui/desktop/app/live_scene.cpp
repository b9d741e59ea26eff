// Serves each tick once; a frame between two ticks has nothing to do.
#include "ui/desktop/app/live_scene.h"

#include <map>

namespace bl::desktop {

void LiveScene::frame(Editor& editor) {
  const std::uint64_t number = editor.document ? editor.document->id() : 0;
  const std::string folder = editor.document ? editor.document->folder() : std::string();
  if (number != document_ || folder != folder_) {
    document_ = number;
    folder_ = folder;
    connections_.reset();
    editor.deliveries.clear();
    tick_ = -1;
    if (number != 0) connections_ = std::make_unique<Connections>(LiveOptions{folder, is_live_, {}});
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
  note_deliveries(editor);
}

// The window's clock is read here, for the eye: no tick hears of it.
void LiveScene::note_deliveries(Editor& editor) const {
  std::map<std::string, Delivery> now;
  for (const ConnectionStatus& status : connections_->status()) {
    if (status.is_sensor) continue;
    const auto before = editor.deliveries.find(status.node);
    Delivery& delivery = now[status.node];
    if (before != editor.deliveries.end()) delivery = before->second;
    if (status.traffic.sent != delivery.messages) delivery.sent_at = editor.now;
    delivery.messages = status.traffic.sent;
    delivery.problem = status.line;
  }
  editor.deliveries = std::move(now);
}

}  // namespace bl::desktop
