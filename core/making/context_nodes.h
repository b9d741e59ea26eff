// The surroundings of a site as nodes of a scene, by commands only.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/codec.h"
#include "core/import/context.h"
#include "core/import/data_layer.h"
#include "core/import/terrain_grid.h"
#include "core/making/earlier_imports.h"
#include "core/making/scene_ground.h"
#include "core/making/site_buildings.h"
#include "core/session/commands.h"

namespace bl::making {

/// Where nodes come from, and how they are made.
struct NodeMaking {
  std::string source, licence, unit;
  bool is_extruded = false;                 ///< buildings from outline and height, even where there is a solid
  bool takes_all_streets = false;           ///< footpaths and the like, too
  bool has_lasting_ids = false;             ///< ids of elements hold beyond the file
  importing::ImportWatch* watch = nullptr;  ///< who waits for it; may be null
};

/// Collects commands that add nodes, or update those that an import brought before. Ids tell what nodes are and where they come
/// from.
class ContextNodes {
 public:
  ContextNodes(const Scene& scene, const Registry& registry);

  /// Sets where the scene lies.
  void place(const importing::GeoReference& reference);
  // Each says in `report`, which is that of the elements, what was made of them.
  void add(const importing::Context& context, const NodeMaking& making, SiteBuildings& sites, importing::ImportReport& report);
  void add(const importing::LocalTerrain& terrain, const NodeMaking& making, importing::ImportReport& report);
  void add(const importing::DataLayer& layer, const NodeMaking& making, importing::ImportReport& report);

  /// Around all that is added of one file. `elements`: ids of all that it has; `is_last`: no other file of its source follows.
  void begin(const NodeMaking& making, std::set<std::string> elements = {});
  void end(const std::string& file, bool is_last);

  /// Sets a port of a node that is there already.
  void set_port(const std::string& node, const std::string& path, const Value& value);

  /// All as one command.
  Command batch() const;
  /// Is there nothing to change?
  bool is_empty() const { return commands_.empty(); }
  /// Did an import bring something of these files before?
  bool is_again() const { return is_again_; }
  /// How many nodes of which sort were added.
  const std::map<std::string, std::size_t>& made() const { return made_; }
  /// Around all that was added [m]; the lower corner is above the upper one where nothing was.
  const std::pair<Point3, Point3>& bounds() const { return bounds_; }
  /// Sentences about what the scene cannot hold.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// By row of the report: why an element became no node.
  using Unused = std::map<std::size_t, std::string>;
  std::string fresh_id(const std::string& wanted);
  /// The id of the node that the element became before; empty where it became none.
  std::string known_id(const std::string& kind, const std::string& wanted, const std::string& element, const Point3& place);
  /// That id, else a new one.
  std::string id_of(const std::string& kind, const std::string& wanted, const std::string& element, const Point3& place);
  /// Removes the node that a building which is cleared became before; its id where people have changed it, so that it stays.
  std::string clear_building(const importing::ContextBuilding& building, std::size_t number, SiteBuildings& sites);
  void add_buildings(const importing::Context& context, const NodeMaking& making, SiteBuildings& sites,
                     importing::ImportReport& report, Unused& unused);
  std::pair<std::string, EarlierImports::Fate> add_building(importing::ContextBuilding building, const NodeMaking& making);
  void add_streets(const importing::Context& context, const NodeMaking& making, importing::ImportReport& report, Unused& unused);
  std::string add_junction(const importing::ContextJunction& junction, const Json& turns);
  void add_street(const std::string& id, const importing::ContextStreet& piece, const std::string& start, const std::string& end,
                  importing::ImportReport& report);
  std::map<std::size_t, Json> turn_rules(const importing::Context& context, const std::vector<std::string>& street_ids,
                                         importing::ImportReport& report, Unused& unused);
  std::string add_plot(const importing::ContextArea& area);
  EarlierImports::Fate add_node(const std::string& kind, const std::string& id, const std::string& element, const Json& node);
  void reach(const Point3& point);

  const Registry* registry_;
  std::vector<SceneTerrain> terrains_;  // of the scene before
  EarlierImports earlier_;
  bool is_again_ = false;
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> numbers_;  // the last one given to each stem
  std::vector<Command> commands_;
  std::map<std::string, std::size_t> made_;
  std::vector<std::string> notes_;
  std::pair<Point3, Point3> bounds_{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
};

}  // namespace bl::making
