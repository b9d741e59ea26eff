// In UTC or a given zone, so that the text depends on no machine.
#include "core/base/moment.h"

#include <array>
#include <cstdlib>
#include <ctime>

namespace bl {

namespace {

constexpr int kMinute = 60, kMostAhead = 14 * kMinute;  // [s], [min]: no clock on Earth is farther from UTC

std::optional<int> two_digits(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() != 2 || !is_digit(text[0]) || !is_digit(text[1])) return std::nullopt;
  return 10 * (text[0] - '0') + (text[1] - '0');
}

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

}  // namespace

std::string zone_text(int minutes_ahead) {
  if (minutes_ahead == 0) return "UTC";
  const int minutes = std::abs(minutes_ahead);
  return (minutes_ahead < 0 ? "-" : "+") + two_digits(minutes / 60) + ":" + two_digits(minutes % 60);
}

std::optional<int> read_zone(std::string_view text) {
  if (text == "UTC") return 0;
  if (text.size() != 6 || (text[0] != '+' && text[0] != '-') || text[3] != ':') return std::nullopt;
  const auto hours = two_digits(text.substr(1, 2)), minutes = two_digits(text.substr(4, 2));
  if (!hours || !minutes || *minutes > 59 || 60 * *hours + *minutes > kMostAhead) return std::nullopt;
  return (text[0] == '-' ? -1 : 1) * (60 * *hours + *minutes);
}

std::string moment_text(std::int64_t milliseconds, int minutes_ahead) {
  const std::time_t seconds = static_cast<std::time_t>(milliseconds / 1000) + std::time_t{minutes_ahead} * kMinute;
  std::tm parts{};
  std::array<char, 64> text{};
  if (gmtime_r(&seconds, &parts) == nullptr) return {};
  return std::string(text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M ", &parts)) + zone_text(minutes_ahead);
}

}  // namespace bl
