// Tries a link kind written in Lua on sample values before a scene uses it.
#pragma once

#include <optional>

#include "core/define/registry.h"

namespace bl::cli {

struct KindFault {
  Error error;
  /// True where it reads a name that does not exist, so that it fails on all values. Other failures may come from the sample
  /// values.
  bool is_certain = false;
};

/// The error of a kind that fails on every one of several sets of values: the defaults of its parameters and ports, and others
/// inside their ranges. A kind that accepts some of them has no error.
std::optional<KindFault> fault_of_kind(const LinkDefinition& kind, const Registry& types);

}  // namespace bl::cli
