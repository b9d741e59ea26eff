// Making, saving and restoring states.
#include "core/graph/state.h"

#include <algorithm>

#include "core/graph/fresh_state.h"

namespace bl {

namespace {

using TypeName = std::pair<std::string, std::string>;  // node, typification

TypeName type_name(const Plan& plan, std::size_t node, std::size_t type) {
  return {plan.nodes[node].id, plan.nodes[node].types[type].definition->id};
}

}  // namespace

TypeName analysis_name(const Plan& plan, std::size_t a) { return type_name(plan, plan.analyses[a].node, plan.analyses[a].type); }

bool is_lasting(const State& state, const Voice& voice) { return state.plan->port(voice.target).rule != CombineRule::sum; }

bool is_at_rest(const State& state) { return state.calm >= state.plan->settings.calm_ticks; }

bool State::is_settled() const {
  if (!is_at_rest(*this)) return false;
  for (std::size_t a = 0; a < analyses.size(); ++a) {
    const AnalysisPlan& one = plan->analyses[a];
    const double latency = as_number(nodes[one.node].types[one.type].values[one.latency]);
    // It reads shapes of the tick before. One that was running when calm came is waited for, and the next one; links answer the
    // result in the tick after, and nodes the links in the one after that. Of later results it is enough that they wake nobody.
    if (analyses[a].as_of - 1 <= tick - calm || static_cast<double>(calm) <= 2 * latency + 4) return false;
  }
  return true;
}

SavedState save(const State& state) {
  SavedState saved{.tick = state.tick,
                   .calm = state.calm,
                   .nodes = {},
                   .voices = {},
                   .errors = {},
                   .link_errors = {},
                   .analyses = {},
                   .meshes = {}};
  const Plan& plan = *state.plan;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n) {
    std::map<std::string, Value> values;
    for (std::uint16_t t = 0; t < state.nodes[n].types.size(); ++t) {
      const TypePlan& type = plan.nodes[n].types[t];
      for (std::uint16_t p = 0; p < type.definition->ports.size(); ++p)
        if (const Value& value = state.nodes[n].types[t].values[p];
            !is_derived(type.definition->ports[p].kind) && value != type.set_values[p])
          values[plan.path_text({n, t, p})] = value;
      if (const auto& error = state.nodes[n].types[t].error) saved.errors[type_name(plan, n, t)] = *error;
    }
    if (!values.empty()) saved.nodes[plan.nodes[n].id] = std::move(values);
  }
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const std::string& id = plan.links[l].id;
    for (const Voice& voice : state.links[l].voices)
      if (is_lasting(state, voice))
        saved.voices[id].push_back({plan.nodes[voice.target.node].id, plan.path_text(voice.target), voice.value});
    if (const auto& error = state.links[l].error; state.links[l].has_failed() && !plan.links[l].error)
      saved.link_errors[id] = *error;
  }
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const AnalysisState& now = state.analyses[a];
    if (now.as_of < 0 && now.due < 0) continue;
    const AnalysisResult* result = now.running ? now.running->result() : nullptr;
    // Of a run that is to end at once, one that is under way is left out: the next tick begins it again.
    const bool is_kept = !now.running || result != nullptr;
    saved.analyses[analysis_name(plan, a)] = {.as_of = now.as_of,
                                              .taken = now.taken,
                                              .begun = is_kept ? now.begun : -1,
                                              .due = is_kept ? now.due : -1,
                                              .inputs = now.inputs,
                                              .running_inputs = is_kept ? now.running_inputs : 0,
                                              .result = result ? *result : AnalysisResult{}};
  }
  // What a failing solver leaves standing cannot be made again from inputs that it refuses.
  for (const SetPlan& set : plan.sets)
    if (state.nodes[set.node].types[set.type].error)
      for (const PortRef& ref : set.writes)
        if (const auto* mesh = std::get_if<MeshPointer>(&state.value(ref)); mesh != nullptr && *mesh)
          saved.meshes[{plan.nodes[ref.node].id, plan.path_text(ref)}] = *mesh;
  return saved;
}

NodeState fresh_node(const NodePlan& plan) {
  NodeState fresh;
  fresh.types.reserve(plan.types.size());
  for (const TypePlan& type : plan.types) {
    TypeState& state = fresh.types.emplace_back();
    state.values = copied(type.set_values);
    state.tension = Tensions(type.set_values.size());
  }
  return fresh;
}

