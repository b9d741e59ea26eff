// The report of an import as a list: each element can be gone to, counted, sorted, written down and read again.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tests/ui/desktop/import_support.h"
#include "ui/desktop/panels/import_list.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

class ReportTest : public ::testing::Test {
 protected:
  ReportTest() : folder("import_report") {
    desktop.import({folder.write("houses.geojson", houses_text())});
    desktop.frames(3);
  }
  ImportList& list() { return *memory_of(desktop.editor()).imports; }
  // The row of an id, where it stands now.
  std::string row_of(const std::string& id) {
    const auto& shown = list().shown();
    for (std::size_t k = 0; k < shown.size(); ++k)
      if (shown[k].row->id == id) return "import/row/" + std::to_string(k);
    ADD_FAILURE() << "there is no row " << id;
    return "";
  }
  Folder folder;
  ImportDesktop desktop;
};

TEST_F(ReportTest, CountsByOutcomeAndReason) {
  ASSERT_TRUE(desktop.editor().document) << desktop.told();
  EXPECT_EQ(list().total(), 4u);
  EXPECT_EQ(list().count(importing::ImportOutcome::taken), 1u);
  EXPECT_EQ(list().count(importing::ImportOutcome::repaired), 1u);
  EXPECT_EQ(list().count(importing::ImportOutcome::skipped), 2u);
  ASSERT_EQ(list().groups().size(), 4u);
  EXPECT_EQ(list().groups().front().outcome, importing::ImportOutcome::skipped) << "what is missing stands first";
  desktop.press_on("import/outcome/Skipped");
  desktop.frames(2);
  EXPECT_EQ(list().shown().size(), 2u);
  desktop.press_on("import/group/0");
  desktop.frames(2);
  EXPECT_EQ(list().shown().size(), 1u);
  desktop.press_on("import/group/0");
  desktop.frames(2);
  EXPECT_EQ(list().shown().size(), 4u) << "a second press shows all again";
  desktop.press_on("import/search");
  desktop.type("CROSSES");
  desktop.frames(2);
  ASSERT_EQ(list().shown().size(), 1u);
  EXPECT_EQ(list().shown().front().row->id, "features/2");
}

// What was mended is said as clearly as what is missing: in the notice, as a group, in its row, and a press goes to its node.
TEST_F(ReportTest, WhatWasRepairedSaysWhatWasMended) {
  EXPECT_NE(desktop.notices().find("element repaired, 2 skipped"), std::string::npos) << desktop.notices();
  const auto& groups = list().groups();
  const auto mended = std::find_if(groups.begin(), groups.end(),
                                   [](const ImportGroup& group) { return group.outcome == importing::ImportOutcome::repaired; });
  ASSERT_NE(mended, groups.end());
  EXPECT_EQ(mended->reason, "repeated points dropped");
  desktop.press_on("import/group/" + std::to_string(mended - groups.begin()));
  desktop.frames(2);
  ASSERT_EQ(list().shown().size(), 1u);
  const importing::ImportRow& row = *list().shown().front().row;
  EXPECT_EQ(why_of(row), "repeated points dropped (1)");
  EXPECT_EQ(special_of(row), "taken as building");
  desktop.press_on("import/row/0");
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().picks.nodes, (std::set<std::string>{"building_2"}));
}

// A height that nobody measured is seen in the row of its building, and the rows are a group of their own.
TEST(ImportRows, HeightsOfNeighboursAreTold) {
  std::string features;
  for (int k = 0; k < 5; ++k) {
    const std::string x = std::to_string(85000 + 30 * k), e = std::to_string(85010 + 30 * k);
    features += std::string(k > 0 ? "," : "") + R"({"type": "Feature", "properties": {)" + (k < 4 ? R"("height": 12)" : "") +
                R"(}, "geometry": {"type": "Polygon", "coordinates": [[[)" + x + ", 447000], [" + e + ", 447000], [" + e +
                ", 447010], [" + x + ", 447010], [" + x + ", 447000]]]}}";
  }
  const Folder folder("import_heights");
  ImportDesktop desktop;
  desktop.import({folder.write(
      "five.geojson",
      R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" + features +
          "]}")});
  desktop.frames(3);
  ImportList& list = *memory_of(desktop.editor()).imports;
  ASSERT_EQ(list.groups().size(), 2u) << desktop.told();
  EXPECT_EQ(list.groups().back().reason, "building, height taken from its neighbours");
  EXPECT_EQ(list.groups().back().count, 1u);
  desktop.press_on("import/group/1");
  desktop.frames(2);
  ASSERT_EQ(list.shown().size(), 1u);
  EXPECT_EQ(list.shown().front().row->id, "features/4");
  EXPECT_EQ(special_of(*list.shown().front().row), "height taken from its neighbours: 12 m");
}

TEST_F(ReportTest, WhatWasTakenIsChosenAndFramed) {
  desktop.ticks(1);  // so that there are shapes to frame
  desktop.press_on(row_of("features/1"));
  desktop.frames(60);
  Workbench& editor = desktop.editor();
  EXPECT_EQ(editor.picks.nodes, (std::set<std::string>{"building_2"}));
  const Vector3 at = std::get<Vector3>(editor.scene().nodes.at("building_2").types.at("node").at("position"));
  EXPECT_LT(distance(at, editor.view->camera().target), 10);
  EXPECT_FALSE(editor.view->pin());
}

