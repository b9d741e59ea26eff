// Streets, water and green of the surroundings as ground that a site leaves out.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/context.h"

namespace bl::making {

/// What an import can keep clear of volumes, as people name it.
inline constexpr std::array<const char*, 3> kClearGrounds{"streets", "water", "green"};

/// What comes of it, as the help of the command line and the window say it.
inline constexpr const char* kKeepClearDoc =
    "A site of the scene leaves their ground out over its whole height, so that volumes keep away from it.";

/// "water" or "green" for the use of an area such as `natural=water` or `park`; empty for all else.
std::string_view ground_kind(std::string_view use);

/// The use that the ground of an area keeps open, such as `playground`; empty where its use is not known as open space.
std::string open_use_of(std::string_view use);

/// The width that a street takes from house to house [m]: what the file says, else its lanes and a path on each side.
double street_width(const importing::ContextStreet& street);

/// The ground of a street, counter-clockwise: one ring where its bends allow it, else one for each straight piece.
std::vector<geometry::Ring> street_ground(const importing::ContextStreet& street);

}  // namespace bl::making
