// The journal and the history listen to the session's entries.
#include "core/host/host.h"

#include "core/base/text.h"
#include "core/file/scene_file.h"

namespace bl::host {

namespace {

Command as_one(const std::vector<Command>& commands) {
  return commands.size() == 1 ? commands.front() : command<Batch>({commands});
}

}  // namespace

Host::Host(const Registry& registry, std::string start, std::unique_ptr<LiveSession> session)
    : registry_(&registry), start_(std::move(start)), history_(registry, session->author()), session_(std::move(session)) {
  session_->subscribe([this](const LogEntry& entry) {
    journal_.add(entry, *registry_);
    history_.take(entry, session_->said());
  });
}

Result<std::unique_ptr<Host>> Host::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                          LiveSessionOptions options) {
  auto session = LiveSession::start(registry, scene, state, std::move(options));
  if (!session) return session.error();
  return std::unique_ptr<Host>(new Host(registry, write_scene(scene, registry, state), std::move(*session)));
}

Result<void> Host::submit(const std::vector<Command>& commands, std::int64_t gesture, const std::string& label) {
  return commands.empty() ? Result<void>() : session_->submit(as_one(commands), gesture, label);
}

Result<void> Host::show(const std::vector<Command>& commands, std::int64_t gesture) {
  return commands.empty() ? Result<void>() : session_->show(as_one(commands), gesture);
}

bool Host::can_rewind() const {
  const auto now = moment();
  return now->oldest < now->state->tick;
}

void Host::begin_journal(const std::string& scene_path, const std::string& scene_text) {
  (void)journal_.begin(scene_path, scene_text, session_->last_seq());
}

std::vector<Error> Host::recover(const std::vector<LogEntry>& entries) {
  std::vector<Error> misfits;
  for (const LogEntry& entry : entries) {
    if (entry.is_return()) continue;
    if (auto done = session_->recover(entry); !done)
      misfits.push_back(done.error().within("journal entry " + std::to_string(entry.seq)));
  }
  return misfits;
}

std::string Host::log_text() const {
  session_->finish_rewind();  // until then nobody knows whether it takes place
  std::string text = log_header(start_);
  for (const LogEntry& entry : session_->log())
    if (!entry.is_called_off) text += log_line(entry, *registry_);
  // A replay compares before it applies what was said in that tick: as the tick itself has left it.
  const State& state = *session_->moment()->ticked;
  return text + log_line(LogCheck{.tick = state.tick, .hash = hex_digits(state.hash), .is_end = true});
}

}  // namespace bl::host
