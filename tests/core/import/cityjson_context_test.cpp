// CityJSON: solids made by hand, hostile input, and city models of real places against their own counts and published volumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/import/cityjson_context.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::area_of, test::reason_of, test::rows_of, test::shared_bytes;

// A box of 10 by 20 by 5 m whose vertices are decimetres from a corner far away; `faces` over its corners 0-3 below, 4-7 above.
std::string box(const std::string& faces,
                const std::string& object = R"("type": "Building", "attributes": {"name": "Box", "function": "house"})",
                const std::string& lod = "\"1.2\"") {
  return R"({"type": "CityJSON", "version": "2.0", "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
    "transform": {"scale": [0.1, 0.1, 0.1], "translate": [85000, 447000, -1]},
    "vertices": [[0,0,0],[100,0,0],[100,200,0],[0,200,0],[0,0,50],[100,0,50],[100,200,50],[0,200,50]],
    "CityObjects": {"box": {)" +
         object + R"(, "geometry": [{"type": "Solid", "lod": )" + lod + R"(, "boundaries": [[)" + faces + "]]}]}}}";
}
constexpr const char* kFloor = "[[0,3,2,1]]";
constexpr const char* kRest = "[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]";
constexpr const char* kInsideOut = "[[0,1,2,3]],[[4,7,6,5]],[[0,4,5,1]],[[1,5,6,2]],[[2,6,7,3]],[[3,7,4,0]]";

Result<Context> read(const std::string& text, const std::string& crs = "") {
  ContextOptions options;
  options.crs = crs;
  return read_cityjson_context(text, options);
}

TEST(CityJson, ABoxIsASolidWithItsOutline) {
  const auto context = read(box(std::string(kFloor) + "," + kRest));
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_EQ(context->source_crs, "EPSG:28992") << "the part in plan of a CRS with heights";
  ASSERT_EQ(context->buildings.size(), 1u);
  const ContextBuilding& made = context->buildings[0];
  EXPECT_EQ(made.name, "Box");
  EXPECT_EQ(made.use, "house");
  EXPECT_NEAR(area_of(made), 200, 1e-6);
  EXPECT_NEAR(made.base, -1, 1e-9);
  EXPECT_NEAR(made.height, 5, 1e-9);
  EXPECT_EQ(made.height_source, HeightSource::geometry);
  ASSERT_TRUE(made.solid);
  EXPECT_NEAR(enclosed_volume(*made.solid), 1000, 1e-6);
  EXPECT_EQ(reason_of(context->report, "box"), "taken: building with a solid");
}

TEST(CityJson, SolidsAreTurnedAndClosedWhereThatIsClear) {
  const auto turned = read(box(kInsideOut));
  ASSERT_TRUE(turned->buildings[0].solid);
  EXPECT_NEAR(enclosed_volume(*turned->buildings[0].solid), 1000, 1e-6);
  EXPECT_EQ(reason_of(turned->report, "box"), "repaired: building with a solid");
  const auto mixed = read(box(std::string("[[0,1,2,3]],") + kRest));
  ASSERT_TRUE(mixed->buildings[0].solid) << "one face of six looks inward";
  EXPECT_NEAR(enclosed_volume(*mixed->buildings[0].solid), 1000, 1e-6);
  const auto no_floor = read(box(kRest));
  ASSERT_TRUE(no_floor->buildings[0].solid);
  EXPECT_NEAR(enclosed_volume(*no_floor->buildings[0].solid), 1000, 1e-6);
  EXPECT_EQ(reason_of(no_floor->report, "box"), "repaired: building with a solid");
  const auto no_wall = read(box(std::string(kFloor) + ",[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]]"));
  EXPECT_FALSE(no_wall->buildings[0].solid);
  EXPECT_NEAR(area_of(no_wall->buildings[0]), 200, 1e-6);
  EXPECT_EQ(reason_of(no_wall->report, "box"), "repaired: building as an extrusion");
}

TEST(CityJson, FacesMayHaveHoles) {
  // The roof with a hole whose sides lead to a shaft down to the floor, which has the hole, too.
  const std::string text =
      R"({"type": "CityJSON", "version": "1.1", "metadata": {"referenceSystem": "urn:ogc:def:crs:EPSG::7415"},
    "transform": {"scale": [1,1,1], "translate": [85000,447000,0]},
    "vertices": [[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,4],[9,0,4],[9,9,4],[0,9,4],[3,3,0],[6,3,0],[6,6,0],[3,6,0],[3,3,4],[6,3,4],[6,6,4],[3,6,4]],
    "CityObjects": {"court": {"type": "Building", "geometry": [{"type": "Solid", "lod": 1, "boundaries": [[
      [[0,3,2,1],[8,9,10,11]], [[4,5,6,7],[12,15,14,13]], [[0,1,5,4]], [[1,2,6,5]], [[2,3,7,6]], [[3,0,4,7]],
      [[9,8,12,13]], [[10,9,13,14]], [[11,10,14,15]], [[8,11,15,12]]]]}]}}})";
  const auto context = read(text);
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_TRUE(context->buildings[0].solid);
  EXPECT_NEAR(enclosed_volume(*context->buildings[0].solid), 4 * (81 - 9), 1e-6);
  EXPECT_EQ(context->buildings[0].holes.size(), 1u);
  EXPECT_NEAR(area_of(context->buildings[0]), 72, 1e-6);
}

