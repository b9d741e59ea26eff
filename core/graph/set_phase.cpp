// Phase 6: solvers over sets of nodes, within the tick or beside it.
#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "core/graph/phases.h"
#include "core/graph/set_replies.h"
#include "core/graph/sums_of_now.h"

namespace bl {

namespace {

// One typification with all of its sets, and what it reads, gathered before any of them writes.
struct SetCase {
  const SetGroup* group = nullptr;
  std::span<const SetPlan> plans;
  std::vector<Value> values;
  std::vector<SetValues> own;  // of one that keeps nothing
  std::span<SetValues> sets;   // these, or those that are kept
  SetMemo* memo = nullptr;     // of one that keeps its sets

  std::uint32_t node() const { return group->node; }
  std::uint32_t type() const { return group->type; }
};

const TypificationDefinition& definition_of(const Plan& plan, const SetGroup& group) {
  return *plan.nodes[group.node].types[group.type].definition;
}

// Why the group cannot be evaluated, or nothing.
const Error* error_of(const Plan& plan, const SetGroup& group) {
  const auto sets = sets_of(plan, group);
  const auto broken = std::find_if(sets.begin(), sets.end(), [](const SetPlan& set) { return set.error.has_value(); });
  return broken == sets.end() ? nullptr : &*broken->error;
}

// Where the value `w` of those that set `s` has been given to write goes.
PortRef target_of(const SetCase& one, std::size_t s, std::size_t w) {
  const std::size_t count = one.plans[s].writes.size() / one.plans[s].members.size();
  return one.plans[s].writes[one.sets[s].member_of(w / count) * count + w % count];
}

SetCase begun(const StateDraft& draft, const SetGroup& group) {
  SetCase one;
  one.group = &group;
  one.plans = sets_of(*draft.state.plan, group);
  one.values = draft.nodes[group.node].types[group.type].values;
  return one;
}

SetCase gathered(const StateDraft& draft, const SetGroup& group) {
  SetCase one = begun(draft, group);
  for (const SetPlan& plan : one.plans) one.own.push_back(read_set(draft, plan));
  one.sets = one.own;
  return one;
}

// With what is kept of its sets. One of several that write to the same ports cannot know what has become of its replies.
SetCase gathered(const StateDraft& draft, const SetGroup& group, SetMemo& memo, bool is_anew) {
  SetCase one = begun(draft, group);
  one.memo = &memo;
  one.sets = memo.sets.read(draft, group, is_anew || group.rivals != SetGroup::kNone);
  return one;
}

// By group: is anything that it reads different from when it was asked last, or has somebody else written to what it writes?
std::vector<bool> due_groups(const TickWork& work) {
  const SetDependents& dependents = *work.frozen.plan->dependents->sets;
  std::vector<bool> is_due(dependents.groups.size(), work.frozen.due.is_everything);
  for (std::size_t g = 0; g < is_due.size(); ++g) is_due[g] = is_due[g] || dependents.groups[g].is_always_due;
  // Mostly the first few ports have asked all groups.
  auto left = std::count(is_due.begin(), is_due.end(), false);
  const auto add = [&](const NumberLists& groups, const std::vector<PortRef>& ports) {
    for (auto ref = ports.begin(); ref != ports.end() && left > 0; ++ref)
      for (const std::uint32_t group : groups[dependents.port_index(*ref)]) {
        left -= is_due[group] ? 0 : 1;
        is_due[group] = true;
      }
  };
  add(dependents.groups_reading, work.frozen.due.replied);
  add(dependents.groups_reading, work.moved);
  add(dependents.groups_writing, work.moved);
  std::vector<bool> is_contested(is_due.size());
  for (std::size_t g = 0; g < is_due.size(); ++g)
    if (is_due[g] && dependents.groups[g].rivals != SetGroup::kNone) is_contested[dependents.groups[g].rivals] = true;
  for (std::size_t g = 0; g < is_due.size(); ++g)
    if (dependents.groups[g].rivals != SetGroup::kNone) is_due[g] = is_due[g] || is_contested[dependents.groups[g].rivals];
  return is_due;
}

SetMemo& memo_of(SetMemos& memos, const Plan& plan, const SetGroup& group) {
  return memos[{plan.nodes[group.node].id, plan.nodes[group.node].types[group.type].definition->id}];
}

// Calls take(target, value) for each value that a set has been given to write and that can be stored; false where one cannot. To
// each member the values come in the order of its ports, where nobody else writes to these: what is written then ascends nearly.
template <class Take>
bool each_reply(SetCase& one, const Take& take) {
  bool is_complete = true;
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < one.sets.size(); ++s) {
    SetValues& set = one.sets[s];
    if (set.writes.empty()) continue;
    const std::vector<PortRef>& targets = one.plans[s].writes;
    const std::size_t count = targets.size() / one.plans[s].members.size(), rows = set.writes.size() / count;
    order.resize(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (one.group->writes_alone)
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return targets[a] < targets[b]; });
    for (std::size_t row = 0; row < rows; ++row)
      for (const std::size_t w : order) {
        std::optional<Value>& value = set.writes[row * count + w];
        if (!value) continue;
        if (make_storable(*value)) take(targets[set.member_of(row) * count + w], std::move(*value));
        else is_complete = false;
      }
  }
  return is_complete;
}

