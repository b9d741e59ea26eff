// A law of all importers: of a file that was cut off anywhere, or that noise got into, they never fall, they account for every
// element that they take, and what they refuse they name: what the file should be, or that it is cut off.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "core/base/random.h"
#include "core/import/cityjson_context.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/inflate.h"
#include "core/import/osm_context.h"
#include "core/import/plan_boundary.h"
#include "core/import/programme_csv.h"
#include "core/import/site_table.h"
#include "core/import/terrain_grid.h"
#include "core/import/tntp.h"
#include "tests/core/import/context_data.h"
#include "tests/support/gzip.h"

namespace bl::importing {
namespace {

// What an importer made of some bytes: nothing, or its error; `unsound` says what is wrong with what it took.
struct Verdict {
  std::string error, unsound;
};

Verdict verdict_of(const Error& error) { return {error.text(), error.message.empty() ? "an error without a sentence" : ""}; }

Verdict verdict_of(const ImportReport& report) {
  for (const ImportRow& row : report.rows())
    if (row.reason.empty() || row.count == 0) return {"", "a row without a reason or without an element"};
  return {"", report.total() == 0 ? "nothing is accounted for" : ""};
}

Verdict verdict_of(const Result<Context>& context) {
  if (!context) return verdict_of(context.error());
  for (const ContextBuilding& building : context->buildings)
    if (building.row >= context->report.rows().size() || context->report.rows()[building.row].outcome == ImportOutcome::skipped)
      return {"", "a building without a row that says that it was taken"};
  for (const ContextStreet& street : context->streets)
    if (street.row >= context->report.rows().size() || context->report.rows()[street.row].outcome == ImportOutcome::skipped)
      return {"", "a street without a row that says that it was taken"};
  return verdict_of(context->report);
}

template <class T>
Verdict verdict_of_plain(const Result<T>& result) {
  return result ? Verdict{} : verdict_of(result.error());
}

const std::string kSampleMap =
    R"(<?xml version="1.0" encoding="UTF-8"?><osm version="0.6"><node id="1" lat="60" lon="25"/><node id="2" lat="60" lon="25.001"/>)"
    R"(<node id="3" lat="60.001" lon="25.001"/><node id="4" lat="60.001" lon="25"/><way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/>)"
    R"(<nd ref="4"/><nd ref="1"/><tag k="building" v="yes"/></way><way id="2"><nd ref="1"/><nd ref="3"/><tag k="highway" v="residential"/></way></osm>)";
const std::string kSampleFeatures =
    R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"height": 9, "level": 3}, "geometry": {"type": "Polygon",
 "coordinates": [[[5, 52], [5.001, 52], [5.001, 52.001], [5, 52]]]}}, {"type": "Feature", "properties": {"level": 3}, "geometry": {"type": "Point", "coordinates": [5, 52]}}]})";
const std::string kSampleModel =
    R"({"type": "CityJSON", "version": "2.0", "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"},
 "vertices": [[85000,447000,0],[85010,447000,0],[85010,447010,0],[85000,447010,0]], "CityObjects": {"b": {"type": "Building",
 "attributes": {"measuredHeight": 8}, "geometry": [{"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]}]}}})";
const std::string kSampleSequence =
    R"({"type": "CityJSON", "version": "2.0", "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"}, "transform": {"scale": [1,1,1], "translate": [85000,447000,0]}, "vertices": [], "CityObjects": {}})"
    "\n"
    R"({"type": "CityJSONFeature", "id": "b", "vertices": [[0,0,0],[10,0,0],[10,10,0],[0,10,0]], "CityObjects": {"b": {"type": "Building", "attributes": {"measuredHeight": 8}, "geometry": [{"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]}]}}})"
    "\n";
const std::string kSampleGrid =
    "ncols 3\nnrows 2\nxllcorner 84990\nyllcorner 446990\ncellsize 50\nNODATA_value -9999\n1 2 3\n4 5 6\n";
