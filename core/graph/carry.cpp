// What of a state goes on under another plan: found by names under one that was compiled, by places under one that was amended.
#include "core/graph/carry.h"

#include <algorithm>
#include <optional>

#include "core/graph/fresh_state.h"

namespace bl {

namespace {

using Placed = std::set<std::pair<std::string, std::string>>;

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
  // A lock or an edit may let go what links have agreed on, without another set value: then there are other inputs, too.
  for (std::size_t p = 0; fresh.is_evaluated && p < fresh.values.size(); ++p)
    fresh.is_evaluated = after.definition->ports[p].is_computed || fresh.values[p] == old.values[p];
}

// Would a link go on from what it says now, under the plan of another one?
bool is_same_kind(const LinkPlan& before, const LinkPlan& now) {
  // By id: a script that was edited is another definition of the same kind.
  return before.definition != nullptr && now.definition != nullptr && before.definition->id == now.definition->id;
}

void carry_link(const State& old, std::size_t from, const Plan& plan, LinkState& fresh) {
  fresh.error = old.links[from].error;
  fresh.remark = old.links[from].remark;
  fresh.work = old.links[from].work;
  fresh.is_stuck = old.links[from].is_stuck;
  for (const Voice& voice : old.links[from].voices) {
    const std::uint32_t node = plan.node_index(old.plan->nodes[voice.target.node].id);
    if (node == plan.nodes.size()) continue;
    const auto path = parse_port_path(old.plan->path_text(voice.target));
    if (const auto ref = plan.find(node, *path)) fresh.voices.push_back({*ref, voice.value, voice.magnitude, voice.strength});
  }
}

// Do two scenes ask for the same? Names, titles and what stands on the canvas move nobody.
bool has_same_inputs(const Scene& a, const Scene& b) {
  const auto asked = [](PortValues settings) {
    for (const char* told : {"title", "about"}) settings.erase(told);
    return settings;
  };
  if (a.nodes.size() != b.nodes.size() || a.links != b.links || !(a.scripts == b.scripts)) return false;
  for (auto x = a.nodes.begin(), y = b.nodes.begin(); x != a.nodes.end(); ++x, ++y)
    if (x->first != y->first || x->second.types != y->second.types || x->second.locked != y->second.locked) return false;
  return asked(a.settings) == asked(b.settings);
}

NodeState carried_node(const NodePlan& before, const NodeState& old, const NodePlan& node, const Placed& placed) {
  NodeState fresh = fresh_node(node);
  const auto first = placed.lower_bound({node.id, ""});
  const bool is_placed = first != placed.end() && first->first == node.id;
  for (std::size_t t = 0; t < node.types.size(); ++t)
    for (std::size_t o = 0; o < before.types.size(); ++o) {
      const TypePlan& type = before.types[o];
      if (type.definition->id != node.types[t].definition->id) continue;
      std::set<std::string> ports;
      for (const PortDefinition& port : type.definition->ports)
        if (is_placed && placed.contains({node.id, type.definition->id + "." + port.id})) ports.insert(port.id);
      carry_type(type, old.types[o], node.types[t], fresh.types[t], ports);
    }
  return fresh;
}

void carry_analyses(const State& old, State& state) {
  for (std::size_t a = 0; a < state.analyses.size(); ++a)
    for (std::size_t o = 0; o < old.analyses.size(); ++o)
      if (analysis_name(*state.plan, a) == analysis_name(*old.plan, o)) state.analyses[a] = old.analyses[o];
}

}  // namespace

State carry(const State& old, std::shared_ptr<const Plan> plan, const Placed& placed) {
  StateDraft draft = fresh_state(std::move(plan));
  State& state = draft.state;
  state.tick = old.tick;
  // What rests goes on resting, unless somebody asks for something else.
  if (old.calm > 0 && placed.empty() && has_same_inputs(old.plan->scene, state.plan->scene)) state.calm = old.calm;
  for (std::size_t n = 0; n < state.plan->nodes.size(); ++n) {
    const NodePlan& node = state.plan->nodes[n];
    const std::uint32_t before = old.plan->node_index(node.id);
    if (before < old.plan->nodes.size())
      draft.nodes.put(n, carried_node(old.plan->nodes[before], old.nodes[before], node, placed));
  }
  // Both lists ascend by id: one walk along both.
  for (std::size_t l = 0, o = 0; l < state.plan->links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    while (o < old.plan->links.size() && old.plan->links[o].id < link.id) ++o;
    if (o == old.plan->links.size() || old.plan->links[o].id != link.id) continue;
    if (is_same_kind(old.plan->links[o], link)) carry_link(old, o, *state.plan, draft.links.edit(l));
  }
  carry_analyses(old, state);
  State carried = std::move(draft).publish();
  carried.hash = hash_of(carried);
  return carried;
}

