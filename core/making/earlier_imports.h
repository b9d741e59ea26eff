// What earlier imports brought into a scene: finds it again, and updates what people have not changed since.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/codec.h"
#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::making {

/// Of a node that an import has set, and another one changes in its place: later imports take it for unchanged by people where it
/// was unchanged before. Was it?
bool set_as_imported(NodeRecord& node, const NodeRecord& before, const Registry& registry);

/// Knows a node again by its typification, its element, and one of three: the same place; an id that holds beyond a file, as
/// those of OpenStreetMap do; or the same source. Of features without an id the geometry is the element (`kGeometryId`); one
/// whose geometry changed is the nearest node whose element left the file. Nodes of scenes before the typification `imported` are
/// known by their id and their place.
class EarlierImports {
 public:
  EarlierImports(const Scene& scene, const Registry& registry);

  /// Begins with a file: each node is the same as one of its elements at most. `elements`: ids of all that it has.
  void begin(const std::string& source, const std::string& licence, bool has_lasting_ids, std::set<std::string> elements = {});
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
  /// The command that removes the node that was claimed; nothing where people have changed it.
  std::optional<Command> remove(const std::string& id);

  /// Ends a file: what became of what it brought before, as sentences; nothing where it is the first import of it. `is_last`: no
  /// other file of the source follows.
  std::vector<std::string> end(bool is_last = true);

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
    std::size_t made = 0, updated = 0, unchanged = 0, edited = 0, removed = 0;
  };
  bool is_claimed(const std::string& node) const { return claimed_.contains(node); }
  bool is_free(const std::string& node) const { return !claimed_.contains(node) && !removed_.contains(node); }
  bool is_near(const std::string& node, const Point3& place) const;
  bool is_left_alone(const std::string& node) const;
  std::string claim_known(Knowns& knowns, const Point3& place);
  std::string claim_near(const std::string& kind, const Point3& place);
  void update(const std::string& id, const NodeRecord& now, const NodeRecord& wanted, std::vector<Command>& commands) const;
  Json record(const std::string& element, const std::string& hash) const;

  const Scene* scene_;
  const Registry* registry_;
  std::map<std::string, Knowns> known_;                   // by typification and element
  std::vector<std::pair<std::string, Known>> made_here_;  // by this file, with the key of `known_`
  std::set<std::string> elements_;                        // of this file
  std::map<std::string, std::vector<Known>> left_;        // by typification: of elements that left it, from west to east
  std::set<std::string> claimed_;                         // of this file
  std::set<std::string> claimed_before_;                  // of files before it in this import
  std::set<std::string> made_now_, removed_;              // by this import, also by its files before
  std::map<std::string, std::set<std::string>> kinds_;    // that the files have, by source
  std::string source_, licence_;
  bool has_lasting_ids_ = false;
  Counts counts_;
  std::vector<std::string> both_;  // changed by people and in the file
};

}  // namespace bl::making