TEST_F(ReportTest, WhatWasSkippedGetsAPinAtItsPlace) {
  Workbench& editor = desktop.editor();
  editor.picks.only_node("building_1");
  desktop.frames(2);
  desktop.press_on(row_of("features/2"));
  desktop.frames(60);
  ASSERT_TRUE(editor.view->pin());
  EXPECT_TRUE(editor.picks.nodes.empty());
  const Point3 pin = editor.view->pin()->place;
  // The scene's origin lies at whole metres of the CRS.
  const Settings settings = settings_of(editor.scene());
  EXPECT_NEAR(settings.origin_x + pin.x, 85035, 1e-6);
  EXPECT_NEAR(settings.origin_y + pin.y, 447105, 1e-6);
  EXPECT_LT(distance(pin, editor.view->camera().target), 0.01);
  EXPECT_NE(editor.view->pin()->text.find("crosses or touches itself"), std::string::npos);
  desktop.move_to({1000, 400});
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  EXPECT_FALSE(editor.view->pin()) << "Esc takes it away";
  desktop.press_on(row_of("features/2"));
  desktop.frames(2);
  editor.picks.only_node("building_1");
  desktop.frames(2);
  EXPECT_FALSE(editor.view->pin()) << "another choice takes it away";
}

TEST_F(ReportTest, WhatHasNoPlaceSaysSo) {
  const Camera before = desktop.editor().view->camera();
  desktop.frames(60);
  desktop.press_on(row_of("features/3"));
  desktop.frames(2);
  EXPECT_FALSE(desktop.editor().view->pin());
  EXPECT_NE(desktop.notices().find("does not say where feature features/3 lies"), std::string::npos) << desktop.notices();
  (void)before;
}

TEST_F(ReportTest, AnUndoneImportLeavesPlaces) {
  desktop.editor().undo();
  desktop.frames(2);
  desktop.press_on(row_of("features/0"));
  desktop.frames(2);
  EXPECT_TRUE(desktop.editor().view->pin()) << "its node is gone, its place is not";
}

TEST_F(ReportTest, IsKeptBesideTheSceneAndReadAgain) {
  Workbench& editor = desktop.editor();
  const std::string scene = folder.at("site.json");
  ASSERT_TRUE(editor.document->save(scene));
  const auto text = read_file(folder.at("site.import.csv"));
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->starts_with("file,outcome,kind,id,reason,detail,count,x,y,made\r\n")) << *text;
  EXPECT_NE(text->find("houses.geojson,taken,feature,features/0,building,,1,"), std::string::npos) << *text;
  ImportDesktop other;
  ASSERT_TRUE(other.editor().open(scene));
  other.frames(2);
  ASSERT_EQ(other.editor().document->imports().size(), 1u);
  EXPECT_EQ(import_csv(other.editor().document->imports()), *text);
  EXPECT_EQ(other.editor().document->imports().front().second.rows()[0].made, (std::vector<std::string>{"building_1"}));
  folder.write("site.import.csv", text->substr(0, text->size() - 3));
  ImportDesktop third;
  ASSERT_TRUE(third.editor().open(scene)) << "a damaged report does not keep the scene shut";
  ASSERT_FALSE(third.editor().problems.empty());
  EXPECT_NE(third.editor().problems.front().error.place.find("site.import.csv"), std::string::npos);
}

TEST_F(ReportTest, IsWrittenAsCsv) {
  desktop.press_on("import/csv");
  desktop.frames(3);
  ASSERT_TRUE(desktop.editor().dialogs->is_choosing_file());
  desktop.key(GLFW_KEY_A, true);
  desktop.type(folder.at("rows.csv"));
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  const auto text = read_file(folder.at("rows.csv"));
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, import_csv(desktop.editor().document->imports()));
}

TEST_F(ReportTest, TwentyThousandRowsAreDrawnAsFarAsTheyAreSeen) {
  importing::ImportReport report;
  for (int k = 0; k < 20000; ++k) {
    report.skip("way", "w" + std::to_string((k * 7919) % 20000), k % 3 == 0 ? "its line is open" : "no building", "natural=tree");
    report.locate(std::array{0.5 * (k % 200), 0.5 * (k / 200)});
  }
  desktop.editor().document->add_imports({{"many.osm", report}});
  desktop.frames(3);
  EXPECT_EQ(list().shown().size(), 20004u);
  std::size_t drawn = 0;
  for (const auto& [key, place] : memory_of(desktop.editor()).places) drawn += key.starts_with("import/row/") ? 1 : 0;
  EXPECT_GT(drawn, 3u);
  EXPECT_LT(drawn, 60u);
  list().sort(ImportColumn::id, false);
  const auto& shown = list().shown();
  std::vector<std::string> last;
  for (std::size_t k = shown.size() - 3; k < shown.size(); ++k) last.push_back(shown[k].row->id);
  EXPECT_EQ(last, (std::vector<std::string>{"w19997", "w19998", "w19999"})) << "numbers in ids count as numbers";
  const auto begin = std::chrono::steady_clock::now();
  desktop.move_to(desktop.middle("import/row/2"));
  for (int k = 0; k < 50; ++k) desktop.wheel(-20);
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("a frame while 20 004 rows scroll: %.1f ms\n", 1000 * taken / 102);
  EXPECT_FALSE(desktop.has("import/row/2")) << "the wheel scrolls";
}

}  // namespace
}  // namespace bl::desktop