// Whether all that it replies can be written. What nobody else writes to is written at once.
bool evaluate_now(TickWork& work, SetCase& one, ThreadPool& pool, std::vector<Reply>& replies) {
  StateDraft& next = work.next;
  const Plan& plan = *next.state.plan;
  const TypificationDefinition& definition = definition_of(plan, *one.group);
  TypeState& state = next.edit(one.node(), one.type());
  const std::string place = place_of(plan, one.node(), one.type());
  const std::vector<Value> before = state.values;
  const Tick tick{.index = tick_for(definition, next.state.tick), .pool = &pool, .memo = &one.memo->own};
  auto done = definition.evaluate(one.values, one.sets, tick);
  const bool is_good = done.ok();
  accept_values(definition, state, std::move(one.values), std::move(done), place);
  for (std::uint16_t p = 0; p < before.size(); ++p)
    if (!(before[p] == state.values[p]))
      next.state.due.replied.push_back({one.node(), static_cast<std::uint16_t>(one.type()), p});
  if (!is_good) return false;
  ReplyWriter writer(next);
  const bool is_complete = each_reply(one, [&](PortRef target, Value&& value) {
    if (one.group->writes_alone) writer.write(target, std::move(value));
    else replies.push_back({.target = target, .value = std::move(value), .node = one.node(), .type = one.type()});
  });
  if (!is_complete)
    state.error =
        Error{ErrorCode::not_finite, place, "wrote a number that is not finite to a member; it keeps its last good value"};
  return is_complete;
}

// Results that came from nodes which have gone since are for nobody.
void take_result(StateDraft& next, const SetGroup& group, const AnalysisResult& result, std::vector<Reply>& replies) {
  const Plan& plan = *next.state.plan;
  TypeState& state = next.edit(group.node, group.type);
  // Whoever has left the sets since gets nothing any more.
  std::set<PortRef> members;
  for (const SetPlan& set : sets_of(plan, group)) members.insert(set.writes.begin(), set.writes.end());
  state.error.reset();
  if (result.error) state.error = result.error->within(place_of(plan, group.node, group.type));
  state.is_evaluated = !result.error;
  for (const AnalysisOutput& output : result.outputs) {
    const std::uint32_t node = plan.node_index(output.node);
    const auto path = parse_port_path(output.path);
    if (node == plan.nodes.size() || !path) continue;
    const auto ref = plan.find(node, *path);
    if (!ref || (!members.contains(*ref) && (ref->node != group.node || ref->type != group.type))) continue;
    Value value = output.value;
    if (!make_storable(value)) {
      state.error = Error{ErrorCode::not_finite, place_of(plan, group.node, group.type),
                          "`" + output.path + "` of `" + output.node + "` came out as a number that is not finite"};
      continue;
    }
    replies.push_back({.target = *ref, .value = std::move(value), .node = group.node, .type = group.type});
  }
}

AnalysisInput input_of(const StateDraft& draft, SetCase&& one) {
  const Plan& plan = *draft.state.plan;
  AnalysisInput input{.plan = draft.state.plan,
                      .definition = &definition_of(plan, *one.group),
                      .node = plan.nodes[one.node()].id,
                      .tick = draft.state.tick,
                      .values = std::move(one.values),
                      .sets = std::move(one.own),
                      .members = {},
                      .write_paths = {},
                      .memo = nullptr,
                      .time = nullptr};
  for (std::size_t s = 0; s < one.plans.size(); ++s) {
    std::vector<std::string>& members = input.members.emplace_back();
    std::vector<std::string>& paths = input.write_paths.emplace_back();
    for (const std::uint32_t member : one.plans[s].members) members.push_back(plan.nodes[member].id);
    const std::size_t count = input.definition->sets[s].writes.size();
    for (std::size_t w = 0; w < count && w < one.plans[s].writes.size(); ++w)
      paths.push_back(plan.path_text(one.plans[s].writes[w]));
  }
  return input;
}

