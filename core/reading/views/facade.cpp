// The façade of a volume, as its style dresses it.
#include "core/reading/views/facade.h"

namespace bl::reading {

void FacadeFigures::declare(ViewBuilder<FacadeFigures>& v) {
  v.of("facade");
  v.reads(&FacadeFigures::style_in_force, "facade.style_in_force");
  v.reads(&FacadeFigures::facade_area, "facade.facade_area", Unit::square_metre);
  v.reads(&FacadeFigures::glazed_area, "facade.glazed_area", Unit::square_metre);
  v.reads(&FacadeFigures::opaque_area, "facade.opaque_area", Unit::square_metre);
  v.reads(&FacadeFigures::cost, "facade.cost", Unit::euro);
  v.reads(&FacadeFigures::true_north, "facade.true_north", Unit::degree);
  v.reads(&FacadeFigures::by_orientation, "facade.by_orientation");
}
BL_VIEW(FacadeFigures)

BL_VIEWS(facade, FacadeFigures)

}  // namespace bl::reading
