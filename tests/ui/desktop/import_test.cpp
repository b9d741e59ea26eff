// Surroundings through the window: one step that can be undone, in the frame of the scene; what cannot be read changes nothing.
#include <chrono>
#include <cstdio>

#include "core/making/site_grounds.h"
#include "core/reading/views/solver.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/reference_files.h"
#include "tests/ui/desktop/import_support.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

std::size_t steps_of(Workbench& editor) { return editor.document->history().size(); }

TEST(WindowImport, IsOneStepThatCanBeUndone) {
  const Folder folder("import_step");
  ImportDesktop desktop("scenes/start/quarter.json");
  const std::string before = desktop.scene_text();
  desktop.import({folder.write("houses.geojson", houses_text())});
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  Workbench& editor = desktop.editor();
  ASSERT_TRUE(editor.scene().nodes.contains("building_1"));
  ASSERT_TRUE(editor.scene().nodes.contains("building_2"));
  EXPECT_EQ(steps_of(editor), 1u);
  EXPECT_EQ(editor.document->history().back().label, "Import \xc2\xb7 houses.geojson");
  EXPECT_EQ(settings_of(editor.scene()).coordinate_system, "EPSG:28992");
  EXPECT_NE(desktop.notices().find("Imported houses.geojson: 2"), std::string::npos) << desktop.notices();
  desktop.editor().undo();
  desktop.frames(2);
  EXPECT_EQ(desktop.scene_text(), before);
  desktop.editor().redo();
  EXPECT_TRUE(editor.scene().nodes.contains("building_1"));
}

// Twenty metres north of the first of the houses.
constexpr const char* kNorth =
    R"({"type": "Feature", "properties": {"building": "yes", "gid": 7}, "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
    "geometry": {"type": "Polygon", "coordinates": [[[85000, 447020], [85020, 447020], [85020, 447030], [85000, 447030], [85000, 447020]]]}})";

Vector3 position_of(Workbench& editor, const std::string& id) {
  return std::get<Vector3>(editor.scene().nodes.at(id).types.at("node").at("position"));
}

TEST(WindowImport, LaterFilesLandInTheFrameOfTheFirst) {
  const Folder folder("import_frame");
  ImportDesktop desktop;
  desktop.import({folder.write("houses.geojson", houses_text())});
  Workbench& editor = desktop.editor();
  ASSERT_TRUE(editor.document) << "where no scene is open, a new one begins";
  EXPECT_EQ(desktop.desktop().title(), "* Untitled scene - BehaviourLinks");
  const double origin = settings_of(editor.scene()).origin_x;
  desktop.import({folder.write("more.geojson", kNorth)});
  ASSERT_TRUE(editor.scene().nodes.contains("building_7")) << desktop.told();
  const Vector3 way = position_of(editor, "building_7") - position_of(editor, "building_1");
  EXPECT_NEAR(way.y, 20, 1e-3);
  EXPECT_NEAR(way.x, 0, 1e-3);
  EXPECT_EQ(settings_of(editor.scene()).origin_x, origin);
  EXPECT_EQ(steps_of(editor), 2u);
}

// A site of 100 m by 80 m, and a street of 10 m that runs 50 m into it.
constexpr const char* kClearSite = R"({"format": "behaviourlinks", "version": 1,
  "settings": {"coordinate_system": "EPSG:28992", "origin_x": 85000, "origin_y": 447000},
  "nodes": [{"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[100,0,0],[100,80,0],[0,80,0]]}}}], "links": []})";
constexpr const char* kClearStreet =
    R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
  "features": [{"type": "Feature", "properties": {"gid": "main", "highway": "residential", "width": 10},
    "geometry": {"type": "LineString", "coordinates": [[84950,447040],[85050,447040]]}}]})";

