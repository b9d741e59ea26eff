// A plot, its rules, and what is built on it.
#include "core/reading/views/plot.h"

namespace bl::reading {

void PlotFigures::declare(ViewBuilder<PlotFigures>& v) {
  v.of("plot");
  v.reads(&PlotFigures::polygon, "plot.polygon", Unit::metre);
  v.reads(&PlotFigures::ground, "plot.ground", Unit::metre);
  v.reads(&PlotFigures::fsi_max, "plot.fsi_max", Unit::ratio);
  v.reads(&PlotFigures::gsi_max, "plot.gsi_max", Unit::ratio);
  v.reads(&PlotFigures::height_max, "plot.height_max", Unit::metre);
  v.reads(&PlotFigures::fsi, "plot.fsi", Unit::ratio);
  v.reads(&PlotFigures::gsi, "plot.gsi", Unit::ratio);
  v.reads(&PlotFigures::overshoot, "plot.overshoot", Unit::ratio);
}
BL_VIEW(PlotFigures)

void PlotRuleParameters::declare(ViewBuilder<PlotRuleParameters>& v) {
  v.of_links("plot_rules");
  v.reads(&PlotRuleParameters::hold_fsi, "plot_rules.hold_fsi");
  v.reads(&PlotRuleParameters::hold_gsi, "plot_rules.hold_gsi");
  v.reads(&PlotRuleParameters::hold_height, "plot_rules.hold_height");
}
BL_VIEW(PlotRuleParameters)

BL_VIEWS(plot, PlotFigures, PlotRuleParameters)

}  // namespace bl::reading
