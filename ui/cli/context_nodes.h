// The surroundings of a site as nodes of a scene, by commands only.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/exchange/context.h"
#include "core/exchange/data_layer.h"
#include "core/exchange/terrain_grid.h"
#include "core/session/commands.h"

namespace bl::cli {

/// Where nodes come from, and how they are made.
struct NodeMaking {
  std::string source, licence, unit;
  bool is_extruded = false;        ///< buildings from outline and height, even where there is a solid
  bool takes_all_streets = false;  ///< footpaths and the like, too
};

/// Collects commands that add nodes; ids are new to the scene and tell what they are and where they come from.
class ContextNodes {
 public:
  ContextNodes(const Scene& scene, const Registry& registry);

  /// Sets where the scene lies.
  void place(const GeoReference& reference);
  /// Answers which rows of the report were read and then made no node, and why.
  std::map<std::string, std::string> add(const Context& context, const NodeMaking& making);
  void add(const LocalTerrain& terrain, const NodeMaking& making);
  void add(const DataLayer& layer, const NodeMaking& making);

  /// All as one command.
  Command batch() const;
  /// How many nodes of which sort were added.
  const std::map<std::string, std::size_t>& made() const { return made_; }
  /// Sentences about what the scene cannot hold.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  // What became of the elements of each row: a row is used where any of them is.
  struct Uses {
    std::set<std::string> used;
    std::map<std::string, std::string> reasons;
    void use(const std::string& row) { used.insert(row); }
    void leave(const std::string& row, const std::string& reason) { reasons.emplace(row, reason); }
  };

  std::string fresh_id(const std::string& wanted);
  void add_building(const ContextBuilding& building, const NodeMaking& making);
  void add_streets(const Context& context, const NodeMaking& making, Uses& uses);
  void add_plot(const ContextArea& area);

  const Registry* registry_;
  std::set<std::string> taken_;
  std::vector<std::string> commands_;  // each a JSON text
  std::map<std::string, std::size_t> made_;
  std::vector<std::string> notes_;
};

}  // namespace bl::cli
