// Imports the surroundings of a site from GeoJSON: footprints, plots, land use and streets, by their properties.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/import/context.h"

namespace bl::importing {

/// What the properties of a feature can say, by our names: the left sides of ContextOptions::properties.
std::vector<std::string> context_property_names();

/// Plain or packed with gzip. `feature_kind` of the options says what polygons are; else their properties do, see README.
Result<Context> read_geojson_context(std::string_view bytes, const ContextOptions& options = {});

}  // namespace bl::importing
