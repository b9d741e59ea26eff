// Kept apart, because only here the things that panels remember are all known.
#include "ui/desktop/panels/panel_memory.h"

#include "ui/desktop/panels/import_list.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/plan_picture.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/room_agenda.h"
#include "ui/desktop/panels/statistics_record.h"
#include "ui/desktop/panels/time_list.h"

namespace bl::desktop {

PanelMemory::PanelMemory()
    : problems(std::make_unique<ProblemList>()),
      record(std::make_unique<RunRecord>()),
      imports(std::make_unique<ImportList>()),
      times(std::make_unique<TimeList>()),
      plans(std::make_unique<PlanPictures>()) {}
PanelMemory::~PanelMemory() = default;

PanelMemory& memory_of(Workbench& editor) {
  if (!editor.panels) editor.panels = std::make_shared<PanelMemory>();
  return *editor.panels;
}

}  // namespace bl::desktop
