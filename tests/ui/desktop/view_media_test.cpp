// Pictures in the 3D view: turned as cameras say, veiled without consent, a frame where the file is missing.
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/document/media_place.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/view_builder.h"

namespace bl::desktop {
namespace {

const std::string kMediaFolder = test::source_folder() + "/scenes/media/";

TEST(MediaPlace, StandsAsItIsTold) {
  const MediaPlace ground = place_of({"ground", {10, 20, 0}, 90, 0, 8, 4, 1});
  EXPECT_LT(distance(ground.corner + 0.5 * (ground.across + ground.up), {10, 20, 0}), 1e-12);
  EXPECT_LT(distance(ground.up, {4, 0, 0}), 1e-12) << "its upper edge lies in the east";
  const MediaPlace board = place_of({"billboard", {0, 0, 1}, 180, 0, 6, 3, 1});
  EXPECT_LT(distance(board.corner, {-3, 0, 1}), 1e-12) << "who looks north sees its left in the west";
  const MediaPlace seen = place_of({"camera", {0, 0, 2}, 0, 90, 6, 3, 10});
  EXPECT_LT(distance(seen.corner + 0.5 * (seen.across + seen.up), {0, 0, 12}), 1e-9) << "straight up";
}

TEST(MediaPlace, SequencesCountFromOneAgainAndAgain) {
  EXPECT_EQ(frame_file("a.png", 99, 1, 5), "a.png");
  EXPECT_EQ(frame_file("walk_###.png", 0, 10, 4), "walk_001.png");
  EXPECT_EQ(frame_file("walk_###.png", 9, 10, 4), "walk_004.png");
  EXPECT_EQ(frame_file("walk_###.png", 12, 10, 4), "walk_001.png");
  EXPECT_EQ(frame_file("#.jpg", 30 * 11, 1, 100), "12.jpg");
}

class ViewMedia : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(gl_.is_there()) << gl_.failure() << "; `./bl setup` installs Mesa's software driver";
    std::string failure;
    renderer_ = GlRenderer::make(failure);
    ASSERT_NE(renderer_, nullptr) << failure;
    scene_.colours.sky = 0xffffffffu;
    scene_.colours.ground = 0xffc0c0c0u;
    scene_.colours.edge = 0xff202020u;
    scene_.layers.ground = false;
    scene_.centre = {0, 0, 5};
    scene_.radius = 12;
    // Level, from the south.
    scene_.camera.is_parallel = true;
    scene_.camera.azimuth = -1.5707963;
    scene_.camera.elevation = 0;
    scene_.camera.fit({0, 0, 5}, 6, 1.6);
  }

  void add(const std::string& file, int orientation, bool is_veiled = false) {
    ViewPicture& picture = scene_.pictures.emplace_back();
    picture.path = file;
    picture.corner = {-8, 0, 0};
    picture.across = {16, 0, 0};
    picture.up = {0, 0, 10};
    picture.orientation = orientation;
    picture.is_veiled = is_veiled;
  }

  std::vector<std::uint8_t> drawn() {
    renderer_->draw(scene_, 320, 200);
    renderer_->wait_for_pictures();
    EXPECT_NE(renderer_->draw(scene_, 320, 200), 0u);
    return renderer_->pixels();
  }

  static double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
    return sum / static_cast<double>(a.size());
  }

  OffscreenGl gl_;
  std::unique_ptr<GlRenderer> renderer_;
  ViewScene scene_;
};

TEST_F(ViewMedia, IsTurnedAsTheCameraSays) {
  const auto nothing = drawn();
  add(kMediaFolder + "houses.png", 1);
  const auto upright = drawn();
  scene_.pictures.clear();
  add(kMediaFolder + "houses_turned.png", 8);
  const auto turned = drawn();
  scene_.pictures[0].orientation = 6;
  const auto wrong = drawn();
  EXPECT_GT(difference(upright, nothing), 20);
  EXPECT_LT(difference(upright, turned), 2) << "the same drawing, stored on its side";
  EXPECT_GT(difference(upright, wrong), 20);
}

TEST_F(ViewMedia, WithoutConsentNothingIsRecognised) {
  add(kMediaFolder + "houses.png", 1);
  const auto open = drawn();
  scene_.pictures[0].is_veiled = true;
  const auto veiled = drawn();
  EXPECT_GT(difference(open, veiled), 15);
}

TEST_F(ViewMedia, AMissingFileIsAFrameAndSaysWhy) {
  const auto nothing = drawn();
  add(kMediaFolder + "lost.png", 1);
  EXPECT_GT(difference(drawn(), nothing), 5);
  EXPECT_NE(renderer_->why_missing(kMediaFolder + "lost.png"), "");
  add(test::source_folder() + "/README.md", 1);
  drawn();
  EXPECT_NE(renderer_->why_missing(test::source_folder() + "/README.md").find("no picture"), std::string::npos);
}

TEST_F(ViewMedia, SceneShowsItsPictures) {
  ImGuiContext* context = ImGui::CreateContext();
  World world = World::from_file("scenes/nodes/media.json");
  ASSERT_TRUE(world.settle());
  Theme theme;
  theme.apply(false, 1);
  const auto facts = read_facts(world.session().state(), nullptr);
  ASSERT_EQ(facts->media.size(), 5u);
  ViewChoices choices;
  choices.folder = test::source_folder() + "/scenes/nodes";
  choices.camera.azimuth = -1.75;
  choices.camera.elevation = 0.42;
  choices.camera.fit({2, 4, 5}, 24, 4.0 / 3);
  PersonSettings person;
  ViewScene view = build_view(*facts, colour_volumes(*facts, "use", theme), choices, {}, person, theme);
  ASSERT_EQ(view.pictures.size(), 5u);
  renderer_->draw(view, 1200, 900);
  renderer_->wait_for_pictures();
  renderer_->draw(view, 1200, 900);
  if (const char* folder = std::getenv("BL_PICTURES"); folder != nullptr) {
    const auto pixels = renderer_->pixels();
    std::FILE* file = std::fopen((std::string(folder) + "/media.ppm").c_str(), "wb");
    ASSERT_NE(file, nullptr);
    std::fprintf(file, "P6\n%d %d\n255\n", renderer_->width(), renderer_->height());
    for (int y = renderer_->height() - 1; y >= 0; --y)
      for (int x = 0; x < renderer_->width(); ++x)
        std::fwrite(&pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(renderer_->width()) +
                                 static_cast<std::size_t>(x))],
                    1, 3, file);
    std::fclose(file);
  }
  set_layer(person, "media", false);
  EXPECT_TRUE(build_view(*facts, colour_volumes(*facts, "use", theme), choices, {}, person, theme).pictures.empty());
  ImGui::DestroyContext(context);
}

}  // namespace
}  // namespace bl::desktop
