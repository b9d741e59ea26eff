// The neighbours of each site in the unbounded power diagram, decided exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Neighbour lists of all sites in one array. Lists are sorted by index: nothing depends on the order of the triangulation.
struct PowerNeighbours {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> first;  ///< neighbours of site i are list[first[i] .. first[i + 1])
  std::vector<std::uint32_t> list;
  std::vector<std::uint8_t> has_cell;    ///< does the site have a cell in the unbounded diagram of the participants?
  std::vector<std::uint32_t> swallower;  ///< of a participant without a cell: the site of least power at its position

  std::span<const std::uint32_t> of(std::size_t site) const {
    return std::span(list).subspan(first[site], first[site + 1] - first[site]);
  }
};

/// `participants`: indices into `sites`, at different positions. Any number and any degenerate arrangement is accepted.
Result<void> find_power_neighbours(std::span<const PowerSite> sites, std::span<const std::uint32_t> participants,
                                   PowerNeighbours& out);

}  // namespace bl::geometry
