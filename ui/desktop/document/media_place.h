// Where a picture stands in the scene, and which file a sequence shows in a tick.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/vector.h"

namespace bl::desktop {

/// From the lower left corner as people see it: along the lower side, and along the left one [m].
struct MediaPlace {
  Point3 corner;
  Vector3 across, up;
};

struct MediaStance {
  std::string placement;                       ///< ground, billboard or camera
  Point3 position;                             ///< [m]
  double azimuth = 0, tilt = 0;                ///< [degree]
  double width = 1, height = 1, distance = 1;  ///< [m]
};
MediaPlace place_of(const MediaStance& stance);

/// The first run of `#` becomes the frame's number, with as many digits at least; frames count from 1, again and again. A second
/// has thirty ticks.
std::string frame_file(const std::string& file, std::int64_t tick, double rate, std::int64_t frames);

}  // namespace bl::desktop
