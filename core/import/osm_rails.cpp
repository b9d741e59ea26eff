// Railways and trams of OpenStreetMap: lines of tracks on the ground, for what has to keep clear of them.
#include "core/base/plural.h"
#include "core/import/osm_import.h"
#include "core/import/osm_tags.h"

namespace bl::importing {

namespace {

// The nodes of a way that follow each other without a gap in the file.
std::vector<std::vector<Point3>> tracks_of(const OsmImport& import, const OsmWay& way, std::size_t& missing) {
  std::vector<std::vector<Point3>> tracks(1);
  for (const std::int64_t node : way.nodes) {
    std::size_t none = 0;
    const std::vector<Point3> place = import.places({node}, none);
    missing += none;
    if (none == 0) tracks.back().push_back(place.front());
    else if (!tracks.back().empty()) tracks.emplace_back();
  }
  std::erase_if(tracks, [](const std::vector<Point3>& track) { return track.size() < 2; });
  return tracks;
}

void read_rail(OsmImport& import, const OsmWay& way, const std::string& rail_class) {
  ImportRow& row = import.row_of(way);
  std::size_t missing = 0, number = 0;
  std::string far;
  for (std::vector<Point3>& track : tracks_of(import, way, missing)) {
    if (const std::string reach = out_of_reach(*import.options, track); !reach.empty()) {
      far = reach;
      continue;
    }
    import.context->rails.push_back({"w" + std::to_string(way.id) + "/" + std::to_string(number++), tag_of(way.tags, "name"),
                                     rail_class, std::move(track), import.index_of(row)});
  }
  const std::string lost = missing == 0 ? "" : how_many(missing, "node") + by_number(missing, " is", " are") + " not in the file";
  if (number == 0)
    return decide(row, ImportOutcome::skipped, "railway: " + (far.empty() ? std::string("fewer than two nodes") : far), lost);
  decide(row, missing > 0 ? ImportOutcome::repaired : ImportOutcome::taken, "railway", lost);
}

}  // namespace

void read_osm_rails(OsmImport& import) {
  const std::vector<OsmWay>& ways = import.store->ways;
  for (std::size_t i = 0; i < ways.size() && import.goes_on("railways", i, ways.size()); ++i)
    if (const std::string rail_class = osm_rail(ways[i].tags); !rail_class.empty() && import.row_of(ways[i]).reason.empty())
      read_rail(import, ways[i], rail_class);
}

}  // namespace bl::importing
