// Puts lists in order that nearly are.
#pragma once

#include <algorithm>
#include <vector>

namespace bl {

/// As std::sort, for items of which equal ones cannot be told apart. A list that was put together from a few others which ascend
/// is merged, which compares each item a few times only.
template <class T>
void sort_runs(std::vector<T>& list) {
  constexpr int kMostRuns = 8;
  auto middle = std::is_sorted_until(list.begin(), list.end());
  for (int runs = 1; middle != list.end(); ++runs) {
    if (runs == kMostRuns) return std::sort(list.begin(), list.end());
    const auto next = std::is_sorted_until(middle, list.end());
    std::inplace_merge(list.begin(), middle, next);
    middle = next;
  }
}

}  // namespace bl
