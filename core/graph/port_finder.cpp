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

}  // namespace

std::optional<PortRef> PortFinder::at(std::uint32_t node) {
  const std::uint32_t form = plan_->forms->of[node];
  if (searched_.empty() || searched_[last_].form != form) {
    last_ = static_cast<std::size_t>(
        std::find_if(searched_.begin(), searched_.end(), [&](const Searched& one) { return one.form == form; }) -
        searched_.begin());
    if (last_ == searched_.size()) searched_.push_back({form, plan_->find(node, path_)});
  }
  std::optional<PortRef> found = searched_[last_].found;
  if (found) found->node = node;
  return found;
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
  // By form: where its tags are, or kNone where its nodes are not meant.
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> tagged;
  for (const auto& types : plan.forms->types) {
    const auto base = std::find(types.begin(), types.end(), tags.base);
    const bool is_meant = (type == nullptr || std::find(types.begin(), types.end(), type) != types.end()) &&
                          (selection.tag.empty() || base != types.end());
    tagged.push_back(is_meant ? static_cast<std::size_t>(base - types.begin()) : kNone);
  }
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    const std::size_t base = tagged[plan.forms->of[n]];
    if (base == kNone) continue;
    if (!selection.tag.empty()) {
      const auto& list = *std::get<Shared<std::vector<std::string>>>(plan.nodes[n].types[base].set_values[tags.port]);
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
