// Compiling a scene: resolving ends, ports and units once, so that a tick only follows indices.
#include "core/graph/plan.h"

#include <algorithm>

#include "core/graph/link_compiler.h"
#include "core/graph/node_compiler.h"

namespace bl {

std::uint32_t Plan::node_index(std::string_view id) const {
  const auto it =
      std::lower_bound(nodes.begin(), nodes.end(), id, [](const NodePlan& node, std::string_view key) { return node.id < key; });
  return static_cast<std::uint32_t>(it != nodes.end() && it->id == id ? it - nodes.begin() : nodes.end() - nodes.begin());
}

std::optional<PortRef> Plan::find(std::uint32_t node, const PortPath& path) const {
  if (path.typification == kBaseNode && path.port == "id") return PortRef{node, PortRef::kNodeId, 0};
  const auto& types = forms->types_of(node);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const TypificationDefinition& definition = *types[t];
    if (definition.id != path.typification &&
        std::find(definition.aliases.begin(), definition.aliases.end(), path.typification) == definition.aliases.end())
      continue;
    const std::size_t port = definition.port_index(path.port);
    if (port < definition.ports.size()) return PortRef{node, static_cast<std::uint16_t>(t), static_cast<std::uint16_t>(port)};
  }
  return std::nullopt;
}

std::string Plan::path_text(PortRef ref) const {
  if (ref.type == PortRef::kNodeId) return "node.id";
  return forms->types_of(ref.node)[ref.type]->id + "." + port(ref).id;
}

std::shared_ptr<const NodeForms> forms_of(const SharedItems<NodePlan>& nodes) {
  NodeForms forms;
  forms.of.reserve(nodes.size());
  for (const NodePlan& node : nodes) {
    const auto is_form = [&](const auto& types) {
      return std::equal(types.begin(), types.end(), node.types.begin(), node.types.end(),
                        [](const auto* definition, const TypePlan& type) { return definition == type.definition; });
    };
    // Most nodes are of the form of the one before.
    std::uint32_t form = forms.of.empty() ? 0 : forms.of.back();
    if (forms.types.empty() || !is_form(forms.types[form]))
      form = static_cast<std::uint32_t>(std::find_if(forms.types.begin(), forms.types.end(), is_form) - forms.types.begin());
    if (form == forms.types.size()) {
      auto& types = forms.types.emplace_back();
      for (const TypePlan& type : node.types) types.push_back(type.definition);
    }
    forms.of.push_back(form);
  }
  return std::make_shared<const NodeForms>(std::move(forms));
}

std::shared_ptr<const Plan> compile(const Scene& scene, const Registry& program) {
  auto plan = std::make_shared<Plan>();
  plan->scene = scene;
  plan->settings = settings_of(scene);
  const Registry& registry = plan->scene.scripts.types(program);  // kept alive by the plan's scene
  std::vector<NodePlan> nodes;
  for (const auto& [id, record] : plan->scene.nodes) nodes.push_back(compiled_node(plan->scene, registry, id, record));
  plan->nodes = published<NodePlan>(SharedItems<NodePlan>::Draft(std::move(nodes)));
  plan->forms = forms_of(plan->nodes);
  const LinkCompiler compiler(*plan, registry);
  std::vector<LinkPlan> links;
  for (const auto& [id, record] : plan->scene.links) links.push_back(compiler.compiled(id, record));
  plan->links = published<LinkPlan>(SharedItems<LinkPlan>::Draft(std::move(links)));
  put_sets(*plan, [&](std::uint32_t n, std::uint32_t t, std::uint32_t s) { return compiled_set(*plan, registry, n, t, s); });
  (void)mark_served(*plan);
  plan->dependents = dependents_of(*plan);
  return plan;
}

}  // namespace bl
