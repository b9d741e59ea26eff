// Sharing and cellars of volumes that stand.
#include "core/reading/views/building.h"

namespace bl::reading {

void SharingFigures::declare(ViewBuilder<SharingFigures>& v) {
  v.of("footprint");
  v.reads(&SharingFigures::shares, "footprint.shares");
  v.reads(&SharingFigures::storeys_held, "footprint.storeys_held");
  v.reads(&SharingFigures::building, "footprint.building");
}
BL_VIEW(SharingFigures)

void CellarFigures::declare(ViewBuilder<CellarFigures>& v) {
  v.of("footprint");
  v.reads(&CellarFigures::storeys, "footprint.cellars_built");
  v.reads(&CellarFigures::storey_height, "footprint.cellar_height", Unit::metre);
  v.reads(&CellarFigures::area, "footprint.cellar_area", Unit::square_metre);
}
BL_VIEW(CellarFigures)

BL_VIEWS(building, SharingFigures, CellarFigures)

}  // namespace bl::reading
