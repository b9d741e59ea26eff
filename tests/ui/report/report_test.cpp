// Reports are complete, well formed and say what the state says, also where a scene is empty or odd.
#include "core/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/base/mesh.h"
#include "core/drawing/furniture.h"
#include "core/drawing/markup.h"
#include "core/drawing/palette.h"
#include "core/drawing/projection.h"
#include "core/drawing/solid_drawing.h"
#include "core/file/file_io.h"
#include "core/geometry/cell_mesh.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/mesh_lines.h"
#include "core/geometry/tessellate.h"
#include "core/reading/exact_shape.h"
#include "core/reading/figures.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"

namespace bl::report {
namespace {

constexpr const char* kBlock = R"({"format": "behaviourlinks", "version": 1, "settings": {"title": "A block"},
  "nodes": [
    {"id": "brief", "types": {"programme": {"rows": [
      {"use": "housing", "floor_area": 900, "storey_height": 3, "count": 2}, {"use": "office", "floor_area": 700, "storey_height": 3.5}]}}},
    {"id": "home_a", "name": "Home <A> & \"B\"", "position": [-8, -6, 6], "types": {"smart_volume": {"use": "housing"}}},
    {"id": "home_b", "position": [9, -5, 6], "types": {"smart_volume": {"use": "housing"}}},
    {"id": "office", "name": "Office", "position": [0, 9, 7], "types": {"smart_volume": {"use": "office"}}},
    {"id": "site", "name": "Site", "types": {"boundary": {}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}}],
  "links": [{"id": "deal", "kind": "demand", "from": "brief", "to": {"typification": "smart_volume"}},
            {"id": "near", "kind": "adjacency", "from": "home_a", "to": "office"}]})";

struct Files {
  std::string html, csv, obj;
};

std::string folder_for(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("report_" + name)).string();
}

ReportData data_of(const State& state) {
  ReportData data{&state, {}, "scenes/block.json", "settled after 40 ticks, worst error 0.4 %, hash 00"};
  for (std::int64_t t = 1; t <= 40; ++t) {
    const double error = std::pow(0.8, static_cast<double>(t));
    data.history.push_back({t, error, error / 3, 2 * error});
  }
  return data;
}

Files write_and_read(const std::string& name, const ReportData& data) {
  const std::string folder = folder_for(name);
  const auto written = write_report(folder, data);
  EXPECT_TRUE(written.ok()) << (written.ok() ? "" : written.error().text());
  Files files;
  for (const auto& [file, text] :
       {std::pair{"report.html", &files.html}, {"volumes.csv", &files.csv}, {"volumes.obj", &files.obj}}) {
    const auto read = read_file(folder + "/" + file);
    if (read) *text = *read;
    else ADD_FAILURE() << read.error().text();
  }
  return files;
}

// Tags match, attributes are quoted and not repeated, ampersands start references: what makes XML well formed, as far as a page
// needs it.
std::string fault_in(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t i = xml.find('<'); i != std::string::npos; i = xml.find('<', i + 1)) {
    const std::size_t end = xml.find('>', i);
    if (end == std::string::npos) return "a tag that does not end";
    const std::string tag = xml.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return "a bare < near " + tag;
    if (tag.starts_with("!")) continue;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1))
        return "</" + tag.substr(1) + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
      continue;
    }
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "odd quotes in " + tag;
    if (!tag.ends_with("/")) open.push_back(tag.substr(0, tag.find(' ')));
  }
  for (std::size_t i = xml.find('&'); i != std::string::npos; i = xml.find('&', i + 1))
    if (const std::size_t end = xml.find(';', i); end == std::string::npos || end - i > 6)
      return "a bare & near " + xml.substr(i, 20);
  return open.empty() ? "" : "never closed: " + open.back();
}

// The objects of an OBJ text as meshes.
std::map<std::string, Mesh> meshes_in(const std::string& obj) {
  std::map<std::string, Mesh> meshes;
  std::istringstream lines(obj);
  std::string word, name;
  std::size_t total = 0, first = 0;
  while (lines >> word) {
    if (word == "o") {
      lines >> name;
      first = total;
      meshes[name];
    } else if (word == "v") {
      Point3 point;
      lines >> point.x >> point.y >> point.z;
      meshes[name].vertices.push_back(point);
      ++total;
    } else if (word == "f") {
      std::array<std::size_t, 3> corner{};
      lines >> corner[0] >> corner[1] >> corner[2];
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = static_cast<std::uint32_t>(corner[k] - 1 - first);
      meshes[name].triangles.push_back(triangle);
    } else {
      std::getline(lines, word);
    }
  }
  return meshes;
}

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  for (const auto& [side, count] : sides)
    if (count != 1 || !sides.contains({side.second, side.first})) return false;
  return !sides.empty();
}

