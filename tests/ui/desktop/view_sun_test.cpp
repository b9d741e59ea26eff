// The sun's time in the 3D view: a preview that leaves the scene alone, the way into the scene, and what the sun casts.
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/reading/views/sun.h"
#include "core/sun/shadow_shape.h"
#include "core/sun/solar_position.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/urban_picture.h"

namespace bl::desktop {
namespace {

constexpr double kNoon = 43200;

class ViewSun : public ::testing::Test {
 protected:
  void SetUp() override { desktop.ticks(30); }
  Workbench& editor() { return desktop.editor(); }
  SceneView& view() { return *editor().view; }
  const std::string& day() { return std::get<std::string>(value_in(editor().state(), sun().id, "sun_and_sky.day")); }
  const SunFacts& sun() { return view().facts()->urban.suns.front(); }
  ImVec2 track_at(double seconds) {
    const ImVec4 track = view().sun_track();
    return {track.x + static_cast<float>(seconds / 86400) * (track.z - track.x), (track.y + track.w) / 2};
  }
  void show(const char* layer) {
    set_layer(editor().person, layer, true);
    desktop.frames(1);
  }
  std::size_t steps() { return editor().document->history().size(); }

  NullDesktop desktop{"scenes/studies/urban_mode.json"};
};

TEST_F(ViewSun, ReadsTheNodeAsTheNodeReadsItself) {
  for (const char* rule : {"none", "europe", "north_america", "australia"}) {
    ASSERT_TRUE(editor().submit(command<SetPort>({"sun", {"sun_and_sky.daylight_saving"}, {std::string("\"") + rule + "\""}})));
    for (const char* date : {"2026-01-15", "2026-07-15"}) {
      ASSERT_TRUE(editor().submit(command<SetPort>({"sun", {"sun_and_sky.date"}, {std::string("\"") + date + "\""}})));
      ASSERT_TRUE(editor().submit(command<SetPort>({"sun", {"sun_and_sky.days"}, {"2.7"}})));
      EXPECT_FALSE((desktop.frames(1), sun().is_ahead)) << "while the clock stands, the node is asked at once";
      desktop.ticks(1);
      EXPECT_FALSE(sun().is_ahead);
      EXPECT_EQ(sun().toward, reading::read<&reading::SunFigures::direction>(editor().state(), sun().node))
          << rule << " " << date;
      EXPECT_EQ(sun::date_text(sun().clock.day), day());
    }
  }
}

TEST_F(ViewSun, PullingAlongTheTrackPreviewsAndLeavesTheSceneAlone) {
  const std::string before = desktop.scene_text();
  ASSERT_GT(view().sun_track().z, view().sun_track().x + 200);
  EXPECT_EQ(view().sun_words(), "12:00, the scene's time");
  desktop.drag(track_at(kNoon), track_at(15 * 3600 + 40 * 60));
  ASSERT_TRUE(view().preview());
  EXPECT_NEAR(view().preview()->seconds, 15 * 3600 + 40 * 60, 301);
  EXPECT_EQ(std::fmod(view().preview()->seconds, 300), 0) << "whole five minutes";
  view().preview_sun({sun().clock.day, 15 * 3600 + 40 * 60});
  desktop.frames(1);
  EXPECT_EQ(view().sun_words(), "15:40, preview; scene: 12:00");
  const sun::SunPosition there = sun_position(sun().place, moment_of(sun().place, sun().clock.day, 15 * 3600 + 40 * 60));
  EXPECT_EQ(view().choices().sun.toward, scene_direction(sun().place, there.azimuth, there.altitude));
  EXPECT_TRUE(view().choices().sun.is_preview);
  const ViewScene scene = build_view(*view().facts(), {}, view().choices(), {}, editor().person, editor().theme);
  EXPECT_NEAR(distance(scene.sun, view().choices().sun.toward), 0, 1e-9) << "the renderer's shadows follow";
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_EQ(steps(), 0u);
  desktop.ticks(3);
  EXPECT_TRUE(view().preview()) << "ticks go on under it";
}

TEST_F(ViewSun, EscapeAndDoubleClickGoBackToTheScenesMoment) {
  desktop.move_to({track_at(kNoon).x, view().sun_track().y - 150});
  desktop.key(GLFW_KEY_RIGHT, false, false, true);
  ASSERT_TRUE(view().preview());
  EXPECT_EQ(view().preview()->seconds, kNoon + 1800);
  desktop.key(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(view().preview());
  EXPECT_EQ(view().choices().sun.toward, sun().toward);
  desktop.drag(track_at(kNoon), track_at(9 * 3600));
  ASSERT_TRUE(view().preview());
  desktop.frames(40);
  desktop.double_click(track_at(9 * 3600));
  EXPECT_FALSE(view().preview());
  EXPECT_EQ(steps(), 0u);
}

TEST_F(ViewSun, OneButtonMakesItTheScenesMomentAsOneStep) {
  const std::string before = desktop.scene_text();
  view().preview_sun({sun().clock.day + 92, 16 * 3600});
  desktop.frames(2);
  const Vector3 shown = view().choices().sun.toward;
  const ImVec4 button = view().sun_button();
  ASSERT_GT(button.z, button.x);
  EXPECT_EQ(view().sun_words(), "21 Jun 16:00, preview; scene: 21 Mar 12:00");
  desktop.click({(button.x + button.z) / 2, (button.y + button.w) / 2});
  EXPECT_FALSE(view().preview());
  EXPECT_EQ(steps(), 1u);
  EXPECT_EQ(sun().clock.seconds, 16 * 3600);
  EXPECT_EQ(sun::date_text(sun().clock.day), "2026-06-21");
  EXPECT_EQ(view().choices().sun.toward, shown) << "nothing jumps, though the clock stands";
  desktop.ticks(1);
  EXPECT_EQ(day(), "2026-06-21");
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(ViewSun, DaysThatTheNodeAddsAreMinded) {
  ASSERT_TRUE(editor().submit(command<SetPort>({"sun", {"sun_and_sky.days"}, {"10.5"}})));
  desktop.ticks(1);
  const sun::DayNumber wanted = sun().clock.day + 1;
  view().step_sun(0, 1);
  view().set_sun_in_scene();
  desktop.ticks(1);
  EXPECT_EQ(day(), sun::date_text(wanted));
}

TEST_F(ViewSun, StepsGoOverMidnightAndStayInTheYears) {
  view().preview_sun({sun().clock.day, 23 * 3600 + 1800});
  view().step_sun(3600, 0);
  EXPECT_EQ(view().preview()->seconds, 1800);
  EXPECT_EQ(view().preview()->day, sun().clock.day + 1);
  view().step_sun(0, 10000000);
  EXPECT_EQ(sun::date_text(view().preview()->day), "2100-12-31");
}

TEST_F(ViewSun, ByNightNothingIsCast) {
  show("shade_bodies");
  show("shadow_outlines");
  EXPECT_FALSE(view().choices().sun.bodies.empty());
  view().preview_sun({sun().clock.day, 3600});
  desktop.frames(1);
  EXPECT_LT(view().choices().sun.toward.z, 0);
  EXPECT_TRUE(view().choices().sun.bodies.empty());
  EXPECT_TRUE(view().choices().sun.outlines.empty());
  const ViewScene scene = build_view(*view().facts(), {}, view().choices(), {}, editor().person, editor().theme);
  EXPECT_FALSE(scene.layers.shadows);
  EXPECT_GT(scene.sun.z, 0) << "a light to see the model by";
}

TEST_F(ViewSun, RunsThroughTheDayByItself) {
  view().toggle_sun_run();
  desktop.frames(30);
  ASSERT_TRUE(view().preview());
  const double began = view().preview()->seconds;
  EXPECT_GT(began, kNoon);
  desktop.frames(60 * 30);
  const sun::SunDay day = sun_day(sun().place, view().preview()->day);
  EXPECT_GE(view().preview()->seconds, *day.sunrise);
  EXPECT_LE(view().preview()->seconds, *day.sunset);
  view().end_preview();
  EXPECT_FALSE(view().is_sun_running());
}

TEST_F(ViewSun, OutlinesOfAPreviewAreThoseOfItsSun) {
  show("shadow_outlines");
  EXPECT_TRUE(view().choices().sun.outlines.empty()) << "those of the scene are the study's";
  view().preview_sun({sun().clock.day, 16 * 3600});
  desktop.frames(1);
  const SunLook& look = view().choices().sun;
  const auto& casters = view().facts()->urban.casters;
  ASSERT_EQ(look.outlines.size(), casters.size());
  for (std::size_t k = 0; k < casters.size(); ++k)
    EXPECT_EQ(look.outlines[k].ring, sun::shadow_outline(*casters[k].mesh, look.toward, casters[k].ground)) << casters[k].id;
}

TEST_F(ViewSun, WhatIsOlderThanTheStateSaysSo) {
  show("shadow_outlines");
  SceneFacts facts = *view().facts();
  const auto text = [&] {
    std::string all;
    for (const Legend& legend : urban_legends(facts, view().choices(), editor().theme, [](const char*) { return true; })) {
      all += legend.title + "\n";
      for (const Legend::Row& row : legend.rows) all += row.label + "\n";
    }
    return all;
  };
  facts.urban.sun_age = 3;
  EXPECT_NE(text().find("Outlines on the ground at 12:00 (tentative: 3 ticks old)"), std::string::npos) << text();
  facts.urban.sun_age = 0;
  EXPECT_EQ(text().find("tentative"), std::string::npos) << text();
  facts.urban.suns.front().is_ahead = true;
  EXPECT_NE(text().find("tentative: of an earlier sun"), std::string::npos) << text();
  view().preview_sun({sun().clock.day, 16 * 3600});
  desktop.frames(1);
  EXPECT_NE(text().find("Outlines on the ground at 16:00 (preview)"), std::string::npos) << text();
  EXPECT_NE(text().find("Direct sun per day, of the scene's days"), std::string::npos) << "maps do not follow a preview";
}

TEST_F(ViewSun, BodiesOfShadeAreOfTheChosenCastersElseOfAll) {
  EXPECT_TRUE(view().choices().sun.bodies.empty()) << "off at first";
  show("shade_bodies");
  EXPECT_EQ(view().choices().sun.bodies.size(), view().facts()->urban.casters.size());
  EXPECT_GT(view().choices().sun.bodies.size(), 10u) << "volumes and existing buildings";
  editor().picks.only_node("offices");
  desktop.frames(1);
  ASSERT_EQ(view().choices().sun.bodies.size(), 1u);
  EXPECT_EQ(view().choices().sun.bodies[0].id, "offices");
  ASSERT_TRUE(editor().submit(command<SetPort>({"offices", {"shadow_caster.casts"}, {"false"}})));
  desktop.frames(1);
  EXPECT_GT(view().choices().sun.bodies.size(), 10u) << "a caster that does not cast is none";
}

TEST_F(ViewSun, WallsOfShadeStandAlongTheRaysAndAreMadeOnce) {
  show("shade_bodies");
  const SunLook before = view().choices().sun;
  for (const ShadeBody& body : before.bodies) {
    ASSERT_FALSE(body.walls->triangles.empty()) << body.id;
    for (const auto& t : body.walls->triangles) {
      const Point3 &a = body.walls->vertices[t[0]], &b = body.walls->vertices[t[1]], &c = body.walls->vertices[t[2]];
      const Vector3 normal = cross(b - a, c - a);
      EXPECT_LT(dot(normal, before.toward), 1e-5 * norm(normal)) << body.id;
    }
  }
  desktop.frames(1);
  for (std::size_t k = 0; k < before.bodies.size(); ++k)
    EXPECT_EQ(view().choices().sun.bodies[k].walls, before.bodies[k].walls) << "the same mesh: nothing is sent again";
  const auto began = std::chrono::steady_clock::now();
  ShadeStore store;
  const auto made = store.bodies(view().facts()->urban.casters, view().choices().sun.toward);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::size_t triangles = 0;
  for (const CasterFacts& caster : view().facts()->urban.casters) triangles += caster.mesh->triangles.size();
  std::printf("%zu bodies of shade from %zu triangles: %.1f ms\n", made.size(), triangles, 1000 * seconds);
}

TEST(ViewSunless, ASceneWithoutASunHasNoTrack) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(2);
  SceneView& view = *desktop.editor().view;
  EXPECT_FALSE(view.has_sun());
  EXPECT_EQ(view.sun_track().z, 0);
  view.step_sun(1800, 1);
  view.set_sun_in_scene();
  EXPECT_FALSE(view.preview());
  EXPECT_FALSE(view.choices().sun.is_there);
}

}  // namespace
}  // namespace bl::desktop
