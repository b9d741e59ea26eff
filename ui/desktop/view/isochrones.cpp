// Streets and junctions of the chosen node's traffic network as ways, by the names of their ports.
#include "ui/desktop/view/isochrones.h"

#include <algorithm>

#include "core/reading/report_model.h"
#include "core/traffic/street_reach.h"
#include "ui/desktop/view/urban_facts.h"

namespace bl::desktop {

namespace {

constexpr const char *kNetwork = "traffic_network", *kStreet = "street", *kZone = "traffic_zone";

std::vector<std::uint32_t> members_of(const Plan& plan, std::uint32_t network, std::string_view selection) {
  for (const SetPlan& set : plan.sets) {
    const TypificationDefinition& definition = *plan.nodes[set.node].types[set.type].definition;
    if (set.node == network && definition.id == kNetwork && definition.sets[set.set].selection == selection) return set.members;
  }
  return {};
}

template <class Content>
const Content* shared_at(const State& state, std::uint32_t node, const char* type, const char* port) {
  const auto ref = state.plan->find(node, PortPath{type, port, ""});
  const auto* value = ref ? std::get_if<Shared<Content>>(&state.value(*ref)) : nullptr;
  return value == nullptr ? nullptr : &**value;
}

bool flag_at(const State& state, std::uint32_t node, const char* port) {
  const auto ref = state.plan->find(node, PortPath{kStreet, port, ""});
  const bool* flag = ref ? std::get_if<bool>(&state.value(*ref)) : nullptr;
  return flag != nullptr && *flag;
}

std::string end_of(const State& state, std::uint32_t street, const char* port) {
  const Selection* chosen = shared_at<Selection>(state, street, kStreet, port);
  return chosen != nullptr && chosen->ids.size() == 1 ? chosen->ids.front() : "";
}

// The rules are those of the network: one drives where it has a time for it, and walks both ways along all streets that are open.
ReachStreet way_along(const State& state, std::uint32_t street, bool by_car, double walking_speed) {
  const auto number = [&](const char* port) { return report::number_at(state, street, kStreet, port); };
  ReachStreet way{state.plan->nodes[street].id, end_of(state, street, "start"), end_of(state, street, "end")};
  const bool may_drive = report::text_at(state, street, kStreet, "reason").empty();
  if (by_car && may_drive) {
    way.forth = number("time_forth");
    if (!flag_at(state, street, "one_way")) way.back = number("time_back");
  }
  const bool is_open = number("lanes") * number("capacity_per_lane") * number("open") > 0;
  if (!by_car && is_open && number("used_length") > 0) way.forth = way.back = number("used_length") / walking_speed;
  return way;
}

// Turns are forbidden to cars alone.
std::vector<DistrictRules> rules_of(const State& state, const std::vector<std::uint32_t>& junctions) {
  std::vector<DistrictRules> all;
  for (const std::uint32_t junction : junctions) {
    const Table* turns = report::table_at(state, junction, "turn_rules", "turns");
    if (turns == nullptr) continue;
    DistrictRules& rules = all.emplace_back(DistrictRules{state.plan->nodes[junction].id, {}});
    for (std::size_t row = 0; row < turns->rows.size(); ++row)
      rules.turns.push_back({turns->text(row, "from"), turns->text(row, "to"), turns->text(row, "rule")});
  }
  return all;
}

std::vector<ReachEntry> entries_of(const State& state, std::uint32_t node, double walking_speed) {
  const std::string& own = state.plan->nodes[node].id;
  const auto* access = shared_at<std::vector<std::string>>(state, node, kZone, "access");
  if (access == nullptr || access->empty())
    return report::has_type(state, node, "junction") ? std::vector<ReachEntry>{{own, 0}} : std::vector<ReachEntry>{};
  std::vector<ReachEntry> entries;
  const Point3 from = report::point_at(state, node, "node", "position");
  for (const std::string& id : *access)
    if (const std::uint32_t junction = state.plan->node_index(id); junction < state.plan->nodes.size())
      entries.push_back({id, distance(from, report::point_at(state, junction, "node", "position")) / walking_speed});
  return entries;
}

std::string doubt_of(const State& state, std::uint32_t network, bool by_car) {
  const auto& types = state.plan->nodes[network].types;
  for (std::size_t t = 0; t < types.size(); ++t)
    if (types[t].definition->id == kNetwork && state.nodes[network].types[t].error)
      return "tentative: the traffic network fails, these are its last good times";
  const auto number = [&](const char* port) { return report::number_at(state, network, kNetwork, port); };
  const bool is_moving = number("relative_gap") > number("gap");
  return by_car && is_moving ? "tentative: flows still move" : "";
}

}  // namespace

std::shared_ptr<const Isochrones> isochrones_of(const State& state, std::uint32_t node, bool by_car) {
  const Plan& plan = *state.plan;
  if (node >= plan.nodes.size()) return nullptr;
  const std::uint32_t network = keeper_of(plan, node, kNetwork);
  const bool can_begin = report::has_type(state, node, kZone) || report::has_type(state, node, "junction");
  if (!can_begin || network >= plan.nodes.size()) return nullptr;
  auto found = std::make_shared<Isochrones>();
  found->node = node;
  found->is_by_car = by_car;
  found->walking_speed = report::number_at(state, network, kNetwork, "walking_speed");
  const double step = report::number_at(state, network, kNetwork, "isochrone_step");
  const auto bands = static_cast<int>(report::number_at(state, network, kNetwork, "isochrone_bands"));
  for (int k = 1; k <= bands; ++k) found->times.push_back(k * step);
  found->tentative = doubt_of(state, network, by_car);
  const std::vector<std::uint32_t> streets = members_of(plan, network, "streets");
  std::vector<ReachStreet> ways;
  for (const std::uint32_t street : streets) ways.push_back(way_along(state, street, by_car, found->walking_speed));
  const std::vector<ReachEntry> entries = entries_of(state, node, found->walking_speed);
  const auto parts =
      reached_parts(ways, entries, found->times,
                    by_car ? rules_of(state, members_of(plan, network, "junctions")) : std::vector<DistrictRules>{});
  if (!parts) found->reason = "`" + parts.error().place + "`: " + parts.error().message;
  else
    for (const ReachedPart& part : *parts) found->parts.push_back({streets[part.street], part.begin, part.end, part.band});
  if (!found->parts.empty() || !found->reason.empty()) return found;
  if (state.tick == 0) found->reason = "nothing has run yet";
  else found->reason = entries.empty() ? report::text_at(state, node, kZone, "reason") : "no street is reached in that time";
  if (found->reason.empty()) found->reason = "it has no access to a street";
  return found;
}

}  // namespace bl::desktop