// Whoever stands on a roof is drawn after it, or the roof would hide its foot.
TEST(Report, WhatStandsOnARoofIsDrawnAfterIt) {
  World world = World::from_text(*read_file(test::source_folder() + "/scenes/studies/tower_on_podium.json"));
  world.tick(40);
  const std::string html = write_and_read("podium", data_of(world.state())).html;
  const std::size_t picture = html.find("<svg");
  const auto place_of = [&](const std::string& name) { return html.find(". " + name + ",", picture); };
  for (const auto& [below, above] : {std::pair{"Shops", "Flats"}, std::pair{"Podium", "Tower"}}) {
    ASSERT_NE(place_of(below), std::string::npos) << below;
    ASSERT_NE(place_of(above), std::string::npos) << above;
    EXPECT_LT(place_of(below), place_of(above)) << above;
  }
}

// Of volumes that share a footprint the upper storeys are drawn last, and those of one storey by how near they are.
TEST(Report, SharedBuildingsAreDrawnStoreyByStorey) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "flats", "name": "Flats", "types": {"footprint": {"order": 1, "shares": ["shops"]},
                                                 "smart_volume": {"use": "housing", "demand": 9000, "storey_height": 3}}},
      {"id": "shops", "name": "Shops", "types": {"footprint": {"storeys": 3},
                                                 "smart_volume": {"use": "shops", "demand": 5400, "storey_height": 4.5}}},
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-40, -40, 0], [40, -40, 0], [40, 40, 0], [-40, 40, 0]], "height": 30}}},
      {"id": "solver", "types": {"standing_solver": {}}}]})");
  world.tick(40);
  const std::string html = write_and_read("shared", data_of(world.state())).html;
  const std::size_t begin = html.find("<svg");
  const std::string picture = html.substr(begin, html.find("</svg>", begin) - begin);
  const std::size_t first = picture.find(". Flats,"), last = picture.rfind(". Flats,"), shops = picture.find(". Shops,");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(shops, std::string::npos);
  EXPECT_NE(first, last) << "their part of the ground floor is drawn by itself";
  EXPECT_LT(shops, last) << "the flats above hide the roof of the shops";
  EXPECT_EQ(picture.find(". Shops,", shops + 1), std::string::npos) << "one storey is one piece";
}

TEST(Report, HoldsEveryVolumeInAllThreeFiles) {
  World world = World::from_text(kBlock);
  world.tick(60);
  const Files files = write_and_read("block", data_of(world.state()));
  EXPECT_EQ(fault_in(files.html), "");
  for (const char* name : {"home_b", "Office"}) {
    EXPECT_NE(files.html.find(">" + std::string(name) + "</th>"), std::string::npos) << name;
    EXPECT_NE(files.csv.find("," + std::string(name) + ","), std::string::npos) << name;
    EXPECT_NE(files.obj.find("o " + std::string(name) + "\n"), std::string::npos) << name;
  }
  EXPECT_NE(files.html.find("Home &lt;A&gt; &amp; &quot;B&quot;</th>"), std::string::npos);
  EXPECT_EQ(files.html.find("<A>"), std::string::npos);
  EXPECT_NE(files.html.find("A block"), std::string::npos);
  EXPECT_NE(files.html.find("settled after 40 ticks"), std::string::npos);
}

