// Lists of few runs and of many come out as std::sort has them.
#include "core/base/sorted_runs.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/hash.h"

namespace bl {
namespace {

TEST(SortedRuns, SortsWhateverTheRuns) {
  for (std::uint64_t runs = 0; runs < 20; ++runs)
    for (std::uint64_t length = 1; length < 6; ++length) {
      std::vector<std::uint64_t> list;
      for (std::uint64_t run = 0; run < runs; ++run) {
        const std::size_t first = list.size();
        for (std::uint64_t k = 0; k < length; ++k) list.push_back(Hash::mix(100 * run + k) % 50);
        std::sort(list.begin() + static_cast<std::ptrdiff_t>(first), list.end());
      }
      std::vector<std::uint64_t> wanted = list;
      std::sort(wanted.begin(), wanted.end());
      sort_runs(list);
      EXPECT_EQ(list, wanted) << runs << " runs of " << length;
    }
}

}  // namespace
}  // namespace bl
