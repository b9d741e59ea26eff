// How a room is: for GET /health, and for facilitators, who see more of it.
#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/reading/survey.h"
#include "core/serve/readiness.h"
#include "core/serve/room_address.h"
#include "core/serve/room_frames.h"
#include "core/serve/room_host.h"

namespace bl::serve {

namespace {

constexpr double kBetweenHealth = 2;  // [s]

// One verdict for each figure that has one. What the computer does not say has none.
Json verdicts_of(const Surroundings& around, const std::map<std::string, std::size_t>& reached) {
  const Machine& machine = around.machine;
  Json verdicts = Json::object();
  const auto note = [&verdicts](const std::string& figure, const Finding& finding) {
    verdicts[figure] = word_of(finding.verdict);
  };
  if (machine.battery || machine.is_on_mains) note("power", judge_power(machine));
  if (machine.memory_free) note("memory", judge_memory(machine.memory_free));
  if (machine.disk_free) note("space", judge_free_disk(machine.disk_free));
  for (const auto& [interface, quality] : machine.wireless) note("wireless/" + interface, judge_wireless(interface, quality));
  for (const auto& [url, count] : reached) note("reached/" + url, judge_reach(url, count));
  return verdicts;
}

}  // namespace

RoomHost::Health RoomHost::health() const {
  Health health;
  for (const auto& [number, seat] : room_->state().seats) health.seats += seat.is_removed ? 0 : 1;
  health.guests = visitors_.size();
  health.followers = followers_->count();
  const auto moment = session_->moment();
  health.tick = moment->state->tick;
  health.seq = stored_seq_;
  health.hash = hex_digits(moment->ticked->hash);
  health.problem = problem_;
  health.waiting = commits_under_way_ + (is_packing_ ? 1 : 0);
  health.disk_seconds = writer_->latency().median;
  health.tick_seconds = moment->tick_seconds;
  return health;
}

// Only those addresses that people are told; of others nobody would know what they are.
std::map<std::string, std::size_t> RoomHost::reached_addresses(const Surroundings& around) const {
  std::map<std::string, std::size_t> reached;
  for (const std::string& url : options_.addresses) {
    const auto address = room_address(url + "/" + code_);
    if (!address) continue;
    const auto found = around.reached.find(address->host);
    reached[url] = found == around.reached.end() ? 0 : found->second;
  }
  return reached;
}

wire::HealthOut RoomHost::health_message() const {
  wire::HealthOut health;
  const auto moment = session_->moment();
  health.tick_ms = moment->tick_seconds * 1000;
  health.rate = moment->rate;
  health.wanted = moment->wanted_rate;
  health.settled = moment->state->is_settled();
  const reading::Survey survey = reading::survey_of(*moment->state);
  health.worst = survey.worst_error;
  health.worst_of = survey.worst;
  health.failure = moment->failure;
  health.problem = problem_;
  const auto latency = writer_->latency();
  health.disk_ms = latency.median * 1000;
  health.disk_slow_ms = latency.p95 * 1000;
  std::error_code error;
  const auto file = std::filesystem::absolute(journal_path_, error);
  health.file = error ? journal_path_ : file.string();
  std::int64_t bytes = 0;
  for (const char* part : {"", "-wal"})
    if (const auto size = std::filesystem::file_size(journal_path_ + part, error); !error)
      bytes += static_cast<std::int64_t>(size);
  health.journal = bytes;
  if (snapshot_stored_) health.snapshot_age = static_cast<std::int64_t>(options_.clock->now() - *snapshot_stored_);
  health.followers = static_cast<std::int64_t>(followers_->count());
  const Surroundings around = options_.surroundings ? options_.surroundings() : Surroundings{};
  const Machine& machine = around.machine;
  using Mains = wire::HealthOut::Mains;
  health.battery = machine.battery.value_or(-1);
  health.mains = !machine.is_on_mains ? Mains::unknown : *machine.is_on_mains ? Mains::yes : Mains::no;
  health.wireless = JsonValue::of(Json(machine.wireless));
  health.memory_free = machine.memory_free.value_or(-1);
  health.disk_free = machine.disk_free.value_or(-1);
  const auto reached = reached_addresses(around);
  health.reached = JsonValue::of(Json(reached));
  Json verdicts = verdicts_of(around, reached);
  verdicts["ticks"] = word_of(judge_pace(moment->tick_seconds, health.wanted, room_->state().is_paused).verdict);
  verdicts["disk"] = word_of(judge_storing(latency.median, latency.p95).verdict);
  health.verdicts = JsonValue::of(verdicts);
  return health;
}

bool RoomHost::leads(std::int64_t number) const {
  const room::Seat* seat = room_->state().seat(number);
  return seat != nullptr && !seat->is_removed && seat->role == Role::facilitator;
}

// Also where nothing can be stored: then it matters most. Each facilitator gets the same.
void RoomHost::tell_health() {
  const double now = options_.clock->now();
  if (now - last_health_ < kBetweenHealth) return;
  last_health_ = now;
  std::shared_ptr<const std::string> frame;
  for (auto& [key, visitor] : visitors_) {
    if (!visitor.is_welcome || !leads(visitor.seat)) continue;
    if (!frame) frame = frame_of_message(health_message());
    visitor.guest->send(frame);
  }
}

}  // namespace bl::serve
