// The figures of a SmartVolume: what is asked of it, and what a solver has made of it.
#include "core/reading/views/volume.h"

namespace bl::reading {

void VolumeFigures::declare(ViewBuilder<VolumeFigures>& v) {
  v.of("smart_volume");
  v.reads(&VolumeFigures::position, "node.position", Unit::metre);
  v.reads_tension(&VolumeFigures::tension, "node.position", Unit::metre);
  v.reads(&VolumeFigures::use, "smart_volume.use");
  v.reads(&VolumeFigures::standing, "smart_volume.standing");
  v.reads(&VolumeFigures::demand, "smart_volume.demand", Unit::cubic_metre);
  v.reads(&VolumeFigures::demand_limit, "smart_volume.demand_limit", Unit::cubic_metre);
  v.reads(&VolumeFigures::demand_min, "smart_volume.demand_min", Unit::cubic_metre);
  v.reads(&VolumeFigures::storey_height, "smart_volume.storey_height", Unit::metre);
  v.reads(&VolumeFigures::wanted, "smart_volume.wanted", Unit::cubic_metre);
  v.reads(&VolumeFigures::weight, "smart_volume.weight", Unit::square_metre);
  v.reads(&VolumeFigures::radius, "smart_volume.radius", Unit::metre);
  v.reads(&VolumeFigures::volume, "smart_volume.volume", Unit::cubic_metre);
  v.reads(&VolumeFigures::cell_volume, "smart_volume.cell_volume", Unit::cubic_metre);
  v.reads(&VolumeFigures::floor_area, "smart_volume.floor_area", Unit::square_metre);
  v.reads(&VolumeFigures::surface_area, "smart_volume.surface_area", Unit::square_metre);
  v.reads(&VolumeFigures::footprint, "smart_volume.footprint", Unit::square_metre);
  v.reads(&VolumeFigures::spherical_area, "smart_volume.spherical_area", Unit::square_metre);
  v.reads(&VolumeFigures::height, "smart_volume.height", Unit::metre);
  v.reads(&VolumeFigures::bottom, "smart_volume.bottom", Unit::metre);
  v.reads(&VolumeFigures::error, "smart_volume.error", Unit::ratio);
  v.reads(&VolumeFigures::mesh, "smart_volume.mesh");
  v.reads(&VolumeFigures::state, "smart_volume.state");
  v.reads(&VolumeFigures::reason, "smart_volume.reason");
  v.reads(&VolumeFigures::neighbours, "smart_volume.neighbours");
  v.reads(&VolumeFigures::stands_on, "smart_volume.stands_on");
  v.reads(&VolumeFigures::hang, "smart_volume.hang", Unit::metre);
}
BL_VIEW(VolumeFigures)

void FootprintFigures::declare(ViewBuilder<FootprintFigures>& v) {
  v.of("footprint");
  v.reads(&FootprintFigures::form, "footprint.form");
  v.reads(&FootprintFigures::angle, "footprint.angle", Unit::degree);
  v.reads(&FootprintFigures::aspect, "footprint.aspect", Unit::ratio);
  v.reads(&FootprintFigures::storeys, "footprint.storeys");
  v.reads(&FootprintFigures::storeys_built, "footprint.storeys_built");
  v.reads(&FootprintFigures::plates, "footprint.plates");
}
BL_VIEW(FootprintFigures)

void StoreyFigures::declare(ViewBuilder<StoreyFigures>& v) {
  v.of("footprint");
  v.reads(&StoreyFigures::storeys, "footprint.storeys");
  v.reads(&StoreyFigures::storeys_built, "footprint.storeys_built");
  v.reads(&StoreyFigures::height_limit, "footprint.height_limit", Unit::metre);
  v.reads(&StoreyFigures::is_limited, "footprint.is_limited");
  v.reads(&StoreyFigures::bases, "footprint.bases");
  v.reads(&StoreyFigures::ground, "footprint.ground", Unit::metre);
}
BL_VIEW(StoreyFigures)

void VolumePlace::declare(ViewBuilder<VolumePlace>& v) {
  v.of("smart_volume");
  v.reads(&VolumePlace::position, "node.position", Unit::metre);
  v.reads(&VolumePlace::wanted, "smart_volume.wanted", Unit::cubic_metre);
  v.reads(&VolumePlace::hang, "smart_volume.hang", Unit::metre);
  v.reads(&VolumePlace::bottom, "smart_volume.bottom", Unit::metre);
}
BL_VIEW(VolumePlace)

void StandParameters::declare(ViewBuilder<StandParameters>& v) {
  v.of_links("stand");
  v.reads(&StandParameters::stiffness, "stand.stiffness", Unit::ratio);
}
BL_VIEW(StandParameters)

BL_VIEWS(volume, VolumeFigures, FootprintFigures, StoreyFigures, VolumePlace, StandParameters)

}  // namespace bl::reading
