// Nodes and links to JSON and back; ghosts are kept unchanged.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/near_names.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/scene_file.h"

namespace bl {

namespace {

const TypificationDefinition& base_node(const Registry& registry) { return *registry.typification(kBaseNode); }

// What a node has beside the ports of the base node.
constexpr std::string_view kNodeKeys[] = {"id", "name", "types", "locked"};

Result<void> check_node_keys(const Json& json, const TypeDefinition& base, const std::string& place) {
  const auto is_known = [&](const auto& field) {
    return std::ranges::find(kNodeKeys, field.first) != std::end(kNodeKeys) || base.find_port(field.first) != nullptr;
  };
  const auto& fields = json.get_ref<const Json::object_t&>();
  if (std::all_of(fields.begin(), fields.end(), is_known)) return {};
  std::vector<std::string> known(std::begin(kNodeKeys), std::end(kNodeKeys));
  for (const std::string& port : port_ids(base)) known.push_back(port);
  return check_keys(json, known, place);
}

Result<bool> flag_from_json(const Json& json, const std::string& place) {
  if (!json.is_boolean()) return Error{ErrorCode::wrong_kind, place, "expects true or false"};
  return json.get<bool>();
}

Result<void> read_types(const Json& types, const Registry& registry, const std::string& place, NodeRecord& node) {
  if (!types.is_object()) return Error{ErrorCode::wrong_kind, place, "expects {\"typification\": {\"port\": value, ...}, ...}"};
  for (const auto& [id, content] : types.items()) {
    const std::string here = place + "/" + id;
    const TypificationDefinition* type = registry.typification(id);
    if (type == nullptr) {
      if (!content.is_object()) return Error{ErrorCode::wrong_kind, here, "expects {\"port\": value, ...}"};
      node.ghosts[id] = write_json_line(content);
      continue;
    }
    if (type->id == kBaseNode) return Error{ErrorCode::conflict, here, "position and tags stand beside `types`, not inside"};
    auto values = ports_from_json(*type, content, here);
    if (!values) return values.error();
    if (!node.types.emplace(type->id, std::move(*values)).second)
      return Error{ErrorCode::duplicate, here, "the typification `" + type->id + "` stands twice, once under an old name"};
  }
  return {};
}

}  // namespace

Json node_to_json(const NodeRecord& node, const Registry& registry) {
  Json json = Json::object();
  if (!node.name.empty()) json["name"] = node.name;
  if (const auto base = node.types.find(std::string(kBaseNode)); base != node.types.end())
    append_fields(json, ports_to_json(base_node(registry), base->second));
  Json types = Json::object();
  std::map<std::string, Json> sorted;
  for (const auto& [id, values] : node.types)
    if (id != kBaseNode) sorted[id] = ports_to_json(*registry.typification(id), values);
  for (const auto& [id, text] : node.ghosts) sorted[id] = Json::parse(text, nullptr, false);
  for (auto& [id, content] : sorted) append_field(types, id) = std::move(content);
  if (!types.empty()) json["types"] = std::move(types);
  if (!node.locked.empty()) json["locked"] = node.locked;
  return json;
}

Result<NodeRecord> node_from_json(const Json& json, const Registry& registry, const std::string& place) {
  if (!json.is_object()) return Error{ErrorCode::wrong_kind, place, "expects a node {\"id\": ..., \"types\": {...}}"};
  if (auto keys = check_node_keys(json, base_node(registry), place); !keys) return keys.error();
  NodeRecord node;
  if (const auto name = json.find("name"); name != json.end()) {
    if (!name->is_string()) return Error{ErrorCode::wrong_kind, place + "/name", "expects a text"};
    node.name = name->get<std::string>();
  }
  auto values = ports_from_json(base_node(registry), json, place, kNodeKeys);
  if (!values) return values.error();
  node.types[std::string(kBaseNode)] = std::move(*values);
  if (const auto types = json.find("types"); types != json.end())
    if (auto done = read_types(*types, registry, place + "/types", node); !done) return done.error();
  if (const auto locked = json.find("locked"); locked != json.end()) {
    if (!locked->is_array()) return Error{ErrorCode::wrong_kind, place + "/locked", "expects a list of \"typification.port\""};
    for (const Json& path : *locked) {
      if (!path.is_string()) return Error{ErrorCode::wrong_kind, place + "/locked", "expects a list of \"typification.port\""};
      node.locked.insert(path.get<std::string>());
    }
  }
  return node;
}

Json link_to_json(const LinkRecord& link, const Registry& registry) {
  if (!link.ghost.empty()) return Json::parse(link.ghost, nullptr, false);
  Json json = Json::object();
  json["kind"] = link.kind;
  json["from"] = selection_to_json(link.from);
  json["to"] = selection_to_json(link.to);
  if (link.strength != 1) json["strength"] = link.strength;
  if (!link.is_enabled) json["enabled"] = false;
  if (link.is_muted) json["muted"] = true;
  if (Json parameters = ports_to_json(*registry.link(link.kind), link.parameters); !parameters.empty())
    json["parameters"] = std::move(parameters);
  return json;
}

namespace {

Result<void> read_link_options(const Json& json, const std::string& place, LinkRecord& link) {
  if (const auto it = json.find("strength"); it != json.end()) {
    PortDefinition strength;
    strength.hard_minimum = 0;
    strength.hard_maximum = 1;
    auto value = value_from_json(strength, *it, place + "/strength");
    if (!value) return value.error();
    link.strength = std::get<double>(*value);
  }
  if (const auto it = json.find("enabled"); it != json.end()) {
    const auto flag = flag_from_json(*it, place + "/enabled");
    if (!flag) return flag.error();
    link.is_enabled = *flag;
  }
  if (const auto it = json.find("muted"); it != json.end()) {
    const auto flag = flag_from_json(*it, place + "/muted");
    if (!flag) return flag.error();
    link.is_muted = *flag;
  }
  return {};
}

}  // namespace

Result<LinkRecord> link_from_json(const Json& json, const Registry& registry, const std::string& place) {
  if (!json.is_object())
    return Error{ErrorCode::wrong_kind, place, "expects a link {\"id\": ..., \"kind\": ..., \"from\": ..., \"to\": ...}"};
  const auto kind = json.find("kind");
  if (kind == json.end() || !kind->is_string()) return Error{ErrorCode::missing, place, "`kind` is missing"};
  LinkRecord link;
  link.kind = kind->get<std::string>();
  const LinkDefinition* definition = registry.link(link.kind);
  if (definition == nullptr) {
    Json ghost = json;
    ghost.erase("id");
    link.ghost = write_json_line(ghost);
    return link;
  }
  link.kind = definition->id;
  if (auto keys = check_keys(json, {"id", "kind", "from", "to", "strength", "enabled", "muted", "parameters"}, place); !keys)
    return keys.error();
  for (const End end : {End::from, End::to}) {
    const std::string name(name_of(end));
    const auto it = json.find(name);
    if (it == json.end()) return Error{ErrorCode::missing, place, "`" + name + "` is missing"};
    auto selection = selection_from_json(*it, place + "/" + name);
    if (!selection) return selection.error();
    if (selection->is_empty()) return Error{ErrorCode::missing, place + "/" + name, "names no node"};
    (end == End::from ? link.from : link.to) = std::move(*selection);
  }
  if (auto options = read_link_options(json, place, link); !options) return options.error();
  if (const auto it = json.find("parameters"); it != json.end()) {
    auto parameters = ports_from_json(*definition, *it, place + "/parameters");
    if (!parameters) return parameters.error();
    link.parameters = std::move(*parameters);
  }
  return link;
}

std::vector<Problem> unfit_links(const Scene& scene, const Registry& registry) {
  const Registry& types = scene.scripts.types(registry);
  std::vector<Problem> problems;
  for (const auto& [id, link] : scene.links) {
    if (link.ghost.empty() || types.link(link.kind) == nullptr) continue;
    const std::string place = "links/" + id;
    const auto json = parse_json(link.ghost);
    const auto fresh = json ? link_from_json(*json, types, place) : Result<LinkRecord>(json.error());
    if (!fresh) {
      problems.push_back({true, fresh.error()});
      continue;
    }
    for (const End end : {End::from, End::to})
      for (const std::string& node : (end == End::from ? fresh->from : fresh->to).ids)
        if (!scene.nodes.contains(node))
          problems.push_back({true,
                              {ErrorCode::not_found, place + "/" + std::string(name_of(end)),
                               "there is no node `" + node + "`" + did_you_mean_among(node, scene.nodes)}});
  }
  return problems;
}

}  // namespace bl
