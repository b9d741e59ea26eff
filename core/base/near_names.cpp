// The edit distance behind "did you mean".
#include "core/base/near_names.h"

#include <algorithm>
#include <array>

#include "core/base/text.h"

namespace bl {

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
std::string did_you_mean(std::string_view name, std::span<const std::string> names) { return question(nearest_of(name, names)); }
std::string did_you_mean_of(std::string_view name, std::span<const std::string_view> names) {
  return question(nearest_of(name, names));
}

std::vector<std::string> slips_of(const std::string& name) {
  std::vector<std::string> slips;
  if (name.size() > kLongestName) return slips;
  for (std::size_t i = 0; i < name.size(); ++i) {
    slips.push_back(name);
    slips.back().erase(i, 1);
    if (i + 1 == name.size() || name[i] == name[i + 1]) continue;
    slips.push_back(name);
    std::swap(slips.back()[i], slips.back()[i + 1]);
  }
  return slips;
}

}  // namespace bl