// What the analyses of one node keep is shared by those that run, also by one that nobody wants any more.
std::shared_ptr<AnalysisMemo> shared_memo_of(Memo& memo) {
  auto& shared = memo.of<std::shared_ptr<AnalysisMemo>>();
  if (!shared) shared = std::make_shared<AnalysisMemo>();
  return shared;
}

AnalysisState done_at(std::int64_t begun, std::int64_t taken, std::uint64_t inputs) {
  return {.as_of = begun,
          .taken = taken,
          .inputs = inputs,
          .begun = -1,
          .due = -1,
          .running_inputs = 0,
          .running = nullptr,
          .seen = {}};
}

// Has the data of an analysis to be looked at in this tick? Data that cannot have changed since it was looked at is not.
bool needs_data(const AnalysisState& analysis, std::int64_t tick) {
  if (analysis.running && tick < analysis.due) return false;
  const bool has_result = analysis.running || analysis.as_of >= 0;
  return !has_result || analysis.seen != (analysis.running ? analysis.running_inputs : analysis.inputs);
}

// Takes in what is due, and begins anew where the data is other than that of the last result. `one` is given where the analysis
// needs its data.
void advance_analysis(TickWork& work, const SetGroup& group, std::optional<SetCase>& one, AnalysisRunner& runner, SetMemos& memos,
                      std::vector<Reply>& replies) {
  StateDraft& next = work.next;
  State& state = next.state;
  AnalysisState& analysis = state.analyses[group.analysis];
  std::vector<Reply> own;
  if (analysis.running && state.tick >= analysis.due) {
    const AnalysisResult* result = analysis.running->result();
    if (result == nullptr) return;  // stopped: so is the tick
    take_result(next, group, *result, own);
    const auto seen = analysis.seen;
    analysis = done_at(analysis.begun, state.tick, analysis.running_inputs);
    analysis.seen = seen;
  }
  const auto hand_on = [&] { std::move(own.begin(), own.end(), std::back_inserter(replies)); };
  if (analysis.running) return hand_on();
  if (!one) {
    analysis.as_of = state.tick;
    return hand_on();
  }
  ++work.counts.sets;
  const auto latency = static_cast<std::int64_t>(as_number(one->values[state.plan->analyses[group.analysis].latency]));
  Memo& memo = memo_of(memos, *state.plan, group).own;
  AnalysisInput input = input_of(next, std::move(*one));
  const std::uint64_t inputs = hash_of(input);
  analysis.seen = inputs;
  if (analysis.as_of >= 0 && inputs == analysis.inputs) {
    analysis.as_of = state.tick;
    return hand_on();
  }
  input.memo = shared_memo_of(memo);
  if (work.times != nullptr) input.time = work.times->beside(group.analysis);
  const auto begun = std::make_shared<Analysis>(std::move(input));
  if (latency > 0) {
    analysis.begun = state.tick;
    analysis.due = state.tick + latency;
    analysis.running_inputs = inputs;
    analysis.running = begun;
    runner.begin(begun);
  } else {
    own.clear();  // of an older one that was due in the same tick
    const AnalysisResult* result = begun->result();
    if (result == nullptr) return;
    take_result(next, group, *result, own);
    analysis = done_at(state.tick, state.tick, inputs);
    analysis.seen = inputs;
  }
  hand_on();
}

}  // namespace