TEST(CityJson, WhatIsNotReadHasItsRow) {
  const auto bridge = read(box(std::string(kFloor) + "," + kRest, R"("type": "Bridge")"));
  EXPECT_EQ(reason_of(bridge->report, "box"), "skipped: objects of this type are not read");
  const std::string instance =
      R"({"type": "CityJSON", "version": "2.0", "vertices": [[0,0,0]], "metadata": {"referenceSystem": "EPSG:28992"},
    "CityObjects": {"a": {"type": "Building", "geometry": [{"type": "GeometryInstance", "template": 0, "boundaries": [0]}]}}})";
  const auto templates = read(instance);
  ASSERT_TRUE(templates.ok()) << templates.error().text();
  EXPECT_EQ(reason_of(templates->report, "a"), "skipped: no geometry that can be read");
  EXPECT_EQ(templates->report.rows()[0].detail, "geometry templates are not read");
  const auto bad_index = read(box("[[0,1,99]]"));
  EXPECT_EQ(reason_of(bad_index->report, "box"), "skipped: no geometry that can be read");
}

TEST(CityJson, HostileInputIsAnErrorWithAPlace) {
  const std::string good = box(std::string(kFloor) + "," + kRest);
  const std::string no_crs =
      R"({"type": "CityJSON", "version": "2.0", "vertices": [[0,0,0]], "CityObjects": {"a": {"type": "Building"}}})";
  const std::pair<std::string, std::string> rows[] = {
      {"", "line 1"},
      {"{}", "type"},
      {"[1, 2", "line 1, column 6"},
      {"noise \x01\xff", "byte 0"},
      {good.substr(0, good.size() - 40), ""},
      {R"({"type": "CityJSON", "version": "0.8"})", "version"},
      {R"({"type": "CityJSON", "version": "2.0", "CityObjects": {}})", "vertices"},
      {R"({"type": "CityJSON", "version": "2.0", "vertices": [[1, 2]], "CityObjects": {}})", "vertices/0"},
      {R"({"type": "CityJSON", "version": "2.0", "vertices": [[1, 2, "x"]], "CityObjects": {}})", "vertices/0"},
      {R"({"type": "CityJSON", "version": "2.0", "transform": {"scale": 1}, "vertices": [], "CityObjects": {}})",
       "transform/scale"},
      {R"({"type": "CityJSON", "version": "2.0", "vertices": [], "CityObjects": []})", ""},
      {no_crs, "crs"},
      {"{\"type\": \"CityJSON\", \"version\": \"2.0\", \"vertices\": [], \"CityObjects\": {}}\n{\"type\": \"oops\"}\n",
       "line 2"}};
  for (const auto& [text, place] : rows) {
    const auto context = read(text);
    ASSERT_FALSE(context.ok()) << text;
    if (!place.empty()) { EXPECT_EQ(context.error().place, place) << text.substr(0, 200); }
    EXPECT_GT(context.error().message.size(), 15u) << text;
  }
  EXPECT_EQ(read(good, "EPSG:99999999").error().place, "crs");
  std::string deep(100000, '[');
  EXPECT_FALSE(read(deep).ok());
}

