// Finding elements and tags in what was read of OpenStreetMap.
#include "core/import/osm_store.h"

#include <algorithm>

namespace bl::importing {

namespace {

template <class Element>
const Element* find_in(const std::vector<Element>& list, std::int64_t id) {
  const auto it = std::lower_bound(list.begin(), list.end(), id, [](const Element& a, std::int64_t b) { return a.id < b; });
  return it != list.end() && it->id == id ? &*it : nullptr;
}

}  // namespace

const std::string& tag_of(const OsmTags& tags, std::string_view key) {
  static const std::string nothing;
  const auto it = tags.find(key);
  return it == tags.end() ? nothing : it->second;
}

const OsmNode* OsmStore::node(std::int64_t id) const { return find_in(nodes, id); }
const OsmWay* OsmStore::way(std::int64_t id) const { return find_in(ways, id); }

}  // namespace bl::importing
