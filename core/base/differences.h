// Finds where two long lists of plain numbers differ, at the price of reading them once.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace bl {

/// Calls visit(i) for each place where two lists of equal length differ in any bit, in ascending order: zeros of both signs
/// differ, and a NaN does not differ from itself. `T` holds nothing but doubles.
template <class T, class Visit>
void visit_differences(std::span<const T> before, std::span<const T> after, const Visit& visit) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0, "padding would differ by accident");
  assert(before.size() == after.size());
  constexpr std::size_t kStride = 32;
  for (std::size_t first = 0; first < after.size(); first += kStride) {
    const std::size_t count = std::min(kStride, after.size() - first);
    if (std::memcmp(&before[first], &after[first], count * sizeof(T)) == 0) continue;
    for (std::size_t i = first; i < first + count; ++i)
      if (std::memcmp(&before[i], &after[i], sizeof(T)) != 0) visit(static_cast<std::uint32_t>(i));
  }
}

}  // namespace bl
