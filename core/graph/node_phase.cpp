// Phases 5 and 7: typifications, and the commit.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/sorted_runs.h"
#include "core/graph/phases.h"

namespace bl {

namespace {

bool same_inputs(const TypificationDefinition& definition, const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t p = 0; p < definition.ports.size(); ++p)
    if (!definition.ports[p].is_computed && a[p] != b[p]) return false;
  return true;
}

}  // namespace

bool keeps_memory(const TypificationDefinition& definition) {
  return std::any_of(definition.ports.begin(), definition.ports.end(), [](const PortDefinition& port) { return !!port.recall; });
}

bool is_only_now(const TypificationDefinition& definition) { return !definition.reads_time && !keeps_memory(definition); }

std::int64_t tick_for(const TypeDefinition& definition, std::int64_t tick) {
  return definition.reads_time ? tick : Tick::kUnknown;
}

std::string place_of(const Plan& plan, std::size_t n, std::size_t t) {
  return "nodes/" + plan.nodes[n].id + "/" + plan.nodes[n].types[t].definition->id;
}

void accept_values(const TypificationDefinition& definition, TypeState& state, std::vector<Value>&& values, Result<void> done,
                   const std::string& place) {
  for (std::size_t p = 0; done && p < values.size(); ++p)
    if (definition.ports[p].is_computed && !make_storable(values[p]))
      done = Error{ErrorCode::not_finite, definition.ports[p].id,
                   "was computed as a number that is not finite; the last good values are kept"};
  if (!done) {
    state.error = done.error().within(place);
    state.is_evaluated = false;
    return;
  }
  make_objects(definition, values, state.values);
  state.error.reset();
  state.values = std::move(values);
  state.is_evaluated = true;
}