TEST(WindowImport, KeepsStreetsClearWhereItsBoxIsChecked) {
  const Folder folder("import_clear");
  ImportDesktop desktop;
  desktop.desktop().drop(folder.write("site.json", kClearSite));
  desktop.frames(2);
  const std::string street = folder.write("street.geojson", kClearStreet), before = desktop.scene_text();
  const auto exclusions = [&] {
    const auto& ports = desktop.editor().scene().nodes.at("site").types.at("boundary");
    return ports.contains("exclusions") ? std::get<Shared<Table>>(ports.at("exclusions"))->rows.size() : 0;
  };
  desktop.import({street});
  EXPECT_EQ(exclusions(), 0u) << "nobody has asked for it";
  desktop.editor().undo();
  desktop.frames(2);
  ASSERT_EQ(desktop.scene_text(), before);
  desktop.desktop().drop({street});
  desktop.frames(3);
  for (const char* ground : making::kClearGrounds) EXPECT_TRUE(desktop.has(std::string("import/clear/") + ground)) << ground;
  EXPECT_TRUE(desktop.has("import/least green"));
  desktop.press_on("import/clear/green");
  desktop.press_on("import/clear/streets");
  desktop.press_on("import/clear/green");
  EXPECT_EQ(desktop.editor().dialogs->import_options().keep_clear, std::vector<std::string>{"streets"});
  desktop.press_on("import/begin");
  desktop.finish();
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_EQ(exclusions(), 4u) << desktop.told();
  desktop.ticks(2);
  EXPECT_NEAR(reading::rows<reading::BoundaryFigures>(desktop.editor().state()).front().figures.ground_area, 8000 - 50 * 10,
              1e-6);
  EXPECT_EQ(steps_of(desktop.editor()), 1u);
  desktop.editor().undo();
  desktop.frames(2);
  EXPECT_EQ(desktop.scene_text(), before) << "one step, which can be undone";
}

TEST(WindowImport, OneBadFileOfSeveralKeepsAllOut) {
  const Folder folder("import_several");
  ImportDesktop desktop("scenes/start/quarter.json");
  desktop.import(
      {folder.write("more.geojson", kNorth),
       folder.write("heights.asc", "ncols 3\nnrows 2\nxllcorner 84990\nyllcorner 446990\ncellsize 50\n1 2 3\n4 5 6\n")});
  EXPECT_TRUE(desktop.is_open());
  EXPECT_NE(desktop.told().find("heights.asc: crs: The file does not say in which CRS"), std::string::npos) << desktop.told();
  EXPECT_EQ(steps_of(desktop.editor()), 0u);
  EXPECT_FALSE(desktop.editor().scene().nodes.contains("building_7"));
}

TEST(WindowImport, FramesWhatCameIn) {
  const Folder folder("import_camera");
  ImportDesktop desktop("scenes/start/quarter.json");
  desktop.import({folder.write("houses.geojson", houses_text())});
  desktop.frames(60);  // the camera's way
  const Camera& camera = desktop.editor().view->camera();
  const Vector3 at = position_of(desktop.editor(), "building_1");
  EXPECT_LT(distance({at.x, at.y, 0}, {camera.target.x, camera.target.y, 0}), 60);
  EXPECT_LT(camera.distance, 300);
}

TEST(WindowImport, BadInputSaysWhatAndWhereAndChangesNothing) {
  const Folder folder("import_bad");
  const std::string houses = houses_text();
  struct Case {
    std::string name, bytes, said, crs;
  };
  const std::vector<Case> cases = {
      {"cut.geojson", houses.substr(0, houses.size() / 2), "cut.geojson", ""},
      {"empty.osm", "", "empty.osm: byte 0: The file is empty", ""},
      {"empty.geojson", "", "empty.geojson", ""},
      {"noise.osm", "noise \x01\x02\x03", "noise.osm: byte 0: This is no OpenStreetMap file", ""},
      {"noise.tif", std::string("II*\0\xff\xff\xff\x7f noise", 14), "noise.tif", ""},
      {"cut.osm", "<?xml version='1.0'?><osm version='0.6'><node id='1' lat='1' lon='1'/><way id", "cut.osm: line 1", ""},
      {"houses.geojson", houses, "houses.geojson: crs", "EPSG:1"},
      {"noise.bin", std::string("\0\1\2\3", 4), "noise.bin: byte 0: This is no file that is read but binary data", ""}};
  ImportDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  const std::string before = desktop.scene_text();
  for (const Case& one : cases) {
    const std::string path = folder.write(one.name, one.bytes);
    editor.dialogs->show_import({path});
    desktop.frames(3);
    if (!one.crs.empty()) {
      desktop.editor().dialogs->import_options().context.crs = one.crs;
      desktop.frames(1);
    }
    desktop.press_on("import/begin");
    desktop.finish();
    EXPECT_TRUE(desktop.is_open()) << one.name << ": the dialog stays, so that people can mend what is wrong";
    EXPECT_NE(desktop.told().find(one.said), std::string::npos) << one.name << " said: " << desktop.told();
    EXPECT_NE(desktop.told().find("Nothing was added to the scene."), std::string::npos) << desktop.told();
    EXPECT_EQ(desktop.scene_text(), before) << one.name;
    EXPECT_EQ(steps_of(editor), 0u) << one.name;
    EXPECT_TRUE(editor.document->imports().empty()) << one.name;
    desktop.key(GLFW_KEY_ESCAPE);
    desktop.frames(2);
    editor.dialogs->import_options() = {};
  }
}

