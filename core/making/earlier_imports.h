// What earlier imports brought into a scene: finds it again, and updates what people have not changed since.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/codec.h"
#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::making {

/// Knows a node again by its typification, its element, and one of three: the same source; an id that holds beyond a file, as
/// those of OpenStreetMap do; or the same place. Nodes of scenes before the typification `imported` are known by their id and
/// their place.
class EarlierImports {
 public:
  EarlierImports(const Scene& scene, const Registry& registry);

  /// Begins with a file: each node is the same as one of its elements at most.
  void begin(const std::string& source, const std::string& licence, bool has_lasting_ids);
  /// The node that is the element; empty where there is none. `id`: what a node of it is called.
  std::string claim(const std::string& kind, const std::string& id, const std::string& element, const Point3& place);

  enum class Fate { made, updated, as_before };
  struct Change {
    Fate fate = Fate::made;
    std::vector<Command> commands;
  };
  /// Adds the node, or brings the one that was claimed up to date, where people have left it as it was. `node` as in a scene
  /// file.
  Result<Change> put(const std::string& kind, const std::string& id, const std::string& element, const Json& node);

  /// Ends a file: what became of what it brought before, as sentences; nothing where it is the first import of it.
  std::vector<std::string> end();

 private:
  struct Known {
    std::string node, source;
    Point3 place;
  };
  /// Of one element: each is claimed once for a file, from the first that is left.
  struct Knowns {
    std::vector<Known> nodes;
    std::size_t first = 0;
  };
  struct Counts {
    std::size_t made = 0, updated = 0, unchanged = 0, edited = 0;
  };
  bool is_claimed(const std::string& node) const { return claimed_.contains(node); }
  bool is_near(const std::string& node, const Point3& place) const;
  void update(const std::string& id, const NodeRecord& now, const NodeRecord& wanted, std::vector<Command>& commands) const;
  Json record(const std::string& element, const std::string& hash) const;

  const Scene* scene_;
  const Registry* registry_;
  std::map<std::string, Knowns> known_;                   // by typification and element
  std::vector<std::pair<std::string, Known>> made_here_;  // by this file, with the key of `known_`
  std::set<std::string> claimed_;                         // of this file
  std::set<std::string> made_now_;                        // by this import, also by its files before
  std::set<std::string> kinds_;                           // that this file has
  std::string source_, licence_;
  bool has_lasting_ids_ = false;
  Counts counts_;
  std::vector<std::string> both_;  // changed by people and in the file
};

}  // namespace bl::making
