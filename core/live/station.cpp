// The newest arrival, the state of the line and the counts, behind one mutex.
#include "core/live/station.h"

#include <ctime>
#include <utility>

#include "core/live/message.h"

namespace bl::live {

void Station::put(Arrival arrival) {
  arrival.time = utc_now();
  arrival.came = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  ++traffic_.received;
  if (newest_) ++traffic_.skipped;
  newest_ = std::move(arrival);
}

void Station::message(std::string_view payload) {
  const auto number = number_in(payload, field());
  if (number) put({*number, "", "", {}});
  else put({0, number.error().message, "", {}});
}

void Station::number(double value) { put({value, "", "", {}}); }

void Station::problem(std::string sentence) { put({0, std::move(sentence), "", {}}); }

void Station::line(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  if (line_ == sentence) return;
  line_ = sentence;
  is_line_new_ = true;
}

void Station::count(std::int64_t Traffic::*what) {
  const std::lock_guard lock(mutex_);
  ++(traffic_.*what);
}

Station::Taken Station::collect() {
  const std::lock_guard lock(mutex_);
  Taken taken{std::exchange(newest_, std::nullopt), std::nullopt};
  if (std::exchange(is_line_new_, false)) taken.line = line_;
  return taken;
}

std::string Station::field() const {
  const std::lock_guard lock(mutex_);
  return field_;
}

void Station::set_field(std::string field) {
  const std::lock_guard lock(mutex_);
  field_ = std::move(field);
}

Traffic Station::traffic() const {
  const std::lock_guard lock(mutex_);
  return traffic_;
}

std::string Station::line() const {
  const std::lock_guard lock(mutex_);
  return line_.value_or("");
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts));
}

}  // namespace bl::live
