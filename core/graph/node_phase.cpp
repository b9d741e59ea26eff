// Phases 5 to 7: typifications, solvers over sets of nodes, and the commit.
#include <algorithm>
#include <cmath>

#include "core/graph/phases.h"

namespace bl {

namespace {

bool same_inputs(const TypificationDefinition& definition, const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t p = 0; p < definition.ports.size(); ++p)
    if (!definition.ports[p].is_computed && a[p] != b[p]) return false;
  return true;
}

std::string place_of(const State& state, std::size_t n, std::size_t t) {
  return "nodes/" + state.plan->nodes[n].id + "/" + state.plan->nodes[n].types[t].definition->id;
}

// Takes over what an evaluation wrote, or keeps the last good values and the error.
void accept(const TypificationDefinition& definition, TypeState& state, std::vector<Value>&& values, Result<void> done,
            const std::string& place) {
  for (std::size_t p = 0; done && p < values.size(); ++p)
    if (definition.ports[p].is_computed && !is_finite(values[p]))
      done = Error{ErrorCode::not_finite, definition.ports[p].id,
                   "came out as a number that is not finite; the last good values are kept"};
  if (!done) {
    state.error = done.error().within(place);
    state.is_evaluated = false;
    return;
  }
  state.error.reset();
  state.values = std::move(values);
  state.is_evaluated = true;
}

}  // namespace

void evaluate_nodes(const State& frozen, State& next, ThreadPool& pool) {
  pool.for_each_chunk(next.nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t t = 0; t < next.nodes[n].types.size(); ++t) {
        const TypificationDefinition& definition = *next.plan->nodes[n].types[t].definition;
        TypeState& state = next.nodes[n].types[t];
        if (!definition.evaluate || !definition.sets.empty()) continue;
        if (state.is_evaluated && same_inputs(definition, state.values, frozen.nodes[n].types[t].values)) continue;
        std::vector<Value> values = state.values;
        auto done = definition.evaluate(values, {}, Tick{.index = next.tick});
        accept(definition, state, std::move(values), std::move(done), place_of(next, n, t));
      }
  });
}

namespace {

struct Reply {
  PortRef target;
  Value value;
  const SetPlan* writer;
};

void evaluate_type_sets(State& next, std::span<const SetPlan> plans, ThreadPool& pool, SetMemos& memos,
                        std::vector<Reply>& replies) {
  const std::uint32_t n = plans.front().node, t = plans.front().type;
  const TypificationDefinition& definition = *next.plan->nodes[n].types[t].definition;
  TypeState& state = next.nodes[n].types[t];
  std::vector<SetValues> sets;
  for (const SetPlan& plan : plans) {
    SetValues& set = sets.emplace_back();
    set.members = plan.members.size();
    for (const PortRef& ref : plan.reads) set.reads.push_back(next.value(ref));
    set.writes.resize(plan.writes.size());
    if (plan.error) {
      state.error = plan.error;
      return;
    }
  }
  std::vector<Value> values = state.values;
  auto done = definition.evaluate(values, sets, Tick{next.tick, &pool, &memos[{next.plan->nodes[n].id, definition.id}]});
  const bool is_good = done.ok();
  accept(definition, state, std::move(values), std::move(done), place_of(next, n, t));
  if (!is_good) return;
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (std::size_t w = 0; w < sets[s].writes.size(); ++w) {
      auto& value = sets[s].writes[w];
      if (!value) continue;
      if (is_finite(*value)) replies.push_back({plans[s].writes[w], std::move(*value), &plans[s]});
      else
        state.error = Error{ErrorCode::not_finite, place_of(next, n, t),
                            "wrote a number that is not finite to a member; it keeps its last good value"};
    }
}

}  // namespace

void evaluate_sets(State& next, ThreadPool& pool, SetMemos& memos) {
  const auto& plans = next.plan->sets;
  std::vector<Reply> replies;
  for (std::size_t begin = 0; begin < plans.size();) {
    std::size_t end = begin;
    while (end < plans.size() && plans[end].node == plans[begin].node && plans[end].type == plans[begin].type) ++end;
    evaluate_type_sets(next, std::span(plans).subspan(begin, end - begin), pool, memos, replies);
    begin = end;
  }
  std::map<PortRef, const SetPlan*> owner;
  for (Reply& reply : replies) {
    const auto [it, is_first] = owner.emplace(reply.target, reply.writer);
    if (is_first) {
      next.nodes[reply.target.node].types[reply.target.type].values[reply.target.port] = std::move(reply.value);
    } else {
      next.nodes[reply.writer->node].types[reply.writer->type].error =
          Error{ErrorCode::conflict, place_of(next, reply.writer->node, reply.writer->type),
                "`" + next.plan->nodes[reply.target.node].id + "` already belongs to `" + next.plan->nodes[it->second->node].id +
                    "`; a node can be a member of one such set only"};
    }
  }
}

void commit(State& next) {
  const Settings& settings = next.plan->settings;
  next.largest_residual = largest_residual_of(next);
  const bool is_calm = !has_failure(next) && next.largest_residual <= settings.tolerance &&
                       next.largest_move <= settings.move_limit && next.largest_change <= settings.change_limit;
  next.calm = is_calm ? next.calm + 1 : 0;
  next.hash = hash_of(next);
}

}  // namespace bl
