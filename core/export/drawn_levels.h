// The levels of a drawing, from the deepest cellar up, and the storeys of a building on them: for all who draw plans.
#pragma once

#include <string>
#include <vector>

#include "core/export/proposal_model.h"

namespace bl::exporting {

/// One plan of a drawing. Levels above the ground go by height, cellars by their number below each building.
struct DrawnLevel {
  int number = 0;                  ///< as `Storey::level`: from 0 up, of cellars -1, -2, ...
  double lowest = 0, highest = 0;  ///< between these lie its floors; cellars need not lie at one height [m]
  double area = 0;                 ///< of its storeys [m²]; of cellars no part of the floor area
  bool is_cellar() const { return number < 0; }
  /// "Level 3", "Cellar 1".
  std::string name() const;
  /// "from -3.00 m", "from -4.20 to -3.00 m".
  std::string heights() const;
  /// "level_03", "cellar_01": in names of files.
  std::string file_stem() const;
};

/// From the deepest cellar up.
std::vector<DrawnLevel> drawn_levels(const Proposal& proposal);
/// How many of them are cellars.
int cellar_levels(const Proposal& proposal);
/// Its cellars from the deepest up, then its storeys.
std::vector<const Storey*> drawn_storeys(const Building& building);

}  // namespace bl::exporting
