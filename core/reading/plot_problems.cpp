// Compares the figures of plots with their rules, and looks for the links that hold these.
#include "core/reading/plot_problems.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/demand/demand_limit.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/plot_measure.h"
#include "core/reading/figures.h"
#include "core/reading/views/plot.h"

namespace bl::reading {

namespace {

constexpr std::size_t kNamedBreakers = 4;
constexpr double kLeastLength = 1e-3;  // [m] by which a height or a set-back misses a rule: nobody builds to less

/// A volume with the part that it has in what is found.
struct Breaker {
  std::string id;
  double amount = 0;
};

struct VolumeThere {
  std::string id;
  PlotVolume figures;
  double clearance = 0;  // how far it stays inside the sides of the plot [m]
  bool is_standing = false;
  std::optional<double> ground;  // of its footprint [m]
  double base = 0;               // from where its height counts [m]
};

// As the plot measures it: the plates of a volume that stands, else a disc of the area of its footprint. Nothing of a volume that
// it does not count.
std::optional<VolumeThere> volume_on(const State& state, std::uint32_t node, const PlotFigures& figures) {
  constexpr double kChords = 1e-3;  // [m]
  auto volume = row_of<PlotVolume>(state, node);
  if (!volume || !(volume->volume > 0)) return std::nullopt;
  const auto standing = row_of<PlotStanding>(state, node);
  const bool is_standing = standing && !standing->plates.rows.empty();
  if (!geometry::ring_contains(figures.polygon, is_standing ? standing->stands_at : volume->centroid)) return std::nullopt;
  const double clearance = is_standing ? geometry::clearance_of(geometry::read_body(standing->plates), figures.polygon, kChords)
                                       : geometry::clearance_of_disc(figures.polygon, volume->centroid, volume->footprint);
  return VolumeThere{state.plan->nodes[node].id,
                     std::move(*volume),
                     clearance,
                     is_standing,
                     is_standing ? std::optional(standing->ground) : std::nullopt,
                     0};
}

// The volumes of its selection that the plot counts.
std::vector<VolumeThere> volumes_on(const State& state, std::uint32_t plot, const PlotFigures& figures) {
  std::vector<VolumeThere> volumes;
  for (const SetPlan& set : state.plan->sets) {
    if (set.node != plot || state.plan->nodes[plot].types[set.type].definition->id != type_of<PlotFigures>()) continue;
    for (const std::uint32_t member : set.members)
      if (auto volume = volume_on(state, member, figures)) volumes.push_back(std::move(*volume));
    break;  // the other sets of a plot hold the same volumes
  }
  std::vector<geometry::HeightBase> grounds;
  for (const VolumeThere& volume : volumes) grounds.push_back({volume.id, volume.figures.stands_on, volume.ground});
  const std::vector<double> bases = geometry::height_bases(grounds, figures.ground);
  for (std::size_t i = 0; i < volumes.size(); ++i) volumes[i].base = bases[i];
  return volumes;
}

template <class Amount>
std::vector<Breaker> breakers(const std::vector<VolumeThere>& volumes, const Amount& amount) {
  std::vector<Breaker> all;
  for (const VolumeThere& volume : volumes)
    if (const double part = amount(volume); part > 0) all.push_back({volume.id, part});
  std::stable_sort(all.begin(), all.end(), [](const Breaker& a, const Breaker& b) { return a.amount > b.amount; });
  return all;
}

// "`a` (1 200 m²), `b` (800 m²) and 3 more".
std::string listed_breakers(const std::vector<Breaker>& all, Unit unit) {
  std::string text;
  for (std::size_t k = 0; k < std::min(kNamedBreakers, all.size()); ++k)
    text += (k == 0 ? "`" : k + 1 == all.size() ? " and `" : ", `") + all[k].id + "` (" + quantity(all[k].amount, unit) + ")";
  return all.size() > kNamedBreakers ? text + " and " + std::to_string(all.size() - kNamedBreakers) + " more" : text;
}

// Does a link of the kind `plot_rules` have this rule switched on? A kind that cannot hold it has no such parameter.
bool has_switched_on(const LinkPlan& link, const std::string& port) {
  const std::string name = "hold_" + port.substr(0, port.find('_'));
  const PortDefinition* parameter = link.definition->find_port(name);
  return parameter != nullptr && as_number(parameter->get(link.parameters.get())) != 0;
}

std::string quoted_ids(const std::vector<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) text += (text.empty() ? "`" : ", `") + id + "`";
  return text;
}

// What the holding links say themselves: that they work on it, or that they cannot.
std::string word_of(const State& state, std::size_t link) {
  const LinkState& now = state.links[link];
  if (state.plan->links[link].error || now.has_failed()) return ", and does not run";
  if (now.remark == LinkRemark::unmet) return ", and cannot meet it: its own sentence says why";
  if (now.remark == LinkRemark::at_work || now.work) return ", and is still at work";
  return "";
}

// Who holds the rule, as the end of the sentence; what to do where nobody does.
void find_holders(const State& state, BrokenRule& rule) {
  std::vector<std::string> off, idle;
  std::string holding;
  std::vector<std::uint32_t> reached;
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (link.definition == nullptr || !is_a<PlotRuleParameters>(*link.definition) ||
        !std::binary_search(link.nodes[0].begin(), link.nodes[0].end(), rule.plot))
      continue;
    if (!has_switched_on(link, rule.port)) {
      off.push_back(link.id);
    } else if (!link.is_enabled || link.is_muted) {
      idle.push_back(link.id);
    } else {
      rule.links.push_back(link.id);
      holding += "; link `" + link.id + "` holds it" + word_of(state, l);
      reached.insert(reached.end(), link.nodes[1].begin(), link.nodes[1].end());
    }
  }
  std::vector<std::string> missed;
  for (const std::string& id : rule.volumes)
    if (std::find(reached.begin(), reached.end(), state.plan->node_index(id)) == reached.end()) missed.push_back(id);
  if (!rule.links.empty()) {
    rule.text += holding;
    if (!missed.empty()) rule.text += "; it does not lead to " + quoted_ids(missed) + ": add what is missing to its end";
  } else if (!idle.empty()) {
    rule.text += "; nothing holds it, because link " + quoted_ids(idle) + " is switched off or muted";
  } else if (!off.empty()) {
    rule.text += "; nothing holds it, because link " + quoted_ids(off) + " has `hold_" +
                 rule.port.substr(0, rule.port.find('_')) + "` switched off";
  } else {
    rule.text +=
        "; nothing holds it: lay a link of the kind `plot_rules` from `" + state.plan->nodes[rule.plot].id + "` to the volumes";
  }
}

