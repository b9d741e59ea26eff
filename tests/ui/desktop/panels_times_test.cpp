// The tab Time, on the null renderer.
#include <algorithm>
#include <chrono>
#include <thread>

#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/time_list.h"

namespace bl::desktop {
namespace {

constexpr const char* kTimedQuarter = "scenes/start/quarter.json";

class TimeDesktop : public PanelDesktop {
 public:
  explicit TimeDesktop(const std::string& scene = kTimedQuarter) : PanelDesktop(scene) {}
  TimeList& times() { return *memory_of(editor()).times; }
  void open_tab(const std::string& name) {
    memory_of(editor()).wanted_tab = name;
    frames(3);
  }
  // At the name: between the columns their width is dragged.
  void press_row(std::ptrdiff_t row) {
    const ImVec4 at = place("times/row/" + std::to_string(row));
    click({at.x + 20, (at.y + at.w) / 2});
  }
  bool is_measured() {
    ticks(1);
    return editor().moment->times != nullptr;
  }
};

TEST(Times, AreMeasuredOnlyWhileSomebodyLooks) {
  TimeDesktop desktop;
  EXPECT_FALSE(desktop.is_measured());
  desktop.open_tab("Time");
  EXPECT_EQ(desktop.times().table(), nullptr);
  EXPECT_TRUE(desktop.is_measured());
  desktop.open_tab("Problems");
  EXPECT_FALSE(desktop.is_measured());
  desktop.open_tab("Time");
  EXPECT_TRUE(desktop.is_measured());
  desktop.editor().person.shows_bottom = false;
  desktop.frames(3);
  EXPECT_FALSE(desktop.is_measured());
}

TEST(Times, LookingChangesNothing) {
  TimeDesktop looked_at, left_alone;
  looked_at.open_tab("Time");
  for (int k = 0; k < 20; ++k) {
    looked_at.ticks(1);
    left_alone.ticks(1);
    ASSERT_EQ(looked_at.editor().state().hash, left_alone.editor().state().hash) << k;
  }
  EXPECT_EQ(looked_at.steps(), 0u);
}

TEST(Times, KindsNodesAndLinksStandSlowestFirst) {
  TimeDesktop desktop;
  desktop.open_tab("Time");
  desktop.ticks(12);
  const auto expect_order = [&] {
    const auto& rows = desktop.times().rows();
    ASSERT_GT(rows.size(), 2u);
    for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_GE(rows[k - 1].seconds, rows[k].seconds);
  };
  expect_order();
  for (const char* by : {"Nodes", "Links", "Kinds"}) {
    desktop.press_on(std::string("times/by/") + by);
    desktop.frames(2);
    expect_order();
  }
}

TEST(Times, APressOnARowChoosesWhatItStandsFor) {
  TimeDesktop desktop;
  desktop.open_tab("Time");
  desktop.ticks(12);
  desktop.press_on("times/by/Links");
  desktop.frames(2);
  const std::string link = desktop.times().ids_of(desktop.times().rows().front()).front();
  desktop.press_row(0);
  EXPECT_EQ(desktop.editor().picks.links, std::set<std::string>{link});
  desktop.press_on("times/by/Nodes");
  desktop.frames(2);
  const std::string node = desktop.times().ids_of(desktop.times().rows().front()).front();
  desktop.press_row(0);
  EXPECT_EQ(desktop.editor().picks.nodes, std::set<std::string>{node});
  EXPECT_TRUE(desktop.editor().picks.links.empty());
  desktop.press_on("times/by/Kinds");
  desktop.frames(2);
  const auto& rows = desktop.times().rows();
  const auto volumes =
      std::find_if(rows.begin(), rows.end(), [](const reading::TimeRow& row) { return row.kind->id == "smart_volume"; });
  const auto kind = volumes == rows.end() ? rows.begin() : volumes;
  const std::vector<std::string> ids = desktop.times().ids_of(*kind);
  desktop.press_row(kind - rows.begin());
  const auto& picked = kind->is_link() ? desktop.editor().picks.links : desktop.editor().picks.nodes;
  EXPECT_EQ(picked, std::set<std::string>(ids.begin(), ids.end()));
}

TEST(Times, AColumnSorts) {
  TimeDesktop desktop;
  desktop.open_tab("Time");
  desktop.ticks(12);
  desktop.press_on("times/head/Runs");
  desktop.frames(2);
  const auto& rows = desktop.times().rows();
  ASSERT_GT(rows.size(), 2u);
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_GE(rows[k - 1].evaluations, rows[k].evaluations);
  desktop.press_on("times/head/Kind");
  desktop.frames(2);
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LE(rows[k - 1].kind->label, rows[k].kind->label);
}

// A node that is in the times, and has been removed since: pressing its row is harmless.
TEST(Times, ARowOfANodeThatIsGoneChoosesNothing) {
  TimeDesktop desktop;
  desktop.open_tab("Time");
  desktop.ticks(12);
  desktop.press_on("times/by/Nodes");
  desktop.frames(2);
  const std::string node = desktop.times().ids_of(desktop.times().rows().front()).front();
  ASSERT_TRUE(desktop.editor().submit(command<RemoveNode>({node})));
  desktop.frames(2);
  desktop.press_row(0);
  EXPECT_TRUE(desktop.editor().picks.nodes.empty());
}

TEST(Times, AtRestTheTableHasAllTicksAndAsksForNoFrame) {
  TimeDesktop desktop("scenes/links/attract.json");
  desktop.open_tab("Time");
  host::LiveSession& session = desktop.editor().document->session();
  const std::int64_t first = session.moment()->ticked->tick;
  session.set_rate(1000);
  session.play(true);
  for (int k = 0; k < 30000 && !session.moment()->is_resting; ++k) {
    desktop.frames(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(session.moment()->is_resting);
  const auto times = session.moment()->times;
  ASSERT_NE(times, nullptr);
  EXPECT_EQ(static_cast<std::int64_t>(times->ticks.evaluations), session.moment()->ticked->tick - first);
  const auto moment = session.moment();
  desktop.frames(200);
  EXPECT_EQ(desktop.editor().next_frame, kNoFrame);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(session.moment(), moment);
}

}  // namespace
}  // namespace bl::desktop
