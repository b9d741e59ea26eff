// Cellars are below the ground of their building, whatever the height of that is.
#include "core/export/drawn_levels.h"

#include <algorithm>
#include <cstdlib>

#include "core/base/text.h"

namespace bl::exporting {

std::string DrawnLevel::name() const { return (is_cellar() ? "Cellar " : "Level ") + std::to_string(std::abs(number)); }

std::string DrawnLevel::heights() const {
  const std::string low = fixed(lowest, 2), high = fixed(highest, 2);
  return "from " + low + (low == high ? "" : " to " + high) + " m";
}

std::string DrawnLevel::file_stem() const {
  const int count = std::abs(number);
  return (is_cellar() ? "cellar_" : "level_") + std::string(count < 10 ? "0" : "") + std::to_string(count);
}

int cellar_levels(const Proposal& proposal) {
  std::size_t most = 0;
  for (const Building& building : proposal.buildings) most = std::max(most, building.cellars.size());
  return static_cast<int>(most);
}

std::vector<DrawnLevel> drawn_levels(const Proposal& proposal) {
  std::vector<DrawnLevel> levels;
  const int cellars = cellar_levels(proposal);
  for (int number = -cellars; number < proposal.levels; ++number) {
    const double height = proposal.ground + number * proposal.level_height;
    levels.push_back({number, height, height, 0});
  }
  std::vector<bool> has_floor(levels.size(), false);
  for (const Building& building : proposal.buildings)
    for (const Storey* storey : drawn_storeys(building)) {
      const auto place = static_cast<std::size_t>(storey->level + cellars);
      if (place >= levels.size()) continue;
      DrawnLevel& level = levels[place];
      level.area += storey->floor_area;
      if (!level.is_cellar()) continue;
      level.lowest = has_floor[place] ? std::min(level.lowest, storey->bottom) : storey->bottom;
      level.highest = has_floor[place] ? std::max(level.highest, storey->bottom) : storey->bottom;
      has_floor[place] = true;
    }
  return levels;
}

std::vector<const Storey*> drawn_storeys(const Building& building) {
  std::vector<const Storey*> storeys;
  for (auto cellar = building.cellars.rbegin(); cellar != building.cellars.rend(); ++cellar) storeys.push_back(&*cellar);
  for (const Storey& storey : building.storeys) storeys.push_back(&storey);
  return storeys;
}

}  // namespace bl::exporting
