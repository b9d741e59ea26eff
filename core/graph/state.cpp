// Making, carrying over, saving and hashing states.
#include "core/graph/state.h"

#include <algorithm>
#include <cmath>

namespace bl {

namespace {

bool is_held(const State& state, const LinkState& link, const Voice& voice) {
  return link.has_failed() && state.plan->port(voice.target).rule != CombineRule::sum;
}

bool link_counts(const LinkPlan& link) { return link.definition != nullptr && link.is_enabled && !link.is_muted; }

std::pair<std::string, std::string> analysis_name(const Plan& plan, std::size_t a) {
  const NodePlan& node = plan.nodes[plan.analyses[a].node];
  return {node.id, node.types[plan.analyses[a].type].definition->id};
}

}  // namespace

std::optional<Error> first_failure(const State& state) {
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (const TypeState& type : state.nodes[n].types)
      if (type.error) return type.error;
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (state.links[l].error && state.links[l].remark != LinkRemark::short_of && link_counts(state.plan->links[l]))
      return state.links[l].error;
  return std::nullopt;
}

bool has_failure(const State& state) { return first_failure(state).has_value(); }

std::optional<Error> first_work(const State& state) {
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (state.links[l].work && link_counts(state.plan->links[l]) && state.plan->links[l].strength > 0) return state.links[l].work;
  return std::nullopt;
}

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

double largest_residual_of(const State& state) {
  double largest = 0;
  for (std::size_t n = 0; n < state.nodes.size(); ++n)
    for (std::size_t t = 0; t < state.nodes[n].types.size(); ++t) {
      const auto& ports = state.plan->nodes[n].types[t].definition->ports;
      for (std::size_t p = 0; p < ports.size(); ++p)
        if (ports[p].is_residual) largest = std::max(largest, std::abs(as_number(state.nodes[n].types[t].values[p])));
    }
  return largest;
}

std::uint64_t hash_of(const State& state) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(state.tick));
  hash.add(static_cast<std::uint64_t>(state.calm));
  for (std::size_t n = 0; n < state.nodes.size(); ++n) {
    hash.add(std::string_view(state.plan->nodes[n].id));
    for (std::size_t t = 0; t < state.nodes[n].types.size(); ++t) {
      hash.add(std::string_view(state.plan->nodes[n].types[t].definition->id));
      for (const Value& value : state.nodes[n].types[t].values) add_to(hash, value);
    }
  }
  for (std::size_t l = 0; l < state.links.size(); ++l)
    for (const Voice& voice : state.links[l].voices)
      if (is_held(state, state.links[l], voice)) {
        hash.add(std::string_view(state.plan->links[l].id));
        add_to(hash, voice.value);
      }
  for (const AnalysisState& analysis : state.analyses) {
    for (const std::int64_t tick : {analysis.as_of, analysis.taken, analysis.begun, analysis.due})
      hash.add(static_cast<std::uint64_t>(tick));
    hash.add(analysis.inputs);
    hash.add(analysis.running_inputs);
  }
  return hash.value();
}

SavedState save(const State& state) {
  SavedState saved{state.tick, state.calm, {}, {}, {}, {}};
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n) {
    auto& values = saved.nodes[state.plan->nodes[n].id];
    for (std::uint16_t t = 0; t < state.nodes[n].types.size(); ++t) {
      const TypePlan& type = state.plan->nodes[n].types[t];
      for (std::uint16_t p = 0; p < type.definition->ports.size(); ++p)
        if (const Value& value = state.nodes[n].types[t].values[p];
            type.definition->ports[p].kind != ValueKind::mesh && value != type.set_values[p])
          values[state.plan->path_text({n, t, p})] = value;
    }
    if (values.empty()) saved.nodes.erase(state.plan->nodes[n].id);
  }
  for (std::size_t l = 0; l < state.links.size(); ++l)
    for (const Voice& voice : state.links[l].voices)
      if (is_held(state, state.links[l], voice))
        saved.held[state.plan->links[l].id].push_back(
            {{state.plan->nodes[voice.target.node].id, state.plan->path_text(voice.target)}, voice});
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const AnalysisState& now = state.analyses[a];
    if (now.as_of < 0 && now.due < 0) continue;
    saved.analyses[analysis_name(*state.plan, a)] = {now.as_of,
                                                     now.taken,
                                                     now.begun,
                                                     now.due,
                                                     now.inputs,
                                                     now.running_inputs,
                                                     now.running ? now.running->result() : AnalysisResult{}};
  }
  // What a failing solver leaves standing cannot be made again from inputs that it refuses.
  for (const SetPlan& set : state.plan->sets)
    if (state.nodes[set.node].types[set.type].error)
      for (const PortRef& ref : set.writes)
        if (const auto* mesh = std::get_if<MeshPointer>(&state.value(ref)); mesh != nullptr && *mesh)
          saved.meshes[{state.plan->nodes[ref.node].id, state.plan->path_text(ref)}] = *mesh;
  return saved;
}

