// A direction for two things that stand on one point, from their names alone.
#pragma once

#include <string_view>

#include "core/base/vector.h"

namespace bl {

/// A level unit vector that points from the one to the other; the other way round it is the opposite. Depends on the two names
/// only, so that whoever is asked first, and on which machine, the two part in the same way.
Vector3 direction_by_name(std::string_view from, std::string_view to);

}  // namespace bl
