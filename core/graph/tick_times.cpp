// Adds times up, and hands them on from plan to plan.
#include "core/graph/tick_times.h"

#include <algorithm>

namespace bl {

namespace {

// By how much a recent sum has faded after so many ticks; later than that nothing of it is left that could be seen.
constexpr std::size_t kFadedTicks = 256;
constexpr auto kFading = [] {
  std::array<double, kFadedTicks> factors{};
  double factor = 1;
  for (double& one : factors) {
    one = factor;
    factor *= 0.95;
  }
  return factors;
}();

// What a role of a node in the plan has in the plan before, or nothing.
const WorkTime* time_before(const TimeTable& before, const std::string& node, const TypificationDefinition& definition) {
  if (!before.plan) return nullptr;
  const std::uint32_t n = before.plan->node_index(node);
  if (n == before.plan->nodes.size()) return nullptr;
  const std::vector<TypePlan>& types = before.plan->nodes[n].types;
  const auto type =
      std::find_if(types.begin(), types.end(), [&](const TypePlan& t) { return t.definition->id == definition.id; });
  if (type == types.end()) return nullptr;
  return &before.roles[before.type_index(n, static_cast<std::size_t>(type - types.begin()))];
}

std::vector<WorkTime> roles_of(const Plan& plan, const TimeTable& before) {
  std::vector<WorkTime> roles;
  for (const NodePlan& node : plan.nodes)
    for (const TypePlan& type : node.types) {
      const WorkTime* same = time_before(before, node.id, *type.definition);
      roles.push_back(same == nullptr ? WorkTime{} : *same);
    }
  return roles;
}

const std::string& kind_of(const LinkPlan& link) {
  static const std::string unknown;
  return link.definition == nullptr ? unknown : link.definition->id;
}

std::vector<WorkTime> links_of(const Plan& plan, const TimeTable& before) {
  std::vector<WorkTime> links(plan.links.size());
  if (!before.plan) return links;
  for (std::size_t l = 0, b = 0; l < links.size(); ++l) {
    const LinkPlan& link = plan.links[l];
    while (b < before.links.size() && before.plan->links[b].id < link.id) ++b;
    if (b == before.links.size()) break;
    if (before.plan->links[b].id == link.id && kind_of(before.plan->links[b]) == kind_of(link)) links[l] = before.links[b];
  }
  return links;
}

}  // namespace

void WorkTime::fade(std::int64_t now) {
  if (now == tick) return;
  const auto passed = static_cast<std::size_t>(now - tick);
  const double factor = passed < kFadedTicks ? kFading[passed] : 0;
  recent_evaluations *= factor;
  recent_pairs *= factor;
  recent_seconds *= factor;
  tick = now;
}

void WorkTime::add(std::int64_t now, double more_seconds, std::size_t more_evaluations, std::size_t more_pairs) {
  fade(now);
  evaluations += more_evaluations;
  pairs += more_pairs;
  seconds += more_seconds;
  recent_evaluations += static_cast<double>(more_evaluations);
  recent_pairs += static_cast<double>(more_pairs);
  recent_seconds += more_seconds;
}

// Plans with the same nodes, links and roles as the one before share its dependents.
void TickTimes::follow(const std::shared_ptr<const Plan>& plan) {
  if (table_.plan == plan) return;
  if (!table_.plan || table_.plan->dependents != plan->dependents) {
    std::vector<WorkTime> beside;
    std::vector<std::shared_ptr<BesideTime>> clocks;
    for (const AnalysisPlan& analysis : plan->analyses) {
      const NodePlan& node = plan->nodes[analysis.node];
      const std::string& type = node.types[analysis.type].definition->id;
      beside.emplace_back();
      clocks.push_back(std::make_shared<BesideTime>(now_));
      for (std::size_t b = 0; b < clocks_.size(); ++b) {
        const AnalysisPlan& old = table_.plan->analyses[b];
        const NodePlan& old_node = table_.plan->nodes[old.node];
        if (old_node.id != node.id || old_node.types[old.type].definition->id != type) continue;
        beside.back() = table_.beside[b];
        clocks.back() = clocks_[b];
      }
    }
    std::vector<WorkTime> roles = roles_of(*plan, table_), links = links_of(*plan, table_);
    table_.roles = std::move(roles);
    table_.links = std::move(links);
    table_.beside = std::move(beside);
    clocks_ = std::move(clocks);
  }
  table_.plan = plan;
}

void TickTimes::begin_tick(const std::shared_ptr<const Plan>& plan) {
  follow(plan);
  ++tick_;
  share_of_roles_ = 0;
  began_ = last_ = now();
}

void TickTimes::end_part(TickPart part) {
  const double time = now(), seconds = time - last_;
  last_ = time;
  const auto add = [&](TickPart which, double some) { table_.parts[static_cast<std::size_t>(which)].add(tick_, some, 1, 0); };
  if (part != TickPart::roles) return add(part, seconds);
  add(TickPart::ports, seconds * (1 - share_of_roles_));
  add(TickPart::roles, seconds * share_of_roles_);
}

void TickTimes::add_commands(double began) { commands_ += now() - began; }

void TickTimes::end_tick() {
  table_.parts[static_cast<std::size_t>(TickPart::commands)].add(tick_, commands_, 1, 0);
  table_.ticks.add(tick_, now() - began_ + commands_, 1, 0);
  commands_ = 0;
  for (std::size_t a = 0; a < clocks_.size(); ++a)
    table_.beside[a].add(tick_, clocks_[a]->seconds.exchange(0), clocks_[a]->runs.exchange(0), 0);
}

TimeTable TickTimes::table() const {
  TimeTable table = table_;
  table.ticks.fade(tick_);
  for (WorkTime& part : table.parts) part.fade(tick_);
  for (auto* times : {&table.links, &table.roles, &table.beside})
    for (WorkTime& time : *times) time.fade(tick_);
  return table;
}

}  // namespace bl
