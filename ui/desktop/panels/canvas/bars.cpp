// Finds the account of a box among those that were read for this state.
#include "ui/desktop/panels/canvas/bars.h"

#include <algorithm>

#include "core/reading/figures.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop::canvas {

std::string BarFigures::text() const {
  return reading::readable(account.volume) + " / " + reading::quantity(account.asked, Unit::cubic_metre);
}

float BarFigures::share(double volume) const {
  return static_cast<float>(volume / std::max({account.volume, account.asked, account.limited, 1e-9}));
}

BarFigures bar_figures(Workbench& editor, const NodeBox& box) {
  const reading::Accounts& accounts = memory_of(editor).record->figures(editor).accounts;
  BarFigures bar;
  if (const std::size_t row = accounts.row_of(box.in_state); row < accounts.volumes.size()) {
    bar.account = accounts.volumes[row];
    bar.is_known = true;
  } else if (const auto node = editor.scene().nodes.find(box.id); node != editor.scene().nodes.end()) {
    const auto volume = reading::settings_of<reading::VolumeFigures>(editor.scene(), editor.types(), node->second);
    if (volume) bar.account.asked = bar.account.limited = std::max(volume->demand, volume->demand_min);
  }
  bar.tone = tone_of_account(bar.account, accounts.tolerance);
  bar.is_limited = bar.account.withheld() > accounts.tolerance * bar.account.asked;
  return bar;
}

}  // namespace bl::desktop::canvas
