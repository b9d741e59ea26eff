// A whole study: rectangles that need sun, casters, the sun of each receiver and the loss by each caster.
#pragma once

#include <span>
#include <vector>

#include "core/sun/sun_hours.h"

namespace bl::sun {

/// A rectangle that is measured on a grid.
struct SunReceiver {
  Point3 centre;
  Vector3 half_across, half_up;    ///< to the middle of two sides; it looks along their cross product
  double spacing = 2;              ///< [m]
  double required = 0;             ///< direct sun that points should have [s per day]
  double required_share = 1;       ///< of the points that should have it: those with the most sun
  std::vector<std::uint8_t> mask;  ///< which casters count; empty: all
};
/// Half axes of a level rectangle, turned counter-clockwise by `rotation` [degree].
void level_axes(double width, double depth, double rotation, SunReceiver& receiver);
/// Half axes of an upright one that looks to `azimuth`, clockwise from the y axis [degree].
void upright_axes(double width, double height, double azimuth, SunReceiver& receiver);

/// The sun of a receiver, over its grid.
struct SunRecord {
  SunGrid grid;
  SunHours hours;
  double least = 0, mean = 0, most = 0;  ///< [s per day]
  double share_met = 0;                  ///< of the points that have what is required
  double of_share = 0;                   ///< the least that a point of the required share has [s per day]
  double deficit = 0;                    ///< mean of what the points of the required share are short of it [s per day]
  /// Fills in the last six from the hours.
  void judge(const SunReceiver& receiver);
};

/// The most points of one receiver; their spacing grows until there are no more.
inline constexpr std::size_t kMostSunPoints = 4096;

/// The most rays of one study, which are some twenty seconds of one processor: pairs of points and moments.
inline constexpr double kMostSunRays = 2e8;
/// An error where there would be more.
Result<void> check_sun_rays(std::span<const SunReceiver> receivers, std::size_t moments);

/// One record for each receiver. An empty mesh casts nothing. Errors: a mesh that is not finite (the place is the index of its
/// caster), more rays than `kMostSunRays`, and `cancelled` where a stop wish came true.
Result<std::vector<SunRecord>> sun_study(std::span<const MeshPointer> casters, std::span<const SunMoment> moments,
                                         std::span<const SunReceiver> receivers, ThreadPool* pool = nullptr);

}  // namespace bl::sun
