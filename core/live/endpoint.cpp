// The thread of a connection, its pauses, and the messages that wait to go out.
#include "core/live/endpoint.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace bl::live {

Endpoint::Endpoint(Body body, std::string host, int port, std::vector<Subscriber> subscribers, Pauses pauses, Access access)
    : host_(std::move(host)),
      port_(port),
      subscribers_(std::move(subscribers)),
      pauses_(pauses),
      access_(std::move(access)),
      pause_(pauses.first) {
  thread_ = std::thread([this, body] { run(body); });
}

Endpoint::~Endpoint() {
  ask_to_end();
  thread_.join();
}

// What a library throws must not end the program; the connection then stands still and says so.
void Endpoint::run(Body body) {
  try {
    body(*this);
  } catch (const std::exception& exception) {
    say("the connection to " + place() + " has failed inside (" + exception.what() + ") and is not tried again");
  }
}

void Endpoint::ask_to_end() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
}

std::vector<Subscriber> Endpoint::subscribers() const {
  const std::lock_guard lock(mutex_);
  return subscribers_;
}

void Endpoint::serve(std::vector<Subscriber> subscribers) {
  std::optional<std::string> line;
  {
    const std::lock_guard lock(mutex_);
    if (is_line_known_) line = line_;
    subscribers_ = subscribers;
  }
  if (line)
    for (const Subscriber& subscriber : subscribers) subscriber.station->line(*line);
}

void Endpoint::send(Outgoing message) {
  std::shared_ptr<Station> replaced;
  std::optional<std::string> line;
  const std::shared_ptr<Station> station = message.station;
  {
    const std::lock_guard lock(mutex_);
    if (senders_.emplace(message.path, station).second && is_line_known_) line = line_;
    auto& slot = waiting_[message.path];
    if (slot.station) replaced = slot.station;
    slot = std::move(message);
  }
  if (replaced) replaced->count(&Traffic::replaced);
  if (line) station->line(*line);
  wake_.notify_all();
}

std::string Endpoint::place() const {
  if (port_ == 0) return host_;
  const bool is_v6 = host_.find(':') != std::string::npos;
  return (is_v6 ? "[" + host_ + "]" : host_) + ":" + std::to_string(port_);
}

bool Endpoint::is_ending() const {
  const std::lock_guard lock(mutex_);
  return is_ending_;
}

std::vector<Outgoing> Endpoint::outgoing() {
  const std::lock_guard lock(mutex_);
  std::vector<Outgoing> messages;
  for (auto& [path, message] : std::exchange(waiting_, {})) messages.push_back(std::move(message));
  return messages;
}

void Endpoint::wait_for_work(double seconds) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return is_ending_ || !waiting_.empty(); });
}

void Endpoint::say(const std::string& sentence) {
  std::vector<std::shared_ptr<Station>> told;
  {
    const std::lock_guard lock(mutex_);
    for (const Subscriber& subscriber : subscribers_) told.push_back(subscriber.station);
    line_ = sentence;
    is_line_known_ = true;
    for (const auto& [path, station] : senders_) told.push_back(station);
  }
  for (const auto& station : told) station->line(sentence);
}

void Endpoint::fail(const std::string& sentence) {
  say(sentence);
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, std::chrono::duration<double>(pause_), [this] { return is_ending_; });
  pause_ = std::min(2 * pause_, pauses_.longest);
}

void Endpoint::succeed() {
  {
    const std::lock_guard lock(mutex_);
    pause_ = pauses_.first;
  }
  say("");
}

}  // namespace bl::live
