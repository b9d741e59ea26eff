// Look-ups in definitions.
#include "core/define/definition.h"

#include <algorithm>

namespace bl {

std::string_view name_of(CombineRule rule) {
  switch (rule) {
    case CombineRule::none: return "none";
    case CombineRule::sum: return "sum";
    case CombineRule::blend: return "blend";
    case CombineRule::min: return "min";
    case CombineRule::max: return "max";
    case CombineRule::collect: return "collect";
    case CombineRule::total: return "total";
  }
  return "none";
}

std::string_view name_of(End end) { return end == End::from ? "from" : "to"; }

std::optional<PortPath> parse_port_path(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) return std::nullopt;
  return PortPath{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1)), ""};
}

PortPath port_path(std::string_view text) { return parse_port_path(text).value(); }

void assign_text(std::string& place, std::string_view text) { place = text; }

PortDefinition& new_port(std::vector<PortDefinition>& ports, std::string_view id) {
  PortDefinition& port = ports.emplace_back();
  port.id = id;
  return port;
}

void set_members(const std::vector<PortDefinition>& ports, std::span<const Value> values, void* settings) {
  for (std::size_t p = 0; p < ports.size(); ++p)
    if (!ports[p].is_computed) ports[p].set(settings, values[p]);
    else if (ports[p].recall) ports[p].recall(settings, values[p]);
}

void get_members(const std::vector<PortDefinition>& ports, const void* results, std::span<Value> values) {
  for (std::size_t p = 0; p < ports.size(); ++p)
    if (ports[p].is_computed && !ports[p].make) values[p] = ports[p].get(results);
}

bool can_read(ValueKind wanted, ValueKind held) {
  const bool is_numeric = held == ValueKind::integer || held == ValueKind::boolean;
  return held == wanted || (wanted == ValueKind::number && is_numeric) ||
         (wanted == ValueKind::text && held == ValueKind::choice);
}

std::size_t TypeDefinition::port_index(std::string_view port) const {
  return static_cast<std::size_t>(
      std::find_if(ports.begin(), ports.end(), [&](const PortDefinition& p) { return p.id == port; }) - ports.begin());
}

const PortDefinition* TypeDefinition::find_port(std::string_view port) const {
  const std::size_t index = port_index(port);
  return index < ports.size() ? &ports[index] : nullptr;
}

std::string_view kind_text(ValueKind kind, const MadeType& made) {
  return kind == ValueKind::made && made.type != nullptr ? made.name : name_of(kind);
}

void make_objects(const TypeDefinition& type, std::span<Value> values, std::span<const Value> last) {
  for (std::size_t p = 0; p < type.ports.size(); ++p) {
    const PortDefinition& port = type.ports[p];
    if (!port.make) continue;
    const bool is_same = p < last.size() && std::all_of(port.made_from.begin(), port.made_from.end(),
                                                        [&](std::size_t from) { return values[from] == last[from]; });
    values[p] = is_same ? last[p] : Value(port.make(values));
  }
}

bool LinkDefinition::is_whole(End end) const {
  return std::any_of(reads.begin(), reads.end(), [&](const LinkRead& r) { return r.end == end && r.is_whole; }) ||
         std::any_of(proposes.begin(), proposes.end(), [&](const LinkWrite& w) { return w.end == end && w.is_whole; });
}

}  // namespace bl
