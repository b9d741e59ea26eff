// Chooses the few values that tell most about a node: what people have set, what is still missing, and the main results.
#include "ui/desktop/panels/canvas/sections.h"

#include "core/reading/figures.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/inspector_quantity.h"
#include "ui/desktop/panels/stream_text.h"

namespace bl::desktop::canvas {

namespace {

constexpr std::size_t kMostRows = 5, kMostSettings = 3;
constexpr double kLeastShare = 1e-4;  // smaller ones are written as such

bool is_shown_in_a_row(const PortDefinition& port) { return !is_derived(port.kind) && port.kind != ValueKind::json; }

bool is_number(const PortDefinition& port) { return port.kind == ValueKind::number || port.kind == ValueKind::integer; }

void add_row(Section& section, std::size_t port) {
  const auto& ports = section.type->ports;
  if (port >= ports.size() || section.rows.size() >= kMostRows || !is_shown_in_a_row(ports[port])) return;
  for (const Row& row : section.rows)
    if (row.port == port) return;
  section.rows.push_back({port, label_of(ports[port])});
}

// What the declaration shows first; false where it leaves that open.
bool add_declared(Section& section) {
  const std::vector<PortDefinition>& ports = section.type->ports;
  bool is_declared = false;
  for (std::size_t p = 0; p < ports.size(); ++p) {
    if (ports[p].is_shown_first) add_row(section, p);
    if (ports[p].is_traced) section.spark = p;
    is_declared |= ports[p].is_shown_first;
  }
  return is_declared;
}

void choose_rows(Section& section, const PortValues& values) {
  const TypificationDefinition& type = *section.type;
  // What a device says last stands in a line of its own; beside it counts where it comes from or goes to.
  section.is_stream = is_stream(type);
  if (section.is_stream) {
    add_declared(section);
    return;
  }
  for (std::size_t p = 0; p < type.ports.size() && section.rows.size() < kMostSettings; ++p) {
    const PortDefinition& port = type.ports[p];
    const auto found = values.find(port.id);
    if (!port.is_computed && found != values.end() && found->second != port.default_value) add_row(section, p);
  }
  for (std::size_t p = 0; p < type.ports.size(); ++p)
    if (type.ports[p].is_residual) add_row(section, p);
  if (add_declared(section)) return;
  for (std::size_t p = 0; p < type.ports.size(); ++p) {
    if (!type.ports[p].is_computed || !is_number(type.ports[p])) continue;
    add_row(section, p);
    if (section.spark == kNoIndex) section.spark = p;
  }
  // A role without results and with everything at its defaults still shows what it could be told.
  for (std::size_t p = 0; p < type.ports.size() && section.rows.empty(); ++p) add_row(section, p);
}

std::string text_of(const Vector3& v) {
  return reading::readable(v.x) + ", " + reading::readable(v.y) + ", " + reading::readable(v.z);
}

std::string counted(std::size_t count, const char* noun) { return reading::counted(count, noun); }

}  // namespace

std::string label_of(const PortDefinition& port) {
  std::string label = port.id;
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::vector<Section> sections_of(const Registry& registry, const NodeRecord& node) {
  std::vector<Section> sections;
  for (const auto& [type_id, values] : node.types) {
    if (type_id == kBaseNode) continue;  // place and tags are those of the box itself
    const auto found = registry.typifications().find(type_id);
    if (found == registry.typifications().end()) continue;
    Section& section = sections.emplace_back();
    section.type_id = type_id;
    section.type = &found->second;
    section.label = found->second.label;
    section.category = static_cast<std::size_t>(std::distance(registry.typifications().begin(), found));
    section.has_bar = reading::is_a<reading::VolumeFigures>(*section.type);
    choose_rows(section, values);
  }
  for (const auto& [type_id, text] : node.ghosts) {
    Section& section = sections.emplace_back();
    section.type_id = type_id;
    section.label = type_id + " (unknown here)";
  }
  return sections;
}

float height_of(const std::vector<Section>& sections) {
  float height = kHeadHeight + (sections.empty() ? 0 : kBoxFoot);
  for (const Section& section : sections) {
    height += kSectionHeight + kRowHeight * static_cast<float>(section.rows.size());
    if (section.has_bar) height += kBarHeight;
    if (section.is_stream) height += kStreamHeight;
    if (section.spark != kNoIndex) height += kSparkHeight;
    if (section.type == nullptr) height += kRowHeight;
  }
  return std::ceil(height / kGrid) * kGrid;
}

const Value* value_of(const Workbench& editor, const NodeBox& box, const Section& section, std::size_t port) {
  if (section.type == nullptr || port >= section.type->ports.size()) return nullptr;
  if (box.in_state != kNoIndex && section.in_state != kNoIndex) {
    const auto& values = editor.state().nodes[box.in_state].types[section.in_state].values;
    if (port < values.size()) return &values[port];
  }
  const auto node = editor.scene().nodes.find(box.id);
  if (node == editor.scene().nodes.end() || !node->second.types.contains(section.type_id)) return nullptr;
  return &set_value(editor.scene(), node->second, *section.type, section.type->ports[port]);
}

std::string text_of(const Workbench& editor, const NodeBox& box, const Section& section, std::size_t port) {
  const Value* value = value_of(editor, box, section, port);
  if (value == nullptr) return "–";
  const PortDefinition& definition = section.type->ports[port];
  if (const auto* is_on = std::get_if<bool>(value)) return *is_on ? "on" : "off";
  if (const auto* text = std::get_if<std::string>(value)) return text->empty() ? "–" : *text;
  if (const auto* place = std::get_if<Vector3>(value)) return text_of(*place);
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(value)) return counted((*points)->size(), "point");
  if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(value)) return counted((*texts)->size(), "text");
  if (const auto* table = std::get_if<Shared<Table>>(value)) return counted((*table)->rows.size(), "row");
  if (const auto* selection = std::get_if<Shared<Selection>>(value)) return text_of(editor, **selection);
  if (const auto* numbers = std::get_if<Numbers>(value)) return counted((*numbers)->size(), "number");
  if (is_derived(definition.kind)) return std::string(kind_text(definition.kind, definition.made));
  if (means_none(definition, as_number(*value))) return kNoneWord;
  if (definition.unit == Unit::ratio) {
    const double share = as_number(*value);
    return share != 0 && std::abs(share) < kLeastShare ? "< 0.01 %" : reading::percent(share);
  }
  Unit unit = definition.unit;
  if (!definition.unit_from.empty())
    if (const auto node = editor.scene().nodes.find(box.id); node != editor.scene().nodes.end())
      unit = unit_of(editor.types(), node->second, *section.type, definition);
  const bool is_whole = definition.kind == ValueKind::integer || unit == Unit::count;
  if (is_whole && as_number(*value) == std::round(as_number(*value))) return reading::grouped(as_number(*value));
  return reading::quantity(as_number(*value), unit);
}

void refresh_texts(const Workbench& editor, const NodeBox& box, Section& section, std::size_t revision) {
  if (section.texts_of == revision && section.texts.size() == section.rows.size()) return;
  section.texts.clear();
  for (const Row& row : section.rows) section.texts.push_back(text_of(editor, box, section, row.port));
  section.texts_of = revision;
}

}  // namespace bl::desktop::canvas
