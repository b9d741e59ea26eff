// Categories for uses, a diverging ramp for errors, an even ramp for everything else that is a number.
#include "ui/desktop/view/colouring.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "core/reading/changed_nodes.h"
#include "core/reading/figures.h"
#include "core/reading/report_model.h"
#include "core/reading/views/programme.h"
#include "core/reading/views/volume.h"

namespace bl::desktop {

namespace {

constexpr double kLargestShownError = 0.25;
constexpr double kFarOff = 0.1;  // of what was asked for
constexpr int kRampSteps = 24;

// A number port of any kind that people and links read as a quantity.
bool is_numeric(const PortDefinition& port) { return port.kind == ValueKind::number || port.kind == ValueKind::integer; }

std::vector<double> values_of(const SceneFacts& facts, const std::string& choice, Unit& unit) {
  std::vector<double> values;
  const auto path = parse_port_path(choice);
  for (const VolumeFacts& volume : facts.volumes) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (choice == "tension") {
      value = volume.figures.tension;
      unit = Unit::metre;
    } else if (choice == "fill") {
      // Of what was asked for, before any limit: who is short in the list is not full here.
      value = volume.asked > 0 ? 1 + std::min(0.0, volume.standing()) : value;
      unit = Unit::ratio;
    } else if (path) {
      if (const auto ref = facts.state->plan->find(volume.node, *path)) {
        unit = facts.state->plan->port(*ref).unit;
        value = as_number(facts.state->value(*ref));
      }
    }
    values.push_back(value);
  }
  return values;
}

std::string told(double value, Unit unit) {
  return unit == Unit::ratio ? reading::percent(value) : reading::quantity(value, unit);
}

Colour colour_by_use(const VolumeFacts& volume, const Theme& theme, const UseNumbers& numbers) {
  return colour_of_use(theme, numbers.tone(volume.figures.use));
}

// Against what was asked for: short to one side, more than that to the other.
Colour colour_by_error(const VolumeFacts& volume, const Theme& theme) {
  return theme.diverging(volume.standing() / kLargestShownError);
}

Colouring by_use(const SceneFacts& facts, const Theme& theme, const UseNumbers& numbers) {
  Colouring out;
  out.legend.title = "Use";
  for (const VolumeFacts& volume : facts.volumes) out.colours.push_back(colour_by_use(volume, theme, numbers));
  // As they are numbered; what has no use comes last.
  std::vector<std::string> uses = facts.uses;
  std::stable_sort(uses.begin(), uses.end(),
                   [&](const std::string& a, const std::string& b) { return numbers.of(a) < numbers.of(b); });
  for (const std::string& use : uses) out.legend.rows.push_back({label_of_use(use), colour_of_use(theme, numbers.tone(use))});
  return out;
}

Colouring by_error(const SceneFacts& facts, const Theme& theme) {
  Colouring out;
  out.legend = {"Volume against demand",
                {},
                {},
                reading::signed_percent(-kLargestShownError),
                "met",
                reading::signed_percent(kLargestShownError)};
  for (const VolumeFacts& volume : facts.volumes) out.colours.push_back(colour_by_error(volume, theme));
  for (int k = 0; k <= kRampSteps; ++k) out.legend.ramp.push_back(theme.diverging(2.0 * k / kRampSteps - 1));
  return out;
}

}  // namespace

UseNumbers::UseNumbers(const Scene& scene) {
  const Registry& registry = full_registry();
  const auto add = [&](const std::string& use) {
    if (!use.empty()) rows_.emplace(use, Row{rows_.size(), tone_of_use(use)});
  };
  std::set<std::string> others;
  for (const auto& [id, node] : scene.nodes) {
    if (const auto use = reading::setting<&reading::VolumeFigures::use>(scene, registry, node)) others.insert(*use);
    if (const auto brief = reading::setting<&reading::ProgrammeFigures::rows>(scene, registry, node))
      for (std::size_t row = 0; row < (*brief)->rows.size(); ++row) add((*brief)->text(row, "use"));
  }
  // What links credit their volumes to.
  for (const auto& [id, link] : scene.links)
    if (const auto demand = reading::parameters_of<reading::DemandParameters>(link, registry)) others.insert(demand->use);
  for (const std::string& use : others) add(use);
}

namespace {

// What a node adds to the uses that there are.
struct UsesOfNode {
  std::optional<std::string> use;
  std::optional<Shared<Table>> brief;
  bool operator==(const UsesOfNode&) const = default;
};

UsesOfNode uses_of(const State& state, std::uint32_t node) {
  const Scene& scene = state.plan->scene;
  const NodeRecord& record = scene.nodes.at(state.plan->nodes[node].id);
  UsesOfNode uses;
  if (const auto use = reading::setting<&reading::VolumeFigures::use>(scene, full_registry(), record)) uses.use = *use;
  if (const auto rows = reading::setting<&reading::ProgrammeFigures::rows>(scene, full_registry(), record)) uses.brief = *rows;
  return uses;
}

}  // namespace

const UseNumbers& UseMemo::of(const std::shared_ptr<const State>& state) {
  const auto changed = state_ ? reading::changed_nodes(*state_, *state) : std::nullopt;
  const bool is_same = changed && std::all_of(changed->begin(), changed->end(), [&](std::uint32_t node) {
                         return uses_of(*state_, node) == uses_of(*state, node);
                       });
  if (!is_same) numbers_ = UseNumbers(state->plan->scene), ++revision_;
  state_ = state;
  return *numbers_;
}

std::size_t UseNumbers::of(const std::string& use) const {
  if (use.empty()) return kNoUse;
  const auto found = rows_.find(use);
  return found == rows_.end() ? rows_.size() : found->second.number;
}

