// What the bar of a box shows: what there is against what was asked for.
#pragma once

#include <string>

#include "core/reading/account.h"
#include "ui/desktop/panels/canvas/model.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop::canvas {

struct BarFigures {
  reading::Account account;  ///< the one that list, colours, statistics and report read
  AccountTone tone = AccountTone::far;
  bool is_known = false;    ///< a tick has seen the volume
  bool is_limited = false;  ///< limits leave visibly less than was asked for

  /// "400 / 600 m³": what there is, and what was asked for.
  std::string text() const;
  /// Of the length of the bar, which is that of the largest of its figures.
  float share(double volume) const;
};

/// Of a box with a SmartVolume. One that no tick has seen yet has nothing of what its scene asks for.
BarFigures bar_figures(Workbench& editor, const NodeBox& box);

}  // namespace bl::desktop::canvas