namespace {

struct Answered {
  std::size_t typifications = 0;
  double seconds = 0;  // where somebody measures
};

// Asks the typifications of a node that are without sets and for which `is_due` holds, by their definition and number.
template <class IsDue>
Answered ask_node(const Plan& plan, std::uint32_t n, std::int64_t tick, NodeState& node, TickTimes* times, const IsDue& is_due) {
  Answered answered;
  for (std::size_t t = 0; t < node.types.size(); ++t) {
    const TypificationDefinition& definition = *plan.nodes[n].types[t].definition;
    if (!definition.evaluate || !definition.sets.empty() || !is_due(definition, t)) continue;
    const double began = moment_of(times);
    std::vector<Value> values = node.types[t].values;
    auto done = definition.evaluate(values, {}, Tick{.index = tick_for(definition, tick)});
    accept_values(definition, node.types[t], std::move(values), std::move(done), place_of(plan, n, t));
    ++answered.typifications;
    if (times != nullptr) answered.seconds += times->add_role(n, t, began, 1);
  }
  return answered;
}

// Whom links say something else to, who is on the way, who remembers; and everybody who is spoken to when rest begins or ends.
std::vector<std::uint32_t> due_nodes(const TickWork& work, const RestLimits& rest) {
  const State& frozen = work.frozen;
  std::vector<std::uint32_t> nodes;
  if (frozen.due.is_everything) {
    nodes.resize(frozen.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0u);
    return nodes;
  }
  for (const auto* some : {&work.spoken_to, &frozen.due.nodes, &frozen.plan->dependents->sets->timed_nodes})
    nodes.insert(nodes.end(), some->begin(), some->end());
  if (rest.is_on != frozen.due.was_at_rest)
    for (std::size_t l = 0; l < work.next.links.size(); ++l)
      for (const Voice& voice : work.next.links[l].voices) nodes.push_back(voice.target.node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

bool is_same(const TypeState& a, const TypeState& b) {
  return a.is_evaluated == b.is_evaluated && a.error == b.error && a.tension == b.tension && a.values == b.values;
}

// Is anything different that typifications without sets read of themselves?
bool remembers_more(const NodePlan& plan, const NodeState& before, const NodeState& after) {
  for (std::size_t t = 0; t < after.types.size(); ++t) {
    const TypificationDefinition& definition = *plan.types[t].definition;
    for (std::size_t p = 0; definition.sets.empty() && p < definition.ports.size(); ++p)
      if (definition.ports[p].recall && !(before.types[t].values[p] == after.types[t].values[p])) return true;
  }
  return false;
}

bool is_same(const NodeState& a, const NodeState& b) {
  return std::equal(a.types.begin(), a.types.end(), b.types.begin(), b.types.end(),
                    [](const TypeState& x, const TypeState& y) { return is_same(x, y); });
}

// Nothing changes any more by a thousandth of what counts as calm.
bool stands_still(const State& state) {
  constexpr double kStandstill = 1e-3;
  const Settings& settings = state.plan->settings;
  return state.largest_residual <= settings.tolerance && state.largest_move <= kStandstill * settings.move_limit &&
         state.largest_change <= kStandstill * settings.change_limit;
}

// The same link, which says that its rule cannot be met.
LinkState stuck(const LinkState& link) {
  LinkState told = link;
  told.error = link.work;
  told.error->message = "cannot be met: " + told.error->message +
                        ", and nothing changes any more; loosen the rule, or let go what holds it up: a lock, another link, or "
                        "a `gain` of 0";
  told.remark = LinkRemark::unmet;
  told.is_stuck = true;
  return told;
}

// The same link where something changes again: it works on.
LinkState at_work_again(const LinkState& link) {
  LinkState told = link;
  told.error.reset();
  told.remark.reset();
  told.is_stuck = false;
  return told;
}

// Calls visit(l) for the links of all leaves whose digest `may_have` it.
template <class MayHave, class Visit>
void visit_links(const State& state, const MayHave& may_have, const Visit& visit) {
  for (std::size_t leaf = 0; leaf < state.links.leaf_count(); ++leaf)
    for (std::size_t l = leaf * LinkStates::kLeaf;
         may_have(state.links.digest(leaf)) && l < std::min(state.links.size(), (leaf + 1) * LinkStates::kLeaf); ++l)
      visit(static_cast<std::uint32_t>(l));
}

// Whoever is bringing a rule about while nothing changes does so in vain. Links that nobody asks in this tick say what they would
// say if they were asked: so a scene whose rules cannot be kept rests as well, and costs nothing.
void judge_work(State& state, bool stands_still) {
  std::vector<std::pair<std::uint32_t, LinkState>> told;
  if (stands_still)
    visit_links(
        state, [](const LinkDigest& digest) { return digest.is_at_work; },
        [&](std::uint32_t l) {
          if (is_at_work(state, l)) told.emplace_back(l, stuck(state.links[l]));
        });
  else
    visit_links(
        state, [](const LinkDigest& digest) { return digest.is_stuck; },
        [&](std::uint32_t l) {
          if (state.links[l].is_stuck) told.emplace_back(l, at_work_again(state.links[l]));
        });
  if (told.empty()) return;
  StateDraft draft(state);
  for (auto& [l, link] : told) draft.links.put(l, std::move(link));
  state = std::move(draft).publish();
}

// Ports that differ from the state before. Whether a typification fails is read with what it computes.
void add_changes(std::uint32_t n, const NodeState& before, const NodeState& after, const NodePlan& plan,
                 std::vector<PortRef>& changed) {
  for (std::uint16_t t = 0; t < after.types.size(); ++t) {
    const bool has_turned = before.types[t].error.has_value() != after.types[t].error.has_value();
    for (std::uint16_t p = 0; p < after.types[t].values.size(); ++p)
      if ((has_turned && plan.types[t].definition->ports[p].is_computed) ||
          !(before.types[t].values[p] == after.types[t].values[p]))
        changed.push_back({n, t, p});
  }
}

}  // namespace

void evaluate_nodes(TickWork& work, ThreadPool& pool) {
  const State& frozen = work.frozen;
  const Plan& plan = *frozen.plan;
  const RestLimits rest = rest_limits_of(frozen);
  const std::vector<std::uint32_t> due = due_nodes(work, rest);
  struct Asked {
    NodeState node;
    NodeChange change;
    Answered answered;
    double seconds = 0;  // where somebody measures
    bool differs = false;
    bool remembers_more = false;  // the same settings may give something else in the next tick
  };
  std::vector<Asked> asked(due.size());
  pool.for_each_chunk(due.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double began = moment_of(work.times);
      const NodeState& before = frozen.nodes[due[i]];
      NodeState& node = asked[i].node = before;
      asked[i].change = resolve_node(frozen, due[i], rest, voices_at(work.next, due[i]), node);
      const auto is_due = [&](const TypificationDefinition& definition, std::size_t t) {
        return work.asks_all || !node.types[t].is_evaluated || !is_only_now(definition) ||
               !same_inputs(definition, node.types[t].values, before.types[t].values);
      };
      asked[i].answered = ask_node(plan, due[i], work.next.state.tick, node, work.times, is_due);
      asked[i].differs = !is_same(node, before);
      asked[i].remembers_more = asked[i].differs && remembers_more(plan.nodes[due[i]], before, node);
      asked[i].seconds = moment_of(work.times) - began;
    }
  });
  State& next = work.next.state;
  next.due.was_at_rest = rest.is_on;
  next.largest_move = next.largest_change = 0;
  work.counts.nodes += due.size();
  double seconds = 0, in_roles = 0;
  for (std::size_t i = 0; i < due.size(); ++i) {
    const NodeChange& change = asked[i].change;
    work.counts.typifications += asked[i].answered.typifications;
    seconds += asked[i].seconds;
    in_roles += asked[i].answered.seconds;
    if (change.is_on_its_way || !change.unsound.empty() || asked[i].remembers_more) next.due.nodes.push_back(due[i]);
    next.largest_move = std::max(next.largest_move, change.move);
    for (const PortRef port : change.unsound) report_overflow(work, port);
    if (change.change > next.largest_change) {
      next.largest_change = change.change;
      next.restless = change.restless;
    }
    if (!asked[i].differs) continue;
    add_changes(due[i], frozen.nodes[due[i]], asked[i].node, plan.nodes[due[i]], work.moved);
    work.next.nodes.put(due[i], std::move(asked[i].node));
  }
  if (work.times != nullptr) work.times->split_nodes(seconds, in_roles);
}

