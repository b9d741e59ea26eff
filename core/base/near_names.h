// Suggests near names for an unknown one, at a cost that does not grow with the number of names.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bl {

/// As did_you_mean() of core/base/text.h, for names that are kept elsewhere.
std::string did_you_mean_of(std::string_view name, std::span<const std::string_view> names);

/// `name` with one character left out, or with two neighbours exchanged: the mistakes that can be looked up.
std::vector<std::string> slips_of(const std::string& name);
/// So many names on either side of where a name would stand are looked at in a large map [count].
inline constexpr int kNamesOnEachSide = 32;
/// ", did you mean `x`?" of the keys of a map that ascends by them, such as the nodes of a scene. What it costs does not grow
/// with the map, because a refusal is often read by nobody: of a large one only the names that begin alike are looked at, and
/// simple slips.
template <class Map>
std::string did_you_mean_among(const std::string& name, const Map& map) {
  const bool is_small = map.size() <= 2 * kNamesOnEachSide;
  std::vector<std::string_view> names;
  if (!is_small)
    for (const std::string& slip : slips_of(name))
      if (const auto meant = map.find(slip); meant != map.end()) names.push_back(meant->first);
  auto first = is_small ? map.begin() : map.lower_bound(name), last = is_small ? map.end() : first;
  for (int k = 0; !is_small && k < kNamesOnEachSide && first != map.begin(); ++k) --first;
  for (int k = 0; !is_small && k < kNamesOnEachSide && last != map.end(); ++k) ++last;
  for (; first != last; ++first) names.push_back(first->first);
  return did_you_mean_of(name, names);
}

}  // namespace bl
