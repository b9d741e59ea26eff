// Vertices are worked through two at a time, or four where the processor has registers for it.
#include "core/geometry/inside/plane_side.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <cmath>

#include "core/geometry/inside/lane_pair.h"
#include "core/geometry/inside/wide_registers.h"

namespace bl::geometry {

namespace {

PlaneSides sides_in_pairs(const VertexLanes& vertices, const Vector3& normal, double offset, double tolerance, double* beyond,
                          std::uint64_t* taken) {
  const LanePair along_x = in_both_lanes(normal.x), along_y = in_both_lanes(normal.y), along_z = in_both_lanes(normal.z),
                 far = in_both_lanes(offset), most = in_both_lanes(tolerance);
  LanePair nearest = in_both_lanes(1e300);
  std::uint64_t any = 0;
  for (std::uint32_t first = 0; first < vertices.count; first += 64) {
    const std::uint32_t end = std::min(vertices.count, first + 64);
    std::uint64_t bits = 0;
    for (std::uint32_t v = first; v < end; v += 2) {
      const LanePair distance =
          lanes_at(vertices.x + v) * along_x + lanes_at(vertices.y + v) * along_y + lanes_at(vertices.z + v) * along_z - far;
      put_lanes(beyond + v, distance);
      nearest = smaller_of(nearest, larger_of(distance, -distance));
      bits |= bits_of(distance > most) << (v - first);
    }
    // The copies behind the last vertex do not count.
    taken[first / 64] = bits & lowest_bits(end - first);
    any |= taken[first / 64];
  }
  return {any != 0, smallest_lane(nearest)};
}

#if defined(__x86_64__)

__attribute__((target("avx2"))) PlaneSides sides_in_fours(const VertexLanes& vertices, const Vector3& normal, double offset,
                                                          double tolerance, double* beyond, std::uint64_t* taken) {
  const __m256d along_x = _mm256_set1_pd(normal.x), along_y = _mm256_set1_pd(normal.y), along_z = _mm256_set1_pd(normal.z),
                far = _mm256_set1_pd(offset), most = _mm256_set1_pd(tolerance), sign = _mm256_set1_pd(-0.0);
  __m256d nearest = _mm256_set1_pd(1e300);
  std::uint64_t any = 0;
  for (std::uint32_t first = 0; first < vertices.count; first += 64) {
    const std::uint32_t end = std::min(vertices.count, first + 64);
    std::uint64_t bits = 0;
    for (std::uint32_t v = first; v < end; v += 4) {
      const __m256d distance = _mm256_loadu_pd(vertices.x + v) * along_x + _mm256_loadu_pd(vertices.y + v) * along_y +
                               _mm256_loadu_pd(vertices.z + v) * along_z - far;
      _mm256_storeu_pd(beyond + v, distance);
      nearest = _mm256_min_pd(nearest, _mm256_andnot_pd(sign, distance));
      bits |= static_cast<std::uint64_t>(_mm256_movemask_pd(_mm256_cmp_pd(distance, most, _CMP_GT_OQ))) << (v - first);
    }
    taken[first / 64] = bits & lowest_bits(end - first);
    any |= taken[first / 64];
  }
  const __m128d half = _mm_min_pd(_mm256_castpd256_pd128(nearest), _mm256_extractf128_pd(nearest, 1));
  return {any != 0, std::min(half[0], half[1])};
}

__attribute__((target("avx2"))) double largest_in_fours(const double* numbers, std::uint32_t count) {
  __m256d most = _mm256_setzero_pd();
  for (std::uint32_t v = 0; v < count; v += 4) most = _mm256_max_pd(most, _mm256_loadu_pd(numbers + v));
  const __m128d half = _mm_max_pd(_mm256_castpd256_pd128(most), _mm256_extractf128_pd(most, 1));
  return std::max(half[0], half[1]);
}

bool has_fours() { return __builtin_cpu_supports("avx2") != 0; }

#endif

}  // namespace

PlaneSides find_plane_sides(const VertexLanes& vertices, const Vector3& normal, double offset, double tolerance, double* beyond,
                            std::uint64_t* taken, [[maybe_unused]] bool may_use_fours) {
#if defined(__x86_64__)
  if (may_use_fours && has_fours()) return sides_in_fours(vertices, normal, offset, tolerance, beyond, taken);
#endif
  return sides_in_pairs(vertices, normal, offset, tolerance, beyond, taken);
}

BL_WIDE_REGISTERS void Reaches::measure(const VertexLanes& vertices) {
  // Each direction with its opposite.
  constexpr std::array<std::uint32_t, 13> kPlaces{22, 16, 14, 25, 19, 23, 21, 17, 15, 26, 24, 20, 8};
  LanePair most[kPlaces.size()], least[kPlaces.size()];
  for (LanePair& lanes : most) lanes = in_both_lanes(-1e300);
  for (LanePair& lanes : least) lanes = in_both_lanes(1e300);
  for (std::uint32_t v = 0; v < vertices.count; v += 2) {
    const LanePair x = lanes_at(vertices.x + v), y = lanes_at(vertices.y + v), z = lanes_at(vertices.z + v), sum = x + y,
                   difference = x - y;
    const LanePair along[kPlaces.size()] = {x,     y,     z,       sum,     difference,     x + z,         x - z,
                                            y + z, y - z, sum + z, sum - z, difference + z, z - difference};
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
      most[k] = larger_of(most[k], along[k]);
      least[k] = smaller_of(least[k], along[k]);
    }
  }
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    most_[kPlaces[k]] = largest_lane(most[k]);
    most_[26 - kPlaces[k]] = -smallest_lane(least[k]);
  }
}

// Without branches, because nobody can foretell how the coordinates of a plane are ordered.
BL_WIDE_REGISTERS double Reaches::bound(const Vector3& along) const {
  const double x = std::abs(along.x), y = std::abs(along.y), z = std::abs(along.z);
  const double largest = std::max(std::max(x, y), z), least = std::min(std::min(x, y), z),
               middle = std::max(std::min(x, y), std::min(std::max(x, y), z));
  const int to_x = along.x < 0 ? -9 : 9, to_y = along.y < 0 ? -3 : 3, to_z = along.z < 0 ? -1 : 1;
  const auto chosen = [](bool is_wanted, int number) { return -static_cast<int>(is_wanted) & number; };
  // Of equal coordinates it does not matter which one is taken, since what is multiplied is their difference.
  const bool is_x_least = x == least, is_y_least = !is_x_least & (y == least), is_z_least = !(is_x_least | is_y_least),
             is_x_most = x == largest, is_y_most = !is_x_most & (y == largest), is_z_most = !(is_x_most | is_y_most);
  const int corner = 13 + to_x + to_y + to_z,
            edge = corner - (chosen(is_x_least, to_x) + chosen(is_y_least, to_y) + chosen(is_z_least, to_z)),
            face = 13 + chosen(is_x_most, to_x) + chosen(is_y_most, to_y) + chosen(is_z_most, to_z);
  return (largest - middle) * most_[static_cast<std::size_t>(face)] + (middle - least) * most_[static_cast<std::size_t>(edge)] +
         least * most_[static_cast<std::size_t>(corner)];
}

double largest_of_lanes(const double* numbers, std::uint32_t count) {
#if defined(__x86_64__)
  if (has_fours()) return largest_in_fours(numbers, count);
#endif
  LanePair most = in_both_lanes(0);
  for (std::uint32_t v = 0; v < count; v += 2) most = larger_of(most, lanes_at(numbers + v));
  return largest_lane(most);
}

}  // namespace bl::geometry