const std::string kSampleTable = "x,y,level\n85000,447000,55\n85040,447040,65\n";
const std::string kSampleBrief = "use,floor_area_m2,count\nhousing,1200,3\noffices,800,2\n";
const std::string kSampleSites = "x,y,z,weight,demand\n1,2,3,4,100\n5,6,7,8,200\n";
const std::string kSampleNetwork =
    "<NUMBER OF ZONES> 2\n<NUMBER OF NODES> 3\n<FIRST THRU NODE> 1\n<NUMBER OF LINKS> 3\n<END OF METADATA>\n"
    "~ init_node term_node capacity length free_flow_time b power speed toll type ;\n"
    "1 3 900 2.5 6 0.15 4 0 20 1 ;\n3 2 1000 1 4 0.2 2 0 0 1 ;\n2 1 500 1 4 0.2 2 0 0 1 ;\n";
const std::string kSampleTrips =
    "<NUMBER OF ZONES> 2\n<TOTAL OD FLOW> 42.5\n<END OF METADATA>\nOrigin 1\n1 : 0.0; 2 : 12.0;\nOrigin 2\n1 : 30.5;\n";

// A PBF with blocks that are not packed: a header, and one block with a node of no tags.
std::string sample_pbf() {
  const auto number = [](std::uint64_t value) {
    std::string text;
    for (; value > 127; value >>= 7) text += static_cast<char>((value & 127) | 128);
    return text + static_cast<char>(value);
  };
  const auto field = [&](char key, const std::string& bytes) { return std::string(1, key) + number(bytes.size()) + bytes; };
  const auto block = [&](const std::string& type, const std::string& content) {
    const std::string blob = field('\x0a', content), header = field('\x0a', type) + '\x18' + number(blob.size());
    std::string length(4, '\0');
    length[3] = static_cast<char>(header.size());
    return length + header + blob;
  };
  const auto node = [&](std::uint64_t id) {  // sint64: doubled; 52 and 5 degrees in units of 100 nanodegrees
    return field('\x0a', '\x08' + number(2 * id) + '\x40' + number(2 * (520000000 + 100 * id)) + '\x48' + number(2 * 50000000));
  };
  const std::string header = field('\x22', "OsmSchema-V0.6");
  const std::string content = field('\x0a', field('\x0a', "")) + field('\x12', node(1) + node(2));
  return block("OSMHeader", header) + block("OSMData", content);
}

struct Importer {
  const char* name;
  std::string sample;
  std::function<Verdict(const std::string&)> read;
  bool is_cut_seen;                // wherever it is cut off, it cannot be a whole file
  std::vector<const char*> names;  // of what the file should be, one of which a refusal contains
};

std::vector<Importer> all_importers() {
  const ContextOptions local = test::in_crs("EPSG:28992");
  const auto osm = [](const std::string& text) { return verdict_of(read_osm_context(text)); };
  const auto city = [](const std::string& text) { return verdict_of(read_cityjson_context(text)); };
  const auto grid = [](const std::string& text) { return verdict_of_plain(read_terrain_grid(text)); };
  return {
      {"OSM XML", kSampleMap, osm, true, {"OpenStreetMap", "XML"}},
      {"OSM gzip", test::gzip_of(kSampleMap), osm, true, {"OpenStreetMap", "XML", "packed file"}},
      {"OSM PBF", sample_pbf(), osm, false, {"OpenStreetMap", "PBF", "holds no node"}},
      {"GeoJSON",
       kSampleFeatures,
       [](const std::string& text) { return verdict_of(read_geojson_context(text)); },
       true,
       {"GeoJSON", "JSON", "features", "position", "geometr"}},
      {"GeoJSON layer",
       kSampleFeatures,
       [](const std::string& text) {
         const auto layer = read_layer_geojson(text, {}, "level");
         return layer ? verdict_of(layer->report) : verdict_of(layer.error());
       },
       true,
       {"GeoJSON", "JSON", "features", "position", "point"}},
      {"GeoJSON plan",
       kSampleFeatures,
       [](const std::string& text) { return verdict_of_plain(read_plan_boundary(text)); },
       true,
       {"GeoJSON", "JSON", "feature", "polygon", "ring"}},
      {"CityJSON", kSampleModel, city, true, {"CityJSON", "CityObjects", "vert", "JSON"}},
      {"CityJSON sequence", kSampleSequence, city, false, {"CityJSON", "CityObjects", "line", "vert"}},
      {"ASCII grid", kSampleGrid, grid, false, {"ASCII grid"}},
      {"table",
       kSampleTable,
       [local](const std::string& text) {
         const auto layer = read_layer_csv(text, local, "");
         return layer ? verdict_of(layer->report) : verdict_of(layer.error());
       },
       false,
       {"table", "column", "point"}},
      {"programme", kSampleBrief, [](const std::string& text) { return verdict_of_plain(read_programme_csv(text)); }, false, {}},
      {"sites", kSampleSites, [](const std::string& text) { return verdict_of_plain(read_site_table(text)); }, false, {}},
      {"TNTP network",
       kSampleNetwork,
       [](const std::string& text) { return verdict_of_plain(read_tntp_network(text)); },
       false,
       {}},
      {"TNTP trips", kSampleTrips, [](const std::string& text) { return verdict_of_plain(read_tntp_trips(text)); }, false, {}},
  };
}

