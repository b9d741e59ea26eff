// Whatever data says, and however long: the window's lists and notices stay sentences.
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {
namespace {

constexpr std::size_t kMostShown = 6000;  // bytes

std::vector<ProblemItem> written_items(PanelDesktop& desktop) {
  std::vector<ProblemItem> items;
  PanelMemory& memory = memory_of(desktop.editor());
  for (ProblemItem item : memory.problems->items()) {
    write_problem(desktop.editor().state(), memory.record->figures(desktop.editor()).accounts, item);
    items.push_back(std::move(item));
  }
  return items;
}

// A file with a message of 20 MB, about a script whose name is as long.
TEST(BoundedTexts, ProblemsOfAFileAreCut) {
  PanelDesktop desktop("scenes/start/quarter.json");
  const std::string data(20'000'000, 'x');
  desktop.editor().list_problems("file.json", {{true, {ErrorCode::parse, "nodes/library", data}},
                                               {true, {ErrorCode::parse, "scripts/" + data, "`" + data + "` is no name"}}});
  desktop.frames(2);
  std::size_t seen = 0;
  for (const ProblemItem& item : written_items(desktop)) {
    if (item.kind != ProblemKind::file) continue;
    ++seen;
    EXPECT_FALSE(item.text.empty());
    EXPECT_LT(item.subject.size() + item.text.size(), kMostShown);
    EXPECT_NE((item.subject + item.text).find("(20000"), std::string::npos) << "says how long it was";
  }
  EXPECT_EQ(seen, 2u);
  for (const Problem& problem : desktop.editor().problems) EXPECT_LT(problem.error.message.size(), kMostShown);
}

// Names are data as well: of volumes in conflicts, shortages and whatever else the state says.
TEST(BoundedTexts, ProblemsOfTheStateAreCut) {
  PanelDesktop desktop("scenes/start/quarter.json");
  const std::string name(2'000'000, 'n');
  for (const char* node : {"library", "cafe", "theatre"}) ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({node, name})));
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"library", {"smart_volume.demand"}, {"4000"}})));
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"cafe", {"smart_volume.demand_limit"}, {"1"}})));
  desktop.ticks(10);
  std::size_t named = 0;
  for (const ProblemItem& item : written_items(desktop)) {
    EXPECT_LT(item.subject.size() + item.text.size(), kMostShown) << static_cast<int>(item.kind);
    named += item.subject.find("nnnn") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(named, 0u) << "the case that is tested has gone";
}

TEST(BoundedTexts, NoticesAreCut) {
  PanelDesktop desktop("scenes/start/quarter.json");
  desktop.editor().notify(NoticeKind::error, "This is no `" + std::string(20'000'000, 'x') + "`.");
  desktop.frames(1);
  ASSERT_EQ(desktop.editor().notices.size(), 1u);
  EXPECT_LT(desktop.editor().notices.back().text.size(), 1000u);
  EXPECT_TRUE(desktop.editor().notices.back().text.ends_with("x`.")) << desktop.editor().notices.back().text;
  desktop.editor().notify(NoticeKind::told, "Saved as quarter.json.");
  EXPECT_EQ(desktop.editor().notices.back().text, "Saved as quarter.json.");
}

}  // namespace
}  // namespace bl::desktop
