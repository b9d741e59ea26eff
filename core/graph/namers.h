// The namers of a node: the links, and the values of nodes, that contain its id.
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/define/value.h"

namespace bl {

struct LinkRecord;
struct NodeRecord;
struct Scene;

/// Kept while nodes are removed one after another, so that each removal need not search all others. Entries may be out of date: a
/// namer may be gone, or name the node no longer. No namer is missing.
class Namers {
 public:
  explicit Namers(const Scene& scene);

  void note(const std::string& id, const NodeRecord& node);
  void note(const std::string& id, const LinkRecord& link);
  /// A value of a node.
  void note(const std::string& id, const Value& value);
  /// Ids of links, and of nodes, that may name the node.
  const std::set<std::string>& links_to(const std::string& node) const;
  const std::set<std::string>& nodes_to(const std::string& node) const;

 private:
  std::map<std::string, std::set<std::string>> links_, nodes_;  // by who is named
};

}  // namespace bl
