// The section of the 3D view under the hand: its place and its angle, its numbers, its drawing, and that it is kept.
#include <cmath>
#include <optional>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/export/format.h"
#include "core/export/read_proposal.h"
#include "core/export/section.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/import_support.h"
#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/panels/export_dialog.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/section_plane.h"

namespace bl::desktop {
namespace {

using PlaneHandle = SceneView::PlaneHandle;

TEST(SectionPlane, IsSaidInNumbersAndReadAgain) {
  const std::pair<ViewSection, const char*> planes[] = {{level_section(12.5), "level 12.5"},
                                                        {flipped(level_section(12.5)), "level 12.5 below"},
                                                        {upright_section(0, 4), "upright 0 4"},
                                                        {upright_section(35.5, -7.25), "upright 35.5 -7.25"},
                                                        {flipped(upright_section(35.5, -7.25)), "upright 215.5 7.25"}};
  for (const auto& [plane, text] : planes) {
    EXPECT_EQ(section_text(plane), text);
    const auto read = section_from_text(text);
    ASSERT_TRUE(read) << text;
    EXPECT_NEAR(distance(read->normal, plane.normal), 0, 1e-9) << text;
    EXPECT_NEAR(read->offset, plane.offset, 1e-9) << text;
  }
  for (const char* text : {"", "level", "level x", "upright 3", "level 3 above", "upright 1 2 3", "sideways 1 2"})
    EXPECT_FALSE(section_from_text(text)) << text;
  // Who looks north from a plane at y = 4 has before them what lies farther north.
  EXPECT_TRUE(hides(upright_section(0, 4), {0, 3, 0}));
  EXPECT_FALSE(hides(upright_section(0, 4), {0, 5, 0}));
  EXPECT_TRUE(hides(upright_section(90, 4), {3, 0, 0}));
}

// The line of the exported section has to its left what the view shows.
TEST(SectionPlane, TheExportedLineLooksTheSameWay) {
  const ModelBox box{{0, 0, 0}, {80, 60, 20}};
  for (const double bearing : {0.0, 35.0, 90.0, 180.0, 261.5}) {
    const ViewSection plane = upright_section(bearing, 11);
    const auto line = exporting::section_line({}, section_option(plane, box));
    ASSERT_TRUE(line);
    const Vector3 way = line->to - line->from, left{-way.y / norm(way), way.x / norm(way), 0};
    EXPECT_NEAR(distance(left, -plane.normal), 0, 1e-6) << bearing;
    EXPECT_NEAR(dot(plane.normal, line->from), plane.offset, 1e-5) << bearing;
    EXPECT_FALSE(hides(plane, line->from + left));
  }
  EXPECT_EQ(section_option(flipped(level_section(-2.5)), box), "-2.5");
}

class SectionDesktop : public ImportDesktop {
 public:
  SectionDesktop() : ImportDesktop("scenes/start/standing.json") {
    ticks(20);
    frames(40);
    editor().area = Area::view;
  }
  SceneView& view() { return *editor().view; }
  const ViewSection& section() { return view().section(); }
  std::optional<ImVec2> handle(PlaneHandle which) {
    for (const auto& [one, place] : view().plane_handles())
      if (one == which) return place;
    return {};
  }
  void type_into(const std::string& field, const std::string& text) {
    press_on(field);
    frames(3);
    key(GLFW_KEY_A, true);
    type(text);
    key(GLFW_KEY_ENTER);
    frames(2);
  }
};

TEST(ViewSectionPlane, IsPulledAlongItsAxisAndTurnedByHand) {
  SectionDesktop desktop;
  EXPECT_TRUE(desktop.view().plane_handles().empty());
  desktop.key(GLFW_KEY_B, false, false, true);
  desktop.frames(2);
  ASSERT_TRUE(desktop.section().is_on);
  ASSERT_TRUE(is_level(desktop.section()));
  EXPECT_FALSE(desktop.handle(PlaneHandle::angle)) << "a level plane has no angle";
  auto grip = desktop.handle(PlaneHandle::place);
  ASSERT_TRUE(grip);
  const std::string before = desktop.logic_text();
  const double height = position_of(desktop.section());
  desktop.drag(*grip, {grip->x, grip->y - 40});
  const double raised = position_of(desktop.section());
  EXPECT_GT(raised, height + 1);
  EXPECT_NEAR(std::round(100 * raised), 100 * raised, 1e-6) << "whole centimetres";
  // Upright, and turned around its middle by a hand that goes a quarter of the way around.
  desktop.key(GLFW_KEY_B, false, true, true);
  desktop.frames(2);
  ASSERT_FALSE(is_level(desktop.section()));
  grip = desktop.handle(PlaneHandle::angle);
  ASSERT_TRUE(grip);
  desktop.drag(*grip, {grip->x - 60, grip->y + 50}, 0, 12);
  const double turned = bearing_of(desktop.section());
  EXPECT_GT(std::abs(std::remainder(turned, 90)), 0.5) << "at any angle, not along the axes alone";
  // Esc takes it back; Control snaps.
  grip = desktop.handle(PlaneHandle::angle);
  ASSERT_TRUE(grip);
  desktop.move_to(*grip);
  desktop.press();
  desktop.hold(true, false);
  desktop.move_to({grip->x + 40, grip->y + 60});
  desktop.frames(2);
  EXPECT_TRUE(desktop.view().is_moving());
  EXPECT_NE(bearing_of(desktop.section()), turned);
  EXPECT_NEAR(std::remainder(bearing_of(desktop.section()), 15), 0, 1e-6);
  desktop.hold(false, false);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.release();
  desktop.frames(2);
  EXPECT_NEAR(bearing_of(desktop.section()), turned, 1e-9);
  EXPECT_FALSE(desktop.view().is_moving());
  grip = desktop.handle(PlaneHandle::place);
  ASSERT_TRUE(grip);
  const double place = position_of(desktop.section());
  desktop.drag(*grip, {grip->x + 50, grip->y - 20});
  EXPECT_GT(std::abs(position_of(desktop.section()) - place), 0.5);
  EXPECT_NEAR(bearing_of(desktop.section()), turned, 1e-6) << "its angle stays";
  EXPECT_EQ(desktop.logic_text(), before) << "a view is no part of the scene";
  EXPECT_TRUE(desktop.editor().document->history().empty());
}

TEST(ViewSectionPlane, ItsNumbersAreTypedAndItIsFlippedAndSwitchedOff) {
  SectionDesktop desktop;
  desktop.view().toggle_section();
  desktop.frames(3);
  desktop.type_into("view/section/at", "7.5 m");
  EXPECT_EQ(desktop.section(), level_section(7.5));
  desktop.press_on("view/section/kind");
  desktop.frames(3);
  ASSERT_FALSE(is_level(desktop.section()));
  desktop.type_into("view/section/towards", "35");
  EXPECT_NEAR(bearing_of(desktop.section()), 35, 1e-9);
  desktop.type_into("view/section/at", "60 m");
  EXPECT_NEAR(position_of(desktop.section()), 60, 1e-9);
  EXPECT_NEAR(bearing_of(desktop.section()), 35, 1e-9);
  desktop.type_into("view/section/at", "far away");
  EXPECT_NEAR(position_of(desktop.section()), 60, 1e-9) << "what is no length changes nothing";
  EXPECT_EQ(memory_of(desktop.editor()).complaint_key, "view/section/at");
  // What stood before the plane is hidden: marks too, and the other half after it was flipped.
  const std::uint32_t hotel = desktop.editor().index_of("hotel");
  const Point3 place = desktop.view().facts()->places[hotel];
  const bool is_hidden = hides(desktop.section(), place);
  desktop.press_on("view/section/flip");
  desktop.frames(2);
  EXPECT_NE(hides(desktop.section(), place), is_hidden);
  desktop.press_on("view/section/off");
  desktop.frames(2);
  EXPECT_FALSE(desktop.section().is_on);
  EXPECT_FALSE(desktop.has("view/section/at"));
  desktop.key(GLFW_KEY_B, false, false, true);
  desktop.frames(2);
  EXPECT_NEAR(bearing_of(desktop.section()), 215, 1e-9) << "it comes back where it was";
}

TEST(ViewSectionPlane, IsKeptWithTheSceneOfEachPerson) {
  SectionDesktop desktop;
  const std::string file = desktop.editor().document->source();
  desktop.view().set_section(upright_section(35, 60));
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().person.sections.at(file), "upright 35 60");
  ASSERT_TRUE(desktop.editor().open(test::source_folder() + "/scenes/start/quarter.json"));
  desktop.frames(3);
  EXPECT_FALSE(desktop.section().is_on) << "another scene has its own";
  ASSERT_TRUE(desktop.editor().open(file));
  desktop.frames(3);
  EXPECT_TRUE(desktop.section().is_on);
  EXPECT_NEAR(bearing_of(desktop.section()), 35, 1e-9);
  EXPECT_NEAR(position_of(desktop.section()), 60, 1e-9);
  desktop.view().toggle_section();
  desktop.frames(2);
  EXPECT_FALSE(desktop.editor().person.sections.contains(file));
}

TEST(ViewSectionPlane, IsExportedAsItStands) {
  const Folder folder("export_section");
  SectionDesktop desktop;
  for (const ViewSection& plane : {upright_section(35, 60), level_section(7.5)}) {
    desktop.view().set_section(plane);
    desktop.frames(3);
    const std::string option = desktop.view().section_for_export();
    desktop.press_on("view/section/export");
    desktop.frames(3);
    ASSERT_TRUE(desktop.is_open());
    desktop.press_on("export/folder");
    desktop.frames(3);
    desktop.key(GLFW_KEY_A, true);
    desktop.type(folder.at(""));
    desktop.frames(2);
    desktop.press_on("export/write");
    desktop.frames(3);
    if (desktop.is_open()) desktop.press_on("export/write");  // the first one is replaced
    desktop.frames(3);
    EXPECT_FALSE(desktop.is_open()) << desktop.told();
    const auto text = read_file(folder.at("standing.svg"));
    ASSERT_TRUE(text);
    if (is_level(plane)) EXPECT_NE(text->find("Level cut at +7.50 m"), std::string::npos);
    else EXPECT_NE(text->find("Section A, from ("), std::string::npos);
    const auto proposal = exporting::read_proposal(desktop.editor().state(), "standing.json");
    ASSERT_TRUE(proposal);
    const exporting::FormatDefinition& format = *exporting::find_format("svg");
    std::vector<Value> options;
    for (const PortDefinition& port : format.ports)
      options.push_back(port.id == "section" ? Value(option) : port.id == "level" ? Value(std::int64_t{-1}) : port.default_value);
    const auto made = format.write(*proposal, options, false);
    ASSERT_TRUE(made);
    EXPECT_EQ(*text, made->files.front().content);
  }
  // Without a section the dialog asks for what it asked for before.
  desktop.key(GLFW_KEY_E, true);
  desktop.frames(3);
  EXPECT_FALSE(desktop.editor().dialogs->exports().missing().empty()) << "nothing was chosen before";
}

// A tall box of three storeys, cut through its middle and seen from the front: fill, strokes and floors are three tones.
TEST(ViewSectionPlane, TheCutIsFilledHatchedAndHasItsFloors) {
  OffscreenGl gl;
  ASSERT_TRUE(gl.is_there()) << gl.failure();
  std::string failure;
  const auto renderer = GlRenderer::make(failure);
  ASSERT_NE(renderer, nullptr) << failure;
  Mesh box;
  for (const double z : {0.0, 9.0})
    for (const auto& [x, y] : {std::pair{-6.0, -6.0}, std::pair{6.0, -6.0}, std::pair{6.0, 6.0}, std::pair{-6.0, 6.0}})
      box.vertices.push_back({x, y, z});
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                   {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  ViewScene scene;
  scene.volumes = listed({{0, as_cell(box), 0xff4080c0u, 0, 3, 0, {}}});
  scene.camera.is_parallel = true;
  scene.camera.azimuth = -1.5707963267948966;
  scene.camera.elevation = 0;
  scene.camera.target = {0, 0, 4.5};
  scene.camera.distance = 30;
  scene.centre = {0, 0, 4.5};
  scene.radius = 12;
  scene.layers.shadows = scene.layers.ground = false;
  scene.colours = {.sky = 0xffffffffu, .ground = 0xffffffffu, .edge = 0xff000000u, .cut = 0xff4a403au, .is_dark = false};
  scene.section = upright_section(0, 0);
  constexpr int kSize = 240;
  renderer->draw(scene, kSize, kSize);
  const std::vector<std::uint8_t> pixels = renderer->pixels();
  const int wide = renderer->width();
  const double per_metre = wide / scene.camera.height_seen();
  const auto green = [&](double x, double z) {
    const int px = static_cast<int>(wide / 2 + per_metre * x), py = static_cast<int>(wide / 2 + per_metre * (z - 4.5));
    return static_cast<int>(pixels[4 * static_cast<std::size_t>(py * wide + px) + 1]);
  };
  // Floors lie under 3 m and 6 m and the roof under 9 m, so these are darker than anything between.
  int darkest = 255, lightest = 0;
  for (double x = -4; x <= 4; x += 0.05) darkest = std::min(darkest, green(x, 4.6)), lightest = std::max(lightest, green(x, 4.6));
  EXPECT_GT(lightest, darkest + 12) << "no strokes";
  for (const double floor : {2.85, 5.85, 8.85}) EXPECT_LT(green(0.3, floor) + 8, darkest) << floor;
  EXPECT_GT(green(-8, 4.5), 240) << "beside it there is nothing";
}

}  // namespace
}  // namespace bl::desktop
