// What is drawn of a state that follows another one is what would be drawn of it by a window that has just seen it.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "core/base/random.h"
#include "tests/support/random_commands.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

// Chooses and points at something else now and then.
void pick_at_random(Picks& picks, const Scene& scene, Random& random) {
  const auto some = [&](const auto& records) {
    return records.empty() ? std::string()
                           : std::next(records.begin(), static_cast<std::ptrdiff_t>(random.below(records.size())))->first;
  };
  picks.clear();
  for (auto count = random.below(4); count > 0; --count) picks.nodes.insert(some(scene.nodes));
  if (random.below(2) == 0) picks.links.insert(some(scene.links));
  picks.hovered_node = random.below(2) == 0 ? some(scene.nodes) : "";
  picks.hovered_link = random.below(3) == 0 ? some(scene.links) : "";
}

class ViewFollows : public ::testing::TestWithParam<const char*> {};

TEST_P(ViewFollows, PicturesColoursAndLinesOfSightAreThoseMadeAnew) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  Random random(11);
  std::shared_ptr<const SceneFacts> facts;
  VolumePictures kept;
  std::map<std::string, ColourMemo> memos;
  Picks picks;
  std::size_t shared = 0;
  for (int step = 0; step < 60; ++step) {
    if (random.below(2) == 0) (void)editor.document->session().submit(random_command(editor.scene(), random, step));
    desktop.ticks(1);
    if (random.below(3) == 0) pick_at_random(picks, editor.scene(), random);
    for (const char* layer : {"facades", "buildings"})
      if (random.below(8) == 0) set_layer(editor.person, layer, !is_on(editor.person, layer));
    facts = read_facts(editor.moment->state, facts.get());
    Colouring colouring;
    for (const char* choice : {"error", "tension", "fill", "smart_volume.volume", "use"}) {
      colouring = memos[choice].of(facts, choice, editor.theme);
      const Colouring fresh = colour_volumes(*facts, choice, editor.theme);
      EXPECT_EQ(colouring.colours, fresh.colours) << choice;
      EXPECT_EQ(colouring.legend.title, fresh.legend.title) << choice;
      EXPECT_EQ(colouring.legend.rows.size(), fresh.legend.rows.size()) << choice;
    }
    const std::vector<ColourChoice> choices = colour_choices(*facts);
    EXPECT_TRUE(std::equal(choices.begin(), choices.end(), memos["use"].choices(*facts).begin(),
                           memos["use"].choices(*facts).end(),
                           [](const ColourChoice& a, const ColourChoice& b) { return a.id == b.id; }));
    const ViewScene before{.volumes = kept.of({*facts, colouring.colours, picks, true, true, true})};
    const ViewScene followed = build_view(*facts, colouring, {}, picks, editor.person, editor.theme, &kept);
    const ViewScene fresh = build_view(*facts, colouring, {}, picks, editor.person, editor.theme);
    EXPECT_EQ(followed, fresh) << "step " << step;
    for (std::size_t leaf = 0; leaf < followed.volumes.leaf_count(); ++leaf)
      shared += followed.volumes.shares_leaf(before.volumes, leaf) ? 1 : 0;
    for (int look = 0; look < 20; ++look) {
      const Ray ray{facts->centre + facts->radius * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), 3}, {0, 0, -1}};
      const auto near = facts->balls.rows_along(ray);
      for (std::uint32_t row = 0; row < facts->balls.size(); ++row) {
        const Vector3 to = ray.origin - Point3{facts->balls.x[row], facts->balls.y[row], facts->balls.z[row]};
        const double b = dot(to, ray.direction), square = facts->balls.squared_radius[row];
        if (square < 0 || !(b * b - squared_norm(to) + square >= 0)) continue;
        EXPECT_NE(std::find(near.begin(), near.end(), row), near.end()) << "the line goes through ball " << row;
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(shared, 0u);
}

// All corners and colours of a frame, window after window.
std::vector<std::uint8_t> drawn() {
  std::vector<std::uint8_t> bytes;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int list = 0; list < data.CmdListsCount; ++list) {
    const auto& corners = data.CmdLists[list]->VtxBuffer;
    const auto* begin = reinterpret_cast<const std::uint8_t*>(corners.Data);
    bytes.insert(bytes.end(), begin, begin + corners.size_in_bytes());
  }
  return bytes;
}

TEST_P(ViewFollows, AWindowThatHasSeenEverythingDrawsWhatAFreshOneDraws) {
  NullDesktop desktop(GetParam());
  Workbench& editor = desktop.editor();
  Random random(12);
  desktop.frames(3);
  for (int step = 0; step < 40; ++step) {
    if (random.below(2) == 0) (void)editor.document->session().submit(random_command(editor.scene(), random, step));
    desktop.ticks(1);
    pick_at_random(editor.picks, editor.scene(), random);
    const double now = desktop.now();
    const Camera camera = editor.view->camera();
    for (int settling = 0; settling < 3; ++settling) desktop.frame_at(now);
    const std::vector<std::uint8_t> followed = drawn();
    editor.view->forget();
    editor.canvas->board().glances = {};
    desktop.frame_at(now);
    editor.view->set_camera(camera);
    for (int settling = 0; settling < 2; ++settling) desktop.frame_at(now);
    ASSERT_EQ(drawn(), followed) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ViewFollows,
                         ::testing::Values("scenes/start/quarter.json", "scenes/studies/sixty_volumes.json",
                                           "scenes/studies/urban_mode.json"));

}  // namespace
}  // namespace bl::desktop
