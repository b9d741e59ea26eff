// The state that the parts of the OpenStreetMap importer share while one file is read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/import/context_shape.h"
#include "core/import/osm_store.h"

namespace bl::importing {

/// One file on its way to a Context. The rows stand beside the ways and relations of the store, one for each; an empty reason
/// means that nobody has decided yet.
struct OsmImport {
  const OsmStore* store = nullptr;
  const ContextOptions* options = nullptr;
  const LocalFrame* frame = nullptr;
  Context* context = nullptr;
  std::vector<ImportRow> ways, relations;
  std::vector<std::pair<std::size_t, std::size_t>> followers;  ///< rows of the report, each with the one that it is taken for

  ImportRow& row_of(const OsmWay& way) { return ways[static_cast<std::size_t>(&way - store->ways.data())]; }
  /// Of a row in one of the lists: where it will stand in the report.
  std::size_t index_of(const ImportRow& row) const;
  /// Was the import stopped? `done` of `total` elements are finished.
  bool goes_on(const char* step, std::size_t done, std::size_t total) const {
    return done % 256 != 0 || bl::importing::goes_on(options->watch, step, done, total);
  }
  /// The nodes' places in local metres; `missing` counts those that the file does not hold.
  std::vector<Point3> places(const std::vector<std::int64_t>& nodes, std::size_t& missing) const;
};

inline void decide(ImportRow& row, ImportOutcome outcome, std::string reason, std::string detail = "") {
  row.outcome = outcome;
  row.reason = std::move(reason);
  row.detail = std::move(detail);
}

/// Buildings with their parts, and areas of land use, green and water: of relations first, then of ways.
void read_osm_areas(OsmImport& import);
/// Streets between junctions, and turn restrictions.
void read_osm_streets(OsmImport& import);
/// Tracks of railways and trams that no street runs along.
void read_osm_rails(OsmImport& import);

}  // namespace bl::importing
