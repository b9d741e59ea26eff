// Objects that both have are told by their identity: the same content in another place takes memory again.
#include "core/graph/held_bytes.h"

#include <map>
#include <set>
#include <string>
#include <variant>

#include "core/base/heap_bytes.h"

namespace bl {

namespace {

// An entry of a map or of a set, beside what it holds.
constexpr std::size_t kBytesOfEntry = kBytesOfBlock + 32;
// The struct that a link kind reads its parameters from, for each of them.
constexpr std::size_t kBytesOfParameter = 32;

std::size_t content_bytes(const Numbers& numbers) { return kBytesOfBlock + heap_bytes(*numbers); }
std::size_t content_bytes(const Shared<std::vector<Point3>>& points) { return kBytesOfBlock + heap_bytes(*points); }
std::size_t content_bytes(const Shared<std::vector<std::string>>& texts) { return kBytesOfBlock + heap_bytes(*texts); }

std::size_t heap_bytes(const Selection& selection) {
  return bl::heap_bytes(selection.ids) + bl::heap_bytes(selection.typification) + bl::heap_bytes(selection.tag);
}
std::size_t content_bytes(const Shared<Selection>& selection) {
  return kBytesOfBlock + sizeof(Selection) + heap_bytes(*selection);
}

std::size_t content_bytes(const Shared<Table>& table) {
  std::size_t bytes = kBytesOfBlock + sizeof(Table) + bl::heap_bytes(table->columns) + bl::heap_bytes(table->rows);
  for (const TableRow& row : table->rows) {
    bytes += row.bytes();
    for (const Scalar& cell : row) {
      if (const auto* text = std::get_if<std::string>(&cell)) bytes += bl::heap_bytes(*text);
      else if (const auto* numbers = std::get_if<Numbers>(&cell)) bytes += content_bytes(*numbers);
      else if (const auto* indices = std::get_if<Indices>(&cell)) bytes += kBytesOfBlock + bl::heap_bytes(**indices);
    }
  }
  return bytes;
}

// Beside the value itself. What `before` (nullptr: none) shares with it is not counted.
std::size_t heap_bytes(const Value& value, const Value* before) {
  return std::visit(
      [&](const auto& content) -> std::size_t {
        using Content = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<Content, std::string>) {
          return bl::heap_bytes(content);
        } else if constexpr (requires { content_bytes(content); }) {
          const auto* other = before != nullptr ? std::get_if<Content>(before) : nullptr;
          return other != nullptr && &**other == &*content ? 0 : content_bytes(content);
        } else {
          return 0;  // plain, or made from the others
        }
      },
      value);
}

std::size_t held_bytes(const PortValues& values, const PortValues* before) {
  std::size_t bytes = 0;
  for (const auto& [port, value] : values) {
    const auto other = before != nullptr ? before->find(port) : values.end();
    const bool is_known = before != nullptr && other != before->end();
    bytes += kBytesOfEntry + sizeof(PortValues::value_type) + bl::heap_bytes(port) +
             heap_bytes(value, is_known ? &other->second : nullptr);
  }
  return bytes;
}

std::size_t held_bytes(const NodeRecord& node, const NodeRecord* before) {
  std::size_t bytes = bl::heap_bytes(node.name);
  for (const auto& [type, values] : node.types) {
    const PortValues* other = nullptr;
    if (before != nullptr)
      if (const auto found = before->types.find(type); found != before->types.end()) other = &found->second;
    bytes += kBytesOfEntry + sizeof(*node.types.begin()) + bl::heap_bytes(type) + held_bytes(values, other);
  }
  for (const auto& [type, text] : node.ghosts)
    bytes += kBytesOfEntry + sizeof(*node.ghosts.begin()) + bl::heap_bytes(type) + bl::heap_bytes(text);
  for (const std::string& port : node.locked) bytes += kBytesOfEntry + sizeof(port) + bl::heap_bytes(port);
  return bytes;
}

std::size_t held_bytes(const LinkRecord& link, const LinkRecord* before) {
  return bl::heap_bytes(link.kind) + heap_bytes(link.from) + heap_bytes(link.to) + bl::heap_bytes(link.ghost) +
         held_bytes(link.parameters, before != nullptr ? &before->parameters : nullptr);
}

// What shared values hold is the scene's.
std::size_t heap_bytes(const NodePlan& node) {
  std::size_t bytes = bl::heap_bytes(node.id) + bl::heap_bytes(node.name) + bl::heap_bytes(node.types);
  if (const auto* id = std::get_if<std::string>(&node.id_value)) bytes += bl::heap_bytes(*id);
  for (const TypePlan& type : node.types) {
    bytes += bl::heap_bytes(type.set_values) + 2 * (kBytesOfBlock + type.set_values.size() / 8);
    for (const Value& value : type.set_values)
      if (const auto* text = std::get_if<std::string>(&value)) bytes += bl::heap_bytes(*text);
  }
  return bytes;
}

std::size_t heap_bytes(const LinkPlan& link) {
  std::size_t bytes = bl::heap_bytes(link.id) + bl::heap_bytes(link.nodes[0]) + bl::heap_bytes(link.nodes[1]) +
                      bl::heap_bytes(link.reads) + bl::heap_bytes(link.targets) + bl::heap_bytes(link.writes);
  for (const auto& ports : link.reads) bytes += bl::heap_bytes(ports);
  for (const auto& ports : link.writes) bytes += bl::heap_bytes(ports);
  if (link.parameters) bytes += kBytesOfBlock + kBytesOfParameter * link.definition->ports.size();
  if (link.error) bytes += bl::heap_bytes(link.error->place) + bl::heap_bytes(link.error->message);
  return bytes;
}

std::size_t bytes_of(const NodeForms& forms) {
  std::size_t bytes = sizeof(forms) + bl::heap_bytes(forms.types) + bl::heap_bytes(forms.of);
  for (const auto& types : forms.types) bytes += bl::heap_bytes(types);
  return bytes;
}

std::size_t bytes_of(const SharedVector<SetPlan>& sets) {
  std::size_t bytes = kBytesOfBlock + sets.size() * sizeof(SetPlan);
  for (const SetPlan& set : sets) bytes += bl::heap_bytes(set.members) + bl::heap_bytes(set.reads) + bl::heap_bytes(set.writes);
  return bytes;
}

}  // namespace

