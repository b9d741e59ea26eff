// Courses of imported streets: by hand, and against a reading of real files that shares no code with the importer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "core/import/inflate.h"
#include "tests/support/reference_files.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

using SortedJson = nlohmann::json;

std::map<std::string, SortedJson> nodes_of(const SortedJson& scene) {
  std::map<std::string, SortedJson> nodes;
  for (const SortedJson& node : scene["nodes"]) nodes[node["id"]] = node;
  return nodes;
}

// Junction, course, junction.
std::vector<std::array<double, 2>> line_of(const std::map<std::string, SortedJson>& nodes, const SortedJson& street) {
  std::vector<std::array<double, 2>> line;
  const auto add = [&line](const SortedJson& point) { line.push_back({point[0], point[1]}); };
  const auto place = [&](const SortedJson& id) { return nodes.at(id).value("position", SortedJson{0, 0, 0}); };
  add(place(street["start"]));
  for (const SortedJson& point : street.value("course", SortedJson::array())) {
    add(point);
    EXPECT_EQ(point[2], 0) << "a course is a plan";
  }
  add(place(street["end"]));
  return line;
}

double length_of(const std::vector<std::array<double, 2>>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
  return length;
}

// What a file says, found by looking for its marks: no parser of XML, no projection.
struct Reading {
  std::map<std::string, std::array<double, 2>> nodes;    // longitude and latitude [degree]
  std::map<std::string, std::vector<std::string>> ways;  // all that have a highway
};

std::string between(const std::string& text, const std::string& begin, char end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  return text.substr(at + begin.size(), text.find(end, at + begin.size()) - at - begin.size());
}

Reading read_plainly(const std::string& xml) {
  Reading reading;
  std::size_t at = 0;
  while ((at = xml.find("<node ", at)) != std::string::npos) {
    const std::string tag = xml.substr(at, xml.find('>', at) - at);
    if (const std::string latitude = between(tag, " lat=\"", '"'); !latitude.empty())
      reading.nodes[between(tag, " id=\"", '"')] = {std::stod(between(tag, " lon=\"", '"')), std::stod(latitude)};
    ++at;
  }
  at = 0;
  while ((at = xml.find("<way ", at)) != std::string::npos) {
    const std::string way = xml.substr(at, xml.find("</way>", at) - at);
    ++at;
    if (way.find("k=\"highway\"") == std::string::npos) continue;
    std::vector<std::string>& refs = reading.ways[between(way, " id=\"", '"')];
    for (std::size_t nd = way.find("<nd "); nd != std::string::npos; nd = way.find("<nd ", nd + 1))
      refs.push_back(between(way.substr(nd), "ref=\"", '"'));
  }
  return reading;
}

// Along the ellipsoid of WGS84, of points so near to each other that its curvature does not change between them [m].
double geodesic(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  constexpr double kAxis = 6378137, kFlat = 1 / 298.257223563, kRadian = std::numbers::pi / 180;
  const double e2 = kFlat * (2 - kFlat), latitude = 0.5 * (a[1] + b[1]) * kRadian;
  const double w = std::sqrt(1 - e2 * std::sin(latitude) * std::sin(latitude));
  return std::hypot(kAxis * (1 - e2) / (w * w * w) * (b[1] - a[1]) * kRadian,
                    kAxis / w * std::cos(latitude) * (b[0] - a[0]) * kRadian);
}

class ImportStreets : public testing::Test {
 protected:
  SortedJson imported(const std::string& file, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"import", file, "--out", "scene.json", "--report", "rows.csv", "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome done = place.run(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    said = done.out;
    return place.json("scene.json");
  }
  Workplace place;
  std::string said;
};

// 0.001 degrees at 60 degrees north are 55.8 m to the east and 111.4 m to the north.
std::string map_of(const std::string& ways) {
  std::string text = R"(<osm version="0.6">)";
  for (int i = 0; i < 9; ++i)
    text += "<node id=\"" + std::to_string(i + 1) + "\" lat=\"" + std::to_string(60 + 0.001 * (i / 3)) + "\" lon=\"" +
            std::to_string(25 + 0.001 * (i % 3)) + "\"/>";
  return text + ways + "</osm>";
}
std::string way(const std::string& id, const std::vector<int>& nodes, const std::string& more = "") {
  std::string text = "<way id=\"" + id + "\">";
  for (const int node : nodes) text += "<nd ref=\"" + std::to_string(node) + "\"/>";
  return text + R"(<tag k="highway" v="residential"/>)" + more + "</way>";
}

TEST_F(ImportStreets, PointsBetweenJunctionsAreTheCourse) {
  // 1 - 2 - 5 - 4 meets 5 - 8; nodes 2 bends, 5 is a junction; the second is one way against its nodes.
  place.write("map.osm", map_of(way("10", {1, 2, 5, 4, 7}) + way("11", {9, 6, 5}, R"(<tag k="oneway" v="-1"/>)")));
  const auto nodes = nodes_of(imported("map.osm"));
  const SortedJson &first = nodes.at("street_w10_0")["types"]["street"], &second = nodes.at("street_w10_1")["types"]["street"],
                   &third = nodes.at("street_w11_0")["types"]["street"];
  EXPECT_EQ(first["course"].size(), 1u);
  EXPECT_EQ(second["course"].size(), 1u);
  EXPECT_EQ(first.count("length"), 0u) << "it is that of its line";
  EXPECT_NEAR(length_of(line_of(nodes, first)), 55.8 + 111.4, 0.1);
  EXPECT_EQ(third["start"], SortedJson("junction_n5"));
  EXPECT_TRUE(third["one_way"]);
  const auto line = line_of(nodes, third);
  ASSERT_EQ(line.size(), 3u);
  EXPECT_GT(line[1][0], line[0][0] + 50) << "from 5 to the east";
  EXPECT_GT(line[2][1], line[1][1] + 100) << "then to the north";
  EXPECT_EQ(said.find("bends"), std::string::npos) << said;
  const Outcome run = place.run({"run", "scene.json", "--save", "after.json"});
  EXPECT_EQ(run.code, 0) << run.out << run.err;
}

