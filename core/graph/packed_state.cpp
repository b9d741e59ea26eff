// Packs leaf by leaf, as states share their nodes and links.
#include "core/graph/packed_state.h"

#include <algorithm>
#include <utility>

namespace bl {

void PackedValues::add(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    kinds_.push_back(Kind::number);
    numbers_.push_back(*number);
  } else if (const auto* point = std::get_if<Vector3>(&value)) {
    kinds_.push_back(Kind::point);
    numbers_.insert(numbers_.end(), {point->x, point->y, point->z});
  } else {
    kinds_.push_back(Kind::other);
    others_.push_back(value);
  }
}

std::vector<Value> PackedValues::values() const {
  std::vector<Value> values;
  auto number = numbers_.begin();
  auto other = others_.begin();
  for (const Kind kind : kinds_) {
    if (kind == Kind::other) {
      values.push_back(*other++);
    } else if (kind == Kind::number) {
      values.emplace_back(*number++);
    } else {
      values.emplace_back(Vector3{number[0], number[1], number[2]});
      number += 3;
    }
  }
  return values;
}

std::size_t PackedValues::bytes() const {
  // What a text or a list takes beside itself, on average.
  constexpr std::size_t kContent = 64;
  return kinds_.size() * sizeof(Kind) + numbers_.size() * sizeof(double) + others_.size() * (sizeof(Value) + kContent);
}

std::size_t PackedState::Leaf::bytes() const {
  return sizeof(Leaf) + ports.size() * sizeof(PortRef) + links.size() * sizeof(std::uint32_t) + values.bytes() +
         failures.size() * sizeof(Failure);
}

PackedState::Leaf PackedState::packed_nodes(const State& state, std::size_t leaf) {
  constexpr std::size_t kLeaf = NodeStates::kLeaf;
  Leaf packed;
  const std::size_t end = std::min(state.nodes.size(), (leaf + 1) * kLeaf);
  for (auto n = static_cast<std::uint32_t>(leaf * kLeaf); n < end; ++n) {
    const NodeState& node = state.nodes[n];
    for (std::uint16_t t = 0; t < node.types.size(); ++t) {
      const TypePlan& type = state.plan->nodes[n].types[t];
      if (node.types[t].error) packed.failures.push_back({n, t, *node.types[t].error});
      for (std::uint16_t p = 0; p < type.definition->ports.size(); ++p) {
        const Value& value = node.types[t].values[p];
        if (is_derived(type.definition->ports[p].kind) || value == type.set_values[p]) continue;
        packed.ports.push_back({n, t, p});
        packed.values.add(value);
      }
    }
  }
  return packed;
}

PackedState::Leaf PackedState::packed_links(const State& state, std::size_t leaf) {
  constexpr std::size_t kLeaf = LinkStates::kLeaf;
  Leaf packed;
  const std::size_t end = std::min(state.links.size(), (leaf + 1) * kLeaf);
  for (auto l = static_cast<std::uint32_t>(leaf * kLeaf); l < end; ++l) {
    const LinkState& link = state.links[l];
    if (link.has_failed() && !state.plan->links[l].error) packed.failures.push_back({l, 0, *link.error});
    for (const Voice& voice : link.voices) {
      if (!is_lasting(state, voice)) continue;
      packed.ports.push_back(voice.target);
      packed.links.push_back(l);
      packed.values.add(voice.value);
    }
  }
  return packed;
}

void PackedState::keep(Leaves& leaves, Leaf&& leaf) {
  bytes_ += leaf.bytes();
  leaves.push_back(std::make_shared<const Leaf>(std::move(leaf)));
}

PackedState::PackedState(const State& state, const State* before, const PackedState* packed_before)
    : tick_(state.tick), calm_(state.calm), plan_(state.plan), analyses_(state.analyses) {
  const bool has_same_nodes = before != nullptr && before->plan->dependents->sets == plan_->dependents->sets;
  const bool has_same_links = before != nullptr && before->plan->dependents == plan_->dependents;
  for (std::size_t leaf = 0; leaf < state.nodes.leaf_count(); ++leaf) {
    if (has_same_nodes && state.nodes.shares_leaf(before->nodes, leaf)) nodes_.push_back(packed_before->nodes_[leaf]);
    else keep(nodes_, packed_nodes(state, leaf));
  }
  for (std::size_t leaf = 0; leaf < state.links.leaf_count(); ++leaf) {
    if (has_same_links && state.links.shares_leaf(before->links, leaf)) links_.push_back(packed_before->links_[leaf]);
    else keep(links_, packed_links(state, leaf));
  }
  // What a failing solver leaves standing cannot be made again from inputs that it refuses.
  for (const SetPlan& set : plan_->sets)
    if (state.nodes[set.node].types[set.type].error)
      for (const PortRef& ref : set.writes)
        if (const auto* mesh = std::get_if<MeshPointer>(&state.value(ref)); mesh != nullptr && *mesh) meshes_.emplace_back(ref, *mesh);
  bytes_ += sizeof(PackedState) + (nodes_.size() + links_.size()) * sizeof(nodes_[0]) + meshes_.size() * sizeof(meshes_[0]) +
            analyses_.size() * sizeof(AnalysisState);
}

SavedState PackedState::saved() const {
  SavedState saved{.tick = tick_, .calm = calm_, .nodes = {}, .voices = {}, .errors = {}, .link_errors = {}, .analyses = {}, .meshes = {}};
  const Plan& plan = *plan_;
  for (const auto& leaf : nodes_) {
    std::vector<Value> values = leaf->values.values();
    for (std::size_t i = 0; i < values.size(); ++i)
      saved.nodes[plan.nodes[leaf->ports[i].node].id][plan.path_text(leaf->ports[i])] = std::move(values[i]);
    for (const Failure& failure : leaf->failures) {
      const NodePlan& node = plan.nodes[failure.item];
      saved.errors[{node.id, node.types[failure.type].definition->id}] = failure.error;
    }
  }
  for (const auto& leaf : links_) {
    std::vector<Value> values = leaf->values.values();
    for (std::size_t i = 0; i < values.size(); ++i)
      saved.voices[plan.links[leaf->links[i]].id].push_back(
          {plan.nodes[leaf->ports[i].node].id, plan.path_text(leaf->ports[i]), std::move(values[i])});
    for (const Failure& failure : leaf->failures) saved.link_errors[plan.links[failure.item].id] = failure.error;
  }
  for (const auto& [ref, mesh] : meshes_) saved.meshes[{plan.nodes[ref.node].id, plan.path_text(ref)}] = mesh;
  return saved;
}

}  // namespace bl
