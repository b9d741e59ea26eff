// Streets and junctions of the chosen node's traffic network as ways.
#include "ui/desktop/view/isochrones.h"

#include <algorithm>

#include "core/reading/views/node.h"
#include "core/reading/views/traffic.h"
#include "core/traffic/street_reach.h"
#include "ui/desktop/view/urban_facts.h"

namespace bl::desktop {

namespace {

using reading::JunctionPlace;
using reading::NetworkFigures;
using reading::NodePlace;
using reading::StreetFigures;
using reading::ZoneFigures;

std::vector<std::uint32_t> members_of(const Plan& plan, std::uint32_t network, const std::string& selection) {
  for (const SetPlan& set : plan.sets) {
    const TypificationDefinition& definition = *plan.nodes[set.node].types[set.type].definition;
    const bool is_asked = definition.id + "." + definition.sets[set.set].selection == selection;
    if (set.node == network && is_asked) return set.members;
  }
  return {};
}

std::string end_of(const Selection& chosen) { return chosen.ids.size() == 1 ? chosen.ids.front() : ""; }

// The rules are those of the network: one drives where it has a time for it, and walks both ways along all streets that are open.
traffic::ReachStreet way_along(const std::string& id, const reading::StreetFigures& street, bool by_car, double walking_speed) {
  traffic::ReachStreet way{id, end_of(street.start), end_of(street.end)};
  const bool may_drive = street.reason.empty();
  if (by_car && may_drive) {
    way.forth = street.time_forth;
    if (!street.one_way) way.back = street.time_back;
  }
  const bool is_open = street.lanes * street.capacity_per_lane * street.open > 0;
  if (!by_car && is_open && street.used_length > 0) way.forth = way.back = street.used_length / walking_speed;
  return way;
}

// Turns are forbidden to cars alone.
std::vector<traffic::DistrictRules> rules_of(const State& state, const std::vector<std::uint32_t>& junctions) {
  std::vector<traffic::DistrictRules> all;
  for (const std::uint32_t junction : junctions) {
    if (!reading::is_a<reading::TurnRules>(state, junction)) continue;
    const Shared<Table> turns = reading::read<&reading::TurnRules::turns>(state, junction);
    traffic::DistrictRules& rules = all.emplace_back(traffic::DistrictRules{state.plan->nodes[junction].id, {}});
    for (std::size_t row = 0; row < turns->rows.size(); ++row)
      rules.turns.push_back({turns->text(row, "from"), turns->text(row, "to"), turns->text(row, "rule")});
  }
  return all;
}

std::vector<traffic::ReachEntry> entries_of(const State& state, std::uint32_t node, double walking_speed) {
  const std::string& own = state.plan->nodes[node].id;
  const std::vector<std::string> access = reading::read<&reading::ZoneFigures::access>(state, node);
  if (access.empty())
    return reading::is_a<reading::JunctionPlace>(state, node) ? std::vector<traffic::ReachEntry>{{own, 0}}
                                                              : std::vector<traffic::ReachEntry>{};
  std::vector<traffic::ReachEntry> entries;
  const Point3 from = reading::read<&reading::NodePlace::position>(state, node);
  for (const std::string& id : access)
    if (const std::uint32_t junction = state.plan->node_index(id); junction < state.plan->nodes.size())
      entries.push_back({id, distance(from, reading::read<&reading::NodePlace::position>(state, junction)) / walking_speed});
  return entries;
}

std::string doubt_of(const State& state, std::uint32_t node, const reading::NetworkFigures& network, bool by_car) {
  const auto& types = state.plan->nodes[node].types;
  for (std::size_t t = 0; t < types.size(); ++t)
    if (reading::is_a<reading::NetworkFigures>(*types[t].definition) && state.nodes[node].types[t].error)
      return "tentative: the traffic network fails, these are its last good times";
  return by_car && network.relative_gap > network.gap ? "tentative: flows still change" : "";
}

}  // namespace

std::shared_ptr<const Isochrones> isochrones_of(const State& state, std::uint32_t node, bool by_car) {
  const Plan& plan = *state.plan;
  if (node >= plan.nodes.size()) return nullptr;
  const std::uint32_t network = keeper_of(plan, node, reading::type_of<reading::NetworkFigures>());
  const bool can_begin = reading::is_a<reading::ZoneFigures>(state, node) || reading::is_a<reading::JunctionPlace>(state, node);
  const auto figures = reading::row_of<reading::NetworkFigures>(state, network);
  if (!can_begin || !figures) return nullptr;
  auto found = std::make_shared<Isochrones>();
  found->node = node;
  found->is_by_car = by_car;
  found->walking_speed = figures->walking_speed;
  for (int k = 1; k <= figures->isochrone_bands; ++k) found->times.push_back(k * figures->isochrone_step);
  found->tentative = doubt_of(state, network, *figures, by_car);
  const std::vector<std::uint32_t> streets = members_of(plan, network, reading::path_of<&reading::NetworkFigures::streets>());
  std::vector<traffic::ReachStreet> ways;
  for (const std::uint32_t street : streets)
    ways.push_back(way_along(plan.nodes[street].id,
                             reading::row_of<reading::StreetFigures>(state, street).value_or(reading::StreetFigures{}), by_car,
                             found->walking_speed));
  const std::vector<traffic::ReachEntry> entries = entries_of(state, node, found->walking_speed);
  const auto parts =
      reached_parts(ways, entries, found->times,
                    by_car ? rules_of(state, members_of(plan, network, reading::path_of<&reading::NetworkFigures::junctions>()))
                           : std::vector<traffic::DistrictRules>{});
  if (!parts) found->reason = "`" + parts.error().place + "`: " + parts.error().message;
  else
    for (const traffic::ReachedPart& part : *parts)
      found->parts.push_back({streets[part.street], part.begin, part.end, part.band});
  if (!found->parts.empty() || !found->reason.empty()) return found;
  if (state.tick == 0) found->reason = "nothing has run yet";
  else
    found->reason =
        entries.empty() ? reading::read<&reading::ZoneFigures::reason>(state, node) : "no street is reached in that time";
  if (found->reason.empty()) found->reason = "it has no access to a street";
  return found;
}

}  // namespace bl::desktop
