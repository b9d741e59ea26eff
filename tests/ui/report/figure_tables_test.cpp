// Everything that was computed is in page, tables and JSON: surroundings, streets, sun, plots, façades, conflicts.
#include "core/report/figure_tables.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/drawing/palette.h"
#include "core/drawing/pictures.h"
#include "core/file/file_io.h"
#include "core/reading/figures.h"
#include "core/reading/surroundings.h"
#include "core/report/report.h"
#include "tests/support/world.h"

namespace bl::report {
namespace {

// The law: a port that was renamed does not become an empty column.
TEST(FigureTablesLaw, EveryPortIsDeclared) {
  for (const report::FigureTable& table : report::figure_tables()) {
    const TypificationDefinition* type = full_registry().typification(table.type);
    ASSERT_NE(type, nullptr) << table.type;
    for (const report::FigureColumn& column : table.columns)
      EXPECT_LT(type->port_index(column.port), type->ports.size()) << table.type << "." << column.port;
    for (const report::FigurePart& part : table.parts) {
      const std::size_t port = type->port_index(part.port);
      ASSERT_LT(port, type->ports.size()) << table.type << "." << part.port;
      EXPECT_EQ(type->ports[port].kind, ValueKind::table) << part.port;
    }
  }
}

// The law: what a typification of the city computes as a number is in its table; what is left out is named here with its reason.
TEST(FigureTablesLaw, NoComputedNumberIsForgotten) {
  const std::set<std::string> left_out = {"plot.volume",  // none today; kept so that the set is never empty
                                          "traffic_network.unrest",
                                          "traffic_network.objective",  // how the assignment got there
                                          "shadow_receiver.columns",
                                          "shadow_receiver.rows",  // how the map is laid out; the map itself is a table
                                          "sun_study.ray_count",
                                          "terrain.columns",
                                          "terrain.row_count",  // sizes of what was computed with
                                          "facade.true_north",
                                          "statistics.spread"};
  for (const report::FigureTable& table : report::figure_tables()) {
    const TypificationDefinition& type = *full_registry().typification(table.type);
    for (const PortDefinition& port : type.ports) {
      const bool is_number = port.kind == ValueKind::number || port.kind == ValueKind::integer;
      if (!port.is_computed || port.recall || !is_number || left_out.contains(type.id + "." + port.id)) continue;
      EXPECT_TRUE(std::any_of(table.columns.begin(), table.columns.end(),
                              [&](const report::FigureColumn& column) { return column.port == port.id; }))
          << type.id << "." << port.id << " is computed and stands in no table";
    }
  }
}

class UrbanReport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = new World(World::from_file("scenes/studies/urban_mode.json"));
    world_->tick(40);
    folder_ = new std::string((std::filesystem::path(testing::TempDir()) / "report_urban").string());
    const auto written = write_report(*folder_, {&world_->state(), {}, "urban_mode.json", "ticked"});
    ASSERT_TRUE(written.ok()) << written.error().text();
  }
  static void TearDownTestSuite() {
    delete world_;
    delete folder_;
  }
  static std::string file(const std::string& name) {
    const auto text = read_file(*folder_ + "/" + name);
    EXPECT_TRUE(text.ok()) << name;
    return text ? *text : std::string();
  }
  static inline World* world_ = nullptr;
  static inline std::string* folder_ = nullptr;
};

