// Usual agendas of workshops, and the JSON that a plan is kept as.
#include "ui/desktop/document/phase_plan.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"

namespace bl::desktop {

namespace {

constexpr int kMostMinutes = 9999;

}  // namespace

const std::vector<PhaseTemplate>& phase_templates() {
  static const std::vector<PhaseTemplate> kTemplates = {{"Look, comment, change, vote",
                                                         {{"Look", {}, 10},
                                                          {"Comment", {"comment"}, 10},
                                                          {"Change", {"change", "comment"}, 25},
                                                          {"Vote", {"vote", "comment"}, 10}}},
                                                        {"Drafts and proposals",
                                                         {{"Look", {}, 10},
                                                          {"Work on drafts", {"draft", "comment"}, 30},
                                                          {"Discuss proposals", {"comment"}, 20},
                                                          {"Vote", {"vote", "comment"}, 10}}},
                                                        {"Comments only", {{"Look", {}, 10}, {"Comment", {"comment"}, 30}}},
                                                        {"No phases: all four are allowed all the time", {}}};
  return kTemplates;
}

std::string text_of_plan(const PhasePlan& plan) {
  Json all = Json::array();
  for (const PlannedPhase& phase : plan)
    all.push_back({{"name", phase.name}, {"activities", phase.activities}, {"minutes", phase.minutes}});
  return write_json_line(all);
}

PhasePlan plan_of_text(const std::string& text) {
  const Json all = Json::parse(text, nullptr, false);
  PhasePlan plan;
  if (!all.is_array()) return plan;
  for (const Json& one : all) {
    if (!one.is_object() || !one.contains("name") || !one["name"].is_string()) continue;
    PlannedPhase phase{.name = one["name"].get<std::string>(), .activities = {}, .minutes = 0};
    if (const auto list = one.find("activities"); list != one.end() && list->is_array())
      for (const Json& activity : *list)
        if (activity.is_string()) phase.activities.insert(activity.get<std::string>());
    if (const auto minutes = one.find("minutes"); minutes != one.end() && minutes->is_number_integer())
      phase.minutes = static_cast<int>(std::clamp<std::int64_t>(minutes->get<std::int64_t>(), 0, kMostMinutes));
    plan.push_back(std::move(phase));
  }
  return plan;
}

}  // namespace bl::desktop
