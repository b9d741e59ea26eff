// Rows of import reports: places of what was skipped as well, and the way to CSV and back.
#include <gtest/gtest.h>

#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/import_report.h"
#include "core/import/osm_context.h"

namespace bl::importing {
namespace {

constexpr const char* kTriangleWay = R"(<?xml version='1.0'?><osm version='0.6'>
  <node id='1' lat='52.0000' lon='4.0000'/><node id='2' lat='52.0000' lon='4.0010'/><node id='3' lat='52.0010' lon='4.0010'/>
  <node id='4' lat='52.0005' lon='4.0005'><tag k='natural' v='tree'/></node>
  <way id='10'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='1'/><tag k='building' v='yes'/></way>
  <way id='11'><nd ref='1'/><nd ref='2'/><nd ref='3'/><tag k='building' v='yes'/></way>
  <way id='12'><nd ref='98'/><nd ref='99'/><tag k='building' v='yes'/></way>
  <relation id='20'><member type='way' ref='11' role=''/><tag k='type' v='site'/></relation></osm>)";

const ImportRow& row(const ImportReport& report, const std::string& id) {
  for (const ImportRow& one : report.rows())
    if (one.id == id) return one;
  static const ImportRow nothing;
  ADD_FAILURE() << "no row " << id;
  return nothing;
}

TEST(ImportReport, SkippedElementsHaveThePlaceThatTheFileGivesThem) {
  const auto context = read_osm_context(kTriangleWay, {});
  ASSERT_TRUE(context) << context.error().text();
  const ImportRow &taken = row(context->report, "w10"), &open = row(context->report, "w11"), &lost = row(context->report, "w12");
  EXPECT_EQ(taken.outcome, ImportOutcome::taken);
  EXPECT_EQ(open.outcome, ImportOutcome::skipped);
  ASSERT_TRUE(taken.place && open.place);
  EXPECT_EQ(*taken.place, *open.place) << "the same three corners";
  EXPECT_FALSE(lost.place) << "its nodes are not in the file";
  EXPECT_EQ(row(context->report, "r20").place, open.place) << "a relation lies where its ways lie";
  ASSERT_TRUE(row(context->report, "n4").place);
  EXPECT_NEAR((*row(context->report, "n4").place)[0], (*open.place)[0], 0.1) << "the tree stands in the middle";
  ASSERT_EQ(context->buildings.size(), 1u);
  EXPECT_EQ(context->report.rows()[context->buildings.front().row].id, "w10");
}

TEST(ImportReport, PointsOfALayerWithoutAValueHaveAPlace) {
  ContextOptions options;
  options.crs = "EPSG:28992";
  const auto layer = read_layer_csv("x,y,level\n85000,447000,5\n85010,447020,\n,447020,7\n85000,447000,6\n", options);
  ASSERT_TRUE(layer) << layer.error().text();
  ASSERT_TRUE(row(layer->report, "line 3").place);
  EXPECT_NEAR((*row(layer->report, "line 3").place)[1] - (*row(layer->report, "line 2").place)[1], 20, 1e-6);
  EXPECT_FALSE(row(layer->report, "line 4").place);
}

TEST(ImportReport, GoesToCsvAndBack) {
  ImportReport report;
  report.take("way", "w1", "building", "a \"quoted\", text");
  report.locate(std::array{1.25, -2.5});
  report.made(0, "building_w1");
  report.made(0, "building_w1_2");
  report.skip("node", "", "neither tags nor a way that uses it", "", 280);
  const ImportReports reports{{"a.osm", report}, {"b.osm", report}};
  const std::string text = import_csv(reports);
  const auto again = read_import_csv(text);
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(import_csv(*again), text);
  ASSERT_EQ(again->size(), 2u);
  const ImportRow& first = again->front().second.rows().front();
  EXPECT_EQ(first.place, (std::array{1.25, -2.5}));
  EXPECT_EQ(first.made.size(), 2u);
  EXPECT_EQ(again->back().second.rows().back().count, 280u);
}

TEST(ImportReport, WhatIsNoReportIsRefusedWithItsLine) {
  const std::string text = import_csv({{"a.osm", [] {
                                          ImportReport report;
                                          report.skip("way", "w1", "why");
                                          return report;
                                        }()}});
  EXPECT_EQ(read_import_csv("").error().place, "line 1");
  EXPECT_EQ(read_import_csv("a,b\n1,2\n").error().place, "line 1");
  EXPECT_EQ(read_import_csv(text.substr(0, text.size() - 3)).error().place, "line 2");
  EXPECT_EQ(read_import_csv(text + "a.osm,eaten,way,w2,why,,1,,,\r\n").error().place, "line 3");
  EXPECT_EQ(read_import_csv(text + "a.osm,skipped,way,w2,why,,many,,,\r\n").error().place, "line 3");
  EXPECT_EQ(read_import_csv(text + "a.osm,skipped,way,w2,why,,1,5,,\r\n").error().place, "line 3");
}

TEST(ImportReport, AStoppedImportSaysSo) {
  ImportWatch watch;
  watch.is_stopped = true;
  ContextOptions options;
  options.watch = &watch;
  const auto context = read_osm_context(kTriangleWay, options);
  ASSERT_FALSE(context);
  EXPECT_EQ(context.error().code, ErrorCode::cancelled);
  const auto houses =
      read_geojson_context(R"({"type": "Polygon", "coordinates": [[[4, 52], [4.001, 52], [4.001, 52.001], [4, 52]]]})", options);
  ASSERT_FALSE(houses);
  EXPECT_EQ(houses.error().code, ErrorCode::cancelled);
}

TEST(ImportReport, ReportsComeBackWithEveryName) {
  ImportReport report;
  report.take("building", "=cmd|'/c calc'!A0", "-1", "'=1");
  const ImportReports reports{{"+site.json", report}};
  const std::string text = import_csv(reports);
  EXPECT_EQ(text.find(",=cmd"), std::string::npos) << text;
  const auto read = read_import_csv(text);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->front().first, "+site.json");
  EXPECT_EQ(read->front().second.rows().front().id, "=cmd|'/c calc'!A0");
  EXPECT_EQ(read->front().second.rows().front().detail, "'=1");
  EXPECT_EQ(import_csv(*read), text);
}

}  // namespace
}  // namespace bl::importing
