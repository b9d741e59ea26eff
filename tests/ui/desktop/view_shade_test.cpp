// Bodies of shade in the picture: translucent, each pixel once, hidden by what stands before them, and lines on the right side.
#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {
namespace {

class ViewShade : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(gl_.is_there()) << gl_.failure() << "; `./bl setup` installs Mesa's software driver";
    std::string failure;
    renderer_ = GlRenderer::make(failure);
    ASSERT_NE(renderer_, nullptr) << failure;
    scene_.centre = {0, 0, 5};
    scene_.radius = 40;
    scene_.colours.sky = scene_.colours.ground = scene_.colours.grid = 0xff808080u;
    scene_.layers = {false, false, false, true};
    scene_.camera.target = {0, 0, 5};
    scene_.camera.elevation = 0.5;
    scene_.camera.distance = 120;
  }
  static MeshPointer box(const Point3& low, const Point3& high) {
    Mesh mesh;
    for (int k = 0; k < 8; ++k)
      mesh.vertices.push_back({(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return std::make_shared<const Mesh>(std::move(mesh));
  }
  std::vector<std::uint8_t> drawn() {
    EXPECT_NE(renderer_->draw(scene_, 320, 240), 0u);
    return renderer_->pixels();
  }
  static std::size_t differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    std::size_t count = 0;
    for (std::size_t k = 0; k + 3 < a.size(); k += 4)
      count += std::abs(a[k] - b[k]) + std::abs(a[k + 1] - b[k + 1]) + std::abs(a[k + 2] - b[k + 2]) > 3 ? 1 : 0;
    return count;
  }

  OffscreenGl gl_;
  std::unique_ptr<GlRenderer> renderer_;
  ViewScene scene_;
  static constexpr Colour kShade = 0x80301810u;
};

TEST_F(ViewShade, IsTranslucentAndNoOrderOfDrawingIsSeen) {
  const auto without = drawn();
  scene_.bodies = {{box({-10, -10, 0}, {10, 10, 10}), kShade},
                   {box({-5, -15, 0}, {15, 5, 8}), kShade},
                   {box({-10, -10, 0}, {10, 10, 10}), kShade}};
  const auto with = drawn();
  EXPECT_GT(differing(with, without), 1000u);
  std::swap(scene_.bodies[0], scene_.bodies[1]);
  EXPECT_EQ(differing(drawn(), with), 0u);
  scene_.bodies.pop_back();
  EXPECT_EQ(differing(drawn(), with), 0u) << "shade on the same shade is no darker";
  scene_.bodies.clear();
  EXPECT_EQ(differing(drawn(), without), 0u);
}

TEST_F(ViewShade, IsHiddenByVolumesThatStandBeforeIt) {
  scene_.volumes = listed({{0, ball_cell({0, 0, 10}, 20), 0xff8080c0u, 0, 0, 0}});
  const auto without = drawn();
  scene_.bodies = {{box({-3, -3, 7}, {3, 3, 13}), kShade}};
  EXPECT_EQ(differing(drawn(), without), 0u) << "inside the ball";
}

TEST_F(ViewShade, ThinLinesDoNotShineThroughWhatStandsBeforeThem) {
  scene_.layers.ground = false;
  scene_.volumes = listed({{0, ball_cell({0, 0, 5}, 4), 0xff8080c0u, 0, 0, 0}});
  const auto without = drawn();
  const Point3 behind = Point3{0, 0, 5} + 5.0 * scene_.camera.forward();
  scene_.lines = {{behind - 2.0 * scene_.camera.right(), behind + 2.0 * scene_.camera.right(), 0xffffffffu, 1, 0}};
  EXPECT_EQ(differing(drawn(), without), 0u);
}

TEST_F(ViewShade, LinesBeforeItAreClearAndLinesBehindItAreDimmed) {
  const auto line_at = [&](const Vector3& shift) {
    const Point3 middle = Point3{0, 0, 5} + shift;
    const Vector3 along = 4.0 * scene_.camera.right();
    scene_.lines = {{middle - along, middle + along, 0xffffffffu, 4, 0}};
    const auto pixels = drawn();
    const std::size_t w = static_cast<std::size_t>(renderer_->width()), h = static_cast<std::size_t>(renderer_->height());
    return static_cast<int>(pixels[4 * (h / 2 * w + w / 2)]);
  };
  scene_.layers.ground = false;
  scene_.bodies = {{box({-10, -10, -10}, {10, 10, 20}), kShade}};
  const int before = line_at(-30.0 * scene_.camera.forward()), behind = line_at(30.0 * scene_.camera.forward());
  EXPECT_GT(before, 245);
  EXPECT_LT(behind, 200);
  EXPECT_GT(behind, 60) << "seen through it";
}

}  // namespace
}  // namespace bl::desktop
