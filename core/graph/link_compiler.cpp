// Resolves the ends of a link to ports of nodes, and checks that the link fits them.
#include "core/graph/link_compiler.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/text.h"

namespace bl {

namespace {

const Value& parameter_of(const LinkRecord& record, const PortDefinition& port) {
  const auto it = record.parameters.find(port.id);
  return it != record.parameters.end() ? it->second : port.default_value;
}

std::vector<Value> parameters_of(const LinkDefinition& definition, const LinkRecord& record) {
  std::vector<Value> values;
  for (const PortDefinition& port : definition.ports) values.push_back(parameter_of(record, port));
  return values;
}

// Does the parameter decide about the ports of the ends, or about whether they fit?
bool decides_about_ends(const LinkDefinition& definition, const std::string& parameter) {
  const auto is_chosen = [&](const auto& declared) { return declared.path.chosen_by == parameter; };
  return std::any_of(definition.reads.begin(), definition.reads.end(), is_chosen) ||
         std::any_of(definition.proposes.begin(), definition.proposes.end(), is_chosen) ||
         definition.same_units_unless == parameter ||
         std::any_of(definition.same_units.begin(), definition.same_units.end(),
                     [&](const auto& pair) { return pair.first == parameter || pair.second == parameter; });
}

bool keeps_ends(const LinkPlan& before, const LinkRecord& old, const LinkRecord& record) {
  if (before.definition == nullptr || before.error || old.kind != record.kind || old.ghost != record.ghost) return false;
  if (old.from != record.from || old.to != record.to) return false;
  const auto& ports = before.definition->ports;
  return std::none_of(ports.begin(), ports.end(), [&](const PortDefinition& port) {
    return parameter_of(old, port) != parameter_of(record, port) && decides_about_ends(*before.definition, port.id);
  });
}

void set_switches(LinkPlan& link, const LinkRecord& record) {
  link.is_enabled = record.is_enabled;
  link.is_muted = record.is_muted;
  link.strength = record.strength;
}

// The first node of each unit, in the order of the nodes.
std::vector<std::size_t> firsts_of(const std::vector<Unit>& units) {
  std::vector<std::size_t> firsts;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (std::none_of(firsts.begin(), firsts.end(), [&](std::size_t first) { return units[first] == units[i]; }))
      firsts.push_back(i);
  return firsts;
}

}  // namespace

LinkPlan LinkCompiler::compiled(const std::string& id, const LinkRecord& record) const {
  LinkPlan link;
  link.id = id;
  link.definition = record.ghost.empty() ? registry_.link(record.kind) : nullptr;
  set_switches(link, record);
  if (link.definition == nullptr) {
    link.error = Error{ErrorCode::unknown_type, "links/" + link.id, why_it_rests(record.kind)};
    return link;
  }
  const std::vector<Value> values = parameters_of(*link.definition, record);
  link.parameters = link.definition->instantiate(values);
  for (const End end : {End::from, End::to}) {
    auto nodes = end_nodes(link, end == End::from ? record.from : record.to, end, values);
    if (!nodes) {
      link.error = nodes.error().within("links/" + link.id);
      return link;
    }
    link.nodes[static_cast<int>(end)] = std::move(*nodes);
  }
  link.is_symmetric = link.nodes[0] == link.nodes[1] && link.nodes[0].size() > 1;
  if (auto ports = resolve_ports(link, values); !ports) link.error = ports.error().within("links/" + link.id);
  return link;
}

LinkPlan LinkCompiler::amended(const LinkPlan& before, const LinkRecord& old, const LinkRecord& record) const {
  if (!keeps_ends(before, old, record)) return compiled(before.id, record);
  LinkPlan link = before;
  set_switches(link, record);
  link.parameters = link.definition->instantiate(parameters_of(*link.definition, record));
  return link;
}

std::string LinkCompiler::why_it_rests(const std::string& kind) const {
  if (registry_.link(kind) != nullptr)
    return "the link does not fit its kind `" + kind + "`: kept as it is, not run; correct it in the scene file";
  std::string guess = did_you_mean(kind, keys_of(registry_.links()));
  return "unknown link kind `" + kind + "`: kept as it is, not run" +
         (guess.empty()
              ? "; a Lua file of yours is put into the scene by `script` or --script, a library is named by --plugins FOLDER"
              : guess);
}

// Every path of the declaration at this end, with parameters put in for chosen ones.
std::vector<LinkCompiler::Wanted> LinkCompiler::wanted_at(const LinkDefinition& definition, End end,
                                                          std::span<const Value> values) const {
  std::vector<Wanted> list;
  for (const LinkRead& read : definition.reads)
    if (read.end == end) list.push_back({actual_path(definition, read.path, values), &read.unit, read.is_optional});
  for (const LinkWrite& write : definition.proposes)
    if (write.end == end) list.push_back({actual_path(definition, write.path, values), &write.unit, write.is_optional});
  return list;
}

// The nodes of an end that have all the ports but for optional ones. A query leaves out those that lack one; a named node must
// have them.
Result<std::vector<std::uint32_t>> LinkCompiler::end_nodes(const LinkPlan& link, const Selection& selection, End end,
                                                           std::span<const Value> values) const {
  const std::vector<Wanted> wanted = wanted_at(*link.definition, end, values);
  enum class Fit : std::uint8_t { unknown, fits, fits_by_unit, lacks };
  std::vector<Fit> fits(plan_.forms->types.size());
  std::vector<std::uint32_t> nodes = selected_nodes(plan_, registry_, selection);
  const std::size_t chosen = nodes.size();
  std::size_t kept = 0;
  const PortPath* lacking = nullptr;  // of the first node that is left out
  for (const std::uint32_t node : nodes) {
    Fit& fit = fits[plan_.forms->of[node]];
    if (fit == Fit::unknown || fit == Fit::fits_by_unit) {
      const auto missing = std::find_if(wanted.begin(), wanted.end(),
                                        [&](const Wanted& one) { return !one.is_optional && !plan_.find(node, one.path); });
      if (missing == wanted.end()) {
        const auto unit = check_units(node, wanted);
        if (!unit) return unit.error().within(name_of(end));
        fit = *unit ? Fit::fits_by_unit : Fit::fits;
      } else {
        if (!selection.is_query()) return lack_of(*link.definition, node, missing->path, end);
        fit = Fit::lacks;
        if (lacking == nullptr) lacking = &missing->path;
      }
    }
    if (fit != Fit::lacks) nodes[kept++] = node;
  }
  nodes.resize(kept);
  if (nodes.empty()) return nothing_fits(*link.definition, chosen, lacking, end);
  return nodes;
}

// A query that chooses nodes none of which has the port is mostly a misspelt port; one that chooses none is not.
Error LinkCompiler::nothing_fits(const LinkDefinition& definition, std::size_t chosen, const PortPath* lacking, End end) const {
  std::string why = "; the link does nothing";
  if (lacking != nullptr && lacking->typification.empty()) why += ": choose the port that `" + definition.id + "` works on";
  else if (lacking != nullptr)
    why += ": " + (chosen == 1 ? std::string("the node") : "none of the " + std::to_string(chosen) + " nodes") +
           " that it chooses has" + (chosen == 1 ? " no" : "") + " `" + lacking->typification + "." + lacking->port +
           "`, which `" + definition.id + "` needs" + nearest_port(*lacking);
  return {ErrorCode::not_found, std::string(name_of(end)), "no node fits this end" + why};
}

Error LinkCompiler::lack_of(const LinkDefinition& definition, std::uint32_t node, const PortPath& path, End end) const {
  if (path.typification.empty()) return Error{ErrorCode::missing, "", "choose the port that `" + definition.id + "` works on"};
  return Error{ErrorCode::conflict, std::string(name_of(end)),
               "the node `" + plan_.nodes[node].id + "` has no `" + path.typification + "." + path.port + "`, which `" +
                   definition.id + "` needs" + nearest_port(path)};
}

// ", did you mean `radius`?" for a misspelt port of a known typification.
std::string LinkCompiler::nearest_port(const PortPath& path) const {
  const TypificationDefinition* type = registry_.typification(path.typification);
  if (type == nullptr) return did_you_mean(path.typification, keys_of(registry_.typifications()));
  return type->find_port(path.port) != nullptr ? "" : did_you_mean(path.port, port_ids(*type));
}

Result<bool> LinkCompiler::check_units(std::uint32_t node, std::span<const Wanted> wanted) const {
  bool depends_on_node = false;
  for (const auto& [path, unit, is_optional] : wanted) {
    if (!unit->has_value()) continue;
    const auto ref = plan_.find(node, path);
    if (!ref && is_optional) continue;
    const Unit found = unit_at(ref);
    depends_on_node |= ref->type != PortRef::kNodeId && !plan_.port(*ref).unit_from.empty();
    if (same_dimension(found, **unit)) continue;
    return Error{ErrorCode::wrong_unit, "",
                 "`" + plan_.nodes[node].id + "." + path.typification + "." + path.port + "` is in " +
                     std::string(info(found).name) + "s, the link works in " + std::string(info(**unit).name) + "s"};
  }
  return depends_on_node;
}

Unit LinkCompiler::unit_at(std::optional<PortRef> ref) const {
  if (!ref || ref->type == PortRef::kNodeId) return Unit::none;
  const PortDefinition& port = plan_.port(*ref);
  if (port.unit_from.empty()) return port.unit;
  const NodePlan& node = plan_.nodes[ref->node];
  return unit_of(registry_, plan_.scene.nodes.at(node.id), *node.types[ref->type].definition, port);
}

std::vector<Unit> LinkCompiler::units_at(const std::vector<std::uint32_t>& nodes, const PortPath& path) const {
  std::vector<Unit> units;
  for (const std::uint32_t node : nodes) units.push_back(unit_at(plan_.find(node, path)));
  return units;
}

Result<void> LinkCompiler::check_same_units(const LinkPlan& link, std::span<const Value> values) const {
  const LinkDefinition& definition = *link.definition;
  if (!definition.same_units_unless.empty() && std::get<bool>(values[definition.port_index(definition.same_units_unless)]))
    return {};
  for (const auto& [parameter, other] : definition.same_units) {
    const PortPath from = actual_path(definition, {"", "", parameter}, values),
                   to = actual_path(definition, {"", "", other}, values);
    const std::vector<Unit> froms = units_at(link.nodes[0], from), tos = units_at(link.nodes[1], to);
    const std::vector<std::size_t> first_tos = firsts_of(tos);
    for (const std::size_t f : firsts_of(froms))
      for (const std::size_t t : first_tos)
        if (!same_dimension(froms[f], tos[t]))
          return Error{
              ErrorCode::wrong_unit, "",
              "`" + plan_.nodes[link.nodes[0][f]].id + "." + from.typification + "." + from.port + "` is in " +
                  std::string(info(froms[f]).name) + "s, `" + plan_.nodes[link.nodes[1][t]].id + "." + to.typification + "." +
                  to.port + "` in " + std::string(info(tos[t]).name) + "s" +
                  (definition.same_units_unless.empty() ? "" : "; give ranges with `" + definition.same_units_unless + "`")};
  }
  return {};
}

Result<void> LinkCompiler::resolve_ports(LinkPlan& link, std::span<const Value> values) const {
  const LinkDefinition& definition = *link.definition;
  if (auto units = check_same_units(link, values); !units) return units;
  for (const LinkRead& read : definition.reads) {
    auto refs = ports_at(plan_, link.nodes[static_cast<int>(read.end)], actual_path(definition, read.path, values),
                         read.is_optional, [&](PortRef ref) -> Result<void> {
                           if (ref.type == PortRef::kNodeId || read.is_lock) return {};
                           return check_kind(plan_, ref, read.kind, read.made, "link reads");
                         });
    if (!refs) return refs.error();
    link.reads.push_back(std::move(*refs));
  }
  std::vector<std::vector<PortRef>> write_refs;
  for (const LinkWrite& write : definition.proposes) {
    auto refs = ports_at(plan_, link.nodes[static_cast<int>(write.end)], actual_path(definition, write.path, values),
                         write.is_optional, [&](PortRef ref) -> Result<void> {
                           if (ref.type == PortRef::kNodeId || plan_.port(ref).rule == CombineRule::none)
                             return Error{ErrorCode::conflict, "", "`" + plan_.path_text(ref) + "` cannot be changed by links"};
                           return check_kind(plan_, ref, write.kind, {}, "link proposes");
                         });
    if (!refs) return refs.error();
    std::copy_if(refs->begin(), refs->end(), std::back_inserter(link.targets),
                 [](const PortRef& ref) { return ref.type != PortRef::kNodeId; });
    write_refs.push_back(std::move(*refs));
  }
  if (!std::is_sorted(link.targets.begin(), link.targets.end())) std::sort(link.targets.begin(), link.targets.end());
  link.targets.erase(std::unique(link.targets.begin(), link.targets.end()), link.targets.end());
  for (const auto& refs : write_refs) {
    auto& indices = link.writes.emplace_back();
    indices.reserve(refs.size());
    // The nodes of an end ascend, and so do their ports.
    std::uint32_t at = 0;
    for (const PortRef& ref : refs) {
      if (ref.type == PortRef::kNodeId) {
        indices.push_back(LinkPlan::kNoTarget);
        continue;
      }
      while (link.targets[at] < ref) ++at;
      indices.push_back(at);
    }
  }
  return {};
}

}  // namespace bl
