// Merges the settings of what is chosen, and keeps the voices on them for as long as a state lasts.
#include <algorithm>

#include "core/define/codec.h"
#include "ui/desktop/panels/inspector.h"

namespace bl::desktop {

namespace {

SharedPort first_of(const PortDefinition& port, Unit unit, const Value& value, bool is_default) {
  return {&port, unit, value, false, is_default, false, false};
}

void add(SharedPort& shared, Unit unit, const Value& value, bool is_default) {
  if (!shared.is_mixed && !(value == shared.value && unit == shared.unit)) shared.is_mixed = true;
  shared.is_default = shared.is_default && is_default;
}

// Nobody has said anything, or no more than the default.
bool is_default(const PortValues& values, const PortDefinition& port) {
  const auto found = values.find(port.id);
  return found == values.end() || !is_kept(port, found->second);
}

const Value& parameter_of(const LinkRecord& link, const PortDefinition& port) {
  const auto found = link.parameters.find(port.id);
  return found == link.parameters.end() ? port.default_value : found->second;
}

// The unit of a parameter whose unit another one names: the unit of the port that is chosen there. Where that in turn depends on
// the node, the first node of the scene's end decides.
Unit unit_of_parameter(const Workbench& editor, const LinkDefinition& kind, const LinkRecord& link, const PortDefinition& port) {
  const PortDefinition* namer = port.unit_from.empty() ? nullptr : kind.find_port(port.unit_from);
  if (namer == nullptr) return port.unit;
  const auto* text = std::get_if<std::string>(&parameter_of(link, *namer));
  if (text == nullptr) return port.unit;
  const auto path = parse_port_path(*text);
  if (!path) {
    const UnitInfo* row = find_unit(*text);
    return row != nullptr ? row->unit : Unit::none;
  }
  const TypificationDefinition* type = editor.types().typification(path->typification);
  const PortDefinition* chosen = type != nullptr ? type->find_port(path->port) : nullptr;
  if (chosen == nullptr) return Unit::none;
  for (const Selection* end : {&link.from, &link.to})
    for (const std::string& id : end->ids)
      if (const auto node = editor.scene().nodes.find(id);
          node != editor.scene().nodes.end() && node->second.types.contains(type->id))
        return unit_of(editor.types(), node->second, *type, *chosen);
  return chosen->unit;
}

}  // namespace

void InspectorView::refresh(Workbench& editor, const Picks& shown) {
  const std::size_t log_size = editor.document->running().log().size();
  if (editor.moment->state != state_) {
    state_ = editor.moment->state;
    pulls_.clear();
  }
  if (log_size == log_size_ && asked_nodes_ == shown.nodes && asked_links_ == shown.links) return;
  log_size_ = log_size;
  asked_nodes_ = shown.nodes;
  asked_links_ = shown.links;
  nodes_.clear();
  links_.clear();
  for (const std::string& id : shown.nodes)
    if (editor.scene().nodes.contains(id)) nodes_.push_back(id);
  for (const std::string& id : shown.links)
    if (editor.scene().links.contains(id)) links_.push_back(id);
  merge_nodes(editor);
  merge_links(editor);
}

void InspectorView::merge_nodes(const Workbench& editor) {
  types_.clear();
  if (nodes_.empty()) return;
  const Scene& scene = editor.scene();
  const NodeRecord& first = scene.nodes.at(nodes_.front());
  for (const auto& [id, values] : first.types) {
    const bool is_shared = std::all_of(nodes_.begin(), nodes_.end(),
                                       [&, &type = id](const std::string& n) { return scene.nodes.at(n).types.contains(type); });
    const TypificationDefinition* type = editor.types().typification(id);
    if (!is_shared || type == nullptr) continue;
    SharedType shared{type, {}};
    for (const PortDefinition& port : type->ports) {
      if (port.is_computed || port.of_scene == OfScene::always) continue;
      SharedPort setting = first_of(port, unit_of(editor.types(), first, *type, port), set_value(scene, first, *type, port),
                                    is_default(first.types.at(type->id), port));
      std::size_t locked = 0;
      for (const std::string& n : nodes_) {
        const NodeRecord& node = scene.nodes.at(n);
        add(setting, unit_of(editor.types(), node, *type, port), set_value(scene, node, *type, port),
            is_default(node.types.at(type->id), port));
        if (node.locked.contains(type->id + "." + port.id)) ++locked;
      }
      setting.is_locked = locked == nodes_.size();
      setting.is_partly_locked = locked > 0 && !setting.is_locked;
      shared.settings.push_back(std::move(setting));
    }
    // What every node is comes first.
    if (id == kBaseNode) types_.insert(types_.begin(), std::move(shared));
    else types_.push_back(std::move(shared));
  }
}

void InspectorView::merge_links(const Workbench& editor) {
  kind_ = nullptr;
  parameters_.clear();
  if (links_.empty()) return;
  const Scene& scene = editor.scene();
  const LinkRecord& first = scene.links.at(links_.front());
  const bool is_one_kind = std::all_of(links_.begin(), links_.end(), [&](const std::string& l) {
    const LinkRecord& link = scene.links.at(l);
    return link.kind == first.kind && link.ghost.empty();
  });
  kind_ = is_one_kind ? editor.types().link(first.kind) : nullptr;
  if (kind_ == nullptr) return;
  for (const PortDefinition& port : kind_->ports) {
    SharedPort shared = first_of(port, unit_of_parameter(editor, *kind_, first, port), parameter_of(first, port),
                                 is_default(first.parameters, port));
    for (const std::string& l : links_) {
      const LinkRecord& link = scene.links.at(l);
      add(shared, unit_of_parameter(editor, *kind_, link, port), parameter_of(link, port), is_default(link.parameters, port));
    }
    parameters_.push_back(std::move(shared));
  }
}

const std::vector<std::size_t>& InspectorView::touching(const State& state) {
  if (touched_plan_ == state.plan && touched_node_ == nodes_.front()) return touching_;
  touched_plan_ = state.plan;
  touched_node_ = nodes_.front();
  touching_.clear();
  const std::uint32_t node = state.plan->node_index(touched_node_);
  for (std::size_t l = 0; l < state.plan->links.size(); ++l)
    for (const auto& end : state.plan->links[l].nodes)
      if (std::binary_search(end.begin(), end.end(), node)) {
        touching_.push_back(l);
        break;
      }
  return touching_;
}

const reading::ConflictRow& InspectorView::pulls(const State& state, PortRef ref) {
  const auto found = pulls_.find(ref);
  if (found != pulls_.end()) return found->second;
  const double tension = state.nodes[ref.node].types[ref.type].tension[ref.port];
  return pulls_.emplace(ref, reading::conflict_row(state, {ref, tension, reading::severity_of(state, ref, tension)}))
      .first->second;
}

}  // namespace bl::desktop
