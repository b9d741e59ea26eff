// Number formatting by std::to_chars, and the edit distance behind "did you mean".
#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace bl {

std::string shortest(double number) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number == 0 ? 0.0 : number).ptr;
  return {buffer, end};
}

std::string fixed(double number, int decimals) {
  if (!std::isfinite(number)) return shortest(number);
  // 309 digits before the point, the point, a sign and the decimals.
  std::string text(static_cast<std::size_t>(decimals) + 312, ' ');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed, decimals).ptr;
  text.resize(static_cast<std::size_t>(end - text.data()));
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string rough(double number) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, 3).ptr;
  return {buffer, end};
}

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

namespace {

constexpr std::size_t kLongestName = 64;

// Levenshtein distance by one row of dynamic programming, or `limit` where it is no less: then the rest is not worked out.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) >= limit) return limit;
  std::array<std::size_t, kLongestName + 1> row;
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0], least = row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
      least = std::min(least, row[j]);
    }
    if (least >= limit) return limit;
  }
  return std::min(row[b.size()], limit);
}

template <class Names>
std::string nearest_of(std::string_view name, const Names& names) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  if (name.size() > kLongestName) return "";
  for (const auto& candidate : names) {
    if (candidate.size() > kLongestName) continue;
    const std::size_t edits = edit_distance(name, candidate, best_distance);
    if (edits < best_distance) {
      best_distance = edits;
      best = candidate;
    }
  }
  return std::string(best);
}

std::string question(const std::string& near) { return near.empty() ? "" : ", did you mean `" + near + "`?"; }

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> names) { return nearest_of(name, names); }
std::string nearest_name(std::string_view name, std::span<const std::string_view> names) { return nearest_of(name, names); }
std::string did_you_mean(std::string_view name, std::span<const std::string> names) { return question(nearest_of(name, names)); }
std::string did_you_mean(std::string_view name, std::span<const std::string_view> names) {
  return question(nearest_of(name, names));
}

namespace {
bool is_lower_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }
}  // namespace

bool is_identifier(std::string_view text) {
  if (text.empty() || text.size() > 64 || !is_lower_or_digit(text.front())) return false;
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return is_lower_or_digit(c) || c == '_' || c == '-' || c == '.' || c == '#'; });
}

std::string to_identifier(std::string_view text) {
  std::string id;
  for (char c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (is_lower_or_digit(c)) id += c;
    else if (!id.empty() && id.back() != '_') id += '_';
    if (id.size() == 48) break;
  }
  while (!id.empty() && id.back() == '_') id.pop_back();
  return id.empty() ? "item" : id;
}

}  // namespace bl
