// Packs leaf by leaf, as states share their nodes and links.
#include "core/graph/packed_state.h"

#include <algorithm>
#include <utility>

namespace bl {

std::uint32_t TextPool::number_of(const std::string& text) {
  const auto [place, is_new] = numbers_.try_emplace(text, static_cast<std::uint32_t>(texts_.size()));
  if (is_new) texts_.push_back(&place->first);
  return place->second;
}

void PackedValues::add(const Value& value, TextPool& pool) {
  if (const auto* number = std::get_if<double>(&value)) {
    kinds_.push_back(Kind::number);
    numbers_.push_back(*number);
  } else if (const auto* point = std::get_if<Vector3>(&value)) {
    kinds_.push_back(Kind::point);
    numbers_.insert(numbers_.end(), {point->x, point->y, point->z});
  } else if (const auto* table = std::get_if<Shared<Table>>(&value)) {
    add_table(**table, pool);
  } else {
    kinds_.push_back(Kind::other);
    others_.push_back(value);
  }
}

void PackedValues::add_table(const Table& table, TextPool& pool) {
  kinds_.push_back(Kind::table);
  std::size_t heading = 0;
  while (heading < headings_.size() && headings_[heading]->columns != table.columns) ++heading;
  if (heading == headings_.size()) headings_.push_back(Table{table.columns, {}});
  wholes_.push_back(static_cast<std::uint32_t>(heading));
  wholes_.push_back(static_cast<std::uint32_t>(table.rows.size()));
  for (const TableRow& row : table.rows) {
    wholes_.push_back(static_cast<std::uint32_t>(row.size()));
    for (const auto& cell : row) {
      if (const auto* number = std::get_if<double>(&cell)) {
        kinds_.push_back(Kind::number);
        numbers_.push_back(*number);
      } else if (const auto* text = std::get_if<std::string>(&cell)) {
        kinds_.push_back(Kind::text);
        wholes_.push_back(pool.number_of(*text));
      } else {
        kinds_.push_back(Kind::other);
        lists_.push_back(cell);
      }
    }
  }
}

std::vector<Value> PackedValues::values(const TextPool& pool) const {
  std::vector<Value> values;
  auto kind = kinds_.begin();
  auto number = numbers_.begin();
  auto whole = wholes_.begin();
  auto list = lists_.begin();
  auto other = others_.begin();
  while (kind != kinds_.end()) {
    switch (*kind++) {
      case Kind::number: values.emplace_back(*number++); break;
      case Kind::point:
        values.emplace_back(Vector3{number[0], number[1], number[2]});
        number += 3;
        break;
      case Kind::table: {
        Table table = *headings_[*whole++];
        table.rows.resize(*whole++);
        for (TableRow& row : table.rows)
          for (std::uint32_t cells = *whole++; cells > 0; --cells) {
            const Kind cell = *kind++;
            if (cell == Kind::number) row.emplace_back(*number++);
            else if (cell == Kind::text) row.emplace_back(pool.text(*whole++));
            else row.push_back(*list++);
          }
        values.emplace_back(Shared(std::move(table)));
        break;
      }
      default: values.push_back(*other++);
    }
  }
  return values;
}

void PackedValues::shrink() {
  kinds_.shrink_to_fit();
  numbers_.shrink_to_fit();
  wholes_.shrink_to_fit();
  lists_.shrink_to_fit();
  others_.shrink_to_fit();
}

std::size_t PackedValues::bytes() const {
  // What a text or a list takes beside itself, on average.
  constexpr std::size_t kContent = 64;
  return kinds_.size() * sizeof(Kind) + numbers_.size() * sizeof(double) + wholes_.size() * sizeof(std::uint32_t) +
         (others_.size() + lists_.size() + headings_.size()) * (sizeof(Value) + kContent);
}

std::size_t PackedState::Leaf::bytes() const {
  return sizeof(Leaf) + links.size() * sizeof(std::uint32_t) + values.bytes() + failures.size() * sizeof(Failure);
}

PackedState::Leaf PackedState::packed_nodes(const State& state, std::size_t leaf, std::vector<PortRef>& ports) {
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
        ports.push_back({n, t, p});
        packed.values.add(value, *pool_);
      }
    }
  }
  return packed;
}

PackedState::Leaf PackedState::packed_links(const State& state, std::size_t leaf, std::vector<PortRef>& ports) {
  constexpr std::size_t kLeaf = LinkStates::kLeaf;
  Leaf packed;
  const std::size_t end = std::min(state.links.size(), (leaf + 1) * kLeaf);
  for (auto l = static_cast<std::uint32_t>(leaf * kLeaf); l < end; ++l) {
    const LinkState& link = state.links[l];
    if (link.has_failed() && !state.plan->links[l].error) packed.failures.push_back({l, 0, *link.error});
    for (const Voice& voice : link.voices) {
      if (!is_lasting(state, voice)) continue;
      ports.push_back(voice.target);
      packed.links.push_back(l);
      packed.values.add(voice.value, *pool_);
    }
  }
  return packed;
}