namespace {

void carry_links(const State& old, const Amended& amended, StateDraft& draft) {
  if (amended.links.empty()) return;
  DueWork& due = draft.state.due;
  const auto silence = [&](const LinkState& link) {
    for (const Voice& voice : link.voices) due.nodes.push_back(voice.target.node);
  };
  const auto places = places_after(old.links.size(), amended.links);
  std::vector<std::uint32_t> again;
  for (const std::uint32_t link : due.links)
    if (places[link] != ItemEdit::kNone) again.push_back(places[link]);
  draft.links = LinkStates::Draft(old.links, origins_of(amended.plan->links.size(), amended.links));
  for (const ItemEdit& edit : amended.links) {
    if (!edit.is_removed()) again.push_back(edit.now);
    if (edit.is_added()) {
      draft.links.put(edit.now, {});
      continue;
    }
    const LinkPlan& before = old.plan->links[edit.before];
    const bool goes_on = !edit.is_removed() && is_same_kind(before, amended.plan->links[edit.now]);
    // A link that speaks on is asked, and who hears something else finds out; whether it counts is the hearer's business.
    if (!goes_on || before.is_muted != amended.plan->links[edit.now].is_muted) silence(old.links[edit.before]);
    if (goes_on) (void)draft.links.edit(edit.now);
    else if (!edit.is_removed()) draft.links.put(edit.now, {});
  }
  std::sort(again.begin(), again.end());
  again.erase(std::unique(again.begin(), again.end()), again.end());
  due.links = std::move(again);
}

// What stands before `first` ascends already.
void merge_from(std::size_t first, std::vector<PortRef>& ports) {
  const auto middle = ports.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(middle, ports.end());
  std::inplace_merge(ports.begin(), middle, ports.end());
}

// The state under a plan in which nodes have come or gone: those that stay are shared. Its hash is not made yet.
State moved_state(const State& old, const MovedPlan& moved) {
  StateDraft draft(old);
  State& state = draft.state;
  state.plan = moved.plan;
  state.calm = 0;
  state.largest_move = state.largest_change = state.largest_residual = 0;
  state.restless = {};
  state.due = DueWork();
  std::vector<std::uint32_t> origins(moved.plan->nodes.size(), ItemEdit::kNone);
  for (std::uint32_t n = 0; n < moved.places.size(); ++n)
    if (moved.places[n] != ItemEdit::kNone) origins[moved.places[n]] = n;
  draft.nodes = NodeStates::Draft(old.nodes, origins);
  for (std::uint32_t n = 0; n < origins.size(); ++n)
    if (origins[n] == ItemEdit::kNone) draft.nodes.put(n, fresh_node(moved.plan->nodes[n]));
  const auto moves = [&](const Voice& voice) { return moved.places[voice.target.node] != voice.target.node; };
  for (std::size_t l = 0; l < old.links.size(); ++l) {
    if (std::none_of(old.links[l].voices.begin(), old.links[l].voices.end(), moves)) continue;
    std::vector<Voice>& voices = draft.links.edit(l).voices;
    std::erase_if(voices, [&](const Voice& voice) { return moved.places[voice.target.node] == ItemEdit::kNone; });
    for (Voice& voice : voices) voice.target.node = moved.places[voice.target.node];
  }
  state.analyses.assign(moved.plan->analyses.size(), {});
  carry_analyses(old, state);
  return std::move(draft).publish();
}

bool has_rivals(const SetDependents& sets) {
  return std::any_of(sets.groups.begin(), sets.groups.end(),
                     [](const SetGroup& group) { return group.rivals != SetGroup::kNone; });
}

}  // namespace

State carry_amended(const State& from, const Amended& amended, const Placed& placed) {
  const std::optional<State> moved = amended.moved ? std::optional(moved_state(from, *amended.moved)) : std::nullopt;
  const State& old = moved ? *moved : from;
  StateDraft draft(old);
  State& state = draft.state;
  state.plan = amended.plan;
  if (!placed.empty() || !amended.nodes.empty() || !amended.links.empty()) state.calm = 0;
  carry_links(old, amended, draft);
  std::vector<std::uint32_t> touched = amended.nodes;
  for (const auto& [node, path] : placed)
    if (const std::uint32_t n = state.plan->node_index(node); n < state.plan->nodes.size()) touched.push_back(n);
  std::sort(touched.begin(), touched.end());
  const std::size_t changed = state.due.changed.size(), replied = state.due.replied.size();
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  for (const std::uint32_t n : touched) {
    const NodeState& before = old.nodes[n];
    NodeState after = carried_node(old.plan->nodes[n], before, state.plan->nodes[n], placed);
    for (std::uint16_t t = 0; t < after.types.size(); ++t)
      for (std::uint16_t p = 0; p < after.types[t].values.size(); ++p)
        if (const Value& old_value = before.types[t].values[p]; !(old_value == after.types[t].values[p])) {
          for (auto* ports : {&state.due.changed, &state.due.replied}) ports->push_back({n, t, p});
          if (const auto* point = std::get_if<Point3>(&old_value)) state.due.were.push_back({{n, t, p}, *point});
        }
    // A set whose settings say something else is asked, even where links have brought its ports to that already.
    for (std::uint16_t t = 0; t < after.types.size(); ++t)
      if (before.types[t].is_evaluated && !after.types[t].is_evaluated)
        for (std::uint16_t p = 0; p < after.types[t].values.size(); ++p) state.due.replied.push_back({n, t, p});
    state.due.nodes.push_back(n);
    draft.nodes.put(n, std::move(after));
  }
  // A set with other members or ports is asked by its settings; so are those that write to the same ports now. Who did so before
  // may no longer be found as one of them.
  if (!amended.sets.empty() && has_rivals(*from.plan->dependents->sets)) state.due.is_everything = true;
  for (const auto& [n, t] : amended.sets)
    for (std::uint16_t p = 0; p < state.plan->nodes[n].types[t].set_values.size(); ++p)
      state.due.replied.push_back({n, static_cast<std::uint16_t>(t), p});
  merge_from(changed, state.due.changed);
  merge_from(replied, state.due.replied);
  std::sort(state.due.nodes.begin(), state.due.nodes.end());
  state.due.nodes.erase(std::unique(state.due.nodes.begin(), state.due.nodes.end()), state.due.nodes.end());
  // Of a point that has changed several times, links know the first place.
  std::stable_sort(state.due.were.begin(), state.due.were.end(),
                   [](const PointBefore& a, const PointBefore& b) { return a.port < b.port; });
  State carried = std::move(draft).publish();
  carried.hash = hash_of(carried);
  return carried;
}

}  // namespace bl
