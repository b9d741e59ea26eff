// Numbers and vectors in pairs.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <cmath>

#include "core/base/vector.h"

namespace bl::facade {

/// Two numbers worked on at a time, where the compiler would not see by itself that it may.
typedef double Pair __attribute__((vector_size(16), aligned(8)));

inline Pair pair_at(const double* from) { return *reinterpret_cast<const Pair*>(from); }
inline void put_pair(double* to, const Pair& pair) { *reinterpret_cast<Pair*>(to) = pair; }

inline Pair root_of(const Pair& pair) {
#if defined(__SSE2__)
  return reinterpret_cast<Pair>(_mm_sqrt_pd(reinterpret_cast<__m128d>(pair)));
#else
  return Pair{std::sqrt(pair[0]), std::sqrt(pair[1])};
#endif
}

/// Two vectors at a time.
struct VectorPair {
  Pair x, y, z;
};

inline VectorPair both(const Vector3& a) { return {Pair{a.x, a.x}, Pair{a.y, a.y}, Pair{a.z, a.z}}; }
inline VectorPair operator+(const VectorPair& a, const VectorPair& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline VectorPair operator-(const VectorPair& a, const VectorPair& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline VectorPair operator*(const Pair& s, const VectorPair& a) { return {s * a.x, s * a.y, s * a.z}; }
inline VectorPair operator/(const VectorPair& a, const Pair& s) { return {a.x / s, a.y / s, a.z / s}; }
inline Pair dot(const VectorPair& a, const VectorPair& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline VectorPair cross(const VectorPair& a, const VectorPair& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace bl::facade