TEST_F(UrbanReport, EveryTableHasItsRowsInAllForms) {
  const State& state = world_->state();
  const std::string page = file("report.html");
  const Json json = report::figure_json(state);
  for (const char* id :
       {"plots", "streets", "junctions", "zones", "networks", "sun", "sun_studies", "buildings", "layers", "facade_totals"}) {
    const auto tables = report::figure_tables();
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const report::FigureTable& t) { return t.id == id; });
    ASSERT_NE(table, tables.end()) << id;
    const auto nodes = report::rows_of(state, *table);
    ASSERT_FALSE(nodes.empty()) << id;
    const auto csv = csv::read_csv(file(std::string(id) + ".csv"), ',');
    ASSERT_TRUE(csv) << id;
    EXPECT_EQ(csv->records.size(), nodes.size() + 1) << id;
    ASSERT_TRUE(json.contains(id)) << id;
    EXPECT_EQ(json[id].size(), nodes.size()) << id;
    if (!table->heading.empty()) {
      EXPECT_NE(page.find("id=\"" + std::string(id) + "\">" + std::string(table->heading) + "</h2>"), std::string::npos) << id;
    }
  }
  EXPECT_EQ(json["plots"][0]["fsi"].get<double>(), world_->number("plot", "plot.fsi"));
  EXPECT_EQ(json["streets"][0]["volume_over_capacity"].get<double>(),
            world_->number(json["streets"][0]["id"].get<std::string>(), "street.volume_over_capacity"));
  EXPECT_GT(json["sun"][0]["map"].size(), 10u);
  EXPECT_GT(csv::read_csv(file("sun_map.csv"), ',')->records.size(), 100u);
  EXPECT_GT(csv::read_csv(file("uses.csv"), ',')->records.size(), 3u);
  EXPECT_GT(csv::read_csv(file("facade_sides.csv"), ',')->records.size(), 8u);
  EXPECT_NE(page.find("Conflicts by link and person"), std::string::npos);
}

TEST(FigureTables, WhatAllOfManySayIsSaidOnce) {
  std::string nodes = R"({"id": "j0", "types": {"junction": {}}})";
  for (int k = 1; k < 9; ++k) {
    const std::string here = std::to_string(k), before = std::to_string(k - 1);
    nodes += R"(, {"id": "j)" + here + R"(", "position": [)" + here + R"(, 0, 0], "types": {"junction": {}}})";
    nodes += R"(, {"id": "s)" + here + R"(", "types": {"street": {"start": "j)" + before + R"(", "end": "j)" + here + R"("}}})";
  }
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + R"(], "links": []})");
  world.tick();
  drawing::Markup page;
  write_figure_tables(page, world.state());
  EXPECT_NE(page.str().find("All 8: no traffic network takes care of it, or its network fails. The rows are in streets.csv."),
            std::string::npos)
      << page.str();
  EXPECT_NE(
      page.str().find("No traffic network takes care of them, so that there are no figures. The rows are in junctions.csv."),
      std::string::npos)
      << page.str();
  EXPECT_EQ(page.str().find("<table"), std::string::npos) << "rows of zeros";
}

TEST_F(UrbanReport, ThePlanShowsWhatStandsAround) {
  const State& state = world_->state();
  const reading::Surroundings surroundings = reading::read_surroundings(state);
  EXPECT_EQ(surroundings.streets.size(), 10u);
  EXPECT_EQ(surroundings.buildings.size(), 6u);
  EXPECT_EQ(surroundings.sun.size(), 2u);
  EXPECT_EQ(surroundings.plots.size(), 1u);
  EXPECT_EQ(surroundings.data.size(), 1u);
  reading::ReportModel model;
  reading::read_model(state, model);
  const drawing::Picture plan = drawing::draw_plan(state, model, drawing::Palette(model.use_names()));
  for (const char* name : {"Post office", "South street, west", "existing building", "sun per day", "vehicles per hour"})
    EXPECT_NE(plan.svg.find(name), std::string::npos) << name;
  // Links to streets, studies and styles would hide all of it.
  EXPECT_EQ(plan.svg.find("Access route"), std::string::npos);
  EXPECT_EQ(plan.svg.find("Request traffic"), std::string::npos);
  EXPECT_NE(plan.caption.find("Request traffic (7)"), std::string::npos) << plan.caption;
  // A street that leads far away does not make the site small.
  const auto frame = reading::framed({{0, 0, 0}, {120, 80, 0}}, surroundings);
  ASSERT_EQ(frame.size(), 2u);
  EXPECT_GE(frame[0].x, -72 - 1e-9);
  EXPECT_LE(frame[1].x, 192 + 1e-9);
}

