// What the volumes' colours say, and the legend that explains them.
#pragma once

#include <string>
#include <vector>

#include "core/define/registry.h"
#include "ui/desktop/app/theme.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

/// "use", "error", "tension", "fill", or a numeric port as "typification.port".
struct ColourChoice {
  std::string id, label;
};
/// All choices that say something of this state: the four first, then ports by name.
std::vector<ColourChoice> colour_choices(const SceneFacts& facts);

struct Legend {
  std::string title;
  struct Row {
    std::string label;
    Colour colour = 0;
  };
  std::vector<Row> rows;         ///< of categories
  std::vector<Colour> ramp;      ///< of numbers, from low to high; empty for categories
  std::string low, middle, high; ///< what its ends and its middle stand for, with units
};

struct Colouring {
  std::vector<Colour> colours;   ///< as facts.volumes
  Legend legend;
};
Colouring colour_volumes(const SceneFacts& facts, const std::string& choice, const Theme& theme);

/// What people call a use: without underscores, with a capital; "no use" where there is none.
std::string label_of_use(const std::string& use);

}  // namespace bl::desktop
