// What the leaves of a state come to: hashes, residuals and failures, worked out where something was edited.
#include <algorithm>
#include <cmath>

#include "core/graph/state.h"

namespace bl {

namespace {

bool link_counts(const LinkPlan& link) { return link.definition != nullptr && link.is_enabled && !link.is_muted; }

bool fails(const NodeState& node) {
  return std::any_of(node.types.begin(), node.types.end(), [](const TypeState& type) { return type.error.has_value(); });
}

bool fails(const LinkState& link, const LinkPlan& plan) {
  return link.error && link.remark != LinkRemark::short_of && link_counts(plan);
}

bool is_working(const LinkState& link, const LinkPlan& plan) {
  return link.work && !link.is_stuck && link_counts(plan) && plan.strength > 0;
}

double residual_of(const NodeState& node, const NodePlan& plan) {
  double largest = 0;
  for (std::size_t t = 0; t < node.types.size(); ++t) {
    const auto& ports = plan.types[t].definition->ports;
    for (std::size_t p = 0; p < ports.size(); ++p)
      if (ports[p].is_residual) largest = std::max(largest, std::abs(as_number(node.types[t].values[p])));
  }
  return largest;
}

// The first item that `has` holds for, in leaves whose digest says that there is one.
template <class List, class OfLeaf, class OfItem>
std::optional<std::size_t> first_in(const List& list, const OfLeaf& may_have, const OfItem& has) {
  for (std::size_t leaf = 0; leaf < list.leaf_count(); ++leaf)
    for (std::size_t i = leaf * List::kLeaf; may_have(list.digest(leaf)) && i < std::min(list.size(), (leaf + 1) * List::kLeaf);
         ++i)
      if (has(i)) return i;
  return std::nullopt;
}

// A node that was edited.
struct Edited {
  NodeState* node = nullptr;
  const NodePlan* plan = nullptr;
  Hash hash = {};
};

bool has_same_types(const NodePlan& a, const NodePlan& b) {
  return std::equal(a.types.begin(), a.types.end(), b.types.begin(), b.types.end(),
                    [](const TypePlan& x, const TypePlan& y) { return x.definition == y.definition; });
}

// Of nodes with the same typifications, port by port: in each hash every step waits for the one before, but the processor takes
// the steps of several hashes at once.
void hash_together(std::span<Edited> some) {
  for (Edited& one : some) one.hash.add(std::string_view(one.plan->id));
  for (std::size_t t = 0; t < some.front().node->types.size(); ++t) {
    const TypificationDefinition& definition = *some.front().plan->types[t].definition;
    for (Edited& one : some) {
      one.hash.add(std::string_view(definition.id));
      // Links that read it ask whether it fails; the reason is for people.
      if (one.node->types[t].error) one.hash.add(std::string_view("fails"));
    }
    for (std::size_t p = 0; p < definition.ports.size(); ++p)
      for (Edited& one : some) add_to(one.hash, one.node->types[t].values[p]);
  }
}

void sum_up_edited(const Plan& plan, NodeStates::Draft& nodes) {
  constexpr std::size_t kTogether = 4;
  std::vector<Edited> edited;
  for (const std::uint32_t n : nodes.own_items()) edited.push_back({&nodes.edit(n), &plan.nodes[n]});
  for (std::size_t first = 0, end = 0; first < edited.size(); first = end) {
    while (end < edited.size() && end < first + kTogether && has_same_types(*edited[first].plan, *edited[end].plan)) ++end;
    hash_together(std::span(edited).subspan(first, end - first));
  }
  for (const Edited& one : edited) {
    one.node->hash = one.hash.value();
    one.node->residual = residual_of(*one.node, *one.plan);
    one.node->has_failure = fails(*one.node);
  }
}

std::uint64_t hash_of(const LinkState& link, const Plan& plan, std::size_t index) {
  Hash hash;
  bool has_any = false;
  for (const Voice& voice : link.voices) {
    if (plan.port(voice.target).rule == CombineRule::sum) continue;
    if (!has_any) hash.add(std::string_view(plan.links[index].id));
    has_any = true;
    hash.add(std::string_view(plan.nodes[voice.target.node].id));
    hash.add(std::uint64_t{voice.target.type} << 16 | voice.target.port);
    add_to(hash, voice.value);
  }
  return has_any ? hash.value() : 0;
}

template <class Items>
std::uint64_t hash_of_items(const Items& items) {
  Hash hash;
  for (std::size_t k = 0; k < items.size() && items[k]; ++k) hash.add(items[k]->hash);
  return hash.value();
}

}  // namespace

State StateDraft::publish() && {
  const Plan& plan = *state.plan;
  State published = std::move(state);
  sum_up_edited(plan, nodes);
  published.nodes =
      std::move(nodes).publish([](NodeState&, std::size_t) {},
                               [&](const auto& items, std::size_t) {
                                 NodeDigest digest{.hash = hash_of_items(items), .residual = 0, .has_failure = false};
                                 for (std::size_t k = 0; k < items.size() && items[k]; ++k) {
                                   digest.residual = std::max(digest.residual, items[k]->residual);
                                   digest.has_failure |= items[k]->has_failure;
                                 }
                                 return digest;
                               });
  published.links = std::move(links).publish(
      [&](LinkState& link, std::size_t l) { link.hash = hash_of(link, plan, l); },
      [&](const auto& items, std::size_t first) {
        LinkDigest digest{.hash = hash_of_items(items), .has_failure = false, .is_at_work = false, .is_stuck = false};
        for (std::size_t k = 0; k < items.size() && items[k]; ++k) {
          digest.has_failure |= fails(*items[k], plan.links[first + k]);
          digest.is_at_work |= is_working(*items[k], plan.links[first + k]);
          digest.is_stuck |= items[k]->is_stuck;
        }
        return digest;
      });
  return published;
}

std::optional<Error> first_failure(const State& state) {
  if (const auto n = first_in(
          state.nodes, [](const NodeDigest& d) { return d.has_failure; },
          [&](std::size_t i) { return state.nodes[i].has_failure; }))
    for (const TypeState& type : state.nodes[*n].types)
      if (type.error) return type.error;
  const auto l = first_in(
      state.links, [](const LinkDigest& d) { return d.has_failure; },
      [&](std::size_t i) { return fails(state.links[i], state.plan->links[i]); });
  return l ? state.links[*l].error : std::nullopt;
}

bool has_failure(const State& state) { return first_failure(state).has_value(); }

bool is_at_work(const State& state, std::size_t link) { return is_working(state.links[link], state.plan->links[link]); }

std::optional<Error> first_work(const State& state) {
  const auto l = first_in(
      state.links, [](const LinkDigest& d) { return d.is_at_work; }, [&](std::size_t i) { return is_at_work(state, i); });
  return l ? state.links[*l].work : std::nullopt;
}

double largest_residual_of(const State& state) {
  double largest = 0;
  for (std::size_t leaf = 0; leaf < state.nodes.leaf_count(); ++leaf)
    largest = std::max(largest, state.nodes.digest(leaf).residual);
  return largest;
}

std::uint64_t hash_of(const State& state) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(state.tick));
  hash.add(static_cast<std::uint64_t>(state.calm));
  for (std::size_t leaf = 0; leaf < state.nodes.leaf_count(); ++leaf) hash.add(state.nodes.digest(leaf).hash);
  for (std::size_t leaf = 0; leaf < state.links.leaf_count(); ++leaf) hash.add(state.links.digest(leaf).hash);
  for (const AnalysisState& analysis : state.analyses) {
    for (const std::int64_t tick : {analysis.as_of, analysis.taken, analysis.begun, analysis.due})
      hash.add(static_cast<std::uint64_t>(tick));
    hash.add(analysis.inputs);
    hash.add(analysis.running_inputs);
  }
  return hash.value();
}

}  // namespace bl
