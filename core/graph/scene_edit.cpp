// Each change of a scene, with the place that it touches.
#include "core/graph/scene_edit.h"

#include "core/base/near_names.h"
#include "core/define/codec.h"
#include "core/graph/table_differences.h"

namespace bl {

void SceneEdit::touch(ScenePart part, const std::string& id, std::string path) {
  is_logic_touched_ = is_logic_touched_ || part != ScenePart::view;
  touches_.push_back({part, id, std::move(path)});
}

Result<const NodeRecord*> SceneEdit::node(const std::string& id) const {
  const auto it = scene_->nodes.find(id);
  if (it != scene_->nodes.end()) return &it->second;
  return Error{ErrorCode::not_found, "nodes/" + id, "there is no node `" + id + "`" + did_you_mean_among(id, scene_->nodes)};
}

Result<const LinkRecord*> SceneEdit::link(const std::string& id) const {
  const auto it = scene_->links.find(id);
  if (it != scene_->links.end()) return &it->second;
  return Error{ErrorCode::not_found, "links/" + id, "there is no link `" + id + "`" + did_you_mean_among(id, scene_->links)};
}

NodeRecord& SceneEdit::own_node(const std::string& id) {
  past_nodes_.push_back(scene_->nodes);
  return scene_->nodes.edit(id);
}

LinkRecord& SceneEdit::own_link(const std::string& id) {
  past_links_.push_back(scene_->links);
  return scene_->links.edit(id);
}

void SceneEdit::add_node(const std::string& id, NodeRecord node) {
  note_names(id, node);
  if (scene_->nodes.emplace(id, std::move(node))) touch(ScenePart::node, id);
}

void SceneEdit::remove_node(const std::string& id) {
  past_nodes_.push_back(scene_->nodes);
  if (scene_->nodes.erase(id) > 0) touch(ScenePart::node, id);
}

void SceneEdit::set_name(const std::string& node, const std::string& name) {
  NodeRecord& record = own_node(node);
  if (record.name == name) return;
  record.name = name;
  touch(ScenePart::node, node, "name");
}

void SceneEdit::add_type(const std::string& node, const std::string& type, PortValues values) {
  for (const auto& [port, value] : values) note_names(node, value);
  if (own_node(node).types.emplace(type, std::move(values)).second) touch(ScenePart::node, node, "types/" + type);
}

void SceneEdit::remove_type(const std::string& node, const std::string& type) {
  if (own_node(node).types.erase(type) > 0) touch(ScenePart::node, node, "types/" + type);
}

bool SceneEdit::put(PortValues& values, const PortDefinition& port, const Value& value) {
  if (!is_kept(port, value)) return values.erase(port.id) > 0;
  const auto [place, is_new] = values.try_emplace(port.id, value);
  if (is_new) return true;
  if (place->second == value) return false;
  place->second = value;
  return true;
}

void SceneEdit::set_value(const std::string& node, const std::string& type, const PortDefinition& port, const Value& value) {
  note_names(node, value);
  PortValues& values = own_node(node).types.at(type);
  const auto old = values.find(port.id);
  const Value before = old == values.end() ? port.default_value : old->second;
  if (put(values, port, value)) touch_port(node, type, port, before, value);
}

void SceneEdit::erase_value(const std::string& node, const std::string& type, const PortDefinition& port) {
  PortValues& values = own_node(node).types.at(type);
  const auto old = values.find(port.id);
  if (old == values.end()) return;
  const Value before = old->second;
  values.erase(old);
  touch_port(node, type, port, before, port.default_value);
}

void SceneEdit::touch_port(const std::string& node, const std::string& type, const PortDefinition& port, const Value& before,
                           const Value& after) {
  const std::string path = "types/" + type + "/" + port.id;
  std::vector<TableDifference> inner;
  if (port.kind == ValueKind::table)
    inner = table_differences(port, *std::get<Shared<Table>>(before), *std::get<Shared<Table>>(after));
  // A default that is said, or said no more, is a change of the port as a whole.
  if (inner.empty()) inner.emplace_back();
  for (const TableDifference& one : inner) touch(ScenePart::node, node, one.is_whole() ? path : path + "/" + one.path());
}

bool SceneEdit::set_locked(const std::string& node, const std::string& path, bool is_locked) {
  std::set<std::string>& locked = own_node(node).locked;
  const bool is_changed = is_locked ? locked.insert(path).second : locked.erase(path) > 0;
  if (is_changed) touch(ScenePart::node, node, "locked/" + path);
  return is_changed;
}

void SceneEdit::add_link(const std::string& id, LinkRecord link) {
  note_names(id, link);
  if (scene_->links.emplace(id, std::move(link))) touch(ScenePart::link, id);
}

void SceneEdit::remove_link(const std::string& id) {
  past_links_.push_back(scene_->links);
  if (scene_->links.erase(id) > 0) touch(ScenePart::link, id);
}

void SceneEdit::change_link(const std::string& id, LinkRecord link) {
  note_names(id, link);
  LinkRecord& old = own_link(id);
  if (old.kind != link.kind || old.ghost != link.ghost) {
    touch(ScenePart::link, id);
  } else {
    if (old.from != link.from) touch(ScenePart::link, id, "from");
    if (old.to != link.to) touch(ScenePart::link, id, "to");
    if (old.is_enabled != link.is_enabled) touch(ScenePart::link, id, "enabled");
    if (old.is_muted != link.is_muted) touch(ScenePart::link, id, "muted");
    if (old.strength != link.strength) touch(ScenePart::link, id, "strength");
    for (const auto& [port, value] : old.parameters)
      if (!link.parameters.contains(port)) touch(ScenePart::link, id, "parameters/" + port);
    for (const auto& [port, value] : link.parameters)
      if (const auto before = old.parameters.find(port); before == old.parameters.end() || before->second != value)
        touch(ScenePart::link, id, "parameters/" + port);
  }
  old = std::move(link);
}

void SceneEdit::set_setting(const PortDefinition& port, const Value& value) {
  if (put(scene_->settings, port, value)) touch(ScenePart::setting, port.id);
}

void SceneEdit::erase_setting(const std::string& port) {
  if (scene_->settings.erase(port) > 0) touch(ScenePart::setting, port);
}

void SceneEdit::set_scripts(Scripts scripts) {
  const auto &before = scene_->scripts.texts(), &after = scripts.texts();
  for (const auto& [name, text] : before)
    if (!after.contains(name)) touch(ScenePart::script, name);
  for (const auto& [name, text] : after)
    if (const auto old = before.find(name); old == before.end() || old->second != text) touch(ScenePart::script, name);
  scene_->scripts = std::move(scripts);
}

void SceneEdit::set_view(std::string view, const std::vector<std::string>& paths) {
  if (view == scene_->view) return;
  for (const std::string& path : paths) touch(ScenePart::view, "", path);
  scene_->view = std::move(view);
}

const Namers& SceneEdit::namers() {
  auto& namers = namers_slot();
  if (!namers) namers.emplace(*scene_);
  return *namers;
}

}  // namespace bl