StateDraft fresh_state(std::shared_ptr<const Plan> plan) {
  std::vector<NodeState> nodes;
  nodes.reserve(plan->nodes.size());
  for (const NodePlan& node : plan->nodes) nodes.push_back(fresh_node(node));
  std::vector<LinkState> links(plan->links.size());
  State state;
  state.analyses.resize(plan->analyses.size());
  state.plan = std::move(plan);
  return {std::move(state), std::move(nodes), std::move(links)};
}

State initial_state(std::shared_ptr<const Plan> plan) {
  State state = fresh_state(std::move(plan)).publish();
  state.hash = hash_of(state);
  return state;
}

namespace {

Result<void> restore_errors(const SavedState& saved, StateDraft& state) {
  const Plan& plan = *state.state.plan;
  for (const auto& [name, error] : saved.errors) {
    const std::uint32_t node = plan.node_index(name.first);
    bool is_known = false;
    for (std::size_t t = 0; node < plan.nodes.size() && t < plan.nodes[node].types.size(); ++t) {
      if (plan.nodes[node].types[t].definition->id != name.second) continue;
      state.edit(node, static_cast<std::uint32_t>(t)).error = error;
      is_known = true;
    }
    if (!is_known) return Error{ErrorCode::not_found, "state/errors/" + name.first, "the node is not a `" + name.second + "`"};
  }
  for (std::size_t l = 0; l < plan.links.size(); ++l) {
    const LinkPlan& link = plan.links[l];
    if (!link.is_enabled) continue;
    if (link.error) state.links.edit(l).error = link.error;
    else if (const auto said = saved.link_errors.find(link.id); said != saved.link_errors.end())
      state.links.edit(l).error = said->second;
  }
  return {};
}

void restore_analyses(const SavedState& saved, State& state) {
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const auto kept = saved.analyses.find(analysis_name(*state.plan, a));
    if (kept == saved.analyses.end()) continue;
    const SavedAnalysis& now = kept->second;
    state.analyses[a] = {.as_of = now.as_of,
                         .taken = now.taken,
                         .inputs = now.inputs,
                         .begun = now.begun,
                         .due = now.due,
                         .running_inputs = now.running_inputs,
                         .running = now.due < 0 ? nullptr : std::make_shared<Analysis>(now.result),
                         .seen = {}};
  }
}

}  // namespace

Result<State> restore(const SavedState& saved, std::shared_ptr<const Plan> plan) {
  StateDraft draft = fresh_state(std::move(plan));
  State& state = draft.state;
  state.tick = saved.tick;
  state.calm = saved.calm;
  auto find = [&](const std::string& node_id, const std::string& text) -> Result<PortRef> {
    const std::uint32_t node = state.plan->node_index(node_id);
    if (node == state.plan->nodes.size())
      return Error{ErrorCode::not_found, "state/nodes/" + node_id, "there is no node `" + node_id + "`"};
    const auto path = parse_port_path(text);
    if (path)
      if (const auto ref = state.plan->find(node, *path)) return *ref;
    return Error{ErrorCode::not_found, "state/nodes/" + node_id, "the node has no port `" + text + "`"};
  };
  for (const auto& [node, values] : saved.nodes)
    for (const auto& [path, value] : values) {
      const auto ref = find(node, path);
      if (!ref) return ref.error();
      draft.edit(*ref) = value;
    }
  for (std::size_t n = 0; n < draft.nodes.size(); ++n) {
    NodeState& node = draft.nodes.edit(n);
    for (std::size_t t = 0; t < node.types.size(); ++t)
      make_objects(*state.plan->nodes[n].types[t].definition, node.types[t].values, {});
  }
  for (const auto& [target, mesh] : saved.meshes) {
    const auto ref = find(target.first, target.second);
    if (!ref) return ref.error();
    if (state.plan->port(*ref).kind != ValueKind::mesh)
      return Error{ErrorCode::wrong_kind, "state/meshes/" + target.first, "`" + target.second + "` is no mesh"};
    draft.edit(*ref) = mesh;
  }
  if (auto done = restore_errors(saved, draft); !done) return done.error();
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    const auto said = saved.voices.find(link.id);
    if (said == saved.voices.end()) continue;
    for (const SavedVoice& voice : said->second) {
      const auto ref = find(voice.node, voice.path);
      if (!ref) return ref.error();
      draft.links.edit(l).voices.push_back({.target = *ref, .value = voice.value, .magnitude = 0, .strength = link.strength});
    }
    std::sort(draft.links.edit(l).voices.begin(), draft.links.edit(l).voices.end(),
              [](const Voice& a, const Voice& b) { return a.target < b.target; });
  }
  restore_analyses(saved, state);
  State restored = std::move(draft).publish();
  restored.largest_residual = largest_residual_of(restored);
  restored.hash = hash_of(restored);
  return restored;
}

}  // namespace bl
