// Streets, rails, water and green of the surroundings as ground that a site leaves out.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/context.h"

namespace bl::making {

/// What an import can keep clear of volumes, as people name it.
inline constexpr std::array<const char*, 4> kClearGrounds{"streets", "rails", "water", "green"};

/// Green with less ground than this is built over [m²]: the pits of single trees are drawn as areas in many maps.
inline constexpr double kLeastGreen = 10;
inline constexpr const char* kLeastGreenDoc = "Areas of green with less ground than this, in m², are not kept clear.";

/// What comes of it, as the help of the command line and the window say it.
inline constexpr const char* kKeepClearDoc =
    "A site of the scene leaves their ground out over its whole height, so that volumes keep away from it.";

/// One of `kClearGrounds` for the use of an area such as `natural=water`, `park` or `Road`; empty for all else.
std::string_view ground_kind(std::string_view use);

/// The use that the ground of an area keeps open, such as `playground`; empty where its use is not known as open space.
std::string open_use_of(std::string_view use);

/// The width that a street takes from house to house [m]: what the file says, else its lanes and a path on each side.
double street_width(const importing::ContextStreet& street);

/// The ground of a street, counter-clockwise: one ring where its bends allow it, else one for each straight piece.
std::vector<geometry::Ring> street_ground(const importing::ContextStreet& street);

/// The same of a track: as wide as trains need.
std::vector<geometry::Ring> rail_ground(const importing::ContextRail& rail);

/// The ground of an area: its outline; of streets and rails without its holes, as convex pieces, since a road round a block is
/// not the block.
std::vector<geometry::Ring> area_ground(const importing::ContextArea& area);

}  // namespace bl::making
