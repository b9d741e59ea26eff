// Finds the account of a box among those that were read for this state.
#include "ui/desktop/panels/canvas/bars.h"

#include <algorithm>

#include "core/reading/figures.h"
#include "ui/desktop/panels/canvas/sections.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop::canvas {

std::string BarFigures::text() const {
  return report::readable(account.volume) + " / " + report::quantity(account.asked, Unit::cubic_metre);
}

BarFigures bar_figures(Workbench& editor, const NodeBox& box, const Section& section) {
  const report::Accounts& accounts = memory_of(editor).record->figures(editor).accounts;
  BarFigures bar;
  const auto found = std::lower_bound(accounts.volumes.begin(), accounts.volumes.end(), box.in_state,
                                      [](const report::VolumeAccount& v, std::uint32_t node) { return v.node < node; });
  if (found != accounts.volumes.end() && found->node == box.in_state) {
    bar.account = *found;
  } else {
    bar.account.asked = std::max(number_of(editor, box, section, "demand", 0), number_of(editor, box, section, "demand_min", 0));
    bar.account.limited = bar.account.asked;
  }
  bar.tone = tone_of_account(bar.account, accounts.tolerance);
  bar.is_limited = bar.account.withheld() > accounts.tolerance * bar.account.asked;
  return bar;
}

}  // namespace bl::desktop::canvas
