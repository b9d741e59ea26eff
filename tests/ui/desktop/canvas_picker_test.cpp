// What the search boxes of the canvas offer first, and that their descriptions are readable to the end.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {
namespace {

class PickerTest : public ::testing::Test {
 protected:
  PickerTest() : desktop("scenes/start/quarter.json") { desktop.ticks(1); }
  Workbench& editor() { return desktop.editor(); }
  canvas::Board& board() { return editor().canvas->board(); }
  // The choices as they are listed, with nothing typed.
  std::vector<canvas::Choice> offered() {
    desktop.frames(3);
    std::vector<canvas::Choice> all;
    for (const std::size_t k : board().picker.shown) all.push_back(board().picker.choices[k]);
    return all;
  }

  NullDesktop desktop;
};

TEST_F(PickerTest, ADropOffersVolumesFirstWhateverWasUsedLast) {
  editor().person.recent_additions = {"map_value", "control", "statistics", "expression"};
  canvas::open_drop_menu(board(), board().model.find_box("library"), {400, 300});
  const auto choices = offered();
  ASSERT_FALSE(choices.empty());
  bool has_others = false;
  for (const canvas::Choice& choice : choices) {
    if (choice.extra != "smart_volume") has_others = true;
    const bool is_late = choice.extra == "smart_volume" && has_others;
    EXPECT_FALSE(is_late) << choice.label << " stands below a role without a body";
    const bool only_moves =
        choice.id == "attract" || choice.id == "repel" || choice.id == "keep_distance" || choice.id == "align";
    EXPECT_TRUE(!only_moves || choice.extra == "smart_volume") << choice.label;
  }
  EXPECT_TRUE(has_others) << "numbers still lead to whatever has numbers";
}

TEST_F(PickerTest, AmongVolumesWhatWasUsedLastComesFirst) {
  editor().person.recent_additions = {"repel", "attract"};
  canvas::open_drop_menu(board(), board().model.find_box("library"), {400, 300});
  const auto choices = offered();
  ASSERT_GT(choices.size(), 2u);
  EXPECT_EQ(choices[0].id, "repel");
  EXPECT_EQ(choices[1].id, "attract");
}

TEST_F(PickerTest, DescriptionsWrapAndEndWithDots) {
  const Theme& theme = editor().theme;
  const std::string text = "Pulls the two nodes together until they are as far apart as is wished, and no further than that.";
  const canvas::TwoLines wide = canvas::in_two_lines(theme, text, 5000);
  EXPECT_EQ(wide.first, text);
  EXPECT_TRUE(wide.second.empty());
  EXPECT_FALSE(wide.is_cut);
  const canvas::TwoLines two = canvas::in_two_lines(theme, text, 420);
  EXPECT_FALSE(two.is_cut);
  EXPECT_EQ(two.first + " " + two.second, text) << "broken between words";
  const canvas::TwoLines cut = canvas::in_two_lines(theme, text, 150);
  EXPECT_TRUE(cut.is_cut);
  EXPECT_TRUE(cut.second.ends_with("\xe2\x80\xa6")) << cut.second;
  for (const float width : {-5.0f, 0.0f, 1.0f, 12.0f}) canvas::in_two_lines(theme, text, width);
  EXPECT_TRUE(canvas::in_two_lines(theme, "", 100).first.empty());
}

}  // namespace
}  // namespace bl::desktop
