// Who takes how much sun from a receiver, as shares. Works with any table of named columns, as moment_table does.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bl::sun {

/// What each of `ids` would bring back by its absence, as a share of what the one that brings most would, be that one of them or
/// not; 0 for who is not in the table. Who stands where others shade as well brings nothing: what is behind them is nobody's
/// fault alone. Where nobody brings anything alone, but those of `ids` do together, it is each one's part of what is lost.
template <class Table>
std::vector<double> loss_shares(const Table& losses, const std::vector<std::string>& ids) {
  constexpr double kNothing = 1e-6;                        // of what is lost
  std::map<std::string, std::pair<double, double>> taken;  // alone, and its part
  double most = 0, most_part = 0, all = 0;
  for (std::size_t row = 0; row < losses.rows.size(); ++row) {
    const double lost = std::max(0.0, losses.number(row, "lost")), part = std::max(0.0, losses.number(row, "shared"));
    most = std::max(most, lost);
    most_part = std::max(most_part, part);
    all += part;
    taken[losses.text(row, "node")] = {lost, part};
  }
  double alone = 0, shaded_twice = 0;  // by these; and the part of the others in what several shade
  for (const auto& [id, loss] : taken)
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) alone += loss.first;
    else shaded_twice += loss.second - loss.first;
  const bool is_together = alone <= kNothing * all && shaded_twice <= kNothing * all;
  const double whole = is_together ? most_part : most;
  std::vector<double> shares;
  for (const std::string& id : ids) {
    const auto found = taken.find(id);
    const bool is_there = found != taken.end() && whole > 0;
    shares.push_back(!is_there ? 0 : (is_together ? found->second.second : found->second.first) / whole);
  }
  return shares;
}

/// Those that take sun and are none of `ids`, the one that takes most first.
template <class Table>
std::vector<std::string> other_takers(const Table& losses, const std::vector<std::string>& ids) {
  std::vector<std::pair<double, std::string>> others;
  for (std::size_t row = 0; row < losses.rows.size(); ++row)
    if (const std::string id = losses.text(row, "node");
        losses.number(row, "shared") > 0 && std::find(ids.begin(), ids.end(), id) == ids.end())
      others.emplace_back(losses.number(row, "shared"), id);
  std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (const auto& [part, id] : others) names.push_back(id);
  return names;
}

}  // namespace bl::sun