std::size_t UseNumbers::tone(const std::string& use) const {
  const auto found = rows_.find(use);
  return found == rows_.end() ? tone_of_use(use) : found->second.tone;
}

Colour colour_of_use(const Theme& theme, std::size_t tone) {
  const Colours& c = theme.colours();
  if (tone == kNoUse) return mixed(c.text_faint, c.text_soft, 0.6f);
  return IM_COL32((tone >> 16) & 0xff, (tone >> 8) & 0xff, tone & 0xff, 255);
}

AccountTone tone_of_account(const reading::Account& account, double tolerance) {
  const double size = std::abs(account.standing());
  if (size <= tolerance || account.asked <= 0) return AccountTone::met;
  return size > kFarOff ? AccountTone::far : AccountTone::off;
}

Colour colour_of_account(const Theme& theme, AccountTone tone) {
  const Colours& c = theme.colours();
  return tone == AccountTone::met ? c.good : tone == AccountTone::off ? c.warning : c.bad;
}

std::vector<ColourChoice> colour_choices(const SceneFacts& facts) {
  std::vector<ColourChoice> choices = {
      {"use", "Use"}, {"error", "Volume against demand"}, {"tension", "Tension on its place"}, {"fill", "Fill of the demand"}};
  std::set<const TypificationDefinition*> seen;
  std::vector<ColourChoice> ports;
  for (const VolumeFacts& volume : facts.volumes)
    for (const TypePlan& type : facts.state->plan->nodes[volume.node].types) {
      if (type.definition->id == kBaseNode || !seen.insert(type.definition).second) continue;
      for (const PortDefinition& port : type.definition->ports) {
        if (!is_numeric(port) || port.id.starts_with("last_")) continue;
        ports.push_back({type.definition->id + "." + port.id, type.definition->label + ": " + label_of(port.id)});
      }
    }
  std::sort(ports.begin(), ports.end(), [](const ColourChoice& a, const ColourChoice& b) { return a.label < b.label; });
  choices.insert(choices.end(), ports.begin(), ports.end());
  return choices;
}

namespace {

Colouring coloured(const SceneFacts& facts, const std::string& choice, const std::vector<ColourChoice>& choices,
                   const Theme& theme, const UseNumbers& numbers) {
  if (choice == "error") return by_error(facts, theme);
  // What another scene was coloured by may not be known to this one.
  const auto known = std::find_if(choices.begin(), choices.end(), [&](const ColourChoice& c) { return c.id == choice; });
  if (choice == "use" || known == choices.end()) return by_use(facts, theme, numbers);
  Unit unit = Unit::none;
  const std::vector<double> values = values_of(facts, choice, unit);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (choice == "fill") low = 0, high = 1;
  if (!(low <= high)) low = 0, high = 1;
  const double span = high > low ? high - low : 1;
  Colouring out;
  out.legend.title = known->label;
  for (const double value : values)
    out.colours.push_back(std::isfinite(value) ? Theme::ramp(0.2 + 0.8 * (value - low) / span) : theme.colours().text_faint);
  for (int k = 0; k <= kRampSteps; ++k) out.legend.ramp.push_back(Theme::ramp(0.2 + 0.8 * k / kRampSteps));
  out.legend.low = told(low, unit);
  out.legend.high = told(high, unit);
  if (high > low) out.legend.middle = told(0.5 * (low + high), unit);
  return out;
}

}  // namespace

Colouring colour_volumes(const SceneFacts& facts, const std::string& choice, const Theme& theme, const UseNumbers& numbers) {
  return coloured(facts, choice, colour_choices(facts), theme, numbers);
}

// They follow from the roles that nodes have, not from values.
const std::vector<ColourChoice>& ColourMemo::choices(const SceneFacts& facts) {
  if (chosen_from_ && chosen_from_ == facts.state->plan->dependents && nodes_ == facts.columns.node) return choices_;
  chosen_from_ = facts.state->plan->dependents;
  nodes_ = facts.columns.node;
  return choices_ = colour_choices(facts);
}

// False where more than single volumes may have changed.
bool ColourMemo::follow(const SceneFacts& facts, const Theme& theme, const UseNumbers& numbers) {
  const bool is_by_use = choice_ == "use";
  if ((!is_by_use && choice_ != "error") || facts.volumes.size() != facts_->volumes.size()) return false;
  if (is_by_use && facts.uses != facts_->uses) return false;
  for (std::size_t row = 0; row < facts.volumes.size(); ++row) {
    if (row % VolumeList::kLeaf == 0 && facts.volumes.shares_leaf(facts_->volumes, row / VolumeList::kLeaf)) {
      row += VolumeList::kLeaf - 1;
      continue;
    }
    const VolumeFacts& volume = facts.volumes[row];
    colouring_.colours[row] = is_by_use ? colour_by_use(volume, theme, numbers) : colour_by_error(volume, theme);
  }
  return true;
}

const Colouring& ColourMemo::of(const std::shared_ptr<const SceneFacts>& facts, const std::string& choice, const Theme& theme) {
  const UseNumbers& numbers = uses_.of(facts->state);
  const bool is_same_way = facts_ && choice_ == choice && is_dark_ == theme.is_dark() && uses_revision_ == uses_.revision();
  if (!is_same_way || (facts_ != facts && !follow(*facts, theme, numbers)))
    colouring_ = coloured(*facts, choice, choices(*facts), theme, numbers);
  facts_ = facts;
  choice_ = choice;
  is_dark_ = theme.is_dark();
  uses_revision_ = uses_.revision();
  return colouring_;
}

}  // namespace bl::desktop
