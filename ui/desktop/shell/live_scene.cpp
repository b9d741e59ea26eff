// Serves each tick once; a frame between two ticks has nothing to do.
#include "ui/desktop/shell/live_scene.h"

#include <map>

namespace bl::desktop {

void LiveScene::frame() {
  Editor& editor = *editor_;
  const std::uint64_t number = editor.document ? editor.document->id() : 0;
  const std::string folder = editor.document ? editor.document->folder() : std::string();
  if (number != document_ || folder != folder_) {
    document_ = number;
    folder_ = folder;
    devices_.reset();
    editor.deliveries.clear();
    editor.has_devices = false;
    tick_ = -1;
    // The devices of a room are its server's.
    if (number != 0 && editor.document->local() != nullptr)
      devices_ = std::make_unique<host::DeviceDoor>(live::LiveOptions{folder, is_live_, {}});
  }
  if (!devices_ || !editor.moment) return;
  host::LiveSession& session = *editor.document->local();
  const bool has_news = devices_->follow(session.said(), session.last_seq());
  editor.has_devices = !devices_->is_empty();
  if (has_news && devices_->has_recordings() != session.do_ticks_wait()) session.make_ticks_wait(devices_->has_recordings());
  std::int64_t tick = editor.moment->state->tick;
  if (session.do_ticks_wait()) {
    const auto unserved = session.unserved_tick();
    if (!unserved) return;
    tick = *unserved;
  } else if (!editor.moment->is_playing || tick == tick_) {
    return;
  }
  tick_ = tick;
  for (const Error& refused : devices_->bring(tick, [&](Submission said) { return session.submit(std::move(said)); }))
    editor.notify(NoticeKind::warning, refused.text());
  session.serve(tick);
  devices_->send(*editor.moment->state);
  note_deliveries();
}

// The window's clock is read here, for the eye: no tick hears of it.
void LiveScene::note_deliveries() const {
  std::map<std::string, Delivery> now;
  for (const live::ConnectionStatus& status : devices_->status()) {
    if (status.is_sensor) continue;
    const auto before = editor_->deliveries.find(status.node);
    Delivery& delivery = now[status.node];
    if (before != editor_->deliveries.end()) delivery = before->second;
    if (status.traffic.sent != delivery.messages) delivery.sent_at = editor_->now;
    delivery.messages = status.traffic.sent;
    delivery.problem = status.line;
  }
  editor_->deliveries = std::move(now);
}

}  // namespace bl::desktop
