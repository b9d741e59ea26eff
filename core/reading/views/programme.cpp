// What a brief asks for, and how links deal it out.
#include "core/reading/views/programme.h"

namespace bl::reading {

void ProgrammeFigures::declare(ViewBuilder<ProgrammeFigures>& v) {
  v.of("programme");
  v.reads(&ProgrammeFigures::rows, "programme.rows");
}
BL_VIEW(ProgrammeFigures)

void DemandParameters::declare(ViewBuilder<DemandParameters>& v) {
  v.of_links("demand");
  v.reads(&DemandParameters::use, "demand.use");
}
BL_VIEW(DemandParameters)

BL_VIEWS(programme, ProgrammeFigures, DemandParameters)

}  // namespace bl::reading
