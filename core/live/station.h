// The exchange between a connection's thread and the owner of the scene: one for each sensor and actuator.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace bl::live {

/// The content of a message: a number, or the reason why it holds none.
struct Arrival {
  double value = 0;
  std::string problem, time;
  std::chrono::steady_clock::time_point came{};  ///< how long it has waited until it is taken, follows from this
};

/// Counts of messages; every lost message is counted.
struct Traffic {
  std::int64_t received = 0;      ///< messages that came
  std::int64_t skipped = 0;       ///< of these: replaced by a newer one before anybody looked, or retained by a broker
  std::int64_t sent = 0;          ///< messages handed to the network
  std::int64_t acknowledged = 0;  ///< of these: confirmed by the other side, where it confirms at all
  std::int64_t replaced = 0;      ///< messages that a newer one replaced before they were sent
};

/// Thread-safe. Holds the newest arrival only, so that a flood costs no memory.
class Station {
 public:
  explicit Station(std::string field) : field_(std::move(field)) {}

  // Of the connection's thread.
  void message(std::string_view payload);
  void number(double value);
  void problem(std::string sentence);
  /// What is wrong with the connection; empty where it stands.
  void line(const std::string& sentence);
  void count(std::int64_t Traffic::*what);
  std::string field() const;

  // Of the owner's.
  struct Taken {
    std::optional<Arrival> newest;
    std::optional<std::string> line;  ///< where it has changed
  };
  Taken collect();
  /// Which part of the messages holds the number, from the next message on.
  void set_field(std::string field);
  Traffic traffic() const;
  std::string line() const;

 private:
  void put(Arrival arrival);

  std::string field_;
  mutable std::mutex mutex_;
  std::optional<Arrival> newest_;
  std::optional<std::string> line_;  // nothing as long as nobody knows
  bool is_line_new_ = false;
  Traffic traffic_;
};

/// The wall clock's time in UTC as `2026-01-31T12:00:00Z`, for people.
std::string utc_now();

}  // namespace bl::live