TEST(Report, NeedsNothingFromOutside) {
  World world = World::from_text(kBlock);
  world.tick(5);
  const std::string html = write_and_read("alone", data_of(world.state())).html;
  for (const char* word : {"<script", "<link", "src=", "@import", "href=\"h", "url(h"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  // The only addresses are the names of the two languages.
  std::size_t addresses = 0;
  for (std::size_t i = html.find("http"); i != std::string::npos; i = html.find("http", i + 1)) {
    EXPECT_EQ(html.compare(i, 18, "http://www.w3.org/"), 0);
    ++addresses;
  }
  EXPECT_EQ(addresses, 4u);
}

TEST(Report, ShapesAreClosedOutwardAndAsLargeAsTheirMeshes) {
  World world = World::from_text(kBlock);
  world.tick(60);
  const auto meshes = meshes_in(write_and_read("shapes", data_of(world.state())).obj);
  ASSERT_EQ(meshes.size(), 3u);
  double exported = 0, held = 0;
  for (const auto& [name, mesh] : meshes) {
    EXPECT_TRUE(is_closed(mesh)) << name;
    EXPECT_GT(enclosed_volume(mesh), 0) << name;
    exported += enclosed_volume(mesh);
  }
  for (const char* id : {"home_a", "home_b", "office"}) held += enclosed_volume(*world.mesh(id, "smart_volume.mesh"));
  EXPECT_NEAR(exported, held, 1e-9 * held);
}

TEST(Report, IsTheSameTwice) {
  World world = World::from_text(kBlock);
  world.tick(10);
  const Files a = write_and_read("twice", data_of(world.state())), b = write_and_read("twice", data_of(world.state()));
  EXPECT_EQ(a.html, b.html);
  EXPECT_EQ(a.csv, b.csv);
  EXPECT_EQ(a.obj, b.obj);
}

TEST(Report, SaysSoWhereAVolumeHasNoShape) {
  // A volume that wants nothing has no shape; one far outside may still reach in with its cell.
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "far", "name": "Far away", "position": [900, 0, 5], "types": {"smart_volume": {"demand": 500}}},
    {"id": "inside", "position": [0, 0, 5], "types": {"smart_volume": {"demand": 500}}},
    {"id": "idle", "position": [1, 0, 5], "types": {"smart_volume": {"demand": 0}}},
    {"id": "site", "types": {"boundary": {}}}, {"id": "solver", "types": {"smart_volumes_solver": {}}}], "links": []})");
  world.tick(20);
  const Files files = write_and_read("lost", data_of(world.state()));
  EXPECT_EQ(fault_in(files.html), "");
  for (const char* id : {"far", "inside", "idle"}) {
    EXPECT_NE(files.csv.find("," + std::string(id) + ","), std::string::npos) << id;
    const std::string state = world.text(id, "smart_volume.state"), reason = world.text(id, "smart_volume.reason");
    if (state == "alive") continue;
    EXPECT_NE(files.html.find(">" + state + "</td>"), std::string::npos) << state;
    EXPECT_NE(files.html.find(drawing::escape_xml(reason)), std::string::npos) << reason;
  }
  EXPECT_NE(files.obj.find("# idle: no shape"), std::string::npos) << files.obj.substr(0, 200);
}

TEST(Report, AnEmptySceneIsAPageToo) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [], "links": []})");
  world.tick();
  const Files files = write_and_read("empty", {&world.state(), {}, "folder/nothing.json", "done"});
  EXPECT_EQ(fault_in(files.html), "");
  EXPECT_NE(files.html.find("<h1>nothing.json</h1>"), std::string::npos);
  EXPECT_NE(files.html.find("Nothing to draw"), std::string::npos);
  EXPECT_EQ(files.html.find("nan"), std::string::npos);
}

TEST(Report, AVolumeWithoutSiteOrSolverIsAPageToo) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "alone", "types": {"smart_volume": {}}}], "links": []})");
  world.tick();
  const Files files = write_and_read("one", data_of(world.state()));
  EXPECT_EQ(fault_in(files.html), "");
  EXPECT_NE(files.html.find("no solver takes care of it, or its solver fails"), std::string::npos);
}

TEST(Report, AnUnusableFolderIsASentence) {
  World world = World::from_text(kBlock);
  world.tick();
  const std::string taken = folder_for("taken");
  ASSERT_TRUE(write_file(taken, "a file").ok());
  for (const std::string& place : {taken, taken + "/below", std::string("/proc/report")}) {
    const auto written = write_report(place, data_of(world.state()));
    ASSERT_FALSE(written.ok()) << place;
    EXPECT_EQ(written.error().code, ErrorCode::io);
    EXPECT_NE(written.error().message.find("cannot be"), std::string::npos) << written.error().text();
  }
  EXPECT_FALSE(write_report(folder_for("none"), {}).ok());
}