// Types of city objects as counted by a plain JSON reader: the line of the README of the data, and what this test counts again.
std::map<std::string, std::size_t> types_in(const std::string& text) {
  std::map<std::string, std::size_t> counts;
  const auto add = [&counts](const nlohmann::json& root) {
    if (!root.contains("CityObjects")) return;
    for (const auto& [id, object] : root["CityObjects"].items()) ++counts[object["type"].get<std::string>()];
  };
  if (auto whole = nlohmann::json::parse(text, nullptr, false); !whole.is_discarded()) {
    add(whole);
    return counts;
  }
  std::stringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) add(nlohmann::json::parse(line));
  return counts;
}

struct Model {
  const char *file, *crs;
  std::size_t buildings, solids;
};
constexpr Model kModels[] = {
    {"cityjson/delft_v20.city.json", "", 160, 160},
    {"cityjson/delft_buildings_v10_3dfier.city.json", "", 160, 160},
    {"cityjson/rotterdam_subset_v20.city.json", "EPSG:28992", 16, 0},
    {"cityjson/denhaag_DH01_subset_v11.city.json", "EPSG:28992", 9, 9},
    {"cityjson/3dbag_delft_10buildings_v20.city.jsonl", "", 10, 10},
    {"cityjson/3dbag_tile901_52buildings_v11.city.jsonl", "", 52, 52},
};

TEST(CityJson, RealModelsHaveARowForEveryObject) {
  for (const Model& model : kModels) {
    const std::string text = shared_bytes(model.file);
    if (text.empty()) continue;
    const auto context = read(text, model.crs);
    ASSERT_TRUE(context.ok()) << model.file << ": " << context.error().text();
    std::size_t objects = 0;
    for (const auto& [type, count] : types_in(text)) {
      EXPECT_EQ(context->report.total(type), count) << model.file << " " << type;
      objects += count;
    }
    EXPECT_EQ(context->report.total(), objects) << model.file;
    EXPECT_EQ(context->buildings.size(), model.buildings) << model.file;
    std::size_t solids = 0;
    for (const ContextBuilding& building : context->buildings) solids += building.solid ? 1 : 0;
    EXPECT_EQ(solids, model.solids) << model.file;
  }
}

TEST(CityJson, VolumesAreThePublishedOnes) {
  const std::string text = shared_bytes("cityjson/3dbag_delft_10buildings_v20.city.jsonl");
  if (text.empty()) return;
  std::map<std::string, nlohmann::json> published;
  std::stringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto root = nlohmann::json::parse(line);
    for (const auto& [id, object] : root["CityObjects"].items())
      if (object["type"] == "Building") published[id] = object["attributes"];
  }
  for (const auto& [lod, name] : {std::pair{1.2, "b3_volume_lod12"}, {1.3, "b3_volume_lod13"}, {2.2, "b3_volume_lod22"}}) {
    ContextOptions options;
    options.level_of_detail = lod;
    const auto context = read_cityjson_context(text, options);
    ASSERT_EQ(context->buildings.size(), 10u);
    for (const ContextBuilding& building : context->buildings) {
      ASSERT_TRUE(building.solid) << building.id;
      const double volume = published.at(building.whole).at(name).get<double>();
      EXPECT_NEAR(enclosed_volume(*building.solid), volume, 0.25) << building.id << " in level " << lod;
    }
  }
}