// Seen from above: the outline of the plot's corner with a courtyard in it, and no hull over both.
TEST(FigureTables, ThePlanShowsCourtyardsOfWhatStands) {
  const auto plan_with = [](const std::string& depth) {
    World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 60, 0], [0, 60, 0]], "height": 30}}},
      {"id": "solver", "types": {"standing_solver": {}}},
      {"id": "v", "name": "Court", "position": [30, 30, 0], "types": {"smart_volume": {"demand": 9000, "storey_height": 3},
        "footprint": {"form": "block", "storeys": 3)" +
                                   depth + R"(}}}], "links": []})");
    EXPECT_TRUE(world.settle());
    reading::ReportModel model;
    reading::read_model(world.state(), model);
    const std::string svg = drawing::draw_plan(world.state(), model, drawing::Palette(model.use_names())).svg;
    const std::size_t title = svg.find("1. Court: "), path = svg.find(" d=\"", title);
    EXPECT_NE(path, std::string::npos);
    const std::string d = svg.substr(path + 4, svg.find('"', path + 4) - path - 4);
    return std::count(d.begin(), d.end(), 'z');
  };
  EXPECT_EQ(plan_with(""), 1);
  EXPECT_EQ(plan_with(R"(, "depth": 8)"), 2);
}

// A table of an earlier report under the same name is not taken for one of this.
TEST(FigureTables, NothingOlderIsLeftBehind) {
  const std::string folder = (std::filesystem::path(testing::TempDir()) / "report_older").string();
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_file(folder + "/streets.csv", "id,name,used_length [m]\r\nold,Old street,5\r\n").ok());
  World world = World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "v", "types": {"smart_volume": {}}}], "links": []})");
  world.tick(2);
  ASSERT_TRUE(write_report(folder, {&world.state(), {}, "v.json", "ticked"}).ok());
  EXPECT_EQ(read_file(folder + "/streets.csv")->find("Old street"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder + "/zones.csv"));
}

// Whatever people call things: no table of a report holds a formula.
TEST(FigureTables, NoTableOfAReportHoldsAFormula) {
  const std::string evil = R"(=cmd|'/c calc'!A0)";
  World world =
      World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {"title": ")" + evil + R"("}, "nodes": [
    {"id": "b", "name": ")" +
                       evil + R"(", "types": {"existing_building": {"use": "@SUM", "origin": "+1"}}},
    {"id": "d", "name": ")" +
                       evil + R"(", "types": {"data_layer": {"quantity": ")" + evil + R"(", "unit": "-1", "source": "\t=1",
      "values": [{"x": -5, "y": 1, "value": -3}]}}},
    {"id": "p", "types": {"programme": {"rows": [{"use": ")" +
                       evil + R"(", "floor_area": 100}]}}},
    {"id": "v", "name": ")" +
                       evil + R"(", "position": [-3, 0, 5], "types": {"smart_volume": {"use": ")" + evil + R"("}, "facade": {}}}],
    "links": [{"id": "deal", "kind": "demand", "from": "p", "to": "v"}]})");
  world.tick(3);
  const std::string folder = (std::filesystem::path(testing::TempDir()) / "report_evil").string();
  ASSERT_TRUE(write_report(folder, {&world.state(), {}, evil, evil}).ok());
  std::size_t tables = 0, cells = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    ++tables;
    const auto csv = csv::read_csv(*read_file(entry.path().string()), ',');
    ASSERT_TRUE(csv) << entry.path();
    for (const csv::CsvRecord& record : csv->records)
      for (const std::string& cell : record.fields) {
        ++cells;
        const bool is_sign = !cell.empty() && std::string("=+-@\t\r").find(cell[0]) != std::string::npos;
        EXPECT_TRUE(!is_sign || parse_number(cell)) << entry.path() << ": " << cell;
      }
  }
  EXPECT_GE(tables, 4u);
  EXPECT_GT(cells, 40u);
  EXPECT_NE(read_file(folder + "/volumes.csv")->find(",-3,"), std::string::npos) << "negative numbers stay numbers";
}

