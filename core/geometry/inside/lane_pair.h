// Two numbers worked on at a time, where the compiler would not see by itself that it may.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstdint>

namespace bl::geometry {

typedef double LanePair __attribute__((vector_size(16), aligned(8)));
typedef std::int64_t LaneAnswers __attribute__((vector_size(16)));

inline LanePair in_both_lanes(double value) { return LanePair{value, value}; }
inline LanePair lanes_at(const double* from) { return *reinterpret_cast<const LanePair*>(from); }
inline void put_lanes(double* to, const LanePair& lanes) { *reinterpret_cast<LanePair*>(to) = lanes; }

inline LanePair larger_of(const LanePair& a, const LanePair& b) { return a > b ? a : b; }
inline LanePair smaller_of(const LanePair& a, const LanePair& b) { return a < b ? a : b; }
inline double largest_lane(const LanePair& a) { return std::max(a[0], a[1]); }
inline double smallest_lane(const LanePair& a) { return std::min(a[0], a[1]); }

// By intrinsics, because g++ 12 takes some comparisons of vectors apart into their lanes.
inline LaneAnswers is_larger(const LanePair& a, const LanePair& b) {
#if defined(__SSE2__)
  return reinterpret_cast<LaneAnswers>(_mm_cmpgt_pd(a, b));
#else
  return a > b;
#endif
}
inline LaneAnswers is_no_less(const LanePair& a, const LanePair& b) {
#if defined(__SSE2__)
  return reinterpret_cast<LaneAnswers>(_mm_cmpge_pd(a, b));
#else
  return a >= b;
#endif
}

/// A bit per lane of a comparison.
inline std::uint64_t bits_of(const LaneAnswers& answers) {
#if defined(__SSE2__)
  return static_cast<std::uint64_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(answers)));
#else
  return (answers[0] != 0 ? 1u : 0u) | (answers[1] != 0 ? 2u : 0u);
#endif
}

/// The lowest bits of 64: as many as there are, at most.
inline std::uint64_t lowest_bits(std::uint32_t count) { return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0}; }

}  // namespace bl::geometry