bool evaluate_unasked(StateDraft& draft) {
  bool has_any = false;
  for (std::uint32_t n = 0; n < draft.nodes.size(); ++n) {
    const auto is_due = [&](const TypificationDefinition& definition, std::size_t t) {
      // For the others a tick would pass by being asked.
      return !draft.nodes[n].types[t].is_evaluated && is_only_now(definition);
    };
    NodeState node = draft.nodes[n];
    if (ask_node(*draft.state.plan, n, draft.state.tick, node, nullptr, is_due).typifications == 0) continue;
    has_any = true;
    draft.nodes.put(n, std::move(node));
  }
  return has_any;
}

State commit(TickWork&& work) {
  const std::vector<std::uint32_t> own_nodes = work.next.nodes.own_items();
  State next = std::move(work.next).publish();
  const State& frozen = work.frozen;
  const Settings& settings = next.plan->settings;
  next.largest_residual = largest_residual_of(next);
  judge_work(next, stands_still(next));
  // Whoever rests needs more to be woken than to come to rest: volumes that follow by steps of their tolerance are no news, nor
  // is what links answer to these.
  const bool rests = is_at_rest(next);
  const double change_limit = rests ? std::max(settings.change_limit, settings.tolerance) : settings.change_limit;
  const double move_limit = rests ? kWakingPush * settings.move_limit : settings.move_limit;
  const bool is_calm = !has_failure(next) && (rests || !first_work(next)) && next.largest_residual <= settings.tolerance &&
                       next.largest_move <= move_limit && next.largest_change <= change_limit;
  next.calm = is_calm ? next.calm + 1 : 0;
  for (const std::uint32_t n : own_nodes) add_changes(n, frozen.nodes[n], next.nodes[n], next.plan->nodes[n], next.due.changed);
  for (const PortRef& ref : next.due.changed)
    if (const auto* point = std::get_if<Point3>(&frozen.value(ref))) next.due.were.push_back({ref, *point});
  sort_runs(next.due.replied);
  std::sort(next.due.links.begin(), next.due.links.end());
  next.hash = hash_of(next);
  return next;
}

}  // namespace bl
