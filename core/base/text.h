// Numbers and names as text, independent of the locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bl {

/// The shortest text that reads back as the same double (std::to_chars); zero has no sign.
std::string shortest(double number);
/// With a fixed number of decimals (from 0), for people; never "-0.00".
std::string fixed(double number, int decimals);
/// With three significant digits, in scientific notation where that is shorter: for errors and shares.
std::string rough(double number);
/// The whole text as a finite double with a decimal point; nothing where anything is left over.
std::optional<double> parse_number(std::string_view text);
/// Of `names`, the one that `name` was probably meant to be (few edits away), or empty.
std::string nearest_name(std::string_view name, std::span<const std::string> names);
std::string nearest_name(std::string_view name, std::span<const std::string_view> names);
/// ", did you mean `x`?" or an empty text where nothing is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> names);
std::string did_you_mean(std::string_view name, std::span<const std::string_view> names);

/// So many names on either side of where a name would stand are looked at in a large map [count].
inline constexpr int kNamesOnEachSide = 32;
/// The same for the keys of a map that ascends by them, such as the nodes of a scene. What it costs does not grow with the map,
/// because a refusal is often read by nobody: names that begin alike stand side by side.
template <class Map>
std::string did_you_mean_among(const std::string& name, const Map& map) {
  auto first = map.lower_bound(name), last = first;
  const int most = map.size() <= 2 * kNamesOnEachSide ? 2 * kNamesOnEachSide : kNamesOnEachSide;
  for (int k = 0; k < most && first != map.begin(); ++k) --first;
  for (int k = 0; k < most && last != map.end(); ++k) ++last;
  std::vector<std::string_view> names;
  for (; first != last; ++first) names.push_back(first->first);
  return did_you_mean(name, names);
}
/// Is it a legal id: 1 to 64 of a-z, 0-9, `_`, `-`, `.`, `#`, starting with a letter or digit?
bool is_identifier(std::string_view text);
/// Text from people (names, uses) as an identifier: lower case, other characters folded to `_`; never empty.
std::string to_identifier(std::string_view text);

}  // namespace bl
