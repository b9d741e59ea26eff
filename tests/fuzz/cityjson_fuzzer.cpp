// Feeds bytes to the CityJSON importer; what it takes must be sound, finite and accounted for.
#include <cstdint>
#include <string_view>

#include "core/import/cityjson_context.h"
#include "tests/fuzz/context_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  bl::importing::ContextOptions options;
  // A projection of its own, so that no database is asked in every run.
  options.target = bl::importing::GeoReference{"OGC:CRS84", 0, 0, 0, 0, 0};
  options.crs = "OGC:CRS84";
  bl::fuzz::check_context(bl::importing::read_cityjson_context(bytes, options));
  return 0;
}
