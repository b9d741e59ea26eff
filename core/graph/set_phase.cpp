// Phase 6: solvers over sets of nodes, within the tick or beside it, and their replies.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/graph/phases.h"
#include "core/graph/sums_of_now.h"

namespace bl {

namespace {

struct Reply {
  PortRef target;
  Value value;
  std::uint32_t node = 0, type = 0;  // who wrote it
};

// One typification with all of its sets, and what it reads, gathered before any of them writes.
struct SetCase {
  std::span<const SetPlan> plans;
  std::size_t analysis = kNone;
  std::vector<Value> values;
  std::vector<SetValues> sets;
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::uint32_t node() const { return plans.front().node; }
  std::uint32_t type() const { return plans.front().type; }
  const TypificationDefinition& definition(const State& state) const {
    return *state.plan->nodes[node()].types[type()].definition;
  }
  const Error* error() const {
    const auto broken = std::find_if(plans.begin(), plans.end(), [](const SetPlan& plan) { return plan.error.has_value(); });
    return broken == plans.end() ? nullptr : &*broken->error;
  }
};

std::vector<SetCase> gather_sets(const State& state) {
  const auto& plans = state.plan->sets;
  std::vector<SetCase> cases;
  std::size_t analysis = 0;
  for (std::size_t begin = 0, end = 0; begin < plans.size(); begin = end) {
    while (end < plans.size() && plans[end].node == plans[begin].node && plans[end].type == plans[begin].type) ++end;
    SetCase& one = cases.emplace_back();
    one.plans = std::span(plans).subspan(begin, end - begin);
    if (analysis < state.plan->analyses.size() && state.plan->analyses[analysis].first_set == begin) one.analysis = analysis++;
    one.values = state.nodes[one.node()].types[one.type()].values;
    for (const SetPlan& plan : one.plans) {
      SetValues& set = one.sets.emplace_back();
      set.members = plan.members.size();
      for (const PortRef& ref : plan.reads) set.reads.push_back(state.value(ref));
      set.writes.resize(plan.writes.size());
    }
  }
  return cases;
}

void evaluate_now(State& next, SetCase& one, ThreadPool& pool, SetMemos& memos, std::vector<Reply>& replies) {
  const TypificationDefinition& definition = one.definition(next);
  TypeState& state = next.nodes[one.node()].types[one.type()];
  const std::string place = place_of(next, one.node(), one.type());
  Memo& memo = memos[{next.plan->nodes[one.node()].id, definition.id}];
  auto done = definition.evaluate(one.values, one.sets, Tick{.index = next.tick, .pool = &pool, .memo = &memo});
  const bool is_good = done.ok();
  accept_values(definition, state, std::move(one.values), std::move(done), place);
  if (!is_good) return;
  for (std::size_t s = 0; s < one.sets.size(); ++s)
    for (std::size_t w = 0; w < one.sets[s].writes.size(); ++w) {
      auto& value = one.sets[s].writes[w];
      if (!value) continue;
      if (make_storable(*value))
        replies.push_back({.target = one.plans[s].writes[w], .value = std::move(*value), .node = one.node(), .type = one.type()});
      else
        state.error =
            Error{ErrorCode::not_finite, place, "wrote a number that is not finite to a member; it keeps its last good value"};
    }
}

// Results that came from nodes which have gone since are for nobody.
void take_result(State& next, const SetCase& one, const AnalysisResult& result, std::vector<Reply>& replies) {
  TypeState& state = next.nodes[one.node()].types[one.type()];
  // Whoever has left the sets since gets nothing any more.
  std::set<PortRef> members;
  for (const SetPlan& plan : one.plans) members.insert(plan.writes.begin(), plan.writes.end());
  state.error.reset();
  if (result.error) state.error = result.error->within(place_of(next, one.node(), one.type()));
  state.is_evaluated = !result.error;
  for (const AnalysisOutput& output : result.outputs) {
    const std::uint32_t node = next.plan->node_index(output.node);
    const auto path = parse_port_path(output.path);
    if (node == next.plan->nodes.size() || !path) continue;
    const auto ref = next.plan->find(node, *path);
    if (!ref || (!members.contains(*ref) && (ref->node != one.node() || ref->type != one.type()))) continue;
    Value value = output.value;
    if (!make_storable(value)) {
      state.error = Error{ErrorCode::not_finite, place_of(next, one.node(), one.type()),
                          "`" + output.path + "` of `" + output.node + "` was computed as a number that is not finite"};
      continue;
    }
    replies.push_back({.target = *ref, .value = std::move(value), .node = one.node(), .type = one.type()});
  }
}

AnalysisInput input_of(const State& state, SetCase& one) {
  AnalysisInput input{.plan = state.plan,
                      .definition = &one.definition(state),
                      .node = state.plan->nodes[one.node()].id,
                      .tick = state.tick,
                      .values = std::move(one.values),
                      .sets = std::move(one.sets),
                      .members = {},
                      .write_paths = {},
                      .memo = nullptr};
  for (std::size_t s = 0; s < one.plans.size(); ++s) {
    std::vector<std::string>& members = input.members.emplace_back();
    std::vector<std::string>& paths = input.write_paths.emplace_back();
    for (const std::uint32_t member : one.plans[s].members) members.push_back(state.plan->nodes[member].id);
    const std::size_t count = input.definition->sets[s].writes.size();
    for (std::size_t w = 0; w < count && w < one.plans[s].writes.size(); ++w)
      paths.push_back(state.plan->path_text(one.plans[s].writes[w]));
  }
  return input;
}

// What the analyses of one node keep is shared by those that run, also by one that nobody wants any more.
std::shared_ptr<AnalysisMemo> memo_of(Memo& memo) {
  auto& shared = memo.of<std::shared_ptr<AnalysisMemo>>();
  if (!shared) shared = std::make_shared<AnalysisMemo>();
  return shared;
}

AnalysisState done_at(std::int64_t begun, std::int64_t taken, std::uint64_t inputs) {
  return {.as_of = begun, .taken = taken, .inputs = inputs, .begun = -1, .due = -1, .running_inputs = 0, .running = nullptr};
}

void advance_analysis(State& next, SetCase& one, AnalysisRunner& runner, Memo& memo, std::vector<Reply>& replies) {
  AnalysisState& analysis = next.analyses[one.analysis];
  std::vector<Reply> own;
  if (analysis.running && next.tick >= analysis.due) {
    const AnalysisResult* result = analysis.running->result();
    if (result == nullptr) return;  // stopped: so is the tick
    take_result(next, one, *result, own);
    analysis = done_at(analysis.begun, next.tick, analysis.running_inputs);
  }
  const auto hand_on = [&] { std::move(own.begin(), own.end(), std::back_inserter(replies)); };
  if (analysis.running) return hand_on();
  const std::int64_t latency = static_cast<std::int64_t>(as_number(one.values[next.plan->analyses[one.analysis].latency]));
  AnalysisInput input = input_of(next, one);
  const std::uint64_t inputs = hash_of(input);
  if (analysis.as_of >= 0 && inputs == analysis.inputs) {
    analysis.as_of = next.tick;
    return hand_on();
  }
  input.memo = memo_of(memo);
  const auto begun = std::make_shared<Analysis>(std::move(input));
  if (latency > 0) {
    analysis.begun = next.tick;
    analysis.due = next.tick + latency;
    analysis.running_inputs = inputs;
    analysis.running = begun;
    runner.begin(begun);
  } else {
    own.clear();  // of an older one that was due in the same tick
    const AnalysisResult* result = begun->result();
    if (result == nullptr) return;
    take_result(next, one, *result, own);
    analysis = done_at(next.tick, next.tick, inputs);
  }
  hand_on();
}

// Where two write to one port the first one has it, and the other one says so.
void write_replies(State& next, std::vector<Reply>& replies) {
  std::vector<std::size_t> order(replies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return replies[a].target != replies[b].target ? replies[a].target < replies[b].target : a < b;
  });
  std::vector<std::pair<std::size_t, std::size_t>> late;  // replies that came too late, and those before them
  for (std::size_t first = 0, at = 0; at < order.size(); ++at) {
    Reply& reply = replies[order[at]];
    if (at == 0 || reply.target != replies[order[first]].target) {
      first = at;
      next.nodes[reply.target.node].types[reply.target.type].values[reply.target.port] = std::move(reply.value);
    } else {
      late.emplace_back(order[at], order[first]);
    }
  }
  std::sort(late.begin(), late.end());
  for (const auto& [at, before] : late) {
    const Reply& reply = replies[at];
    next.nodes[reply.node].types[reply.type].error =
        Error{ErrorCode::conflict, place_of(next, reply.node, reply.type),
              "`" + next.plan->nodes[reply.target.node].id + "` already belongs to `" +
                  next.plan->nodes[replies[before].node].id + "`; a node can be a member of one such set only"};
  }
}

bool is_negative_zero(double number) { return number == 0 && std::signbit(number); }

// Shapes that a failing solver leaves standing are state like any value, and saved: their zeros have no sign, either.
void keep_shapes(State& next, const SetCase& one) {
  for (const SetPlan& plan : one.plans)
    for (const PortRef& ref : plan.writes) {
      auto* mesh = std::get_if<MeshPointer>(&next.nodes[ref.node].types[ref.type].values[ref.port]);
      if (mesh == nullptr || !*mesh) continue;
      const bool is_plain = std::none_of((*mesh)->vertices.begin(), (*mesh)->vertices.end(), [](const Point3& p) {
        return is_negative_zero(p.x) || is_negative_zero(p.y) || is_negative_zero(p.z);
      });
      if (is_plain) continue;
      auto plain = std::make_shared<Mesh>(**mesh);
      for (Point3& vertex : plain->vertices) vertex += Point3{0, 0, 0};  // -0 + 0 is 0
      *mesh = std::move(plain);
    }
}

}  // namespace