namespace {

// As initial_state() gives it, but for the hash.
State fresh_state(std::shared_ptr<const Plan> plan) {
  State state;
  for (const NodePlan& node : plan->nodes) {
    NodeState& fresh = state.nodes.emplace_back();
    for (const TypePlan& type : node.types)
      fresh.types.push_back({type.set_values, std::vector<double>(type.set_values.size(), 0), std::nullopt, false});
  }
  state.links.resize(plan->links.size());
  state.analyses.resize(plan->analyses.size());
  state.plan = std::move(plan);
  return state;
}

void carry_type(const TypePlan& before, const TypeState& old, const TypePlan& after, TypeState& fresh,
                const std::set<std::string>& placed) {
  for (std::size_t p = 0; p < after.definition->ports.size(); ++p) {
    const PortDefinition& port = after.definition->ports[p];
    // What links have agreed on is a part of what runs: a limit that is tightened tick by tick reads itself. An edit elsewhere
    // must not let it go; an edit of the port itself starts from what people say.
    const bool is_agreed = port.rule != CombineRule::none && before.is_locked[p] == after.is_locked[p] &&
                           before.set_values[p] == after.set_values[p];
    // What nobody computes any more goes back to its defaults, which say so.
    const bool is_lasting = (port.is_computed && after.is_served) || port.rule == CombineRule::sum || is_agreed;
    if (is_lasting && !placed.contains(port.id)) fresh.values[p] = old.values[p];
  }
  fresh.error = old.error;
  fresh.is_evaluated = old.is_evaluated && before.set_values == after.set_values;
}

void carry_link(const State& old, std::size_t from, const Plan& plan, LinkState& fresh) {
  fresh.error = old.links[from].error;
  fresh.remark = old.links[from].remark;
  fresh.work = old.links[from].work;
  for (const Voice& voice : old.links[from].voices) {
    const std::uint32_t node = plan.node_index(old.plan->nodes[voice.target.node].id);
    if (node == plan.nodes.size()) continue;
    const auto path = parse_port_path(old.plan->path_text(voice.target));
    if (const auto ref = plan.find(node, *path)) fresh.voices.push_back({*ref, voice.value, voice.magnitude, voice.strength});
  }
}

// Do two scenes ask for the same? Names, titles and what stands on the canvas move nobody.
bool asks_the_same(const Scene& a, const Scene& b) {
  const auto asked = [](PortValues settings) {
    for (const char* told : {"title", "about"}) settings.erase(told);
    return settings;
  };
  if (a.nodes.size() != b.nodes.size() || a.links != b.links || !(a.scripts == b.scripts)) return false;
  for (auto x = a.nodes.begin(), y = b.nodes.begin(); x != a.nodes.end(); ++x, ++y)
    if (x->first != y->first || x->second.types != y->second.types || x->second.locked != y->second.locked) return false;
  return asked(a.settings) == asked(b.settings);
}

}  // namespace

State initial_state(std::shared_ptr<const Plan> plan) {
  State state = fresh_state(std::move(plan));
  state.hash = hash_of(state);
  return state;
}