TEST(CityJson, DelftHasTheVolumesAndStaysExactFarFromTheOrigin) {
  const std::string old = shared_bytes("cityjson/delft_buildings_v10_3dfier.city.json");
  if (old.empty()) return;
  const auto context = read(old);
  double volume = 0;
  for (const ContextBuilding& building : context->buildings) volume += enclosed_volume(*building.solid);
  EXPECT_NEAR(volume, 83936.3, 0.1) << "the sum of the 160 solids as another program has computed it";
  // Coordinates some 450 km from the origin of the CRS: a millimetre there is a millimetre here.
  const auto root = nlohmann::json::parse(old);
  const auto& v = root["vertices"];
  ContextOptions options;
  options.origin = {{85000, 447500}};
  const auto placed = read_cityjson_context(old, options);
  const ContextBuilding& first = placed->buildings.front();
  double nearest = 1;
  for (const auto& p : v)
    nearest = std::min(nearest,
                       std::hypot(p[0].get<double>() - 85000 - first.outer[0].x, p[1].get<double>() - 447500 - first.outer[0].y));
  EXPECT_LT(nearest, 1e-9);
  // Solids of level 1 are prisms: outline times height.
  const std::string v20 = shared_bytes("cityjson/delft_v20.city.json");
  double prisms = 0, solids = 0;
  const auto twenty = read(v20);
  for (const ContextBuilding& building : twenty->buildings) {
    prisms += area_of(building) * building.height;
    solids += enclosed_volume(*building.solid);
  }
  EXPECT_NEAR(solids / prisms, 1, 0.01);
}

// A cube of 100 units of a CRS, at a height.
std::string cube(const std::string& crs, const std::string& translate, double low) {
  std::string vertices;
  for (const double z : {low, low + 100})
    for (const char* place : {"0,0", "100,0", "100,100", "0,100"})
      vertices += (vertices.empty() ? "[" : ",[") + std::string(place) + "," + std::to_string(z) + "]";
  return R"({"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], "translate": [)" + translate +
         R"(]}, "metadata": {"referenceSystem": ")" + crs + R"("}, "vertices": [)" + vertices +
         R"(], "CityObjects": {"b": {"type": "Building", "geometry": [{"type": "Solid", "lod": "2", "boundaries":
         [[[[3,2,1,0]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}}})";
}

TEST(CityJson, HeightsHaveTheUnitOfTheCrs) {
  constexpr double kUsFoot = 1200.0 / 3937;
  const auto feet = read(cube("EPSG:2263", "985000,200000,0", 100));
  ASSERT_TRUE(feet.ok()) << feet.error().text();
  ASSERT_EQ(feet->buildings.size(), 1u);
  EXPECT_NEAR(area_of(feet->buildings[0]), 30.48 * 30.48, 0.1);
  EXPECT_NEAR(feet->buildings[0].height, 100 * kUsFoot, 1e-6);
  EXPECT_NEAR(feet->buildings[0].base, 100 * kUsFoot, 1e-6);
  EXPECT_TRUE(std::any_of(feet->notes.begin(), feet->notes.end(), [](const std::string& note) {
    return note.find("One unit of height was taken as 0.3048") != std::string::npos;
  }));
  ContextOptions metres;
  metres.height_unit = 1;
  EXPECT_NEAR(read_cityjson_context(cube("EPSG:2263", "985000,200000,0", 100), metres)->buildings[0].height, 100, 1e-9);
  // Metres above the sea over a plan in feet, and a plan in metres.
  EXPECT_NEAR(read(cube("EPSG:2263+5703", "985000,200000,0", 100))->buildings[0].height, 100, 1e-9);
  EXPECT_NEAR(read(cube("EPSG:7415", "85000,447000,0", 100))->buildings[0].height, 100, 1e-9);
}

TEST(CityJson, UnitsOfHeightsAreThoseOfTheLastAxis) {
  EXPECT_EQ(height_unit("EPSG:28992"), 1);
  EXPECT_EQ(height_unit("EPSG:7415"), 1);
  EXPECT_EQ(height_unit("OGC:CRS84"), 1) << "degrees are no heights";
  EXPECT_EQ(height_unit("EPSG:4979"), 1) << "longitude, latitude and metres";
  EXPECT_NEAR(height_unit("EPSG:2263"), 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(height_unit("EPSG:2263+6360"), 1200.0 / 3937, 1e-12);
  EXPECT_EQ(height_unit("nonsense"), 1);
}

TEST(CityJson, ABodyBeyondAllHeightsIsARowAndNotTheEndOfTheImport) {
  const auto high = read(cube("EPSG:28992", "85000,447000,0", 2000000));
  ASSERT_TRUE(high.ok());
  EXPECT_TRUE(high->buildings.empty());
  EXPECT_EQ(reason_of(high->report, "b"), "skipped: its heights lie beyond -10 km or 100 km");
}

}  // namespace
}  // namespace bl::importing
