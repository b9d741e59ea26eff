// Goes by the definitions of a plan, which are the same objects wherever nodes have the same typifications.
#include "core/graph/port_finder.h"

#include <algorithm>
#include <string>

namespace bl {

namespace {

// Where the tags of nodes are.
struct TagPort {
  const TypificationDefinition* base = nullptr;
  std::size_t port = 0;
};

TagPort tag_port(const Registry& registry) {
  const TypificationDefinition* base = registry.typification(std::string(kBaseNode));
  return {base, base == nullptr ? 0 : base->port_index("tags")};
}

const TypePlan* type_of(const NodePlan& node, const TypificationDefinition* definition) {
  for (const TypePlan& type : node.types)
    if (type.definition == definition) return &type;
  return nullptr;
}

}  // namespace

std::optional<PortRef> PortFinder::at(std::uint32_t node) {
  const std::vector<TypePlan>& types = plan_->nodes[node].types;
  const bool is_alike = !searched_.empty() &&
                        std::equal(types.begin(), types.end(), searched_.begin(), searched_.end(),
                                   [](const TypePlan& type, const auto* definition) { return type.definition == definition; });
  if (!is_alike) {
    searched_.clear();
    for (const TypePlan& type : types) searched_.push_back(type.definition);
    found_ = plan_->find(node, path_);
  }
  if (found_) found_->node = node;
  return found_;
}

PortPath actual_path(const TypeDefinition& definition, const PortPath& path, std::span<const Value> values) {
  if (path.chosen_by.empty()) return path;
  const std::string* text = std::get_if<std::string>(&values[definition.port_index(path.chosen_by)]);
  return parse_port_path(text ? *text : "").value_or(PortPath{});
}

std::vector<std::uint32_t> selected_nodes(const Plan& plan, const Registry& registry, const Selection& selection) {
  std::vector<std::uint32_t> nodes;
  const TypificationDefinition* type = registry.typification(selection.typification);
  const TagPort tags = tag_port(registry);
  const bool is_known = selection.is_query() && tags.base != nullptr && (type != nullptr || selection.typification.empty());
  if (!is_known) {
    for (const std::string& id : resolve(plan.scene, registry, selection)) nodes.push_back(plan.node_index(id));
    return nodes;
  }
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    const NodePlan& node = plan.nodes[n];
    if (type != nullptr && type_of(node, type) == nullptr) continue;
    if (!selection.tag.empty()) {
      const TypePlan* base = type_of(node, tags.base);
      if (base == nullptr) continue;
      const auto& list = *std::get<Shared<std::vector<std::string>>>(base->set_values[tags.port]);
      if (std::find(list.begin(), list.end(), selection.tag) == list.end()) continue;
    }
    nodes.push_back(n);
  }
  return nodes;
}

Result<void> check_kind(const Plan& plan, PortRef ref, ValueKind expected, const MadeType& made, const char* verb) {
  const PortDefinition& port = plan.port(ref);
  if (can_read(expected, port.kind) && port.made == made) return {};
  return Error{ErrorCode::wrong_kind, "",
               "the " + std::string(verb) + " " + std::string(kind_text(expected, made)) + ", but `" + plan.path_text(ref) +
                   "` holds " + std::string(kind_text(port.kind, port.made))};
}

}  // namespace bl