void evaluate_sets(State& next, ThreadPool& pool, SetMemos& memos, AnalysisRunner& runner) {
  std::vector<SetCase> cases = gather_sets(next);
  std::vector<Reply> replies;
  for (SetCase& one : cases) {
    if (const Error* error = one.error()) {
      next.nodes[one.node()].types[one.type()].error = *error;
      // Once the sets are whole again it is worked out anew, which takes the error away.
      if (one.analysis != SetCase::kNone) next.analyses[one.analysis] = {};
    } else if (one.analysis == SetCase::kNone) {
      evaluate_now(next, one, pool, memos, replies);
    } else {
      advance_analysis(next, one, runner, memos[{next.plan->nodes[one.node()].id, one.definition(next).id}], replies);
    }
  }
  write_replies(next, replies);
  for (const SetCase& one : cases)
    if (next.nodes[one.node()].types[one.type()].error) keep_shapes(next, one);
}

void recall_meshes(State& state, ThreadPool& pool, SetMemos& memos) {
  for (SetCase& one : gather_sets(state)) {
    const TypificationDefinition& definition = one.definition(state);
    const bool has_mesh = std::any_of(definition.sets.begin(), definition.sets.end(), [](const SetDefinition& set) {
      return std::any_of(set.writes.begin(), set.writes.end(),
                         [](const WriteDefinition& w) { return w.kind == ValueKind::mesh; });
    });
    if (!has_mesh || one.error() != nullptr) continue;
    Memo& memo = memos[{state.plan->nodes[one.node()].id, definition.id}];
    // A failure here is that of the next tick, which says so.
    const Tick recall{.index = state.tick, .pool = &pool, .memo = &memo, .is_recall = true};
    if (!definition.evaluate(one.values, one.sets, recall).ok()) continue;
    for (std::size_t s = 0; s < one.sets.size(); ++s)
      for (std::size_t w = 0; w < one.sets[s].writes.size(); ++w)
        if (auto& value = one.sets[s].writes[w]; value && std::holds_alternative<MeshPointer>(*value)) {
          const PortRef target = one.plans[s].writes[w];
          if (std::get<MeshPointer>(state.value(target))) continue;  // saved, because its solver failed
          state.nodes[target.node].types[target.type].values[target.port] = std::move(*value);
        }
  }
}

State with_sums_of_now(const State& state) {
  State seen = state;
  for (SetCase& one : gather_sets(state)) {
    const TypificationDefinition& definition = one.definition(state);
    const bool only_reads =
        std::all_of(definition.sets.begin(), definition.sets.end(), [](const SetDefinition& set) { return set.writes.empty(); });
    if (!only_reads || one.analysis != SetCase::kNone || one.error() != nullptr || keeps_memory(definition)) continue;
    TypeState& sums = seen.nodes[one.node()].types[one.type()];
    if (!sums.is_evaluated || sums.error) continue;
    TypeState now = sums;
    auto done = definition.evaluate(one.values, one.sets, Tick{.index = state.tick});
    accept_values(definition, now, std::move(one.values), std::move(done), place_of(state, one.node(), one.type()));
    if (!now.error) sums = std::move(now);
  }
  return seen;
}

}  // namespace bl
