// What plots count of the volumes on them; their figures and the lists of broken rules reckon alike.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

/// What carries a volume on the ground, in the port `stands_on`.
inline constexpr std::string_view kTheGround = "the ground";

/// The share of a footprint that is built ground. What has plates covers the ground that it stands on, at whatever height a slope
/// has it. A rounded volume does where it begins within the lowest storey above `ground` [m]: one that shrinks lifts off
/// gradually, and its share falls gradually in the upper half of that storey. A step would make links that hold the GSI
/// oscillate.
double built_share(bool has_plates, std::string_view stands_on, double bottom, double storey_height, double ground);
/// How far a rounded volume stays inside the sides of a plot [m]: a disc of the area of its footprint [m²].
double clearance_of_disc(std::span<const Point3> polygon, const Point3& centroid, double footprint);

/// What of a volume says from where its height counts.
struct HeightBase {
  std::string_view id, stands_on;
  std::optional<double> ground;  ///< of its footprint [m]; nothing for a rounded volume
};
/// From where the heights of the volumes of a plot count [m]: on a terrain above the plot's ground from the ground of what stands
/// on it, also for all that stands upon that.
std::vector<double> height_bases(std::span<const HeightBase> volumes, double plot_ground);

}  // namespace bl::geometry
