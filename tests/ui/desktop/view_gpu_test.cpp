// The graphics processor's wrapped cells against those of the processor, corner by corner, and what sending them costs.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/power_cells.h"
#include "core/geometry/site_domain.h"
#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/gl_tools.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {
namespace {

class ViewGpu : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(gl_.is_there()) << gl_.failure() << "; `./bl setup` installs Mesa's software driver";
    std::string failure;
    renderer_ = GlRenderer::make(failure);
    ASSERT_NE(renderer_, nullptr) << failure;
  }

  // The largest distance between corners of the same triangles, as a share of the cell's size.
  double worst_of(const geometry::CellMeasure& cell, int depth) {
    ViewScene scene;
    scene.volumes = listed({{0, cell.mesh->coarse, 0, 0, 3, 0}});
    const std::vector<float> ours = renderer_->divided(scene, depth);
    const Mesh& theirs = *cell.mesh;
    const Point3& ball = cell.mesh->coarse->wrap->ball_centre;
    EXPECT_GE(ours.size(), 9 * theirs.triangles.size());
    double size = 0, worst = 0;
    for (const Point3& vertex : theirs.vertices) size = std::max(size, distance(vertex, theirs.vertices[0]));
    for (std::size_t t = 0; t < theirs.triangles.size() && 9 * t + 8 < ours.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const float* at = &ours[9 * t + 3 * i];
        const Point3 here{at[0] + ball.x, at[1] + ball.y, at[2] + ball.z};
        worst = std::max(worst, distance(here, theirs.vertices[theirs.triangles[t][i]]));
      }
    return worst / size;
  }

  // The number of cells with seams between pieces.
  std::size_t compare(const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites) {
    std::size_t seamed = 0;
    double worst = 0;
    for (int depth = 0; depth <= 4; ++depth) {
      geometry::CellOptions options;
      options.with_coarse_mesh = true;
      options.tessellation_depth = depth;
      const auto cells = power_cells(domain, sites, options);
      EXPECT_TRUE(cells.ok());
      std::size_t compared = 0;
      for (const geometry::CellMeasure& cell : *cells) {
        if (!cell.mesh) continue;
        worst = std::max(worst, worst_of(cell, depth));
        for (const MeshWrap::Part& part : cell.mesh->coarse->wrap->parts) seamed += part.seams.empty() ? 0 : 1;
        ++compared;
      }
      EXPECT_GT(compared, 2u);
      EXPECT_LT(worst, 1e-4) << "depth " << depth;
    }
    RecordProperty("worst", std::to_string(worst));
    std::printf("largest distance: %.2g of the cell's size\n", worst);
    return seamed;
  }

  OffscreenGl gl_;
  std::unique_ptr<GlRenderer> renderer_;
};

std::vector<geometry::PowerSite> some_sites(double width, double height, std::size_t count) {
  std::vector<geometry::PowerSite> sites;
  Random random(7);
  const auto number = [&] { return random.uniform(); };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = width * number(), y = width * number(), z = height * number(), radius = 6 + 12 * number();
    sites.push_back({{x, y, z}, radius * radius});
  }
  return sites;
}

TEST_F(ViewGpu, ATargetThatCannotBeMadeIsNone) {
  GlTarget target({{GL_RGBA8, GL_NEAREST}}, 0);
  ASSERT_TRUE(target.resize(16, 16));
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(target.resize(1 << 20, 1 << 20)) << "asked for the same size again, it is no better, time " << k;
    EXPECT_EQ(target.width(), 0);
  }
  while (glGetError() != GL_NO_ERROR) {}
  EXPECT_TRUE(target.resize(16, 16));
}

