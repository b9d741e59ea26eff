// Imports the surroundings of a site from OpenStreetMap: buildings with parts, streets with junctions, and areas of ground.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/import/context.h"

namespace bl::importing {

/// OSM XML (plain or packed with gzip) or PBF.
Result<Context> read_osm_context(std::string_view bytes, const ContextOptions& options = {});

}  // namespace bl::importing
