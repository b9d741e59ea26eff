// Counter-based random numbers: the n-th number of a stream is a function of (seed, stream, n) alone.
#pragma once

#include <cstdint>

#include "core/base/hash.h"

namespace bl {

/// Independent of evaluation order and of the standard library's distributions, whose output is not fixed.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(Hash::mix(seed + 0x9e3779b97f4a7c15ull) ^ Hash::mix(stream + 0xd1b54a32d192ed03ull)) {}

  std::uint64_t bits() { return Hash::mix(key_ + 0x9e3779b97f4a7c15ull * ++counter_); }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high]; `high` only by rounding.
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., count-1}; the bias of the multiplication is below 2^-32 for counts below 2^32.
  std::uint64_t below(std::uint64_t count) { return static_cast<std::uint64_t>(uniform() * static_cast<double>(count)); }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace bl