bool says(const std::string& error, const std::vector<const char*>& words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return error.find(word) != std::string::npos; });
}

// A sentence for people, none of a machine's words, and no suspicion of what is not so.
void expect_sentence(const std::string& error, const std::vector<const char*>& names) {
  EXPECT_LT(error.size(), 600u) << error;
  for (const char* word :
       {"std::", "exception", "basic_string", "is it complete", "Is it complete", "is the file complete", "is it GeoJSON?"})
    EXPECT_EQ(error.find(word), std::string::npos) << error;
  const bool is_named =
      names.empty() || says(error, names) || says(error, {"cut off", "empty", "damaged", "binary data", "no format", "crs"});
  EXPECT_TRUE(is_named) << error;
}

TEST(ImportPrefixLaw, WholeSamplesAreTaken) {
  for (const Importer& importer : all_importers()) {
    const Verdict verdict = importer.read(importer.sample);
    EXPECT_EQ(verdict.error, "") << importer.name;
    EXPECT_EQ(verdict.unsound, "") << importer.name;
  }
}

TEST(ImportPrefixLaw, EveryBeginningIsAccountedForOrRefusedAsWhatItIs) {
  for (const Importer& importer : all_importers()) {
    SCOPED_TRACE(importer.name);
    const std::size_t end = importer.sample.find_last_not_of(" \r\n") + 1;
    for (std::size_t length = 0; length < end; ++length) {
      const Verdict verdict = importer.read(importer.sample.substr(0, length));
      SCOPED_TRACE("the first " + std::to_string(length) + " of " + std::to_string(end) + " bytes");
      EXPECT_EQ(verdict.unsound, "");
      if (!verdict.error.empty()) expect_sentence(verdict.error, importer.names);
      const bool is_told = !importer.is_cut_seen || says(verdict.error, {"cut off", "empty"});
      EXPECT_TRUE(is_told) << "`" << verdict.error << "`";
      if (testing::Test::HasFailure()) break;
    }
  }
}

TEST(ImportPrefixLaw, NoiseIsAccountedForOrRefusedAsWhatItIs) {
  for (const Importer& importer : all_importers()) {
    SCOPED_TRACE(importer.name);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      Random random(seed);
      std::string bytes = importer.sample;
      for (std::uint64_t hits = 1 + random.below(4); hits > 0; --hits) {
        const std::size_t at = random.below(bytes.size());
        if (random.below(3) == 0) bytes.erase(at, 1 + random.below(20));
        else if (random.below(2) == 0) bytes[at] = static_cast<char>(random.below(256));
        else bytes.insert(at, bytes.substr(random.below(bytes.size()), 1 + random.below(20)));
        if (bytes.empty()) bytes = "x";
      }
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Verdict verdict = importer.read(bytes);
      EXPECT_EQ(verdict.unsound, "");
      if (!verdict.error.empty()) expect_sentence(verdict.error, {});
      if (testing::Test::HasFailure()) break;
    }
  }
}

