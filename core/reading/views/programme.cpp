// What a brief asks for, and how links deal it out.
#include "core/reading/views/programme.h"

namespace bl::reading {

void ProgrammeFigures::declare(ViewBuilder<ProgrammeFigures>& v) {
  v.of("programme");
  v.reads(&ProgrammeFigures::rows, "programme.rows");
}
BL_VIEW(ProgrammeFigures)

void UseKind::declare(ViewBuilder<UseKind>& v) {
  v.of("use");
  v.reads(&UseKind::use, "use.use");
  v.reads(&UseKind::is_open, "use.is_open");
}
BL_VIEW(UseKind)

void DemandParameters::declare(ViewBuilder<DemandParameters>& v) {
  v.of_links("demand");
  v.reads(&DemandParameters::use, "demand.use");
}
BL_VIEW(DemandParameters)

BL_VIEWS(programme, ProgrammeFigures, UseKind, DemandParameters)

}  // namespace bl::reading