TEST(ReportParts, EscapeWhatXmlDoesNotTake) {
  EXPECT_EQ(drawing::escape_xml("<&\">'"), "&lt;&amp;&quot;&gt;&#39;");
  EXPECT_EQ(drawing::escape_xml(std::string("a\x01") + "b\xFF" + "c\xC3\xA9"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD"
            "c\xC3\xA9");
  EXPECT_EQ(drawing::escape_xml("\xED\xA0\x80").find('\xED'), std::string::npos);  // half a surrogate pair
}

TEST(ReportParts, PathsAreRelativeTenthsThatDoNotDrift) {
  drawing::PathText path;
  path.move({10, 20});
  for (int i = 1; i <= 3; ++i) path.line({10 + i * 0.14, 20.0 - i});
  path.close();
  EXPECT_EQ(path.text(), "m10 20 .1-1 .2-1 .1-1z");
}

TEST(ReportParts, NumbersReadEasily) {
  using namespace report;
  EXPECT_EQ(reading::grouped(1234567),
            "1\xE2\x80\xAF"
            "234\xE2\x80\xAF"
            "567");
  EXPECT_EQ(reading::grouped(1234), "1234");
  EXPECT_EQ(reading::grouped(-0.001, 1), "0.0");
  EXPECT_EQ(reading::signed_percent(-0.5),
            "\xE2\x88\x92"
            "50.00\xC2\xA0%");
  EXPECT_EQ(reading::signed_percent(1e-9), "0.00\xC2\xA0%");
  EXPECT_EQ(drawing::pixels(12.0), "12");
  EXPECT_EQ(drawing::round_length(73), 50);
  EXPECT_EQ(drawing::round_length(0.3), 0.2);
}

TEST(ReportParts, UsesHaveLettersInTheirOrder) {
  std::vector<std::string> uses;
  for (int i = 0; i < 30; ++i) uses.push_back("use " + std::to_string(i));
  const drawing::Palette palette(uses);
  EXPECT_EQ(palette.letter(uses[0]), "A");
  EXPECT_EQ(palette.letter(uses[25]), "Z");
  EXPECT_EQ(palette.letter(uses[26]), "AA");
}

TEST(ReportParts, TheAxonometryIsOrthonormalAndLooksDown) {
  const drawing::View view = drawing::axonometric_view(150, 33);
  EXPECT_NEAR(dot(view.right, view.up), 0, 1e-12);
  EXPECT_NEAR(dot(view.right, view.toward), 0, 1e-12);
  EXPECT_NEAR(norm(view.up), 1, 1e-12);
  EXPECT_GT(view.up.z, 0);
  EXPECT_GT(view.toward.z, 0);
}

// Two by three metres, four high.
Mesh tall_box() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}},
          {{0, 2, 1},
           {0, 3, 2},
           {4, 5, 6},
           {4, 6, 7},
           {0, 1, 5},
           {0, 5, 4},
           {1, 2, 6},
           {1, 6, 5},
           {2, 3, 7},
           {2, 7, 6},
           {3, 0, 4},
           {3, 4, 7}}};
}

TEST(ReportParts, SectionsOfABoxAreItsPlan) {
  const Mesh box = tall_box();
  ASSERT_NEAR(enclosed_volume(box), 24, 1e-12);
  const auto all = [](std::size_t) { return true; };
  for (const double z : {1.0, 4.0}) {
    const auto lines = geometry::section(box, z, all);
    ASSERT_EQ(lines.size(), 1u) << z;
    EXPECT_TRUE(lines.front().is_closed);
  }
  EXPECT_TRUE(geometry::section(box, 5, all).empty());
  const auto normals = geometry::unit_normals(box);
  const auto roof = geometry::outline(box, [&](std::size_t t) { return normals[t].z > 0.5; });
  ASSERT_EQ(roof.size(), 1u);
  EXPECT_EQ(roof.front().points.size(), 4u);
}

// A ball in the corner of an L, in two pieces of it: a cut has one line around, with no border between the pieces.
TEST(ReportParts, ACellInPiecesHasOneLineAroundItsCut) {
  const auto ell = geometry::extrude_plan(
      std::vector<Point3>{{0, 0, 0}, {60, 0, 0}, {60, 20, 0}, {20, 20, 0}, {20, 60, 0}, {0, 60, 0}}, {}, 0, 40);
  ASSERT_TRUE(ell.ok());
  geometry::CellOptions options;
  options.tessellation_depth = 2;
  options.with_coarse_mesh = true;
  const std::vector<geometry::PowerSite> sites{{{17, 17, 20}, 144}};
  const auto cells = power_cells(*ell, sites, options);
  ASSERT_TRUE(cells.ok());
  const MeshPointer fine = geometry::mesh_of_depth((*cells)[0].mesh, geometry::kDeepestTessellation);
  const auto cut = geometry::section(*fine, 20.003, [](std::size_t) { return true; });
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(cut.front().is_closed);
  double twice_area = 0;
  for (std::size_t i = 0; i < cut.front().points.size(); ++i) {
    const Point3 &p = cut.front().points[i], &q = cut.front().points[(i + 1) % cut.front().points.size()];
    twice_area += p.x * q.y - q.x * p.y;
    EXPECT_FALSE(p.x > 20.01 && p.y > 20.01) << p.x << ", " << p.y;
  }
  EXPECT_NEAR(std::abs(twice_area) / 2, (*cells)[0].footprint, 0.01 * (*cells)[0].footprint);
}

