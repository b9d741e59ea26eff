// Compares two compiled plans field by field.
#pragma once

#include <string>

#include "core/graph/plan.h"

namespace bl {

/// The first thing in which two plans of one scene differ, in words, or "".
std::string plan_difference(const Plan& a, const Plan& b);

}  // namespace bl
