// The phases that a facilitator has planned for a session: in order, each with what people may do in it and for how long.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace bl::desktop {

struct PlannedPhase {
  std::string name;
  std::set<std::string> activities;  ///< `change`, `draft`, `comment`, `vote`; none: people only look
  int minutes = 0;                   ///< 0: until the facilitator ends it
  bool operator==(const PlannedPhase&) const = default;
};
using PhasePlan = std::vector<PlannedPhase>;

struct PhaseTemplate {
  const char* label;
  PhasePlan phases;
};
/// Plans to begin with; the last one has no phases.
const std::vector<PhaseTemplate>& phase_templates();

/// As it is kept among a person's settings. A text that is none gives no phases.
std::string text_of_plan(const PhasePlan& plan);
PhasePlan plan_of_text(const std::string& text);

}  // namespace bl::desktop
