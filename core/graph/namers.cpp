// One look at all links and all settings of nodes.
#include "core/graph/namers.h"

#include "core/graph/scene.h"

namespace bl {

namespace {

const std::set<std::string>& found_namers(const std::map<std::string, std::set<std::string>>& all, const std::string& node) {
  static const std::set<std::string> kNobody;
  const auto found = all.find(node);
  return found == all.end() ? kNobody : found->second;
}

}  // namespace

Namers::Namers(const Scene& scene) {
  for (const auto& [id, link] : scene.links) note(id, link);
  for (const auto& [id, node] : scene.nodes) note(id, node);
}

void Namers::note(const std::string& id, const NodeRecord& node) {
  for (const auto& [type, values] : node.types)
    for (const auto& [port, value] : values) note(id, value);
}

void Namers::note(const std::string& id, const Value& value) {
  if (const auto* selection = std::get_if<Shared<Selection>>(&value))
    for (const std::string& named : (*selection)->ids) nodes_[named].insert(id);
}

void Namers::note(const std::string& id, const LinkRecord& link) {
  for (const Selection* end : {&link.from, &link.to})
    for (const std::string& named : end->ids) links_[named].insert(id);
}

const std::set<std::string>& Namers::links_to(const std::string& node) const { return found_namers(links_, node); }
const std::set<std::string>& Namers::nodes_to(const std::string& node) const { return found_namers(nodes_, node); }

}  // namespace bl
