// Grouping follows ISO 80000-1: groups of three, a space between, a point for decimals; four digits stay together.
#include "core/reading/figures.h"

#include <cmath>

#include "core/base/text.h"

namespace bl::reading {

namespace {

constexpr const char* kNarrowSpace = "\xE2\x80\xAF";
constexpr const char* kMinus = "\xE2\x88\x92";
constexpr const char* kDash = "\xE2\x80\x93";
constexpr double kNothingSeen = 1e-3;

}  // namespace

std::string grouped(double value, int decimals) {
  if (!std::isfinite(value)) return "\xE2\x80\x93";
  if (std::abs(value) >= 1e15) return shortest(value);
  std::string digits = fixed(std::abs(value), decimals);
  const bool is_negative = value < 0 && digits.find_first_not_of("0.") != std::string::npos;
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  std::string out = is_negative ? kMinus : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (whole > 4 && i > 0 && i < whole && (whole - i) % 3 == 0) out += kNarrowSpace;
    out += digits[i];
  }
  return out;
}

std::string readable(double value) {
  const double size = std::abs(value);
  return grouped(value, size >= 100 || size == 0 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

const UnitInfo& handy_unit(double value, Unit unit) {
  constexpr double kFromMinutes = 120, kFromHours = 7200;
  if (unit != Unit::second || !(std::abs(value) >= kFromMinutes)) return info(unit);
  return *find_unit(std::abs(value) >= kFromHours ? "h" : "min");
}

std::string quantity(double value, Unit unit) {
  const UnitInfo& handy = handy_unit(value, unit);
  const std::string text = readable(value / handy.scale);
  return handy.pretty.empty() ? text : text + "\xC2\xA0" + std::string(handy.pretty);
}

std::string duration(double seconds) {
  if (seconds == 0 || !std::isfinite(seconds)) return readable(seconds) + "\xC2\xA0s";
  if (std::abs(seconds) >= 0.9995) return quantity(seconds, Unit::second);
  for (const auto& [scale, symbol] : {std::pair{1e3, "ms"}, std::pair{1e6, "\xC2\xB5s"}})
    if (std::abs(seconds) * scale >= 0.9995) return readable(seconds * scale) + "\xC2\xA0" + symbol;
  return readable(seconds * 1e9) + "\xC2\xA0ns";
}

std::string percent(double share) {
  const double size = std::abs(share * 100);
  return grouped(share * 100, size >= 10                 ? 1
                              : size >= 0.1 || size == 0 ? 2
                              : size >= 0.01             ? 3
                              : size >= 0.0001           ? 5
                                                         : 7) +
         "\xC2\xA0%";
}

std::string signed_percent(double share) {
  const double hundred = share * 100;
  const std::string text = grouped(hundred, std::abs(hundred) >= 100 ? 0 : 2);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return (hundred > 0 && !is_zero ? "+" : "") + text + "\xC2\xA0%";
}

std::string share_of(double part, double whole) { return whole > kNothingSeen ? percent(part / whole) : kDash; }

std::string difference_of(double reached, double wanted) {
  return wanted > kNothingSeen ? signed_percent((reached - wanted) / wanted) : kDash;
}

std::string counted(std::size_t count, const std::string& noun) {
  return grouped(static_cast<double>(count)) + "\xC2\xA0" + noun + (count == 1 ? "" : "s");
}

}  // namespace bl::reading
