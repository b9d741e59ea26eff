// Compiles the links of a scene, each for itself.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/graph/plan.h"
#include "core/graph/port_finder.h"

namespace bl {

class LinkCompiler {
 public:
  /// `plan`: with its scene and its nodes; must outlive the compiler. `registry`: the types of that scene.
  LinkCompiler(const Plan& plan, const Registry& registry) : plan_(plan), registry_(registry) {}

  /// Where the link cannot run, its plan says why.
  LinkPlan compiled(const std::string& id, const LinkRecord& record) const;
  /// The same for a link that `before` was compiled from with the record `old`, at the same nodes. Its ends are found anew only
  /// where they may differ.
  LinkPlan amended(const LinkPlan& before, const LinkRecord& old, const LinkRecord& record) const;

 private:
  // A declared path at an end, and the unit in which the link works there.
  struct Wanted {
    PortPath path;
    const std::optional<Unit>* unit = nullptr;
    bool is_optional = false;
  };

  std::string why_it_rests(const std::string& kind) const;
  std::vector<Wanted> wanted_at(const LinkDefinition& definition, End end, std::span<const Value> values) const;
  Result<std::vector<std::uint32_t>> end_nodes(const LinkPlan& link, const Selection& selection, End end,
                                               std::span<const Value> values) const;
  Error lack_of(const LinkDefinition& definition, std::uint32_t node, const PortPath& path, End end) const;
  Error nothing_fits(const LinkDefinition& definition, std::size_t chosen, const PortPath* lacking, End end) const;
  std::string nearest_port(const PortPath& path) const;
  // Whether other nodes of the same form have to be looked at as well: each of them chooses a unit.
  Result<bool> check_units(std::uint32_t node, std::span<const Wanted> wanted) const;
  Unit unit_at(std::optional<PortRef> ref) const;
  std::vector<Unit> units_at(const std::vector<std::uint32_t>& nodes, const PortPath& path) const;
  Result<void> check_same_units(const LinkPlan& link, std::span<const Value> values) const;
  Result<void> resolve_ports(LinkPlan& link, std::span<const Value> values) const;

  const Plan& plan_;
  const Registry& registry_;
};

}  // namespace bl
