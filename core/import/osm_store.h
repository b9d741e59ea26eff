// The nodes, ways and relations of an OpenStreetMap file as plain data, XML or PBF, unjudged.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/import/import_watch.h"

namespace bl::importing {

using OsmTags = std::map<std::string, std::string, std::less<>>;

/// The value of a tag, or an empty text.
const std::string& tag_of(const OsmTags& tags, std::string_view key);

struct OsmNode {
  std::int64_t id = 0;
  bool is_deleted = false;
  double longitude = 0, latitude = 0;  ///< [deg]
  bool has_position = false;
  OsmTags tags;
};
struct OsmWay {
  std::int64_t id = 0;
  bool is_deleted = false;
  std::vector<std::int64_t> nodes;
  OsmTags tags;
  bool is_closed() const { return nodes.size() > 3 && nodes.front() == nodes.back(); }
};
struct OsmMember {
  char kind = 'w';  ///< 'n', 'w' or 'r'
  std::int64_t id = 0;
  std::string role;
};
struct OsmRelation {
  std::int64_t id = 0;
  bool is_deleted = false;
  std::vector<OsmMember> members;
  OsmTags tags;
};

/// Each list in ascending id. Of several versions of one element the last one counts; the others are counted here.
struct OsmStore {
  std::vector<OsmNode> nodes;
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::size_t older_nodes = 0, older_ways = 0, older_relations = 0;
  /// Kind and id of those that the last version in the file deletes; they are in no list.
  std::vector<std::pair<char, std::int64_t>> deleted;

  const OsmNode* node(std::int64_t id) const;
  const OsmWay* way(std::int64_t id) const;
};

/// No more elements than this are read.
inline constexpr std::size_t kMostOsmElements = 20000000;

/// Of osm_reading.cpp. .osm, .osm.gz and .osm.pbf, told apart by their first bytes; read by libosmium.
Result<OsmStore> read_osm(std::string_view bytes, ImportWatch* watch = nullptr);

}  // namespace bl::importing
