// Imports the surroundings of a site from CityJSON: buildings with their solids, and roads, plants, land and water as areas.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/import/context.h"

namespace bl::importing {

/// CityJSON 1.x and 2.0 and sequences of features, plain or packed with gzip. Heights are those of the file.
Result<Context> read_cityjson_context(std::string_view bytes, const ContextOptions& options = {});

}  // namespace bl::importing
