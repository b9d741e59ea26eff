// The processor's time that some work takes, for tests of how it grows.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>

namespace bl::test {

/// [s] of this process, all threads together; the shortest of three rounds, because others work on the machine, too.
inline double processor_time(const std::function<void()>& work) {
  double least = 1e9;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t begin = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

}  // namespace bl::test