// A table of somebody else is not written over, whoever asks for the report: the window does it as well.
TEST(FigureTables, WhatIsSomebodyElsesStays) {
  const std::string folder = (std::filesystem::path(testing::TempDir()) / "report_foreign").string();
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_file(folder + "/plots.csv", "id\n1\n").ok());
  World world = World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "v", "types": {"smart_volume": {}}}], "links": []})");
  world.tick(2);
  const auto written = write_report(folder, {&world.state(), {}, "v.json", "ticked"});
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().text().find("plots.csv: is there already and is no table of a report"), std::string::npos)
      << written.error().text();
  EXPECT_EQ(*read_file(folder + "/plots.csv"), "id\n1\n");
  std::filesystem::remove(folder + "/plots.csv");
}

// Large numbers are numbers: a dash stands for what is none, and for a limit that nobody has set.
TEST(FigureParts, LargeNumbersAreShown) {
  const PortDefinition& most =
      full_registry().typification("data_layer")->ports[full_registry().typification("data_layer")->port_index("maximum")];
  EXPECT_NE(report::figure_text(3e9, most, false).find('3'), std::string::npos) << report::figure_text(3e9, most, false);
  EXPECT_NE(report::figure_text(-2.5e12, most, false).find("500"), std::string::npos);
  EXPECT_EQ(report::figure_text(std::numeric_limits<double>::infinity(), most, false), "\xE2\x80\x93");
  const TypificationDefinition& volume = *full_registry().typification("smart_volume");
  const PortDefinition& limit = volume.ports[volume.port_index("demand_limit")];
  EXPECT_EQ(report::figure_text(1e9, limit, false), "\xE2\x80\x93") << "its default, which is no limit";
  EXPECT_NE(report::figure_text(9e8, limit, false), "\xE2\x80\x93");
}

// Buildings are cut at the frame of the plan: one whose middle lies beyond it has no name on the sheet.
TEST(Surroundings, WhatLiesBeyondTheFrameHasNoName) {
  const auto plan_with = [](double west) {
    const std::string x = std::to_string(west), east = std::to_string(west + 5);
    World world = World::from_text(
        R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [40, 0, 0], [40, 20, 0], [0, 20, 0]], "height": 30}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}},
      {"id": "v", "position": [10, 10, 8], "types": {"smart_volume": {"demand": 1000}}},
      {"id": "j1", "position": [-200, -5, 0], "types": {"junction": {}}}, {"id": "j2", "position": [200, -5, 0], "types": {"junction": {}}},
      {"id": "s", "types": {"street": {"start": "j1", "end": "j2"}}},
      {"id": "tower", "name": "Tower", "types": {"existing_building": {"height": 20, "outline": [[)" +
        x + ", 8, 0], [" + east + ", 8, 0], [" + east + ", 13, 0], [" + x + R"(, 13, 0]]}}}], "links": []})");
    world.tick(3);
    reading::ReportModel model;
    reading::read_model(world.state(), model);
    return drawing::draw_plan(world.state(), model, drawing::Palette(model.use_names())).svg;
  };
  EXPECT_NE(plan_with(-15).find(">Tower</text>"), std::string::npos);
  EXPECT_EQ(plan_with(-33).find(">Tower</text>"), std::string::npos);
  EXPECT_EQ(plan_with(-300).find(">Tower</text>"), std::string::npos);
}

TEST(FigureParts, PercentagesOfNothingAreDashes) {
  EXPECT_EQ(reading::share_of(5, 0), "\xE2\x80\x93");
  EXPECT_EQ(reading::share_of(5, 1e-13), "\xE2\x80\x93");
  EXPECT_EQ(reading::difference_of(1e6, 1e-9), "\xE2\x80\x93");
  EXPECT_EQ(reading::difference_of(0, 0), "\xE2\x80\x93");
  EXPECT_EQ(reading::share_of(50, 100), "50.0\xC2\xA0%");
}

}  // namespace
}  // namespace bl::report
