// Façades in the picture: windows on the walls that a style dresses, none elsewhere, and nothing that is sent twice for them.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>
#include <imgui.h>

#include "tests/support/world.h"
#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/view_builder.h"

namespace bl::desktop {
namespace {

class ViewFacade : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(gl_.is_there()) << gl_.failure() << "; `./bl setup` installs Mesa's software driver";
    std::string failure;
    renderer_ = GlRenderer::make(failure);
    ASSERT_NE(renderer_, nullptr) << failure;
    context_ = ImGui::CreateContext();
    theme_.apply(false, 1);
  }

  void TearDown() override {
    if (context_ != nullptr) ImGui::DestroyContext(context_);
  }

  ViewScene view_of(World& world, double azimuth = -0.9) {
    facts_ = read_facts(world.session().state(), facts_.get());
    ViewChoices choices;
    choices.camera.azimuth = azimuth;
    choices.camera.elevation = 0.35;
    choices.camera.fit({facts_->centre.x, facts_->centre.y, facts_->centre.z - 3}, 0.8 * facts_->radius, 4.0 / 3);
    return build_view(*facts_, colour_volumes(*facts_, "use", theme_), choices, {}, person_, theme_);
  }

  // BL_PICTURES names a folder for those who want to look.
  void keep(const char* name) const {
    const char* folder = std::getenv("BL_PICTURES");
    if (folder == nullptr) return;
    const std::vector<std::uint8_t> pixels = renderer_->pixels();
    std::FILE* file = std::fopen((std::string(folder) + "/" + name + ".ppm").c_str(), "wb");
    if (file == nullptr) return;
    const int w = renderer_->width(), h = renderer_->height();
    std::fprintf(file, "P6\n%d %d\n255\n", w, h);
    for (int y = h - 1; y >= 0; --y)
      for (int x = 0; x < w; ++x) std::fwrite(&pixels[4 * (static_cast<std::size_t>(y) * w + x)], 1, 3, file);
    std::fclose(file);
  }

  // Pixels that are others than in the picture before.
  std::size_t changed(const std::vector<std::uint8_t>& before) const {
    const std::vector<std::uint8_t> after = renderer_->pixels();
    std::size_t count = 0;
    for (std::size_t k = 0; k + 3 < after.size(); k += 4)
      count += std::abs(after[k] - before[k]) + std::abs(after[k + 1] - before[k + 1]) + std::abs(after[k + 2] - before[k + 2]) > 24;
    return count;
  }

  ImGuiContext* context_ = nullptr;
  OffscreenGl gl_;
  std::unique_ptr<GlRenderer> renderer_;
  std::shared_ptr<const SceneFacts> facts_;
  PersonSettings person_;
  Theme theme_;
};

TEST_F(ViewFacade, WindowsStandOnDressedWalls) {
  World world = World::from_file("scenes/nodes/facade_style.json");
  ASSERT_TRUE(world.settle());
  const ViewScene dressed = view_of(world);
  ASSERT_TRUE(std::any_of(dressed.volumes.begin(), dressed.volumes.end(),
                          [](const ViewVolume& v) { return (v.flags & ViewVolume::dressed) != 0; }));
  ASSERT_NE(renderer_->draw(dressed, 1200, 900), 0u);
  keep("facade");
  const std::vector<std::uint8_t> with = renderer_->pixels();
  set_layer(person_, "facades", false);
  ASSERT_NE(renderer_->draw(view_of(world), 1200, 900), 0u);
  keep("facade_off");
  EXPECT_GT(changed(with), with.size() / 4 / 20) << "a twentieth of the picture is windows";
  set_layer(person_, "facades", true);
  ASSERT_NE(renderer_->draw(view_of(world), 1200, 900), 0u);
  EXPECT_EQ(renderer_->pixels(), with) << "and the same again";
}

TEST_F(ViewFacade, ATurnedCameraSendsNothing) {
  World world = World::from_file("scenes/nodes/facade_style.json");
  ASSERT_TRUE(world.settle());
  renderer_->draw(view_of(world), 400, 300);
  (void)renderer_->take_bytes_sent();
  renderer_->draw(view_of(world, 0.6), 400, 300);
  EXPECT_EQ(renderer_->take_bytes_sent(), 0u);
}

}  // namespace
}  // namespace bl::desktop
