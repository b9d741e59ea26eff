// Feeds bytes to the OpenStreetMap importer; what it takes must be sound, finite and accounted for.
#include <cstdint>
#include <string_view>

#include "core/import/osm_context.h"
#include "tests/fuzz/context_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto context = bl::importing::read_osm_context({reinterpret_cast<const char*>(data), size});
  bl::fuzz::check_context(context);
  return 0;
}