class Rules {
 public:
  Rules(const State& state, std::uint32_t plot, const PlotFigures& figures, std::vector<BrokenRule>& all)
      : state_(state), plot_(plot), figures_(figures), all_(all), volumes_(volumes_on(state, plot, figures)) {}

  void compare() {
    at_most("fsi_max", "FSI ", figures_.fsi, figures_.fsi_max, 2, "",
            breakers(volumes_, [](const VolumeThere& v) { return v.figures.floor_area; }), Unit::square_metre);
    at_most("gsi_max", "GSI ", figures_.gsi, figures_.gsi_max, 2, "",
            breakers(volumes_, [&](const VolumeThere& v) { return built_ground(v); }), Unit::square_metre);
    if (figures_.top >= figures_.height_max + kLeastLength)
      at_most("height_max", "a height of ", figures_.top, figures_.height_max, 1, " m",
              breakers(volumes_, [&](const VolumeThere& v) { return top(v) >= figures_.height_max + kLeastLength ? top(v) : 0; }),
              Unit::metre);
    if (figures_.setback_overshoot < kLeastLength) return;
    const double found = figures_.setback - figures_.setback_overshoot;
    add("setback",
        found < 0 ? "built " + fixed(-found, 2) + " m beyond the side of the plot, where a set-back of " +
                        fixed(figures_.setback, 2) + " m is asked for"
                  : "a set-back of " + demand::found_of_allowed(found, figures_.setback, 2, " m") + " asked for",
        found, figures_.setback, breakers(volumes_, [this](const VolumeThere& v) { return lack_of_setback(v); }), Unit::metre);
    const bool has_balls = std::any_of(volumes_.begin(), volumes_.end(),
                                       [this](const VolumeThere& v) { return !v.is_standing && lack_of_setback(v) > 0; });
    if (has_balls) all_.back().text += "; balls keep no set-back by a link: move them inwards, or lower `setback`";
  }

 private:
  static double top(const VolumeThere& volume) { return volume.figures.bottom + volume.figures.height - volume.base; }
  double lack_of_setback(const VolumeThere& volume) const {
    const double lack = figures_.setback - volume.clearance;
    return lack < kLeastLength ? 0 : lack;
  }
  double built_ground(const VolumeThere& volume) const {
    const PlotVolume& v = volume.figures;
    return v.footprint * geometry::built_share(volume.is_standing, v.stands_on, v.bottom, v.storey_height, figures_.ground);
  }

  void at_most(const char* port, const std::string& what, double found, double allowed, int decimals, const char* unit,
               const std::vector<Breaker>& by, Unit amounts) {
    if (found > allowed * (1 + kRuleRounding))
      add(port, what + demand::found_of_allowed(found, allowed, decimals, unit) + " allowed", found, allowed, by, amounts);
  }

  void add(const char* port, const std::string& what, double found, double allowed, const std::vector<Breaker>& by,
           Unit amounts) {
    BrokenRule rule{plot_, port, found, allowed, {}, {}, what};
    for (const Breaker& one : by) rule.volumes.push_back(one.id);
    if (!by.empty()) rule.text += ", by " + listed_breakers(by, amounts);
    find_holders(state_, rule);
    all_.push_back(std::move(rule));
  }

  const State& state_;
  std::uint32_t plot_;
  const PlotFigures& figures_;
  std::vector<BrokenRule>& all_;
  std::vector<VolumeThere> volumes_;
};

}  // namespace

std::vector<BrokenRule> broken_rules(const State& state) {
  std::vector<BrokenRule> all;
  for (const auto& [node, figures] : rows<PlotFigures>(state))
    // Mostly all is kept, and nobody has to be looked for.
    if (figures.overshoot > 0 || figures.setback_overshoot > 0) Rules(state, node, figures, all).compare();
  return all;
}

}  // namespace bl::reading
