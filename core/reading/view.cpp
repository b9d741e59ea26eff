// Finds the ports of views in plans, and reads rows from states and scenes.
#include "core/reading/view.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace bl::reading {

namespace {

std::size_t type_index(const NodePlan& node, std::string_view typification) {
  const auto found = std::find_if(node.types.begin(), node.types.end(),
                                  [&](const TypePlan& type) { return type.definition->id == typification; });
  return static_cast<std::size_t>(found - node.types.begin());
}

[[noreturn]] void end_for(const ViewDefinition& view, const ViewRead& read) {
  std::fprintf(stderr, "behaviourlinks: the view `%s` shows `%s.%s`, and there is no such port\n", view.name.c_str(),
               read.path.typification.c_str(), read.path.port.c_str());
  std::abort();
}

// The indices of a view's ports in their definitions: the same for all of its nodes.
std::vector<std::uint16_t> port_indices(const ViewDefinition& view, const NodePlan& node) {
  std::vector<std::uint16_t> indices;
  for (const ViewRead& read : view.reads) {
    const std::size_t type = type_index(node, read.path.typification);
    const std::size_t port = type < node.types.size() ? node.types[type].definition->port_index(read.path.port) : 0;
    if (type == node.types.size() || port == node.types[type].definition->ports.size()) end_for(view, read);
    indices.push_back(static_cast<std::uint16_t>(port));
  }
  return indices;
}

ViewPorts find_ports(const ViewDefinition& view, const Plan& plan) {
  ViewPorts found;
  std::vector<std::uint16_t> indices;
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    const NodePlan& node = plan.nodes[n];
    const std::size_t own = type_index(node, view.type);
    if (own == node.types.size()) continue;
    if (found.nodes.empty()) indices = port_indices(view, node);
    found.nodes.push_back(n);
    const std::size_t base = type_index(node, kBaseNode);
    for (std::size_t r = 0; r < view.reads.size(); ++r) {
      const std::size_t type = view.reads[r].path.typification == view.type ? own : base;
      found.ports.push_back({n, static_cast<std::uint16_t>(type), indices[r]});
    }
  }
  return found;
}

}  // namespace

std::size_t ViewPorts::row_of(std::uint32_t node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found != nodes.end() && *found == node ? static_cast<std::size_t>(found - nodes.begin()) : nodes.size();
}

std::shared_ptr<const ViewPorts> ports_of(const ViewDefinition& view, const Plan& plan) {
  return plan.memo->of<ViewPorts>(&view, [&] { return find_ports(view, plan); });
}

void fill_row(const ViewDefinition& view, const State& state, const ViewPorts& ports, std::size_t row, void* figures) {
  for (std::size_t r = 0; r < view.reads.size(); ++r) {
    const PortRef ref = ports.ports[row * view.reads.size() + r];
    const TypeState& type = state.nodes[ref.node].types[ref.type];
    if (view.reads[r].is_tension) {
      const Value tension = type.tension[ref.port];
      const Value* value = &tension;
      view.reads[r].assign(figures, std::span(&value, 1));
    } else {
      const Value* value = &type.values[ref.port];
      view.reads[r].assign(figures, std::span(&value, 1));
    }
  }
}

const Value* setting_of(const ViewDefinition& view, std::size_t read, const Scene& scene, const NodeRecord& node,
                        const Registry& registry) {
  if (!node.types.contains(view.type) || registry.typification(view.type) == nullptr) return nullptr;
  const PortPath& path = view.reads[read].path;
  const TypificationDefinition* type = registry.typification(path.typification);
  const PortDefinition* port = type == nullptr ? nullptr : type->find_port(path.port);
  if (port == nullptr) end_for(view, view.reads[read]);
  return &set_value(scene, node, *type, *port);
}

bool fill_settings(const ViewDefinition& view, const Scene& scene, const NodeRecord& node, const Registry& registry,
                   void* figures) {
  for (std::size_t read = 0; read < view.reads.size(); ++read) {
    if (view.reads[read].is_tension) continue;  // nobody has proposed anything yet
    const Value* value = setting_of(view, read, scene, node, registry);
    if (value == nullptr) return false;
    view.reads[read].assign(figures, std::span(&value, 1));
  }
  return true;
}

bool fill_parameters(const ViewDefinition& view, const LinkPlan& link, void* figures) {
  if (link.definition == nullptr || link.definition->id != view.type) return false;
  for (const ViewRead& read : view.reads) {
    const PortDefinition* parameter = link.definition->find_port(read.path.port);
    if (parameter == nullptr) end_for(view, read);
    const Value held = parameter->get(link.parameters.get());
    const Value* value = &held;
    read.assign(figures, std::span(&value, 1));
  }
  return true;
}

bool fill_parameters(const ViewDefinition& view, const LinkRecord& link, const Registry& registry, void* figures) {
  const LinkDefinition* kind = link.ghost.empty() && link.kind == view.type ? registry.link(view.type) : nullptr;
  if (kind == nullptr) return false;
  for (const ViewRead& read : view.reads) {
    const PortDefinition* parameter = kind->find_port(read.path.port);
    if (parameter == nullptr) end_for(view, read);
    const auto said = link.parameters.find(parameter->id);
    const Value* value = said != link.parameters.end() ? &said->second : &parameter->default_value;
    read.assign(figures, std::span(&value, 1));
  }
  return true;
}

std::size_t read_index(const ViewDefinition& view, std::ptrdiff_t member) {
  const auto found =
      std::find_if(view.reads.begin(), view.reads.end(), [&](const ViewRead& read) { return read.member == member; });
  if (found == view.reads.end()) {
    std::fprintf(stderr, "behaviourlinks: the view `%s` does not declare the member that is asked for\n", view.name.c_str());
    std::abort();
  }
  return static_cast<std::size_t>(found - view.reads.begin());
}

const ViewList& all_views() {
  static const ViewList list = [] {
    ViewList made;
    register_views(made);
    return made;
  }();
  return list;
}

}  // namespace bl::reading