TEST(WindowImport, DropsAreToldApart) {
  const Folder folder("import_drops");
  ImportDesktop desktop("scenes/start/quarter.json");
  desktop.desktop().drop({folder.write("houses.json", houses_text()), folder.write("noise.csv", "x,y,level\n1,2,3\n")});
  desktop.frames(3);
  ASSERT_TRUE(desktop.is_open());
  EXPECT_EQ(desktop.editor().dialogs->import_options().files.size(), 2u);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  const std::string scene = folder.write("scene.json", read_file(test::source_folder() + "/scenes/start/quarter.json").value());
  desktop.desktop().drop(scene);
  desktop.frames(2);
  EXPECT_FALSE(desktop.is_open()) << "a scene is opened";
  EXPECT_EQ(desktop.editor().document->path(), scene);
}

TEST(WindowImport, CanBeAskedForByKeyAndPalette) {
  ImportDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_I, true);
  desktop.frames(3);
  EXPECT_TRUE(desktop.has("import/add"));
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(3);
  EXPECT_FALSE(desktop.is_open());
  desktop.key(GLFW_KEY_K, true);
  desktop.frames(3);
  desktop.type("import surr");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  EXPECT_TRUE(desktop.has("import/add"));
  EXPECT_FALSE(desktop.editor().dialogs->is_importing()) << "the Enter of the palette is not that of the dialog";
}

// Many features: the window goes on, and stopping leaves the scene as it was.
TEST(WindowImport, CanBeStopped) {
  const Folder folder("import_stop");
  std::string text =
      R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)";
  for (int k = 0; k < 60000; ++k) {
    const std::string x = std::to_string(80000 + 12 * (k % 250)), y = std::to_string(440000 + 12 * (k / 250));
    const std::string e = std::to_string(80008 + 12 * (k % 250)), n = std::to_string(440008 + 12 * (k / 250));
    text += std::string(k > 0 ? "," : "") +
            R"({"type":"Feature","properties":{"height":9},"geometry":{"type":"Polygon","coordinates":[[[)" + x + "," + y +
            "],[" + e + "," + y + "],[" + e + "," + n + "],[" + x + "," + n + "],[" + x + "," + y + "]]]}}";
  }
  ImportDesktop desktop("scenes/start/quarter.json");
  const std::string before = desktop.scene_text();
  desktop.desktop().drop(folder.write("many.geojson", text + "]}"));
  desktop.frames(3);
  desktop.press_on("import/begin");
  ASSERT_TRUE(desktop.editor().dialogs->is_importing());
  desktop.frames(2);
  desktop.press_on("import/stop");
  EXPECT_FALSE(desktop.editor().dialogs->is_importing());
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_NE(desktop.told().find("stopped"), std::string::npos);
  EXPECT_TRUE(desktop.is_open()) << "with other options it can be tried again";
}

TEST(WindowImport, RealVillage) {
  const auto village = test::shared_file("data/osm/small_village.osm");
  if (village.empty()) {
    std::printf("the shared data are not beside this checkout: no real file is imported here\n");
    return;
  }
  ImportDesktop desktop;
  desktop.import({village.string()});
  ASSERT_TRUE(desktop.editor().document) << desktop.told();
  std::size_t elements = 0;
  for (const auto& [file, report] : desktop.editor().document->imports()) elements += report.total();
  EXPECT_EQ(elements, 340u);
  EXPECT_EQ(desktop.editor().scene().nodes.size(), 58u);
  desktop.ticks(3);
  EXPECT_GE(desktop.editor().state().tick, 3);  // the clock runs beside
}

TEST(WindowImport, RealTownIsAddedWithinOneFrame) {
  const auto town = test::shared_file("data/osm/monaco.osm.gz");
  if (town.empty()) {
    std::printf("the shared data are not beside this checkout: no real file is imported here\n");
    return;
  }
  ImportDesktop desktop;
  desktop.desktop().drop(town.string());
  desktop.frames(3);
  desktop.press_on("import/begin");
  desktop.editor().dialogs->wait_for_import();
  const auto begin = std::chrono::steady_clock::now();
  desktop.frames(1);
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("the frame that adds 2676 nodes: %.0f ms\n", 1000 * taken);
  ASSERT_TRUE(desktop.editor().document) << desktop.told();
  EXPECT_EQ(desktop.editor().scene().nodes.size(), 2676u);
}

}  // namespace
}  // namespace bl::desktop
