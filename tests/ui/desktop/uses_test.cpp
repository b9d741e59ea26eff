// The colours of uses: one numbering for canvas, 3D view, statistics and pictures; and pictures that show every volume.
#include <gtest/gtest.h>

#include "core/drawing/use_colours.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/scene_pictures.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop {
namespace {

class UsesTest : public ::testing::Test {
 protected:
  UsesTest() : desktop("scenes/start/quarter.json") { desktop.ticks(2); }
  Workbench& editor() { return desktop.editor(); }
  std::map<std::string, std::size_t> numbers_in_programme() {
    const UseNumbers numbers(editor().scene());
    std::map<std::string, std::size_t> all;
    for (const auto& [id, node] : editor().scene().nodes) {
      const auto programme = node.types.find("programme");
      if (programme == node.types.end()) continue;
      const Table& table = *std::get<Shared<Table>>(programme->second.at("rows"));
      for (std::size_t row = 0; row < table.rows.size(); ++row) all[table.text(row, "use")] = numbers.of(table.text(row, "use"));
    }
    return all;
  }

  NullDesktop desktop;
};

TEST_F(UsesTest, TheProgrammeNumbersThemAndOthersComeAfterIt) {
  const auto before = numbers_in_programme();
  ASSERT_GT(before.size(), 2u);
  std::set<std::size_t> seen;
  for (const auto& [use, number] : before) {
    EXPECT_LT(number, before.size()) << use;
    EXPECT_TRUE(seen.insert(number).second) << use;
  }
  ASSERT_TRUE(editor().submit(command<AddNode>({"a-first", {R"({"types": {"smart_volume": {"use": "aaa"}}})"}})));
  ASSERT_TRUE(editor().submit(command<AddNode>({"a-second", {R"({"types": {"smart_volume": {}}})"}})));
  desktop.ticks(1);
  EXPECT_EQ(numbers_in_programme(), before) << "uses that come in do not change the colours of the others";
  const UseNumbers numbers(editor().scene());
  EXPECT_GE(numbers.of("aaa"), before.size());
  EXPECT_EQ(numbers.of(""), kNoUse);
}

TEST_F(UsesTest, EveryPanelShowsTheSameColour) {
  ASSERT_TRUE(editor().submit(command<AddNode>({"a-second", {R"({"types": {"smart_volume": {}}})"}})));
  desktop.ticks(2);
  const Theme& theme = editor().theme;
  const UseNumbers numbers(editor().scene());
  const auto facts = read_facts(editor().moment->state, nullptr);
  const Colouring colouring = colour_volumes(*facts, "use", theme);
  canvas::Board& board = editor().canvas->board();
  std::set<std::size_t> seen;
  for (std::size_t k = 0; k < facts->volumes.size(); ++k) {
    const VolumeFacts& volume = facts->volumes[k];
    EXPECT_EQ(colouring.colours[k], colour_of_use(theme, numbers.tone(volume.figures.use))) << volume.id;
    EXPECT_EQ(board.model.boxes[board.model.find_box(volume.id)].use, numbers.tone(volume.figures.use)) << volume.id;
    seen.insert(numbers.tone(volume.figures.use));
  }
  EXPECT_TRUE(seen.contains(kNoUse));
  EXPECT_EQ(colouring.legend.rows.back().label, "No use");
  EXPECT_EQ(colouring.legend.rows.back().colour, colour_of_use(theme, kNoUse));
  std::set<std::size_t> drawn;
  for (const PictureTriangle& triangle : picture_of(editor().state()).triangles) drawn.insert(triangle.colour);
  EXPECT_GT(drawn.size(), 2u);
  for (const std::size_t number : drawn) EXPECT_TRUE(seen.contains(number));
}

// Window, report and files look alike.
TEST_F(UsesTest, ColoursAreThoseOfReportsAndFiles) {
  const UseNumbers numbers(editor().scene());
  for (const std::string use : {"housing", "shops", "something else"}) {
    const std::size_t tone = numbers.tone(use);
    EXPECT_EQ(colour_of_use(editor().theme, tone), colour_of_text(drawing::hex(drawing::use_colour(use).colour))) << use;
  }
}

TEST(Pictures, StreetsAreDrawnWhereThereIsNothingElse) {
  NullDesktop desktop("scenes/studies/braess.json");
  desktop.ticks(2);
  const ScenePicture picture = picture_of(desktop.editor().state());
  EXPECT_EQ(picture.volumes, 0u);
  ASSERT_GE(picture.streets.size(), 5u);
  for (const auto& street : picture.streets) {
    ASSERT_GE(street.size(), 2u);
    for (const auto& [x, y] : street) EXPECT_TRUE(x >= 0 && x <= 1 && y >= 0 && y <= 1) << x << " " << y;
  }
}

TEST(Pictures, BallsAreDrawnWhereNoShapeIsKnown) {
  NullDesktop desktop("scenes/studies/other_metrics.json");
  desktop.ticks(24);
  const ScenePicture picture = picture_of(desktop.editor().state());
  ASSERT_EQ(picture.volumes, 24u);
  ASSERT_EQ(picture.grounds.size(), 3u);
  for (const auto& ground : picture.grounds) {
    float low = 1, high = 0;
    for (const auto& [x, y] : ground) low = std::min(low, x), high = std::max(high, x);
    const float third = (high - low) / 3;
    const auto count = std::count_if(picture.triangles.begin(), picture.triangles.end(), [&](const PictureTriangle& t) {
      const float x = (t.x[0] + t.x[1] + t.x[2]) / 3;
      return x > low + third && x < high - third;
    });
    EXPECT_GT(count, 20) << "each of the three plots is full";
  }
}

}  // namespace
}  // namespace bl::desktop