std::size_t held_bytes(const Scene& scene, const Scene* before) {
  static const Scene kNone;
  const Scene& other = before != nullptr ? *before : kNone;
  const auto bytes_of_record = [](const auto& record, const auto* record_before) { return held_bytes(record, record_before); };
  return sizeof(Scene) + held_bytes(scene.settings, &other.settings) + bl::heap_bytes(scene.view) +
         scene.nodes.unshared_bytes(other.nodes, bytes_of_record) + scene.links.unshared_bytes(other.links, bytes_of_record) +
         scene.scripts.unshared_bytes(other.scripts);
}

std::size_t held_bytes(const Plan& plan, const Plan* before) {
  if (&plan == before) return 0;
  static const Plan kNone;
  const Plan& other = before != nullptr ? *before : kNone;
  std::size_t bytes = kBytesOfBlock + sizeof(Plan) + bl::heap_bytes(plan.analyses) + bl::heap_bytes(plan.scene.view) +
                      held_bytes(plan.scene.settings, &other.scene.settings);
  bytes += plan.nodes.unshared_bytes(other.nodes, [](const NodePlan& node) { return heap_bytes(node); });
  bytes += plan.links.unshared_bytes(other.links, [](const LinkPlan& link) { return heap_bytes(link); });
  if (plan.forms && plan.forms != other.forms) bytes += kBytesOfBlock + bytes_of(*plan.forms);
  if (plan.sets.data() != other.sets.data()) bytes += bytes_of(plan.sets);
  if (plan.dependents && plan.dependents != other.dependents)
    bytes += kBytesOfBlock + plan.dependents->unshared_bytes(other.dependents.get());
  return bytes;
}

}  // namespace bl
