// Feeds bytes to the GeoJSON importers of surroundings and of data layers; what they take must be sound, finite and accounted
// for.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "tests/fuzz/context_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  bl::importing::ContextOptions options;
  options.target = bl::importing::GeoReference{"OGC:CRS84", 0, 0, 0, 0, 0};
  options.crs = "OGC:CRS84";
  bl::fuzz::check_context(bl::importing::read_geojson_context(bytes, options));
  const auto layer = bl::importing::read_layer_geojson(bytes, options);
  if (!layer) {
    bl::fuzz::require(!layer.error().message.empty(), "an error without a sentence");
    return 0;
  }
  for (const bl::importing::LayerPoint& point : layer->points)
    bl::fuzz::require(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.value),
                      "a point that is not finite");
  return 0;
}