TEST_F(ImportStreets, ARoundThatMeetsOneJunctionIsAStreet) {
  place.write("map.osm", map_of(way("10", {1, 2}) + way("11", {2, 3, 6, 5, 2}) + way("12", {7, 7})));
  const auto nodes = nodes_of(imported("map.osm"));
  const SortedJson& round = nodes.at("street_w11_0")["types"]["street"];
  EXPECT_EQ(round["start"], round["end"]);
  EXPECT_EQ(round["course"].size(), 3u);
  EXPECT_NEAR(length_of(line_of(nodes, round)), 2 * (55.8 + 111.4), 0.2);
  EXPECT_EQ(nodes.count("street_w12_0"), 0u);
  EXPECT_NE(said.find("1 piece of street without any length became no node."), std::string::npos) << said;
  EXPECT_EQ(place.run({"run", "scene.json"}).code, 0);
}

TEST_F(ImportStreets, LinesOfGeoJsonBendAsWell) {
  place.write("streets.geojson",
              R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
    {"type": "Feature", "properties": {"id": "a"}, "geometry": {"type": "LineString", "coordinates":
      [[85000, 447000], [85030, 447000], [85030, 447040]]}}]})");
  const auto nodes = nodes_of(imported("streets.geojson", {"--as", "street"}));
  const auto line = line_of(nodes, nodes.at("street_a_0")["types"]["street"]);
  ASSERT_EQ(line.size(), 3u);
  EXPECT_NEAR(line[1][0] - line[0][0], 30, 1e-6);
  EXPECT_NEAR(line[2][1] - line[1][1], 40, 1e-6);
}

TEST_F(ImportStreets, TooManyPointsAreThinnedAndTheReportSaysSo) {
  std::string points;
  for (int k = 0; k <= 3000; ++k) {
    const double angle = k * 0.004;
    points += (k > 0 ? ",[" : "[") + std::to_string(85000 + 100 * std::cos(angle)) + "," + std::to_string(447000 + k * 0.1) + "]";
  }
  place.write("river_road.geojson",
              R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
    {"type": "Feature", "properties": {"id": "a"}, "geometry": {"type": "LineString", "coordinates": [)" +
                  points + "]}}]}");
  const auto nodes = nodes_of(imported("river_road.geojson", {"--as", "street"}));
  const SortedJson& street = nodes.at("street_a_0")["types"]["street"];
  EXPECT_LE(street["course"].size(), 500u);
  EXPECT_GE(street["course"].size(), 50u);
  EXPECT_NEAR(length_of(line_of(nodes, street)), street["length"].get<double>(), 0.001 * street["length"].get<double>());
  EXPECT_NE(place.text("rows.csv")
                .find(std::to_string(street["course"].size()) +
                      " of the 2999 bends of a/0 were taken, the others lie within 0.01 m of its line"),
            std::string::npos)
      << place.text("rows.csv");
  EXPECT_NE(said.find("1 repaired"), std::string::npos) << said;
}

// With all streets, so that what became a piece is decided by lines alone: a node that only one way has, once, and not at its
// end.
TEST_F(ImportStreets, RealFilesKeepEveryPointAndTheLengthOnEarth) {
  for (const char* name : {"small_village.osm", "monaco.osm.gz", "lemans_centre.osm.gz"}) {
    const auto path = shared_file(std::string("data/osm/") + name);
    if (path.empty()) {
      std::printf("the shared data are not beside this checkout: %s is not read here\n", name);
      continue;
    }
    const auto xml = importing::unpacked(read_text(path));
    ASSERT_TRUE(xml.ok());
    const Reading reading = read_plainly(*xml);
    const auto nodes = nodes_of(imported(path.string(), {"--all-streets"}));
    std::map<std::string, std::vector<std::string>> pieces;  // nodes by way
    for (const auto& [id, node] : nodes)
      if (id.starts_with("street_w")) pieces[id.substr(8, id.rfind('_') - 8)].push_back(id);
    std::map<std::string, int> visits;
    for (const auto& [way, streets] : pieces)
      for (const std::string& node : reading.ways.at(way)) ++visits[node];
    std::size_t points = 0, found = 0;
    double most = 0;
    for (const auto& [way, streets] : pieces) {
      const auto& refs = reading.ways.at(way);
      double on_earth = 0, drawn = 0;
      for (std::size_t i = 0; i < refs.size(); ++i) {
        if (i > 0 && i + 1 < refs.size() && visits[refs[i]] == 1) ++points;
        if (i > 0) on_earth += geodesic(reading.nodes.at(refs[i - 1]), reading.nodes.at(refs[i]));
      }
      for (const std::string& id : streets) {
        const auto line = line_of(nodes, nodes.at(id)["types"]["street"]);
        found += line.size() - 2;
        drawn += length_of(line);
      }
      EXPECT_NEAR(drawn, on_earth, 0.005 * on_earth) << name << ", way " << way;
      if (on_earth > 1) most = std::max(most, std::abs(drawn / on_earth - 1));
    }
    EXPECT_EQ(found, points) << name;
    EXPECT_GT(found, 10u) << name;
    std::printf("%s: %zu ways, %zu points between junctions, lengths within %.4f %%\n", name, pieces.size(), found, 100 * most);
  }
}

}  // namespace

}  // namespace bl::test