void evaluate_sets(TickWork& work, ThreadPool& pool, SetMemos& memos, AnalysisRunner& runner) {
  StateDraft& next = work.next;
  const Plan& plan = *next.state.plan;
  const std::vector<SetGroup>& groups = plan.dependents->sets->groups;
  const std::vector<bool> is_due = due_groups(work);
  // All of them are gathered before any of them writes, so that there is no order among them.
  std::vector<std::optional<SetCase>> cases(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (error_of(plan, groups[g]) != nullptr) continue;
    bool is_asked = is_due[g];
    if (groups[g].analysis != SetGroup::kNone) {
      AnalysisState& analysis = next.state.analyses[groups[g].analysis];
      if (is_due[g]) analysis.seen.reset();
      is_asked = needs_data(analysis, next.state.tick);
    }
    if (!is_asked) continue;
    const double began = moment_of(work.times);
    if (groups[g].analysis != SetGroup::kNone) cases[g] = gathered(next, groups[g]);
    else cases[g] = gathered(next, groups[g], memo_of(memos, plan, groups[g]), work.frozen.due.is_everything);
    if (work.times != nullptr) work.times->add_role(groups[g].node, groups[g].type, began, 0);
  }
  std::vector<Reply> replies;
  std::vector<std::pair<std::size_t, bool>> written;  // groups, and whether all that they replied could be written
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const bool is_analysis = groups[g].analysis != SetGroup::kNone;
    const double began = moment_of(work.times);
    const std::size_t asked = work.counts.sets;
    if (const Error* error = error_of(plan, groups[g])) {
      if (next.nodes[groups[g].node].types[groups[g].type].error != *error)
        next.edit(groups[g].node, groups[g].type).error = *error;
      // Once the sets are whole again it is worked out anew, which takes the error away.
      if (is_analysis) next.state.analyses[groups[g].analysis] = {};
    } else if (is_analysis) {
      advance_analysis(work, groups[g], cases[g], runner, memos, replies);
    } else if (cases[g]) {
      ++work.counts.sets;
      written.emplace_back(g, evaluate_now(work, *cases[g], pool, replies));
    }
    if (work.times != nullptr && (is_analysis || cases[g]))
      work.times->add_role(groups[g].node, groups[g].type, began, work.counts.sets - asked);
  }
  write_replies(next, replies);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (next.nodes[groups[g].node].types[groups[g].type].error) keep_shapes(next, groups[g]);
  for (const auto& [g, is_complete] : written) cases[g]->memo->sets.note_written(next, groups[g], is_complete);
}

void recall_meshes(State& state, ThreadPool& pool, SetMemos& memos) {
  const StateDraft before(state);
  StateDraft draft(state);
  for (const SetGroup& group : state.plan->dependents->sets->groups) {
    const TypificationDefinition& definition = definition_of(*state.plan, group);
    const bool has_mesh = std::any_of(definition.sets.begin(), definition.sets.end(), [](const SetDefinition& set) {
      return std::any_of(set.writes.begin(), set.writes.end(),
                         [](const WriteDefinition& w) { return w.kind == ValueKind::mesh; });
    });
    if (!has_mesh || error_of(*state.plan, group) != nullptr) continue;
    SetCase one = gathered(before, group);
    SetMemo& memo = memo_of(memos, *state.plan, group);
    // What the evaluation keeps belongs to this state from now on, and nobody has been answered from it: whatever state the next
    // tick goes out from, all are to be.
    memo.sets = {};
    // A failure here is that of the next tick, which says so.
    const Tick recall{.index = state.tick, .pool = &pool, .memo = &memo.own, .is_recall = true};
    if (!definition.evaluate(one.values, one.sets, recall).ok()) continue;
    for (std::size_t s = 0; s < one.sets.size(); ++s)
      for (std::size_t w = 0; w < one.sets[s].writes.size(); ++w)
        if (auto& value = one.sets[s].writes[w]; value && std::holds_alternative<MeshPointer>(*value)) {
          const PortRef target = target_of(one, s, w);
          if (std::get<MeshPointer>(draft.value(target))) continue;  // saved, because its solver failed
          draft.edit(target) = std::move(*value);
        }
  }
  state = std::move(draft).publish();
}

State with_links_of(const State& state, const State& after) {
  StateDraft told(state);
  for (std::uint32_t l = 0; l < state.links.size(); ++l)
    if (!after.links[l].says_the_same(state.links[l])) told.links.put(l, LinkState(after.links[l]));
  return std::move(told).publish();
}

State with_sums_of_now(const State& state) {
  const StateDraft before(state);
  StateDraft seen(state);
  for (const SetGroup& group : state.plan->dependents->sets->groups) {
    const TypificationDefinition& definition = definition_of(*state.plan, group);
    const bool only_reads =
        std::all_of(definition.sets.begin(), definition.sets.end(), [](const SetDefinition& set) { return set.writes.empty(); });
    if (!only_reads || group.analysis != SetGroup::kNone || error_of(*state.plan, group) != nullptr || !is_only_now(definition))
      continue;
    TypeState now = seen.nodes[group.node].types[group.type];
    if (!now.is_evaluated || now.error) continue;
    SetCase one = gathered(before, group);
    auto done = definition.evaluate(one.values, one.sets, Tick{.index = Tick::kUnknown});
    accept_values(definition, now, std::move(one.values), std::move(done), place_of(*state.plan, one.node(), one.type()));
    if (!now.error) seen.edit(one.node(), one.type()) = std::move(now);
  }
  return std::move(seen).publish();
}

}  // namespace bl
