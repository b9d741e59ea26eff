// A direction for two things on one point, from their names alone.
#pragma once

#include <string_view>

#include "core/base/vector.h"

namespace bl {

/// A horizontal unit vector from the one to the other; with the names exchanged it is the opposite. It depends on the two names
/// only, so that the two separate in the same way in any order and on every machine.
Vector3 direction_by_name(std::string_view from, std::string_view to);

}  // namespace bl
