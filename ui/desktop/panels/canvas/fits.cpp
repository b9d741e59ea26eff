// Checks the declarations like the compiler of plans, but before the link exists.
#include "ui/desktop/panels/canvas/fits.h"

#include <algorithm>
#include <map>

namespace bl::desktop::canvas {

namespace {

std::string type_label(const Registry& registry, const std::string& type) {
  const TypificationDefinition* known = registry.typification(type);
  return known != nullptr ? known->label : type;
}

bool is_numeric(const PortDefinition& port) {
  return port.kind == ValueKind::number || port.kind == ValueKind::integer || port.kind == ValueKind::boolean;
}

struct Candidate {
  std::string port;
  Unit unit = Unit::none;
};

// The ports that the nodes of an end must have, as far as the declaration names them.
std::vector<PortPath> fixed_paths(const LinkDefinition& kind, End end) {
  std::vector<PortPath> paths;
  for (const LinkRead& read : kind.reads)
    if (read.end == end && !read.is_optional && read.path.chosen_by.empty()) paths.push_back(read.path);
  for (const LinkWrite& write : kind.proposes)
    if (write.end == end && !write.is_optional && write.path.chosen_by.empty()) paths.push_back(write.path);
  return paths;
}

bool has_port(const Registry& registry, const std::vector<std::string>& types, const PortPath& path) {
  if (path.typification == kBaseNode && path.port == "id") return true;
  const TypificationDefinition* wanted = registry.typification(path.typification);
  return wanted != nullptr && std::find(types.begin(), types.end(), wanted->id) != types.end();
}

std::vector<std::string> types_of(const NodeRecord& node) {
  std::vector<std::string> types;
  for (const auto& [type, values] : node.types) types.push_back(type);
  return types;
}

// What the node lacks, as a sentence.
std::optional<std::string> lack(const Registry& registry, const LinkDefinition& kind, End end,
                                const std::vector<std::string>& types, const std::string& who) {
  for (const PortPath& path : fixed_paths(kind, end))
    if (!has_port(registry, types, path)) {
      const std::string role = type_label(registry, path.typification);
      return (end == End::from ? "it starts at a " : "it leads to a ") + role + ", and " + who + " is none";
    }
  return std::nullopt;
}

std::optional<std::string> lack_at_end(const Registry& registry, const Scene& scene, const LinkDefinition& kind, End end,
                                       const Selection& selection) {
  const std::vector<std::string> ids = resolve(scene, registry, selection);
  if (ids.empty()) return "no node is in the set";
  std::optional<std::string> first;
  for (const std::string& id : ids) {
    const NodeRecord& node = scene.nodes.at(id);
    const auto why = lack(registry, kind, end, types_of(node), node.name.empty() ? id : node.name);
    // A set leaves out what does not fit; a named node has to fit.
    if (selection.is_query() && !why) return std::nullopt;
    if (!selection.is_query() && why) return why;
    if (!first) first = why;
  }
  return selection.is_query() ? first : std::nullopt;
}

// Ports that a chosen read or proposal can work on, the likeliest first: results before settings for reads.
std::vector<Candidate> candidates(const Registry& registry, const NodeRecord& node, bool is_write) {
  std::vector<Candidate> results, settings;
  for (const auto& [type_id, values] : node.types) {
    const TypificationDefinition* type = registry.typification(type_id);
    if (type == nullptr || type_id == kBaseNode) continue;
    for (const PortDefinition& port : type->ports) {
      if (!is_numeric(port) || (is_write && (port.is_computed || port.rule == CombineRule::none))) continue;
      (port.is_computed ? results : settings).push_back({type_id + "." + port.id, unit_of(registry, node, *type, port)});
    }
  }
  results.insert(results.end(), settings.begin(), settings.end());
  return results;
}

template <class Paths>
bool chooses_port(const Paths& paths, End end) {
  return std::any_of(paths.begin(), paths.end(), [&](const auto& p) { return p.end == end && !p.path.chosen_by.empty(); });
}

}  // namespace

std::optional<std::string> misfit(const Registry& registry, const Scene& scene, const LinkDefinition& kind, const Selection& from,
                                  const Selection& to) {
  if (!from.is_query() && from == to && from.ids.size() <= 1) return "both ends are the same node";
  if (auto why = lack_at_end(registry, scene, kind, End::from, from)) return why;
  if (auto why = lack_at_end(registry, scene, kind, End::to, to)) return why;
  const auto first_of = [&](const Selection& selection) { return scene.nodes.at(resolve(scene, registry, selection).front()); };
  if (chooses_port(kind.reads, End::from) && candidates(registry, first_of(from), false).empty())
    return "the first end has no number to read";
  if (chooses_port(kind.proposes, End::to) && candidates(registry, first_of(to), true).empty())
    return "the second end has no number that links may change";
  return std::nullopt;
}

std::optional<std::string> misfit_with_new(const Registry& registry, const Scene& scene, const LinkDefinition& kind,
                                           const Selection& from, const TypificationDefinition& role) {
  if (auto why = lack_at_end(registry, scene, kind, End::from, from)) return why;
  if (auto why = lack(registry, kind, End::to, {std::string(kBaseNode), role.id}, "a " + role.label)) return why;
  NodeRecord node;
  node.types[role.id];
  const auto sources = resolve(scene, registry, from);
  if (chooses_port(kind.reads, End::from) && candidates(registry, scene.nodes.at(sources.front()), false).empty())
    return "there is no number to read";
  if (chooses_port(kind.proposes, End::to) && candidates(registry, node, true).empty())
    return "it has no number that links may change";
  return std::nullopt;
}

bool knows_places_only(const LinkDefinition& kind, End end) {
  const std::vector<PortPath> paths = fixed_paths(kind, end);
  return !chooses_port(kind.reads, end) && !chooses_port(kind.proposes, end) &&
         std::all_of(paths.begin(), paths.end(), [](const PortPath& path) { return path.typification == kBaseNode; });
}

PortValues chosen_ports(const Registry& registry, const Scene& scene, const LinkDefinition& kind, const Selection& from,
                        const Selection& to) {
  std::map<std::string, std::vector<Candidate>> offers;
  const auto offer = [&](const PortPath& path, const Selection& selection, bool is_write) {
    const auto ids = resolve(scene, registry, selection);
    if (path.chosen_by.empty() || ids.empty()) return;
    offers[path.chosen_by] = candidates(registry, scene.nodes.at(ids.front()), is_write);
  };
  for (const LinkRead& read : kind.reads) offer(read.path, read.end == End::from ? from : to, false);
  for (const LinkWrite& write : kind.proposes) offer(write.path, write.end == End::from ? from : to, true);
  PortValues values;
  for (const auto& [parameter, ports] : offers)
    if (!ports.empty()) values[parameter] = ports.front().port;
  // Where two of them have to have one unit, the first pair that has it.
  for (const auto& [a, b] : kind.same_units) {
    const auto find_pair = [&] {
      for (const Candidate& one : offers[a])
        for (const Candidate& other : offers[b])
          if (same_dimension(one.unit, other.unit)) {
            values[a] = one.port;
            values[b] = other.port;
            return;
          }
    };
    find_pair();
  }
  return values;
}

}  // namespace bl::desktop::canvas
