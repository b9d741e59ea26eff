// Numbers that stand for none at all, such as a depth of 1000 m: read from the declaration of a port.
#pragma once

#include <optional>

#include "core/define/definition.h"

namespace bl {

/// The number that stands for none: a default that is an end of the hard range and lies beyond the range that sliders have.
/// Nothing for ports whose default is a value like others.
std::optional<double> value_of_none(const PortDefinition& port);
/// Does the port hold that number?
bool means_none(const PortDefinition& port, double value);

inline constexpr const char* kNoneWord = "none";  ///< shown for it, and typed to get it

}  // namespace bl
