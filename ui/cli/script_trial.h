// A link kind that people wrote, tried on values of our own before any scene uses it.
#pragma once

#include <optional>

#include "core/define/registry.h"

namespace bl::cli {

struct KindFault {
  Error error;
  /// It reads a name that does not exist, which no values can cure. Else nobody knows: the values that it takes may be none of
  /// ours.
  bool is_certain = false;
};

/// What a kind says where it fails on every one of several sets of values: those that its parameters and ports have by default,
/// and others inside their ranges. A kind that refuses some values and takes others is sound.
std::optional<KindFault> fault_of_kind(const LinkDefinition& kind, const Registry& types);

}  // namespace bl::cli
