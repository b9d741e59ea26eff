// The storeys that volumes have and wish, what a height limit withholds, and who sets it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/graph/state.h"

namespace bl::reading {

/// The height that the limit of a volume takes from what is wished of it.
struct WithheldHeight {
  PortRef limit;      ///< the port that holds the limit
  double height = 0;  ///< of the storeys that are missing [m]
  double share = 0;   ///< of the storeys that are wished
  std::int64_t wished = 0;
};
/// Nothing for a volume that has its storeys, or that does not stand. Of a building that several volumes share it is told of the
/// one whose limit is the least.
std::optional<WithheldHeight> withheld_height(const State& state, std::uint32_t node);

/// Does the value of the port change anything in what the volume is now? Nobody looks at the ground of a volume that stands on a
/// roof, or at the sides of a footprint that is no block.
bool has_effect(const State& state, PortRef ref);

/// "6 of 8 storeys: link `sun` (Solar right) leaves 19.90 m"; empty for a volume that has its storeys, or that does not stand.
/// Of a building that several volumes share it is told of the host.
std::string why_lower(const State& state, std::uint32_t node);

/// Has the volume all the storeys that it wishes, so that only its footprint can give it more? False for one that does not stand.
bool has_all_storeys(const State& state, std::uint32_t node);

}  // namespace bl::reading
