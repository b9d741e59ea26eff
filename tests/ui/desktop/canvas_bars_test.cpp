// The bars on boxes say what list, statistics and report say: what there is against what was asked for.
#include <unistd.h>

#include <filesystem>

#include "core/file/file_io.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/bars.h"

namespace bl::desktop {
namespace {

canvas::BarFigures bar_of(Workbench& editor, const std::string& id) {
  const canvas::Model& model = editor.canvas->board().model;
  const canvas::NodeBox& box = model.boxes.at(model.find_box(id));
  for (const canvas::Section& section : box.sections)
    if (section.has_bar) return canvas::bar_figures(editor, box);
  ADD_FAILURE() << id << " has no bar";
  return {};
}

class CanvasBars : public CanvasFixture {};

// What a limit holds back is missing still: the bar is not full because the solver reached what was left.
TEST_F(CanvasBars, ALimitDoesNotMakeABarFull) {
  const std::string path = ::testing::TempDir() + "limited-" + std::to_string(getpid()) + ".json";
  ASSERT_TRUE(write_file(path, R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "site", "types": {"boundary": {}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}},
    {"id": "free", "position": [9, 0, 5], "types": {"smart_volume": {"demand": 1000}}},
    {"id": "held", "position": [-9, 0, 5], "types": {"smart_volume": {"demand": 600, "demand_limit": 400}}}]})")
                  .ok());
  ASSERT_TRUE(editor().open(path));
  desktop.ticks(120);
  const canvas::BarFigures held = bar_of(editor(), "held"), free = bar_of(editor(), "free");
  EXPECT_EQ(held.account.asked, 600);
  EXPECT_EQ(held.account.limited, 400);
  EXPECT_NEAR(held.account.volume, 400, 8);
  EXPECT_TRUE(held.is_limited);
  EXPECT_EQ(held.tone, AccountTone::far);
  EXPECT_NE(held.text().find(" / 600"), std::string::npos) << held.text();
  EXPECT_FALSE(free.is_limited);
  EXPECT_EQ(free.tone, AccountTone::met);
  std::filesystem::remove(path);
}

// Before a tick has seen it, a volume asks and has nothing.
TEST_F(CanvasBars, AFreshVolumeHasNothingOfWhatItAsks) {
  ASSERT_TRUE(editor().submit(command<AddNode>({"fresh", {R"({"types": {"smart_volume": {"demand": 900}}})"}})));
  desktop.frames(1);
  const canvas::BarFigures bar = bar_of(editor(), "fresh");
  EXPECT_EQ(bar.account.asked, 900);
  EXPECT_EQ(bar.account.volume, 0);
  EXPECT_EQ(bar.tone, AccountTone::far);
}

// The law, over scenes with briefs, caps and plot rules: box and account agree on every volume.
TEST(CanvasBarsLaw, BoxesAgreeWithTheAccount) {
  for (const char* scene : {"scenes/start/quarter.json", "scenes/studies/sixty_volumes.json", "scenes/studies/urban_mode.json"}) {
    NullDesktop desktop(scene);
    desktop.ticks(12);
    Workbench& editor = desktop.editor();
    const reading::Accounts accounts = reading::accounts_of(editor.state());
    ASSERT_FALSE(accounts.volumes.empty()) << scene;
    for (const reading::VolumeAccount& volume : accounts.volumes) {
      const std::string& id = editor.state().plan->nodes[volume.node].id;
      const canvas::BarFigures bar = bar_of(editor, id);
      EXPECT_EQ(bar.account.asked, volume.asked) << scene << " " << id;
      EXPECT_EQ(bar.account.volume, volume.volume) << scene << " " << id;
      EXPECT_EQ(bar.tone == AccountTone::met, std::abs(volume.standing()) <= accounts.tolerance) << scene << " " << id;
    }
  }
}

}  // namespace
}  // namespace bl::desktop
