// The first sheet of a set of drawings: the programme and what became of it, figures of the land, goals, and problems in words.
#pragma once

#include "core/export/plan_sheet.h"

namespace bl::exporting {

/// `scale`: of the plans behind it, which its title names.
PlanSheet overview_sheet(const Proposal& proposal, const SheetOptions& options, double scale);

}  // namespace bl::exporting
