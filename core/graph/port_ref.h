// The place of a port in a plan.
#pragma once

#include <compare>
#include <cstdint>

namespace bl {

/// One port of one typification of one node. `type == kNodeId` stands for the node's own id, which links may read; of a
/// read or proposal that is optional, for a port that the node lacks.
struct PortRef {
  std::uint32_t node = 0;
  std::uint16_t type = 0, port = 0;
  static constexpr std::uint16_t kNodeId = 0xffff;
  auto operator<=>(const PortRef&) const = default;
};

}  // namespace bl
