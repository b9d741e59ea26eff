// What a tick of whole scenes sends to the graphics processor, against what finished meshes would have taken; and how long it
// takes.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"
#include "tests/ui/desktop/offscreen_gl.h"
#include "ui/desktop/view/gl_renderer.h"
#include "ui/desktop/view/view_builder.h"

namespace bl::desktop {
namespace {

struct Traffic {
  double sent = 0, spared = 0, draw = 0, orbit = 0;  // per tick: bytes, and milliseconds of a picture
  int depth = 0;
};

double milliseconds_of(GlRenderer& renderer, const ViewScene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  renderer.draw(scene, 900, 700);
  (void)renderer.pixels();  // waits until it is done
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

Traffic measure(const std::string& path, int ticks) {
  Traffic traffic;
  NullDesktop desktop(path);
  std::string failure;
  const auto renderer = GlRenderer::make(failure);
  if (!renderer) {
    ADD_FAILURE() << failure;
    return traffic;
  }
  Workbench& editor = desktop.editor();
  std::shared_ptr<const SceneFacts> facts;
  ViewChoices choices;
  for (int k = -2; k < ticks; ++k) {
    desktop.ticks(1);
    facts = read_facts(editor.moment->state, facts.get());
    choices.camera.fit(facts->centre, facts->radius, 900.0 / 700);
    const Colouring colouring = colour_volumes(*facts, "use", editor.theme);
    ViewScene scene = build_view(*facts, colouring, choices, editor.picks, editor.person, editor.theme);
    scene.is_hurried = true;
    const double drawn = milliseconds_of(*renderer, scene);
    const auto sent = static_cast<double>(renderer->take_bytes_sent()),
               spared = static_cast<double>(renderer->take_bytes_spared());
    scene.camera.azimuth += 0.1;
    const double turned = milliseconds_of(*renderer, scene);
    if (k < 0) continue;  // the first pictures send everything
    traffic.sent += sent / ticks;
    traffic.spared += spared / ticks;
    traffic.draw += drawn / ticks;
    traffic.orbit += turned / ticks;
  }
  traffic.depth = renderer->depth();
  std::printf(
      "%s: %.0f bytes a tick, %.0f as meshes of depth %d (%.1f times); picture %.1f ms after a tick, %.1f ms while orbiting "
      "(%s)\n",
      path.c_str(), traffic.sent, traffic.spared, traffic.depth, traffic.spared / std::max(1.0, traffic.sent), traffic.draw,
      traffic.orbit, renderer->description().c_str());
  return traffic;
}

TEST(ViewTraffic, CoarseCellsTakeAFractionOfMeshes) {
  const OffscreenGl gl;
  ASSERT_TRUE(gl.is_there()) << gl.failure() << "; `./bl setup` installs Mesa's software driver";
  const Traffic quarter = measure("scenes/start/quarter.json", 12);
  EXPECT_LT(quarter.sent, 0.5 * quarter.spared);
  const Traffic sixty = measure("scenes/studies/sixty_volumes.json", 12);
  EXPECT_LT(sixty.sent, sixty.spared);
  // Only when asked for: its ticks take long.
  if (std::getenv("BL_LARGE_SCENES") != nullptr) (void)measure("scenes/studies/thousand_volumes.json", 4);
}

}  // namespace
}  // namespace bl::desktop
