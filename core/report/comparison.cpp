// Walks both states by node and port, side by side.
#include "core/report/comparison.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/reading/changes.h"
#include "core/reading/figures.h"
#include "core/reading/report_model.h"
#include "core/reading/storeys.h"
#include "core/reading/survey.h"
#include "core/report/setting_difference.h"

namespace bl::report {

namespace {

constexpr const char* kNoFigure = "\u2013";  // an en dash
constexpr double kLeastOfAfter = 0.05;   // of what is there now: less is no base of a percentage

constexpr std::size_t kMostListed = 3;  // nodes of one sort by name; more are counted

std::string spoken(const std::string& id) {
  std::string text = id;
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

// Amounts are added up over nodes; rates and shares are averaged.
bool adds_up(Unit unit) {
  return unit == Unit::square_metre || unit == Unit::cubic_metre || unit == Unit::count || unit == Unit::euro;
}

// What an evaluation still misses, the means by which it gets there and what it remembers of itself say nothing of its result.
bool is_indicator(const PortDefinition& port) {
  return port.is_computed && !port.recall && !port.is_residual && !port.is_means &&
         (port.kind == ValueKind::number || port.kind == ValueKind::integer);
}

bool is_share(const PortDefinition& port) {
  return port.unit == Unit::ratio && std::min(port.hard_maximum, port.soft_maximum.value_or(port.hard_maximum)) <= 1;
}

// " of smart_volume.volume" for a port whose meaning is that of another port, which people have chosen beside it.
std::string subject_of(const State& state, PortRef ref) {
  const TypePlan& type = state.plan->nodes[ref.node].types[ref.type];
  if (type.definition->ports[ref.port].unit_from.empty()) return "";
  for (std::size_t p = 0; p < type.definition->ports.size(); ++p)
    if (type.definition->ports[p].kind == ValueKind::port)
      if (const auto* chosen = std::get_if<std::string>(&type.set_values[p]); chosen != nullptr && !chosen->empty())
        return " of " + *chosen;
  return "";
}

// "0", "0.000": figures without a digit that says anything.
bool reads_as_zero(double value) { return reading::readable(value).find_first_of("123456789") == std::string::npos; }

struct Sum {
  Unit unit = Unit::none;
  bool is_share = false;
  std::string label;
  double before = 0, after = 0;
  std::size_t count_before = 0, count_after = 0;
};

class Walk {
 public:
  Walk(const State& before, const State& after, double least_share) : before_(before), after_(after), least_share_(least_share) {}

  Comparison run() {
    result_.first = first_figures(before_, after_);
    result_.tolerance = std::max(reading::account_tolerance(before_), reading::account_tolerance(after_));
    read_inputs();
    read_reasons();
    read(before_, false);
    read(after_, true);
    pair_up();
    for (const auto& [path, sum] : sums_) {
      const bool is_sum = adds_up(sum.unit);
      const auto figure = [&](double total, std::size_t count) {
        return is_sum || count == 0 ? total : total / static_cast<double>(count);
      };
      IndicatorRow total;
      total.path = path;
      total.label = sum.label + (is_sum ? ", sum" : ", mean");
      total.unit = sum.unit;
      total.before = figure(sum.before, sum.count_before);
      total.after = figure(sum.after, sum.count_after);
      total.is_share = sum.is_share;
      total.has_before = sum.count_before > 0;
      total.has_after = sum.count_after > 0;
      total.is_noise = is_noise(total);
      result_.totals.push_back(std::move(total));
    }
    // A street that had two cars and has one is no news beside one that had two thousand.
    const auto rank = [this](const IndicatorRow& row) { return std::abs(row.after - row.before) / largest_.at(row.path); };
    for (std::vector<IndicatorRow>* rows : {&result_.volumes, &result_.nodes})
      std::stable_sort(rows->begin(), rows->end(),
                       [&](const IndicatorRow& a, const IndicatorRow& b) { return rank(a) > rank(b); });
    return std::move(result_);
  }

 private:
  using Key = std::pair<std::string, std::string>;

  void read(const State& state, bool is_after) {
    const Plan& plan = *state.plan;
    for (std::uint32_t n = 0; n < plan.nodes.size(); ++n)
      for (std::uint16_t t = 0; t < plan.nodes[n].types.size(); ++t) {
        const TypificationDefinition& type = *plan.nodes[n].types[t].definition;
        for (std::uint16_t p = 0; p < type.ports.size(); ++p)
          if (is_indicator(type.ports[p])) take(state, {n, t, p}, is_after);
      }
    // What is missing of what was asked for is no port: it follows from several, by the account that all displays share.
    for (const reading::VolumeAccount& volume : reading::accounts_of(state).volumes) {
      const NodePlan& node = plan.nodes[volume.node];
      ask(node.id, "account.missing", volume.asked);
      ask(node.id, "account.missing_area", volume.asked_area);
      take_figure(node, "account.missing", "SmartVolume: missing of the volume asked for", Unit::cubic_metre, volume.missing(),
                  is_after);
      if (volume.is_by_area)
        take_figure(node, "account.missing_area", "SmartVolume: missing of the floor area asked for", Unit::square_metre,
                    volume.missing_area(), is_after);
    }
  }

  void take_figure(const NodePlan& node, const std::string& path, const std::string& label, Unit unit, double value,
                   bool is_after) {
    note(node, {path, label, unit, false}, value, is_after);
    add_up({path, label, unit, false}, value, is_after);
  }

  void take(const State& state, PortRef ref, bool is_after) {
    const Plan& plan = *state.plan;
    const NodePlan& node = plan.nodes[ref.node];
    const TypificationDefinition& type = *node.types[ref.type].definition;
    const PortDefinition& port = type.ports[ref.port];
    const Unit unit = port.unit_from.empty() ? port.unit : Unit::none;
    const std::string path = type.id + "." + port.id;
    const std::string label = type.label + ": " + spoken(port.id) + subject_of(state, ref);
    const double value = as_number(state.value(ref));
    const Indicator indicator{path, label, unit, is_share(port)};
    note(node, indicator, value, is_after);
    // What means something else at every node has no total; a node alone of its kind is its own.
    if (port.unit_from.empty()) add_up(indicator, value, is_after);
  }

  struct Indicator {
    std::string path, label;
    Unit unit = Unit::none;
    bool is_share = false;
  };

  void note(const NodePlan& node, const Indicator& indicator, double value, bool is_after) {
    IndicatorRow fresh;
    fresh.node = node.id;
    fresh.name = node.name;
    fresh.path = indicator.path;
    fresh.label = indicator.label;
    fresh.unit = indicator.unit;
    fresh.is_share = indicator.is_share;
    IndicatorRow& row = rows_.emplace(Key{node.id, indicator.path}, fresh).first->second;
    (is_after ? row.after : row.before) = value;
    (is_after ? in_after_ : in_before_).insert({node.id, indicator.path});
    double& largest = largest_[indicator.path];
    largest = std::max(largest, std::abs(value));
  }

  void add_up(const Indicator& indicator, double value, bool is_after) {
    Sum& sum = sums_[indicator.path];
    sum.unit = indicator.unit;
    sum.is_share = indicator.is_share;
    sum.label = indicator.label;
    (is_after ? sum.after : sum.before) += value;
    ++(is_after ? sum.count_after : sum.count_before);
  }

  // What was asked for, of a node and of all: the measure of what is missing of it.
  void ask(const std::string& node, const std::string& path, double amount) {
    double& most = asked_[{node, path}];
    asked_[{"", path}] += std::max(0.0, amount - most);
    most = std::max(most, amount);
  }

  static bool is_of_volume(const IndicatorRow& row) {
    return row.path.starts_with("smart_volume.") || row.path.starts_with("footprint.") || row.path.starts_with("account.");
  }

  // Solvers stop within their tolerance: two runs to the same end differ by so much.
  bool is_noise(const IndicatorRow& row) const {
    if (!is_of_volume(row) || !row.has_before || !row.has_after) return false;
    const auto asked = asked_.find({row.node, row.path});
    const double whole = asked == asked_.end() ? std::max(std::abs(row.before), std::abs(row.after)) : asked->second;
    return std::abs(row.after - row.before) <= result_.tolerance * whole;
  }

  void pair_up() {
    for (const auto& [key, row] : rows_) {
      if (!in_before_.contains(key) || !in_after_.contains(key)) continue;
      if (!row.is_seen(least_share_)) ++result_.same;
      else if (is_noise(row)) ++result_.within_tolerance;
      else (is_of_volume(row) ? result_.volumes : result_.nodes).push_back(row);
    }
  }

  static const Value& value_in(const PortValues& values, const PortDefinition& port) {
    const auto found = values.find(port.id);
    return found == values.end() ? port.default_value : found->second;
  }

  void differing_ports(const std::string& place, const TypeDefinition& type, const PortValues& a, const PortValues& b) {
    for (const PortDefinition& port : type.ports) {
      if (port.is_computed) continue;
      if (const std::string what = setting_difference(value_in(a, port), value_in(b, port), port); !what.empty())
        result_.inputs.push_back(place + port.id + ": " + what);
    }
  }

  static std::vector<std::string> reasons_in(const State& state) {
    std::vector<std::string> reasons;
    for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
      if (const std::string why = reading::why_lower(state, n); !why.empty())
        reasons.push_back(state.plan->nodes[n].name + " has " + why);
    for (const Error& problem : reading::problems_of(state)) reasons.push_back(problem.text());
    for (const Error& rule : reading::rule_errors(state)) reasons.push_back(rule.text());
    return reasons;
  }

  void read_reasons() {
    const std::vector<std::string> before = reasons_in(before_), after = reasons_in(after_);
    const auto only = [](const std::vector<std::string>& here, const std::vector<std::string>& there) {
      std::vector<std::string> some;
      std::copy_if(here.begin(), here.end(), std::back_inserter(some),
                   [&](const std::string& reason) { return std::find(there.begin(), there.end(), reason) == there.end(); });
      return some;
    };
    result_.reasons_before = only(before, after);
    result_.reasons_after = only(after, before);
  }

  static const std::string& name_in(const State& state, const std::string& id) {
    return state.plan->nodes[state.plan->node_index(id)].name;
  }

  // An import brings hundreds of nodes: they are counted.
  static std::vector<std::string> names_of(const State& state, const std::vector<std::string>& ids) {
    std::vector<std::string> names;
    std::size_t imported = 0;
    for (const std::string& id : ids)
      if (state.plan->scene.nodes.at(id).types.contains("imported")) ++imported;
    for (const std::string& id : ids)
      if (imported <= kMostListed || !state.plan->scene.nodes.at(id).types.contains("imported"))
        names.push_back(name_in(state, id));
    if (imported > kMostListed) names.push_back(std::to_string(imported) + " imported nodes");
    return names;
  }

  void tell_roles() {
    for (const auto& [role, ids] : roles_) {
      const auto& [type, which] = role;
      if (ids.size() > kMostListed)
        result_.inputs.push_back(type + ": a role of " + std::to_string(ids.size()) + " nodes in the " + which + " only");
      else
        for (const std::string& id : ids)
          result_.inputs.push_back("nodes/" + id + "/" + type + ": a role in the " + which + " only");
    }
  }

  void read_inputs() {
    const Scene &a = before_.plan->scene, &b = after_.plan->scene;
    differing_ports("settings/", settings_type(), a.settings, b.settings);
    const reading::Changes changes = reading::changes_between(before_, after_);
    result_.only_before = names_of(before_, changes.removed_nodes);
    result_.only_after = names_of(after_, changes.added_nodes);
    for (const auto& [id, node] : b.nodes)
      if (const auto other = a.nodes.find(id); other != a.nodes.end() && !(other->second == node))
        differing_node(id, other->second, node);
    tell_roles();
    for (const auto& [id, link] : a.links)
      if (!b.links.contains(id)) result_.inputs.push_back("links/" + id + ": only in the first (" + link.kind + ")");
    for (const auto& [id, link] : b.links) {
      const auto other = a.links.find(id);
      if (other == a.links.end()) result_.inputs.push_back("links/" + id + ": only in the second (" + link.kind + ")");
      else if (!(other->second == link)) differing_link(id, other->second, link);
    }
  }

  void differing_node(const std::string& id, const NodeRecord& a, const NodeRecord& b) {
    const std::string place = "nodes/" + id + "/";
    const auto& types = after_.plan->nodes[after_.plan->node_index(id)].types;
    for (const TypePlan& type : types) {
      const auto first = a.types.find(type.definition->id), second = b.types.find(type.definition->id);
      if (first == a.types.end()) roles_[{type.definition->id, "second"}].push_back(id);
      else if (second != b.types.end())
        differing_ports(place + type.definition->id + "/", *type.definition, first->second, second->second);
    }
    for (const auto& [type, values] : a.types)
      if (!b.types.contains(type)) roles_[{type, "first"}].push_back(id);
    if (a.locked != b.locked) result_.inputs.push_back(place + "locked: other ports are locked");
  }

  void differing_link(const std::string& id, const LinkRecord& a, const LinkRecord& b) {
    const std::string place = "links/" + id + "/";
    const auto say = [&](const std::string& what, const std::string& first, const std::string& second) {
      if (first != second) result_.inputs.push_back(place + what + ": " + text_difference(first, second));
    };
    say("kind", a.kind, b.kind);
    say("from", write_json_line(selection_to_json(a.from)), write_json_line(selection_to_json(b.from)));
    say("to", write_json_line(selection_to_json(a.to)), write_json_line(selection_to_json(b.to)));
    say("strength", shortest(a.strength), shortest(b.strength));
    say("enabled", a.is_enabled ? "yes" : "no", b.is_enabled ? "yes" : "no");
    say("muted", a.is_muted ? "yes" : "no", b.is_muted ? "yes" : "no");
    const std::uint32_t index = link_index(id);
    const LinkDefinition* definition = after_.plan->links[index].definition;
    if (a.kind == b.kind && definition != nullptr) differing_ports(place, *definition, a.parameters, b.parameters);
  }

  std::uint32_t link_index(const std::string& id) const {
    const auto& links = after_.plan->links;
    return static_cast<std::uint32_t>(
        std::find_if(links.begin(), links.end(), [&](const LinkPlan& link) { return link.id == id; }) - links.begin());
  }

  const State &before_, &after_;
  double least_share_;
  std::map<Key, IndicatorRow> rows_;
  std::set<Key> in_before_, in_after_;
  std::map<Key, double> asked_;  // by node and path; all together without a node
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> roles_;  // in one of both only: role, which one; nodes
  std::map<std::string, Sum> sums_;
  std::map<std::string, double> largest_;  // by port: the largest size of all nodes in both
  Comparison result_;
};

}  // namespace

double IndicatorRow::share() const {
  const double most = std::max(std::abs(before), std::abs(after));
  return most > 0 ? std::abs(after - before) / most : 0;
}

std::string IndicatorRow::figure(double value) const {
  return is_share ? reading::percent(value) : reading::quantity(value, unit == Unit::ratio ? Unit::none : unit);
}

std::string IndicatorRow::first() const { return has_before ? figure(before) : kNoFigure; }

std::string IndicatorRow::second() const { return has_after ? figure(after) : kNoFigure; }

std::string IndicatorRow::difference() const {
  if (!has_before || !has_after) return kNoFigure;
  if (figure(before) == figure(after)) return "same";
  // A percentage of what people read as zero says nothing, nor does one of little beside what there is now.
  const bool is_nothing = reads_as_zero(before) || std::abs(before) < kLeastOfAfter * std::abs(after);
  return is_nothing ? figure(after - before) : reading::signed_percent((after - before) / std::abs(before));
}

bool IndicatorRow::is_seen(double least_share) const {
  if (is_noise) return false;
  if (has_before != has_after) return !reads_as_zero(has_before ? before : after);
  return share() > least_share && figure(before) != figure(after) && !(reads_as_zero(before) && reads_as_zero(after));
}

Comparison compare(const State& before, const State& after, double least_share) { return Walk(before, after, least_share).run(); }

}  // namespace bl::report
