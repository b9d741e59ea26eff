// Random values that fit a declaration, for the laws.
#pragma once

#include "core/base/random.h"
#include "core/define/definition.h"

namespace bl {

/// A value inside the hard range of the port: mostly inside the soft range, now and then at an end.
Value random_value(const PortDefinition& port, Random& random);

}  // namespace bl
