// A link kind that people wrote, tried on values of our own before any scene uses it.
#pragma once

#include <optional>

#include "core/define/registry.h"

namespace bl::cli {

/// Its error where it fails on every one of several ordinary sets of values: such a kind never works. A kind that refuses some
/// values and takes others is sound.
std::optional<Error> fault_of_kind(const LinkDefinition& kind, const Registry& types);

}  // namespace bl::cli