State carry(const State& old, std::shared_ptr<const Plan> plan, const std::set<std::pair<std::string, std::string>>& placed) {
  State state = fresh_state(std::move(plan));
  state.tick = old.tick;
  // What rests goes on resting, unless somebody asks for something else.
  if (old.calm > 0 && placed.empty() && asks_the_same(old.plan->scene, state.plan->scene)) state.calm = old.calm;
  for (std::size_t n = 0; n < state.nodes.size(); ++n) {
    const NodePlan& node = state.plan->nodes[n];
    const std::uint32_t before = old.plan->node_index(node.id);
    if (before == old.plan->nodes.size()) continue;
    const auto first = placed.lower_bound({node.id, ""});
    const bool is_placed = first != placed.end() && first->first == node.id;
    for (std::size_t t = 0; t < node.types.size(); ++t)
      for (std::size_t o = 0; o < old.plan->nodes[before].types.size(); ++o) {
        const TypePlan& type = old.plan->nodes[before].types[o];
        if (type.definition->id != node.types[t].definition->id) continue;
        std::set<std::string> ports;
        for (const PortDefinition& port : type.definition->ports)
          if (is_placed && placed.contains({node.id, type.definition->id + "." + port.id})) ports.insert(port.id);
        carry_type(type, old.nodes[before].types[o], node.types[t], state.nodes[n].types[t], ports);
      }
  }
  // Both lists ascend by id: one walk along both.
  for (std::size_t l = 0, o = 0; l < state.links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    while (o < old.plan->links.size() && old.plan->links[o].id < link.id) ++o;
    if (o == old.plan->links.size() || old.plan->links[o].id != link.id) continue;
    const LinkDefinition *before = old.plan->links[o].definition, *now = link.definition;
    // By id: a script that was edited is another definition of the same kind.
    if (before != nullptr && now != nullptr && before->id == now->id) carry_link(old, o, *state.plan, state.links[l]);
  }
  for (std::size_t a = 0; a < state.analyses.size(); ++a)
    for (std::size_t o = 0; o < old.analyses.size(); ++o)
      if (analysis_name(*state.plan, a) == analysis_name(*old.plan, o)) state.analyses[a] = old.analyses[o];
  state.hash = hash_of(state);
  return state;
}

Result<State> restore(const SavedState& saved, std::shared_ptr<const Plan> plan) {
  State state = initial_state(std::move(plan));
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
      state.nodes[ref->node].types[ref->type].values[ref->port] = value;
    }
  for (const auto& [target, mesh] : saved.meshes) {
    const auto ref = find(target.first, target.second);
    if (!ref) return ref.error();
    if (state.plan->port(*ref).kind != ValueKind::mesh)
      return Error{ErrorCode::wrong_kind, "state/meshes/" + target.first, "`" + target.second + "` is no mesh"};
    state.nodes[ref->node].types[ref->type].values[ref->port] = mesh;
  }
  for (std::size_t l = 0; l < state.plan->links.size(); ++l) {
    const auto held = saved.held.find(state.plan->links[l].id);
    if (held == saved.held.end()) continue;
    state.links[l].error = Error{ErrorCode::internal, "links/" + held->first, "held since before the scene was saved"};
    for (const auto& [target, voice] : held->second) {
      const auto ref = find(target.first, target.second);
      if (!ref) return ref.error();
      state.links[l].voices.push_back({*ref, voice.value, voice.magnitude, voice.strength});
    }
    std::sort(state.links[l].voices.begin(), state.links[l].voices.end(),
              [](const Voice& a, const Voice& b) { return a.target < b.target; });
  }
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const auto kept = saved.analyses.find(analysis_name(*state.plan, a));
    if (kept == saved.analyses.end()) continue;
    const SavedAnalysis& now = kept->second;
    state.analyses[a] = {now.as_of,
                         now.taken,
                         now.inputs,
                         now.begun,
                         now.due,
                         now.running_inputs,
                         now.due < 0 ? nullptr : std::make_shared<Analysis>(now.result)};
  }
  state.largest_residual = largest_residual_of(state);
  state.hash = hash_of(state);
  return state;
}

}  // namespace bl
