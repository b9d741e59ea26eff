// Who names a node: the links and the sets of nodes that have its id in them.
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/define/value.h"

namespace bl {

struct LinkRecord;
struct NodeRecord;
struct Scene;

/// Kept while nodes are removed one after another, so that each need not look at all others. What is named here may have ceased
/// to be named, or to be there at all; what is not named here is named by nobody.
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
