// A bundle of rays from a point inside a cell: how far one looks along each until a plane or the ball ends it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vector.h"

namespace bl::geometry {

// Four numbers worked on at a time.
typedef float LaneQuad __attribute__((vector_size(16), may_alias));
typedef std::int32_t LaneNames __attribute__((vector_size(16), may_alias));
inline LaneQuad in_all_lanes(float value) { return LaneQuad{value, value, value, value}; }
inline LaneQuad quad_at(const float* from) { return *reinterpret_cast<const LaneQuad*>(from); }
inline LaneNames names_at(const std::int32_t* from) { return *reinterpret_cast<const LaneNames*>(from); }
inline void put_quad(float* to, const LaneQuad& lanes) { *reinterpret_cast<LaneQuad*>(to) = lanes; }
inline void put_names(std::int32_t* to, const LaneNames& lanes) { *reinterpret_cast<LaneNames*>(to) = lanes; }

// Half of the directions of a rule for integrals over the sphere that is exact up to the eleventh degree (Lebedev 1975); the
// others are opposite. Some that are none fill the last lanes. Four decimals would do: single precision, four at a time.
struct Rays {
  static constexpr std::size_t kCount = 28;
  alignas(16) std::array<float, kCount> x{}, y{}, z{}, share{};

  Rays() {
    std::size_t count = 0;
    const auto add = [&](double a, double b, double c, double part) {
      const double size = std::sqrt(a * a + b * b + c * c);
      x[count] = static_cast<float>(a / size);
      y[count] = static_cast<float>(b / size);
      z[count] = static_cast<float>(c / size);
      share[count++] = static_cast<float>(part);
    };
    const auto add_turned = [&](double a, double b, double c, double part) {
      add(a, b, c, part);
      add(b, c, a, part);
      add(c, a, b, part);
    };
    add_turned(1, 0, 0, 4.0 / 315);
    for (const double s : {1.0, -1.0}) add_turned(1, s, 0, 64.0 / 2835);
    for (const double s : {1.0, -1.0}) {
      for (const double t : {1.0, -1.0}) {
        add(1, s, t, 27.0 / 1280);
        add_turned(3, s, t, 14641.0 / 725760);
      }
    }
  }
};

// How far one looks along each ray and against it, in radii of the demanded ball, which single precision holds.
struct Hits {
  // Per direction: 1/t, what the ray of length t ends at, and what a free end has of the ball's own response, per t³. Each free
  // end has a name of its own: as many sums into one place would wait for each other.
  static constexpr std::size_t kFreeNames = 2 * Rays::kCount;
  alignas(16) std::array<float, Rays::kCount> ahead, back, own_ahead, own_back;
  alignas(16) std::array<std::int32_t, Rays::kCount> cut_ahead, cut_back;

  void begin_at_ball(const Rays& rays, const Point3& eye, double weight, std::int32_t ball) {
    for (std::size_t d = 0; d < Rays::kCount; ++d) {
      cut_ahead[d] = ball + static_cast<std::int32_t>(d);
      cut_back[d] = cut_ahead[d] + static_cast<std::int32_t>(Rays::kCount);
    }
    if (eye == Point3{}) {
      ahead.fill(static_cast<float>(1 / std::sqrt(weight)));
      back = ahead;
      own_ahead.fill(static_cast<float>(0.5 / weight));
      own_back = own_ahead;
      return;
    }
    const auto x = static_cast<float>(eye.x), y = static_cast<float>(eye.y), z = static_cast<float>(eye.z),
               rest = static_cast<float>(weight - squared_norm(eye));
    for (std::size_t d = 0; d < Rays::kCount; ++d) {
      const float along = x * rays.x[d] + y * rays.y[d] + z * rays.z[d], root = std::sqrt(along * along + rest);
      ahead[d] = 1 / (root - along);
      back[d] = 1 / (root + along);
      own_ahead[d] = 0.5f * ahead[d] / root;
      own_back[d] = 0.5f * back[d] / root;
    }
  }

  // A plane, as its normal over its distance from the eye.
  void cut(const Rays& rays, const Vector3& plane, std::int32_t name) {
    const LaneQuad x = in_all_lanes(static_cast<float>(plane.x)), y = in_all_lanes(static_cast<float>(plane.y)),
                   z = in_all_lanes(static_cast<float>(plane.z));
    const LaneNames names{name, name, name, name};
    for (std::size_t d = 0; d < Rays::kCount; d += 4) {
      const LaneQuad here = quad_at(&rays.x[d]) * x + quad_at(&rays.y[d]) * y + quad_at(&rays.z[d]) * z, there = -here,
                     a = quad_at(&ahead[d]), b = quad_at(&back[d]);
      put_names(&cut_ahead[d], here > a ? names : names_at(&cut_ahead[d]));
      put_names(&cut_back[d], there > b ? names : names_at(&cut_back[d]));
      put_quad(&ahead[d], here > a ? here : a);
      put_quad(&back[d], there > b ? there : b);
    }
  }

  // What each ray tells: its share of the sphere times t³, and that times what its end has of the response. No branches: which
  // rays end at the ball is a coin's throw.
  struct Parts {
    alignas(16) std::array<float, Rays::kCount> response_ahead, response_back;
    float volume, free_response;  // sums: of the shares times t³, and of the responses of free ends
  };
  Parts parts(const Rays& rays, std::int32_t ball) const {
    const LaneNames first_free{ball, ball, ball, ball};
    const LaneQuad one = in_all_lanes(1);
    LaneQuad volume = in_all_lanes(0), free = volume;
    Parts made;
    for (std::size_t d = 0; d < Rays::kCount; d += 4) {
      const LaneQuad a = quad_at(&ahead[d]), b = quad_at(&back[d]), share = quad_at(&rays.share[d]);
      const LaneNames is_free = names_at(&cut_ahead[d]) >= first_free, is_free_back = names_at(&cut_back[d]) >= first_free;
      const LaneQuad here = share / (a * a * a), there = share / (b * b * b), zero = in_all_lanes(0),
                     response = here * (is_free ? quad_at(&own_ahead[d]) : one),
                     response_there = there * (is_free_back ? quad_at(&own_back[d]) : one);
      volume += here + there;
      free += (is_free ? response : zero) + (is_free_back ? response_there : zero);
      put_quad(&made.response_ahead[d], response);
      put_quad(&made.response_back[d], response_there);
    }
    made.volume = (volume[0] + volume[1]) + (volume[2] + volume[3]);
    made.free_response = (free[0] + free[1]) + (free[2] + free[3]);
    return made;
  }
};

}  // namespace bl::geometry
