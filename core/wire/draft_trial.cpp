// Indicators of two states side by side.
#include "core/wire/draft_trial.h"

#include <optional>

#include <nlohmann/json.hpp>

#include "core/reading/views/people.h"
#include "core/wire/plan_view.h"

namespace bl::wire {

namespace {

struct Indicator {
  std::string name;
  reading::IndicatorFigures figures;
};

std::map<std::string, Indicator> indicators_of(const State& state) {
  std::map<std::string, Indicator> all;
  for (const auto& row : reading::rows<reading::IndicatorFigures>(state)) {
    const NodePlan& node = state.plan->nodes[row.node];
    all[node.id] = {node.name.empty() ? node.id : node.name, row.figures};
  }
  return all;
}

Json side_of(const Indicator* indicator) {
  if (indicator == nullptr) return nullptr;
  const reading::IndicatorFigures& figures = indicator->figures;
  return {{"value", figures.value}, {"status", figures.status}, {"score", figures.score}};
}

}  // namespace

TrialPicture picture_of(const State& without, const State& with) {
  const std::map<std::string, Indicator> before = indicators_of(without), after = indicators_of(with);
  std::set<std::string> ids;
  for (const auto* side : {&before, &after})
    for (const auto& [id, indicator] : *side) ids.insert(id);
  Json figures = Json::array();
  for (const std::string& id : ids) {
    const auto first = before.find(id), second = after.find(id);
    const Indicator* was = first == before.end() ? nullptr : &first->second;
    const Indicator* is = second == after.end() ? nullptr : &second->second;
    const Indicator& known = is != nullptr ? *is : *was;
    Json figure = {{"id", id}, {"name", known.name}, {"unit", known.figures.unit}, {"target", known.figures.target}};
    figure["before"] = side_of(was);
    figure["after"] = side_of(is);
    const bool are_both = was != nullptr && is != nullptr;
    figure["difference"] = are_both ? Json(is->figures.value - was->figures.value) : Json();
    figures.push_back(std::move(figure));
  }
  return {JsonValue::of(std::move(figures)), plan_view(with)};
}

Json trial_to_json(const DraftTrials* all, const std::string& draft) {
  if (all == nullptr || !all->trials.contains(draft)) return nullptr;
  const DraftTrial& trial = all->trials.at(draft);
  Json json = {{"state", kTrialStateNames[static_cast<std::size_t>(trial.state)]},
               {"ticks", trial.ticks},
               {"is_settled", trial.is_settled},
               {"seq", trial.seq}};
  if (trial.state == TrialState::waiting) json["line"] = trial.line;
  if (!trial.why.empty()) json["why"] = trial.why;
  json["figures"] = trial.picture ? **trial.picture->figures.read() : Json::array();
  return json;
}

}  // namespace bl::wire
