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
  v.reads(&PlotFigures::osr, "plot.osr", Unit::ratio);
  v.reads(&PlotFigures::storeys, "plot.layers", Unit::ratio);
  v.reads(&PlotFigures::top, "plot.top", Unit::metre);
  v.reads(&PlotFigures::overshoot, "plot.overshoot", Unit::ratio);
  v.reads(&PlotFigures::setback, "plot.setback", Unit::metre);
  v.reads(&PlotFigures::setback_overshoot, "plot.setback_overshoot", Unit::metre);
  v.reads(&PlotFigures::message, "plot.message");
}
BL_VIEW(PlotFigures)

void PlotVolume::declare(ViewBuilder<PlotVolume>& v) {
  v.of("smart_volume");
  v.reads(&PlotVolume::position, "node.position", Unit::metre);
  v.reads(&PlotVolume::centroid, "smart_volume.centroid", Unit::metre);
  v.reads(&PlotVolume::volume, "smart_volume.volume", Unit::cubic_metre);
  v.reads(&PlotVolume::floor_area, "smart_volume.floor_area", Unit::square_metre);
  v.reads(&PlotVolume::footprint, "smart_volume.footprint", Unit::square_metre);
  v.reads(&PlotVolume::bottom, "smart_volume.bottom", Unit::metre);
  v.reads(&PlotVolume::height, "smart_volume.height", Unit::metre);
  v.reads(&PlotVolume::storey_height, "smart_volume.storey_height", Unit::metre);
  v.reads(&PlotVolume::stands_on, "smart_volume.stands_on");
}
BL_VIEW(PlotVolume)

void PlotStanding::declare(ViewBuilder<PlotStanding>& v) {
  v.of("footprint");
  v.reads(&PlotStanding::plates, "footprint.plates");
  v.reads(&PlotStanding::stands_at, "footprint.stands_at", Unit::metre);
  v.reads(&PlotStanding::ground, "footprint.ground", Unit::metre);
}
BL_VIEW(PlotStanding)

void PlotRuleParameters::declare(ViewBuilder<PlotRuleParameters>& v) {
  v.of_links("plot_rules");
  v.reads(&PlotRuleParameters::hold_fsi, "plot_rules.hold_fsi");
  v.reads(&PlotRuleParameters::hold_gsi, "plot_rules.hold_gsi");
  v.reads(&PlotRuleParameters::hold_height, "plot_rules.hold_height");
  v.reads(&PlotRuleParameters::hold_setback, "plot_rules.hold_setback");
}
BL_VIEW(PlotRuleParameters)

BL_VIEWS(plot, PlotFigures, PlotVolume, PlotStanding, PlotRuleParameters)

}  // namespace bl::reading