// The pieces of an L and of a ring share sides of unequal lengths: what is left is the L, and the ring with its hole.
TEST(ReportParts, PiecesSideBySideHaveOneOutline) {
  using Ring = std::vector<drawing::Pixel>;
  const auto box = [](double x, double y, double width, double height) {
    return Ring{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  };
  const auto ell = drawing::common_outline({box(0, 0, 60, 20), box(0, 20, 20, 40)});
  ASSERT_EQ(ell.size(), 1u);
  EXPECT_EQ(drawing::simplified(ell.front(), true).size(), 6u);
  EXPECT_EQ(drawing::common_outline({box(0, 0, 60, 20), box(0, 20, 20, 40), box(40, 20, 20, 40), box(0, 60, 60, 20)}).size(), 2u);
  EXPECT_EQ(drawing::common_outline({box(0, 0, 10, 10), box(30, 0, 10, 10)}).size(), 2u);
}

// Two boxes side by side, the second wider: their common wall is no edge of the plan, nor is what sticks out of it lost.
TEST(ReportParts, BodiesSideBySideHaveOneOutline) {
  Mesh both = tall_box();
  for (const Point3& v : tall_box().vertices) both.vertices.push_back({v.x + 2, 2 * v.y, v.z});
  for (const auto& [a, b, c] : tall_box().triangles) both.triangles.push_back({a + 8, b + 8, c + 8});
  EXPECT_EQ(geometry::bodies_of(both).size(), 2u);
  const Mesh mesh = geometry::joined(both);
  EXPECT_EQ(geometry::bodies_of(mesh).size(), 1u);
  EXPECT_EQ(geometry::seen_from_above(both).size(), 1u);
  const auto normals = geometry::unit_normals(mesh);
  const auto roof = geometry::outline(mesh, [&](std::size_t t) { return normals[t].z > 0.5; });
  ASSERT_EQ(roof.size(), 1u);
  EXPECT_TRUE(roof.front().is_closed);
  double twice_area = 0, length = 0;
  for (std::size_t i = 0; i < roof.front().points.size(); ++i) {
    const Point3 a = roof.front().points[i], b = roof.front().points[(i + 1) % roof.front().points.size()];
    twice_area += a.x * b.y - b.x * a.y;
    length += distance(a, b);
  }
  EXPECT_NEAR(std::abs(twice_area), 2 * (6 + 12), 1e-9);
  EXPECT_NEAR(length, 20, 1e-9);
}

// A ball of radius 5 whose upper part is cut off one metre above its middle, and one side four metres beside it.
reading::ExactShape cut_ball() { return {{10, 0, 0}, 5, {{{0, 0, 1}, 1}, {{1, 0, 0}, 14}}}; }

TEST(ReportParts, FacesOfACutBallAreDiscsLessWhatOtherCutsTake) {
  const reading::ExactShape shape = cut_ball();
  const reading::Corners roof = reading::face_of(shape, 0), side = reading::face_of(shape, 1);
  ASSERT_GT(roof.size(), 20u);
  for (const Point3& p : roof) {
    EXPECT_NEAR(p.z, 1, 1e-9);
    EXPECT_LE(p.x, 14 + 1e-9);
    EXPECT_LE(distance(p, shape.centre), 5 + 1e-9);
  }
  for (const Point3& p : side) EXPECT_LE(p.z, 1 + 1e-9);
  EXPECT_TRUE(reading::section_of(shape, 2).empty());
  EXPECT_TRUE(reading::section_of(shape, -5.1).empty());
  EXPECT_EQ(reading::normal_at(shape, {10, 0, 1}), (Vector3{0, 0, 1}));
  EXPECT_NEAR(reading::normal_at(shape, {10, 0, -5}).z, -1, 1e-12);
}

TEST(ReportParts, ExactShapesHoldTheirMeshes) {
  World world = World::from_text(kBlock);
  world.tick(60);
  for (const char* id : {"home_a", "home_b", "office"}) {
    const std::uint32_t node = world.state().plan->node_index(id);
    const auto volume = reading::row_of<reading::VolumeFigures>(world.state(), node);
    ASSERT_TRUE(volume.has_value()) << id;
    const reading::ExactShape shape = reading::exact_shape(world.state(), node, *volume);
    ASSERT_GT(shape.radius, 0) << id;
    for (const Point3& vertex : world.mesh(id, "smart_volume.mesh")->vertices) {
      EXPECT_LE(distance(vertex, shape.centre), shape.radius * (1 + 1e-9)) << id;
      for (const reading::Cut& cut : shape.cuts) EXPECT_LE(dot(cut.normal, vertex), cut.offset + 1e-6) << id;
    }
  }
}

TEST(ReportParts, BodiesThatAreNoBallsAreDrawnFromTheirMesh) {
  const Mesh box = tall_box();
  const drawing::Sheet sheet(drawing::axonometric_view(150, 33), box.vertices, 400, 400, {10, 10, 10, 10});
  drawing::Markup svg;
  drawing::draw_solid(svg, sheet, box, {{0.5, 0.6, 0.7}, {0, 0, 1}, 1, 0, 4});
  EXPECT_EQ(fault_in(svg.str()), "");
  // Two shades (roof, and walls that the sun does not reach), the storeys, creases and the outline: triangles of one face are
  // one.
  std::size_t paths = 0;
  for (std::size_t i = svg.str().find("<path"); i != std::string::npos; i = svg.str().find("<path", i + 1)) ++paths;
  EXPECT_EQ(paths, 5u);
  EXPECT_EQ(drawing::convex_outline(sheet, box).size(), 6u);
}

TEST(ReportParts, LabelsNeverCoverEachOther) {
  drawing::LabelPlacer placer({0, 0, 200, 100}, {});
  drawing::Markup svg;
  std::vector<drawing::Label> labels(60, {{100, 50}, "A long name", "12 m", "7"});
  const std::size_t without = placer.write(svg, labels, 60);
  EXPECT_GT(without, 0u);
  EXPECT_LT(without, 60u);
}

TEST(Report, SumsAreThoseOfTheFiguresBesideThem) {
  std::string scene = kBlock;
  scene.replace(scene.find("{\"id\": \"site\""), 0, "{\"id\": \"sums\", \"types\": {\"statistics\": {}}},\n");
  World world = World::from_text(scene);
  world.tick();
  write_and_read("sums", data_of(world.state()));
  double volumes = 0;
  for (const char* id : {"home_a", "home_b", "office"}) volumes += world.number(id, "smart_volume.volume");
  ASSERT_GT(std::abs(world.number("sums", "statistics.sum") - volumes), 1) << "the state itself lags";
  const auto statistics = read_file(folder_for("sums") + "/statistics.csv");
  ASSERT_TRUE(statistics) << statistics.error().text();
  std::istringstream row(statistics->substr(statistics->find('\n') + 1));
  std::string cell;
  for (int column = 0; column < 5; ++column) std::getline(row, cell, ',');
  EXPECT_NEAR(std::stod(cell), volumes, 1e-9 * volumes) << *statistics;
}

TEST(Report, MeshesSayHowFineTheyAreAndWhatThatMeans) {
  World world = World::from_text(kBlock);
  const Files none = write_and_read("no_mesh", data_of(world.state()));
  EXPECT_EQ(none.obj.find("tessellation"), std::string::npos) << "no mesh, no note";
  world.tick(3);
  const Files files = write_and_read("mesh_note", data_of(world.state()));
  const std::string note = "Meshes are of tessellation depth 1. A mesh lies within its shape and encloses less than it";
  EXPECT_EQ(files.obj.find("# " + note), files.obj.find('\n') + 1);
  EXPECT_NE(files.html.find(note), std::string::npos);
  ASSERT_EQ(world.submit(command<SetPort>({"solver", {"smart_volumes_solver.tessellation_depth"}, {"3"}})), "");
  world.tick();
  EXPECT_NE(write_and_read("finer_note", data_of(world.state())).obj.find("tessellation depth 3."), std::string::npos);
}

}  // namespace
}  // namespace bl::report
