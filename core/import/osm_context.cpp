// From the elements of a file to a Context: the frame first, then areas, streets, and the report of what is left.
#include "core/import/osm_context.h"

#include <array>
#include <cstdint>
#include <functional>
#include <set>

#include "core/import/osm_import.h"
#include "core/import/osm_tags.h"

namespace bl::importing {

namespace {

constexpr const char* kDegrees = "OGC:CRS84";

// The middle of what will probably be taken: of buildings; else of streets; else of everything.
std::optional<std::array<double, 2>> middle(const OsmStore& store) {
  for (const int wanted : {0, 1}) {
    std::vector<std::array<double, 2>> points;
    for (const OsmWay& way : store.ways) {
      if (wanted == 0 ? !is_osm_building(way.tags) : tag_of(way.tags, "highway").empty()) continue;
      for (const std::int64_t id : way.nodes)
        if (const OsmNode* node = store.node(id); node != nullptr && node->has_position)
          points.push_back({node->longitude, node->latitude});
    }
    if (auto found = middle_of(std::move(points))) return found;
  }
  std::vector<std::array<double, 2>> points;
  for (const OsmNode& node : store.nodes)
    if (node.has_position) points.push_back({node.longitude, node.latitude});
  return middle_of(std::move(points));
}

// Which corners each way has, and each relation by its ways: what became of these decides what became of the corners.
ImportCorners corners_of(const OsmStore& store, std::vector<bool>& is_corner) {
  ImportCorners corners{"node", "corner of the lines of ways", "corner of lines that nothing was made of", 0, {}};
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> numbers(store.nodes.size(), kNone);
  const auto add = [&](const OsmWay& way, std::vector<std::uint32_t>& used) {
    for (const std::int64_t id : way.nodes) {
      const OsmNode* node = store.node(id);
      if (node == nullptr || !node->has_position) continue;
      const auto index = static_cast<std::size_t>(node - store.nodes.data());
      if (numbers[index] == kNone) numbers[index] = static_cast<std::uint32_t>(corners.number++);
      is_corner[index] = true;
      used.push_back(numbers[index]);
    }
  };
  for (std::size_t w = 0; w < store.ways.size(); ++w)
    add(store.ways[w], corners.users.emplace_back(w, std::vector<std::uint32_t>()).second);
  for (std::size_t r = 0; r < store.relations.size(); ++r) {
    // A turn restriction names streets, and is no shape of its own.
    if (tag_of(store.relations[r].tags, "type") != "multipolygon") continue;
    auto& used = corners.users.emplace_back(store.ways.size() + r, std::vector<std::uint32_t>()).second;
    for (const OsmMember& member : store.relations[r].members)
      if (const OsmWay* way = member.kind == 'w' ? store.way(member.id) : nullptr) add(*way, used);
  }
  return corners;
}

void report_nodes(const OsmStore& store, const LocalFrame& frame, ImportReport& report) {
  std::vector<bool> is_corner(store.nodes.size(), false);
  ImportCorners corners = corners_of(store, is_corner);
  std::size_t loose = 0, lost = 0;
  for (std::size_t i = 0; i < store.nodes.size(); ++i) {
    const OsmNode& node = store.nodes[i];
    if (!node.has_position) ++lost;
    else if (is_corner[i]) continue;
    else if (node.tags.empty()) ++loose;
    else {
      report.skip("node", "n" + std::to_string(node.id), "a single place: points are not read",
                  node.tags.begin()->first + "=" + node.tags.begin()->second);
      report.locate(place_of({frame.to_local(node.longitude, node.latitude)}));
    }
  }
  if (loose > 0) report.skip("node", "", "neither tags nor a way that uses it", "", loose);
  if (lost > 0) report.skip("node", "", "without a position", "", lost);
  for (const auto& [kind, id] : store.deleted)
    report.skip(kind == 'n' ? "node" : kind == 'w' ? "way" : "relation", kind + std::to_string(id), "it is deleted in the file");
  const auto older = [&report](const char* kind, std::size_t count) {
    if (count > 0) report.skip(kind, "", "another version of it comes later in the file", "", count);
  };
  older("node", store.older_nodes);
  older("way", store.older_ways);
  older("relation", store.older_relations);
  report.set_corners(std::move(corners));
}

// Ways and relations that nobody wanted, told apart by what people would look for.
void decide_rest(OsmImport& import) {
  std::set<std::int64_t> members;
  for (const OsmRelation& relation : import.store->relations)
    for (const OsmMember& member : relation.members)
      if (member.kind == 'w') members.insert(member.id);
  for (const OsmWay& way : import.store->ways) {
    ImportRow& row = import.row_of(way);
    if (!row.reason.empty()) continue;
    if (way.tags.empty() && members.contains(way.id))
      decide(row, ImportOutcome::skipped, "no tags: a piece of a relation that is not read, or of one of its inner rings");
    else
      decide(row, ImportOutcome::skipped, "no building, street or area of ground",
             way.tags.empty() ? "no tags" : way.tags.begin()->first + "=" + way.tags.begin()->second);
  }
}

// Where each way and relation lies, as far as its nodes are in the file.
void locate(OsmImport& import) {
  const auto places_of = [&import](const OsmWay& way) {
    std::size_t missing = 0;
    return import.places(way.nodes, missing);
  };
  for (const OsmWay& way : import.store->ways) import.row_of(way).place = place_of(places_of(way));
  for (std::size_t i = 0; i < import.relations.size(); ++i) {
    std::vector<Point3> points;
    for (const OsmMember& member : import.store->relations[i].members) {
      std::size_t missing = 0;
      const OsmWay* way = member.kind == 'w' ? import.store->way(member.id) : nullptr;
      const std::vector<Point3> more = way != nullptr       ? places_of(*way)
                                       : member.kind == 'n' ? import.places({member.id}, missing)
                                                            : std::vector<Point3>();
      points.insert(points.end(), more.begin(), more.end());
    }
    import.relations[i].place = place_of(points);
  }
}

}  // namespace

std::size_t OsmImport::index_of(const ImportRow& row) const {
  for (std::size_t i = 0; const std::vector<ImportRow>* list : {&ways, &relations}) {
    // Addresses within one list count; std::less orders those of different ones as well.
    const std::less<const ImportRow*> before;
    if (!list->empty() && !before(&row, list->data()) && before(&row, list->data() + list->size()))
      return i + static_cast<std::size_t>(&row - list->data());
    i += list->size();
  }
  return kNoRow;
}

std::vector<Point3> OsmImport::places(const std::vector<std::int64_t>& nodes, std::size_t& missing) const {
  std::vector<Point3> places;
  places.reserve(nodes.size());
  for (const std::int64_t id : nodes) {
    const OsmNode* node = store->node(id);
    if (node == nullptr || !node->has_position) ++missing;
    else places.push_back(frame->to_local(node->longitude, node->latitude));
  }
  return places;
}

Result<Context> read_osm_context(std::string_view bytes, const ContextOptions& options) {
  auto store = read_osm(bytes, options.watch);
  if (!store) return store.error();
  if (!options.crs.empty() && !is_longitude_latitude(tidy_crs_name(options.crs)))
    return Error{ErrorCode::conflict, "crs", "OpenStreetMap files are in longitude and latitude always: leave the CRS out."};
  const auto centre = middle(*store);
  if (!centre) return Error{ErrorCode::missing, "", "The file holds no node with a position: there is nothing to import."};
  auto frame = context_frame(options, kDegrees, *centre);
  if (!frame) return frame.error();
  Context context;
  context.source_crs = kDegrees;
  context.reference = frame->reference();
  context.notes = frame->notes();
  OsmImport import{&*store, &options, &*frame, &context, {}, {}, {}};
  for (const OsmWay& way : store->ways)
    import.ways.push_back({ImportOutcome::taken, "way", "w" + std::to_string(way.id), "", "", 1, {}, {}});
  for (const OsmRelation& relation : store->relations)
    import.relations.push_back({ImportOutcome::taken, "relation", "r" + std::to_string(relation.id), "", "", 1, {}, {}});
  read_osm_areas(import);
  read_osm_streets(import);
  read_osm_rails(import);
  if (options.watch != nullptr && options.watch->is_stopped) return stopped_error();
  decide_rest(import);
  locate(import);
  for (const std::vector<ImportRow>* rows : {&import.ways, &import.relations})
    for (const ImportRow& row : *rows) context.report.add(row);
  for (const auto& [row, leader] : import.followers) context.report.follow(row, leader);
  report_nodes(*store, *frame, context.report);
  assume_heights(options, context);
  return context;
}

}  // namespace bl::importing