TEST_F(ViewGpu, WrapsAsTheProcessorDoes) {
  const Result<geometry::Domain> box =
      geometry::site_domain({{{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {0, 60, 0}}, {}, 0, 30, {}, {}});
  ASSERT_TRUE(box.ok());
  compare(*box, some_sites(60, 30, 14));
}

TEST_F(ViewGpu, WrapsCellsInSeveralPiecesWithoutAGap) {
  // An L: cells at its inner corner reach into two pieces of it.
  const Result<geometry::Domain> angle =
      geometry::site_domain({{{0, 0, 0}, {60, 0, 0}, {60, 25, 0}, {25, 25, 0}, {25, 60, 0}, {0, 60, 0}}, {}, 0, 20, {}, {}});
  ASSERT_TRUE(angle.ok());
  ASSERT_GT(angle->pieces.size(), 1u);
  EXPECT_GT(compare(*angle, {{{24, 24, 8}, 300}, {{10, 45, 10}, 160}, {{45, 12, 9}, 200}, {{8, 8, 10}, 90}, {{27, 20, 4}, 60}}),
            0u);
}

TEST_F(ViewGpu, WrapsFarFromTheOrigin) {
  const double far = 450000;
  const Result<geometry::Domain> box = geometry::site_domain(
      {{{far, far, 0}, {far + 60, far, 0}, {far + 60, far + 60, 0}, {far, far + 60, 0}}, {}, 0, 30, {}, {}});
  ASSERT_TRUE(box.ok());
  std::vector<geometry::PowerSite> sites = some_sites(60, 30, 6);
  for (geometry::PowerSite& site : sites) site.position += Vector3{far, far, 0};
  compare(*box, sites);
}

TEST_F(ViewGpu, SendsOnlyWhatHasChanged) {
  ViewScene scene;
  std::vector<ViewVolume> volumes;
  for (int k = 0; k < 20; ++k)
    volumes.push_back({static_cast<std::uint32_t>(k), ball_cell({30.0 * k, 0, 0}, 10), 0xff8080c0u, 0, 3, 0});
  scene.volumes = listed(volumes);
  scene.centre = {300, 0, 0};
  scene.radius = 320;
  (void)renderer_->take_bytes_sent();
  renderer_->draw(scene, 200, 120);
  const std::uint64_t all = renderer_->take_bytes_sent();
  EXPECT_GT(all, 20u * 200);
  renderer_->draw(scene, 200, 120);
  EXPECT_EQ(renderer_->take_bytes_sent(), 0u);
  scene.camera.azimuth += 0.3;
  renderer_->draw(scene, 200, 120);
  EXPECT_EQ(renderer_->take_bytes_sent(), 0u) << "a camera that turns sends nothing";
  volumes[3].cell = ball_cell({90, 5, 0}, 11);
  scene.volumes = listed(volumes);
  (void)renderer_->take_bytes_spared();
  renderer_->draw(scene, 200, 120);
  const std::uint64_t one = renderer_->take_bytes_sent();
  EXPECT_GT(one, 0u);
  EXPECT_LT(one, all / 15);
  EXPECT_GT(renderer_->take_bytes_spared(), one);
}

TEST_F(ViewGpu, DrawsVolumesWhereTheyStand) {
  ViewScene scene;
  scene.volumes = listed({{0, ball_cell({0, 0, 10}, 10), 0xff3030e0u, 0, 3, 0}});
  scene.centre = {0, 0, 8};
  scene.radius = 30;
  scene.colours.sky = 0xff302010u;
  scene.colours.ground = 0xff405040u;
  scene.camera.fit({0, 0, 10}, 20, 1);
  ASSERT_NE(renderer_->draw(scene, 128, 128), 0u);
  const std::vector<std::uint8_t> pixels = renderer_->pixels();
  const auto at = [&](int x, int y) {
    return &pixels[4 *
                   (static_cast<std::size_t>(y) * static_cast<std::size_t>(renderer_->width()) + static_cast<std::size_t>(x))];
  };
  const int w = renderer_->width(), h = renderer_->height();
  EXPECT_GT(at(w / 2, h / 2)[0], at(w / 2, h / 2)[2] + 40) << "the middle is red";
  EXPECT_LT(at(2, h - 3)[0], 90) << "a corner is not";
}

// Around what is chosen there is an outline, and nobody is chosen here: numbers of volumes have room beside the flags.
TEST_F(ViewGpu, OutlinesNobodyElseAmongManyVolumes) {
  ViewScene scene;
  std::vector<ViewVolume> volumes(20000, {0, ball_cell({0, 0, 10}, 5), 0xff3030e0u, 0, 0, ViewVolume::plain});
  for (std::uint32_t k = 0; k < volumes.size(); ++k) volumes[k].node = k;
  volumes.back().cell = ball_cell({0, 0, 10}, 10);
  scene.colours.chosen = scene.colours.hovered = 0xff00ff00u;
  scene.camera.fit({0, 0, 10}, 20, 1);
  const auto outlined = [&] {
    scene.volumes = listed(volumes);
    EXPECT_NE(renderer_->draw(scene, 64, 64), 0u);
    const std::vector<std::uint8_t> pixels = renderer_->pixels();
    int count = 0;
    for (std::size_t k = 0; k + 3 < pixels.size(); k += 4) count += pixels[k + 1] > pixels[k] + 100 ? 1 : 0;
    return count;
  };
  EXPECT_EQ(outlined(), 0);
  volumes.back().flags |= ViewVolume::chosen;
  EXPECT_GT(outlined(), 20);
}

// Two wide, translucent lines that go on as each other, seen from above: what the picture has at the place of the bend.
TEST_F(ViewGpu, FillsTheCornersOfLinesAndPaintsThemOnce) {
  ViewScene scene;
  scene.radius = 30;
  scene.colours.sky = scene.colours.ground = 0xff000000u;
  scene.layers.ground = false;
  scene.camera = {{0, 0, 0}, 0, 1.5707, 60, true};
  const Point3 corner{0, 0, 0.1};
  scene.lines = {{{-10, 0, 0.1}, corner, 0x80ffffffu, 16, 0}, {corner, {0, 10, 0.1}, 0x80ffffffu, 16, 0}};
  const auto brightness = [&](double x, double y) {
    EXPECT_NE(renderer_->draw(scene, 200, 200), 0u);
    const std::vector<std::uint8_t> pixels = renderer_->pixels();
    const Seen at = scene.camera.project({x, y, 0.1}, renderer_->width(), renderer_->height());
    const int pixel = (renderer_->height() - 1 - static_cast<int>(at.y)) * renderer_->width() + static_cast<int>(at.x);
    return static_cast<int>(pixels[4 * static_cast<std::size_t>(pixel)]);
  };
  const double half = 5 * scene.camera.metres_per_pixel(corner, 200);
  const int plain = brightness(-5, 0), outside = brightness(half, -half), inside = brightness(-half, half);
  EXPECT_GT(plain, 60);
  EXPECT_LT(outside, plain / 4) << "without neighbours there is a gap";
  EXPECT_GT(inside, plain + 20) << "and a place that is painted twice";
  scene.lines[0].goes = {0, 10, 0};
  scene.lines[1].came = {10, 0, 0};
  EXPECT_NEAR(brightness(-5, 0), plain, 2);
  EXPECT_NEAR(brightness(half, -half), plain, 6);
  EXPECT_NEAR(brightness(-half, half), plain, 6);
}

TEST_F(ViewGpu, SurvivesEmptyAndBrokenScenes) {
  ViewScene scene;
  EXPECT_EQ(renderer_->draw(scene, 0, 10), 0u);
  EXPECT_NE(renderer_->draw(scene, 16, 16), 0u);
  const double bad = std::nan("");
  scene.volumes = listed({{0, ball_cell({bad, 0, 0}, 1), 0, 0, 0, 0}});
  scene.lines.push_back({{bad, 0, 0}, {1, 1, 1}, 0xffffffffu, 2, 0});
  scene.camera.target = {bad, bad, bad};
  scene.camera.limit();
  EXPECT_NE(renderer_->draw(scene, 16, 16), 0u);
}

}  // namespace
}  // namespace bl::desktop
