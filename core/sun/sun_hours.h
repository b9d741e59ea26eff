// Hours of sun on points over the moments of a study, and the part that each caster takes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/sun/shadow_scene.h"
#include "core/sun/sun_day.h"

namespace bl::sun {

/// A point of a receiver and the side that it looks to: sun from behind does not count.
struct SunPoint {
  Point3 place;
  Vector3 normal{0, 0, 1};
};

/// What one caster takes from a receiver, as means over its points [s per day].
struct SunLoss {
  double lost = 0;    ///< the sun that the receiver would gain without this one caster
  double shared = 0;  ///< its part of all blocked time: at each moment the blocking casters share it equally
};

struct SunHours {
  std::vector<double> seconds;   ///< of direct sun, for each point [s per day]
  double possible = 0;           ///< mean over the points if there were no casters [s per day]
  std::vector<SunLoss> casters;  ///< for each caster of the scene; `shared` adds up to what is missing
};

/// The same bits with any number of threads: points are taken in fixed chunks, and added up in their order. A stop wish leaves
/// out the chunks that have not begun.
SunHours sun_hours(const ShadowScene& scene, std::span<const SunPoint> points, std::span<const SunMoment> moments,
                   ShadowScene::Mask mask = {}, ThreadPool* pool = nullptr);

/// A rectangle of points: centres of equal fields, no larger than `spacing`.
struct SunGrid {
  std::size_t columns = 0, rows = 0;
  std::vector<SunPoint> points;  ///< row by row
};
/// `centre` and half axes of the rectangle; it looks to the side of `across` x `up`. At most `most` points: else the spacing
/// grows.
SunGrid sun_grid(const Point3& centre, const Vector3& half_across, const Vector3& half_up, double spacing, std::size_t most);

}  // namespace bl::sun
