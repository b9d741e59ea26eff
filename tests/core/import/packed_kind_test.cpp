// Packed files are known by their first bytes, whatever they are called, and every reader says what to do with them.
#include "core/base/packed_kind.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/define/bounded_json.h"
#include "core/import/cityjson_context.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/osm_context.h"
#include "core/import/plan_boundary.h"
#include "core/import/programme_csv.h"
#include "core/import/site_table.h"
#include "core/import/terrain_grid.h"
#include "core/import/tntp.h"
#include "tests/support/gzip.h"

namespace bl::importing {
namespace {

using Reader = std::function<std::string(const std::string&)>;

template <class Work>
std::string said_of(const Work& result) {
  return result.ok() ? "" : result.error().message;
}

const std::vector<std::pair<const char*, Reader>>& all_readers() {
  static const std::vector<std::pair<const char*, Reader>> readers = {
      {"OSM", [](const std::string& bytes) { return said_of(read_osm_context(bytes)); }},
      {"CityJSON", [](const std::string& bytes) { return said_of(read_cityjson_context(bytes)); }},
      {"GeoJSON", [](const std::string& bytes) { return said_of(read_geojson_context(bytes)); }},
      {"grid", [](const std::string& bytes) { return said_of(read_terrain_grid(bytes)); }},
      {"layer", [](const std::string& bytes) { return said_of(read_layer_csv(bytes, {})); }},
      {"GeoJSON layer", [](const std::string& bytes) { return said_of(read_layer_geojson(bytes, {})); }},
      {"plan", [](const std::string& bytes) { return said_of(read_plan_boundary(bytes)); }},
      {"brief", [](const std::string& bytes) { return said_of(read_programme_csv(bytes)); }},
      {"sites", [](const std::string& bytes) { return said_of(read_site_table(bytes)); }},
      {"network", [](const std::string& bytes) { return said_of(read_tntp_network(bytes)); }},
      {"trips", [](const std::string& bytes) { return said_of(read_tntp_trips(bytes)); }},
      {"scene", [](const std::string& bytes) { return said_of(check_json_bounds(bytes)); }}};
  return readers;
}

struct Packed {
  std::string beginning;
  const char* kind;
};

// Archives as their programs begin them; the second and third are a zip without content, and the first of several parts.
TEST(PackedKind, EveryReaderNamesArchivesAndSaysWhatToDo) {
  const Packed all[] = {{"PK\x03\x04", "zip archive"},   {"PK\x05\x06", "zip archive"},
                        {"PK\x07\x08", "zip archive"},   {"7z\xBC\xAF\x27\x1C", "7z archive"},
                        {"Rar!\x1A\x07", "rar archive"}, {"BZh9", "bzip2"},
                        {"\xFD\x37zXZ", "xz"},           {"\x28\xB5\x2F\xFD", "zstd"}};
  for (const Packed& packed : all)
    for (const auto& [name, read] : all_readers())
      for (const std::size_t rest : {std::size_t{0}, std::size_t{18}, std::size_t{400}}) {
        const std::string said = read(packed.beginning + std::string(rest, '\x00'));
        EXPECT_NE(said.find(packed.kind), std::string::npos) << name << ": " << said;
        EXPECT_TRUE(said.find("unpack it") != std::string::npos || said.find("save it") != std::string::npos ||
                    said.find("export it") != std::string::npos)
            << name << ": " << said;
      }
}

// What is packed with gzip is read by importers; where it is not, it is named.
TEST(PackedKind, GzipIsReadOrNamed) {
  EXPECT_EQ(packed_kind(test::gzip_of("text")), "a file packed with gzip");
  for (const char* reader : {"plan", "network", "scene", "brief"})
    for (const auto& [name, read] : all_readers())
      if (name == std::string(reader)) {
        EXPECT_NE(read(test::gzip_of("text")).find("packed with gzip"), std::string::npos) << name;
      }
}

TEST(PackedKind, TextIsNone) {
  for (const char* text : {"", "P", "PK", "PKx", "BZ", "{}", "<osm>", "use,area\n", "7zip", "Rar"})
    EXPECT_EQ(packed_kind(text), "") << text;
  EXPECT_FALSE(packed_refusal("{}").has_value());
}

}  // namespace
}  // namespace bl::importing
