// A scene compiled for running: ids turned into indices, ends resolved to nodes, parameters made into structs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/shared_list.h"
#include "core/graph/dependents.h"
#include "core/graph/plan_memo.h"
#include "core/graph/scene.h"

namespace bl {

struct TypePlan {
  const TypificationDefinition* definition = nullptr;
  std::vector<Value> set_values;  ///< all ports in order; defaults where nobody has set a value
  std::vector<bool> is_set, is_locked;
  bool is_served = true;  ///< has an evaluation, its own or that of its set; else results are defaults
};

struct NodePlan {
  std::string id, name;
  Value id_value;
  std::vector<TypePlan> types;  ///< ascending typification id
};

/// Which typifications the nodes carry. Nodes that carry the same ones have the same form: what follows from it is found out once
/// for all of them, and read without a look at the nodes themselves.
struct NodeForms {
  std::vector<std::vector<const TypificationDefinition*>> types;  ///< by form, as in NodePlan::types
  std::vector<std::uint32_t> of;                                  ///< by node: its form

  const std::vector<const TypificationDefinition*>& types_of(std::uint32_t node) const { return types[of[node]]; }
};

struct LinkPlan {
  static constexpr std::uint32_t kNoTarget = ~std::uint32_t{0};
  std::string id;
  const LinkDefinition* definition = nullptr;  ///< nullptr for ghosts
  bool is_enabled = true, is_muted = false;
  double strength = 1;
  std::shared_ptr<const void> parameters;
  std::vector<std::uint32_t> nodes[2];      ///< node indices of the ends, ascending
  bool is_symmetric = false;                ///< both ends are the same nodes: each unordered pair once
  std::vector<std::vector<PortRef>> reads;  ///< per declared read: one for each node of its end
  std::vector<PortRef> targets;             ///< distinct ports proposed to, ascending
  /// Per declared proposal: index into `targets` for each node of its end; kNoTarget where it is optional and the node lacks it.
  std::vector<std::vector<std::uint32_t>> writes;
  std::optional<Error> error;  ///< why the link cannot run
};

struct SetPlan {
  std::uint32_t node = 0, type = 0, set = 0;
  std::vector<std::uint32_t> members;
  std::vector<PortRef> reads, writes;  ///< row by row, as in SetValues
  std::optional<Error> error;
};

/// A typification that is evaluated beside the tick, with its sets.
struct AnalysisPlan {
  std::uint32_t node = 0, type = 0;
  std::size_t first_set = 0, set_count = 0;  ///< in Plan::sets
  std::size_t latency = 0;                   ///< index of the port that holds it
};

struct Plan {
  Scene scene;  ///< the compiled scene; definitions and ids refer to it, and it keeps its scripts alive
  Settings settings;
  SharedItems<NodePlan> nodes;                   ///< ascending id
  std::shared_ptr<const NodeForms> forms;        ///< of the nodes
  SharedItems<LinkPlan> links;                   ///< ascending id
  SharedVector<SetPlan> sets;                    ///< ascending node id, then typification, then set
  std::vector<AnalysisPlan> analyses;            ///< ascending node id, then typification
  std::shared_ptr<const Dependents> dependents;  ///< shared with plans that are amended from this one in plain values
  /// Shared with plans that are amended from this one while no node comes or goes: nodes, types and ports have the same indices.
  std::shared_ptr<PlanMemo> memo = std::make_shared<PlanMemo>();

  /// Index of a node, or nodes.size().
  std::uint32_t node_index(std::string_view id) const;
  std::optional<PortRef> find(std::uint32_t node, const PortPath& path) const;
  const PortDefinition& port(PortRef ref) const { return forms->types_of(ref.node)[ref.type]->ports[ref.port]; }
  /// "typification.port" of a reference.
  std::string path_text(PortRef ref) const;
};

/// In the order in which the forms are met.
std::shared_ptr<const NodeForms> forms_of(const SharedItems<NodePlan>& nodes);
/// Links that cannot run are kept with the reason; none is left out. `registry`: the types of the program.
std::shared_ptr<const Plan> compile(const Scene& scene, const Registry& registry);

}  // namespace bl