// Trips that were cut off anywhere lack some: no beginning passes with a note.
TEST(ImportPrefixLaw, TripsCutOffAnywhereAreRefused) {
  const std::size_t first = kSampleTrips.find("Origin"), end = kSampleTrips.rfind(';');
  for (std::size_t length = first; length <= end; ++length)
    EXPECT_FALSE(read_tntp_trips(kSampleTrips.substr(0, length)).ok()) << kSampleTrips.substr(0, length);
  EXPECT_TRUE(read_tntp_trips(kSampleTrips.substr(0, end + 1)).ok());
  const std::size_t rows = kSampleNetwork.find("1 3 900"), last = kSampleNetwork.rfind(" ;");
  for (std::size_t length = rows; length <= last; ++length)
    EXPECT_FALSE(read_tntp_network(kSampleNetwork.substr(0, length)).ok()) << kSampleNetwork.substr(0, length);
}

// Real files, cut at places of all sizes.
TEST(ImportPrefixLaw, RealFilesCutOffAreCalledCutOff) {
  struct Real {
    const char* file;
    std::function<Verdict(const std::string&)> read;
  };
  const auto osm = [](const std::string& text) { return verdict_of(read_osm_context(text)); };
  const auto grid = [](const std::string& text) { return verdict_of_plain(read_terrain_grid(text)); };
  for (const Real& real :
       {Real{"osm/small_village.osm", osm},
        {"osm/monaco.osm.gz", osm},
        {"osm/lemans_centre.osm.pbf", osm},
        {"geojson/prague_bubenec_plots.geojson", [](const std::string& text) { return verdict_of(read_geojson_context(text)); }},
        {"cityjson/denhaag_DH01_subset_v11.city.json",
         [](const std::string& text) { return verdict_of(read_cityjson_context(text)); }},
        {"layers/elevation_luxembourg_wgs84.tif", grid},
        {"layers/terrain_loire_15m_l93.asc.gz", grid}}) {
    const std::string bytes = test::shared_bytes(real.file);
    if (bytes.empty()) continue;
    SCOPED_TRACE(real.file);
    for (std::size_t length = 1; length < bytes.size(); length = length * 3 + 1) {
      const Verdict verdict = real.read(bytes.substr(0, length));
      EXPECT_TRUE(says(verdict.error, {"cut off", "empty"})) << length << " bytes: `" << verdict.error << "`";
    }
    const Verdict most = real.read(bytes.substr(0, bytes.size() - 40));
    EXPECT_TRUE(says(most.error, {"cut off", "empty"})) << "all but 40 bytes: `" << most.error << "`";
  }
}

TEST(ImportPrefixLaw, WhatUnpacksToGigabytesIsRefusedEarly) {
  // Blanks without end pack to a thousandth, as nothing does that people make: the first 64 MiB give them away.
  const std::string bomb = test::gzip_of(std::string(std::size_t{160} << 20, ' '));
  const auto refused = unpacked(bomb);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("200 times its size"), std::string::npos) << refused.error().text();
  // Of what is no bomb the size alone decides.
  const std::string sound = test::gzip_of(kSampleMap);
  EXPECT_TRUE(unpacked(sound, kSampleMap.size()).ok());
  const auto large = unpacked(sound, kSampleMap.size() - 1);
  ASSERT_FALSE(large.ok());
  EXPECT_NE(large.error().message.find("unpacks to more than"), std::string::npos);
}

TEST(ImportPrefixLaw, PbfThatUnpacksToGigabytesIsRefusedBeforeItIsUnpacked) {
  // A header, then blocks that each promise the most that a block may hold.
  const auto number = [](std::uint64_t value) {
    std::string text;
    for (; value > 127; value >>= 7) text += static_cast<char>((value & 127) | 128);
    return text + static_cast<char>(value);
  };
  std::string bytes = sample_pbf();
  const std::string blob = '\x10' + number(32u << 20) + '\x1a' + number(4) + "abcd", type = "OSMData";
  const std::string header = '\x0a' + number(type.size()) + type + '\x18' + number(blob.size());
  for (int i = 0; i < 20; ++i) bytes += std::string(3, '\0') + static_cast<char>(header.size()) + header + blob;
  const auto refused = read_osm_context(bytes);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("unpacks to more than 512 MiB"), std::string::npos) << refused.error().text();
}

}  // namespace
}  // namespace bl::importing
