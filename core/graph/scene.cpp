// Settings, look-ups and hash of a scene.
#include "core/graph/scene.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/define/port_builder.h"

namespace bl {

namespace {

// Where on Earth the scene lies.
void declare_place(std::vector<PortDefinition>& ports) {
  auto port = [&](auto member, const char* id) { return add_port(ports, member, id); };
  port(&Settings::coordinate_system, "coordinate_system")
      .doc(
          "Coordinate reference system of the plan, such as EPSG:28992; `local` for metres without a place on Earth; empty where "
          "it is not known.");
  port(&Settings::origin_x, "origin_x").doc("First coordinate of the local origin in that system, in its own unit.");
  port(&Settings::origin_y, "origin_y").doc("Second coordinate of the local origin in that system, in its own unit.");
  port(&Settings::latitude, "latitude")
      .unit(Unit::degree)
      .range(-90, 90)
      .keeps_default()
      .doc("Latitude of the local origin (WGS84), north positive; where it is not set, each sun uses its own.");
  port(&Settings::longitude, "longitude")
      .unit(Unit::degree)
      .range(-180, 180)
      .keeps_default()
      .doc("Longitude of the local origin (WGS84), east positive; where it is not set, each sun uses its own.");
  port(&Settings::true_north, "true_north")
      .unit(Unit::degree)
      .range(-360, 360)
      .doc("Direction of true north, measured clockwise from the y axis.");
}

TypeDefinition declare_settings() {
  TypeDefinition type;
  type.id = "settings";
  type.label = "Settings";
  type.doc = "Settings of the whole scene.";
  auto port = [&](auto member, const char* id) { return add_port(type.ports, member, id); };
  port(&Settings::title, "title").doc("The name of the project, shown on reports.");
  port(&Settings::about, "about").doc("Purpose of the scene, in a few sentences.");
  port(&Settings::tolerance, "tolerance")
      .unit(Unit::ratio)
      .range(1e-9, 1)
      .soft(0.001, 0.1)
      .doc("Tolerance: the scene settles only when every demand is met within this share of itself.");
  port(&Settings::move_limit, "move_limit")
      .unit(Unit::metre)
      .min(0)
      .soft(0, 1)
      // What kWakingPush and kHeldShare of the phases say.
      .doc(
          "Move limit: the scene settles only when no link moves a node by more than this in a tick. A settled scene stands "
          "still until a link proposes more than twice as much.");
  port(&Settings::least_move, "least_move")
      .unit(Unit::metre)
      .min(0)
      .soft(0, 0.001)
      .doc(
          "Least move: shorter moves are not made, so that a slow approach comes to an end. What links propose stays visible as "
          "tension. A scene in which nothing changes costs no processor time.");
  port(&Settings::change_limit, "change_limit")
      .unit(Unit::ratio)
      .min(0)
      .soft(0.0001, 0.1)
      .doc(
          "Change limit: the scene settles only when no link changes a value by more than this share of it in a tick. In a "
          "settled scene, changes up to half of this share are not made.");
  port(&Settings::calm_ticks, "calm_ticks")
      .range(1, 1000)
      .soft(1, 50)
      .doc("Number of calm ticks in a row after which the scene is settled.");
  declare_place(type.ports);
  return type;
}

}  // namespace

const TypeDefinition& settings_type() {
  static const TypeDefinition kType = declare_settings();
  return kType;
}

Settings settings_of(const Scene& scene) {
  Settings settings;
  for (const PortDefinition& port : settings_type().ports)
    if (const auto it = scene.settings.find(port.id); it != scene.settings.end()) port.set(&settings, it->second);
  return settings;
}

namespace {

void add_values(Hash& hash, const PortValues& values) {
  hash.add(std::uint64_t{values.size()});
  for (const auto& [id, value] : values) {
    hash.add(std::string_view(id));
    add_to(hash, value);
  }
}

}  // namespace

std::uint64_t hash_of(const Scene& scene) {
  Hash hash;
  add_values(hash, scene.settings);
  for (const auto& [id, node] : scene.nodes) {
    hash.add(std::string_view(id));
    hash.add(std::string_view(node.name));
    for (const auto& [type, values] : node.types) {
      hash.add(std::string_view(type));
      add_values(hash, values);
    }
    for (const auto& [type, text] : node.ghosts) {
      hash.add(std::string_view(type));
      hash.add(std::string_view(text));
    }
    for (const std::string& path : node.locked) hash.add(std::string_view(path));
  }
  for (const auto& [id, link] : scene.links) {
    hash.add(std::string_view(id));
    hash.add(std::string_view(link.kind));
    add_to(hash, Shared<Selection>(link.from));
    add_to(hash, Shared<Selection>(link.to));
    hash.add(std::uint64_t{(link.is_enabled ? 1u : 0u) + (link.is_muted ? 2u : 0u)});
    hash.add(link.strength);
    add_values(hash, link.parameters);
    hash.add(std::string_view(link.ghost));
  }
  for (const auto& [name, text] : scene.scripts.texts()) {
    hash.add(std::string_view(name));
    hash.add(std::string_view(text));
  }
  return hash.value();
}

bool selects(const Registry& registry, const Selection& selection, const std::string& id, const NodeRecord& node) {
  if (!selection.is_query()) return std::find(selection.ids.begin(), selection.ids.end(), id) != selection.ids.end();
  if (!selection.typification.empty()) {
    const TypificationDefinition* type = registry.typification(selection.typification);
    if (!node.types.contains(type ? type->id : selection.typification)) return false;
  }
  if (selection.tag.empty()) return true;
  const auto base = node.types.find(std::string(kBaseNode));
  if (base == node.types.end()) return false;
  const auto tags = base->second.find("tags");
  if (tags == base->second.end()) return false;
  const auto& list = *std::get<Shared<std::vector<std::string>>>(tags->second);
  return std::find(list.begin(), list.end(), selection.tag) != list.end();
}

std::vector<std::string> resolve(const Scene& scene, const Registry& registry, const Selection& selection) {
  std::vector<std::string> ids;
  if (!selection.is_query()) {
    for (const std::string& id : selection.ids)
      if (scene.nodes.contains(id)) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }
  for (const auto& [id, node] : scene.nodes)
    if (selects(registry, selection, id, node)) ids.push_back(id);
  return ids;
}

const Value& set_value(const PortValues& settings, const PortValues& values, const PortDefinition& port) {
  if (port.of_scene != OfScene::always)
    if (const auto own = values.find(port.id); own != values.end()) return own->second;
  if (port.of_scene != OfScene::no)
    if (const auto setting = settings.find(port.id); setting != settings.end()) return setting->second;
  return port.default_value;
}

namespace {

const PortValues& values_of(const NodeRecord& node, const TypificationDefinition& type) {
  static const PortValues kNone;
  const auto values = node.types.find(type.id);
  return values == node.types.end() ? kNone : values->second;
}

}  // namespace

const Value& set_value(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type,
                       const PortDefinition& port) {
  return set_value(scene.settings, values_of(node, type), port);
}

Unit unit_of(const Registry& registry, const NodeRecord& node, const TypificationDefinition& type, const PortDefinition& port) {
  if (port.unit_from.empty()) return port.unit;
  const PortDefinition* namer = type.find_port(port.unit_from);
  if (namer == nullptr) return port.unit;
  static const PortValues kNoSettings;  // a setting of the scene names no unit
  const Value& name = set_value(kNoSettings, values_of(node, type), *namer);
  const std::string* text = std::get_if<std::string>(&name);
  if (text == nullptr) return port.unit;
  if (namer->kind == ValueKind::port) {
    const auto path = parse_port_path(*text);
    if (!path) return Unit::none;
    const auto chosen = registry.port(*path);
    return chosen ? (*chosen)->unit : Unit::none;
  }
  const UnitInfo* row = find_unit(*text);
  return row ? row->unit : Unit::none;
}

}  // namespace bl
