// The median, which one slow measurement among others does not move.
#pragma once

#include <algorithm>
#include <vector>

namespace bl {

/// The one in the middle, or the mean of the two there; not for an empty list.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace bl