void PackedState::keep(Leaves& leaves, Leaf&& leaf, std::vector<PortRef>&& ports, const Leaves* before) {
  const std::size_t at = leaves.size();
  if (before != nullptr && at < before->size() && *(*before)[at]->ports == ports) {
    leaf.ports = (*before)[at]->ports;
  } else {
    ports.shrink_to_fit();
    bytes_ += ports.size() * sizeof(PortRef);
    leaf.ports = std::make_shared<const std::vector<PortRef>>(std::move(ports));
  }
  leaf.links.shrink_to_fit();
  leaf.values.shrink();
  bytes_ += leaf.bytes();
  leaves.push_back(std::make_shared<const Leaf>(std::move(leaf)));
}

PackedState::PackedState(const State& state, const State* before, const PackedState* packed_before)
    : tick_(state.tick),
      calm_(state.calm),
      plan_(state.plan),
      pool_(packed_before != nullptr ? packed_before->pool_ : std::make_shared<TextPool>()),
      analyses_(state.analyses) {
  const bool has_same_nodes = before != nullptr && before->plan->dependents->sets == plan_->dependents->sets;
  const bool has_same_links = before != nullptr && before->plan->dependents == plan_->dependents;
  for (std::size_t leaf = 0; leaf < state.nodes.leaf_count(); ++leaf) {
    if (has_same_nodes && state.nodes.shares_leaf(before->nodes, leaf)) {
      nodes_.push_back(packed_before->nodes_[leaf]);
    } else {
      std::vector<PortRef> ports;
      Leaf packed = packed_nodes(state, leaf, ports);
      keep(nodes_, std::move(packed), std::move(ports), packed_before != nullptr ? &packed_before->nodes_ : nullptr);
    }
  }
  for (std::size_t leaf = 0; leaf < state.links.leaf_count(); ++leaf) {
    if (has_same_links && state.links.shares_leaf(before->links, leaf)) {
      links_.push_back(packed_before->links_[leaf]);
    } else {
      std::vector<PortRef> ports;
      Leaf packed = packed_links(state, leaf, ports);
      keep(links_, std::move(packed), std::move(ports), packed_before != nullptr ? &packed_before->links_ : nullptr);
    }
  }
  // What a failing solver leaves standing cannot be made again from inputs that it refuses.
  for (const SetPlan& set : plan_->sets)
    if (state.nodes[set.node].types[set.type].error)
      for (const PortRef& ref : set.writes)
        if (const auto* mesh = std::get_if<MeshPointer>(&state.value(ref)); mesh != nullptr && *mesh)
          meshes_.emplace_back(ref, *mesh);
  bytes_ += sizeof(PackedState) + (nodes_.size() + links_.size()) * sizeof(nodes_[0]) + meshes_.size() * sizeof(meshes_[0]) +
            analyses_.size() * sizeof(AnalysisState);
}

SavedState PackedState::saved() const {
  SavedState saved{
      .tick = tick_, .calm = calm_, .nodes = {}, .voices = {}, .errors = {}, .link_errors = {}, .analyses = {}, .meshes = {}};
  const Plan& plan = *plan_;
  for (const auto& leaf : nodes_) {
    std::vector<Value> values = leaf->values.values(*pool_);
    for (std::size_t i = 0; i < values.size(); ++i)
      saved.nodes[plan.nodes[(*leaf->ports)[i].node].id][plan.path_text((*leaf->ports)[i])] = std::move(values[i]);
    for (const Failure& failure : leaf->failures) {
      const NodePlan& node = plan.nodes[failure.item];
      saved.errors[{node.id, node.types[failure.type].definition->id}] = failure.error;
    }
  }
  for (const auto& leaf : links_) {
    std::vector<Value> values = leaf->values.values(*pool_);
    for (std::size_t i = 0; i < values.size(); ++i)
      saved.voices[plan.links[leaf->links[i]].id].push_back(
          {plan.nodes[(*leaf->ports)[i].node].id, plan.path_text((*leaf->ports)[i]), std::move(values[i])});
    for (const Failure& failure : leaf->failures) saved.link_errors[plan.links[failure.item].id] = failure.error;
  }
  for (const auto& [ref, mesh] : meshes_) saved.meshes[{plan.nodes[ref.node].id, plan.path_text(ref)}] = mesh;
  return saved;
}

}  // namespace bl
