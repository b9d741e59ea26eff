// The window's loop without a window: nothing is drawn at rest, and whatever changes is drawn, whoever has changed it.
#include "ui/desktop/shell/frame_watch.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

#include <unistd.h>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr const char* kScene = "scenes/links/attract.json";

// The loop as the window has it, on a clock that jumps over every wait.
class Loop {
 public:
  explicit Loop(const std::string& scene = kScene) : window(scene), now_(window.now()) {}

  struct Passed {
    int frames = 0, looks = 0;
  };
  Passed pass(double seconds) {
    Passed passed;
    for (const double end = now_ + seconds; now_ < end; ++passed.looks) {
      if (watch.is_due(now_)) {
        window.frame_at(now_);
        watch.drawn(now_);
        ++passed.frames;
        now_ += kFrame;
      } else {
        now_ = std::min(end, std::max(now_ + 0.001, watch.next_look()));
      }
    }
    return passed;
  }
  // What was opened, drawn and asked for is over.
  void rest() {
    (void)pass(2);
    ASSERT_EQ(pass(5).frames, 0);
  }
  // What people do, they do in a frame of now.
  template <class Deed>
  void act(const Deed& deed) {
    editor().now = now_;
    deed();
    watch.touch();
  }
  void point_at(ImVec2 place) {
    ImGui::GetIO().MousePos = place;
    watch.touch();
  }
  Workbench& editor() { return window.editor(); }

  NullDesktop window;
  FrameWatch watch{window.desktop(), [] {}};

 private:
  double now_;
};

TEST(FrameWatch, AtRestNothingIsDrawnAndNobodyLooks) {
  for (const char* scene : {kScene, "scenes/start/quarter.json", "scenes/studies/urban_mode.json"}) {
    Loop loop(scene);
    loop.rest();
    const Loop::Passed minute = loop.pass(60);
    EXPECT_EQ(minute.frames, 0) << scene;
    EXPECT_LE(minute.looks, 1) << scene;
  }
}

TEST(FrameWatch, AClockThatPlaysInASettledSceneDrawsNothing) {
  Loop loop;
  host::LiveSession& session = loop.editor().document->session();
  session.set_rate(1000);
  session.play(true);
  for (int k = 0; k < 30000 && !session.moment()->is_resting; ++k) {
    (void)loop.pass(kFrame);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(session.moment()->is_resting);
  loop.rest();
  const auto moment = session.moment();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(loop.pass(60).frames, 0);
  EXPECT_EQ(session.moment(), moment);
  const std::int64_t tick = loop.editor().state().tick;
  ASSERT_TRUE(
      loop.editor().submit(command<SetPort>({loop.editor().scene().nodes.begin()->first, {"node.position"}, {"[50, 60, 0]"}})));
  EXPECT_GT(session.moment()->state->tick, tick) << "the clock has counted on";
  EXPECT_GE(loop.pass(0.2).frames, 1);
}

TEST(FrameWatch, InputIsDrawnUntilAllOfItIsSeen) {
  Loop loop;
  loop.rest();
  loop.point_at({300, 300});
  const int frames = loop.pass(2).frames;
  EXPECT_GE(frames, 3);
  EXPECT_LE(frames, 20);
  EXPECT_EQ(loop.pass(60).frames, 0);
}

TEST(FrameWatch, AHeldButtonDrawsOn) {
  Loop loop;
  loop.rest();
  loop.point_at({1000, 300});
  ImGui::GetIO().MouseDown[0] = true;
  EXPECT_GE(loop.pass(1).frames, 55);
  ImGui::GetIO().MouseDown[0] = false;
  loop.watch.touch();
  loop.rest();
}

TEST(FrameWatch, ACardComesUpUnderAMouseThatRests) {
  Loop loop;
  const auto place = loop.editor().canvas->screen_of(loop.editor().scene().nodes.begin()->first);
  ASSERT_TRUE(place);
  loop.rest();
  loop.point_at(*place);
  double drawn = 0;
  for (int k = 0; k < 200; ++k)
    if (loop.pass(kFrame).frames > 0) drawn = loop.window.now();
  EXPECT_EQ(loop.window.now(), drawn);
  EXPECT_EQ(loop.editor().next_frame, kNoFrame) << "the card is there";
  loop.rest();
}

TEST(FrameWatch, AnEditFromOutsideIsSeenWithoutInput) {
  Loop loop;
  loop.rest();
  const std::string node = loop.editor().scene().nodes.begin()->first;
  ASSERT_TRUE(loop.editor().document->session().submit({command<RenameNode>({node, "Seen"}), Author{"ben"}, 0, {}, {}}).ok());
  loop.editor().document->session().settle();
  EXPECT_GE(loop.pass(1).frames, 1);
  EXPECT_EQ(loop.editor().state().plan->scene.nodes.at(node).name, "Seen");
  loop.rest();
}

TEST(FrameWatch, TicksOfTheOtherThreadEndTheWait) {
  Loop loop;
  loop.rest();
  std::mutex mutex;
  std::condition_variable woken;
  bool is_woken = false;
  FrameWatch watch(loop.window.desktop(), [&] {
    const std::lock_guard lock(mutex);
    is_woken = true;
    woken.notify_all();
  });
  for (int k = 0; k < 10; ++k) {
    while (watch.is_due(loop.window.now())) {
      loop.window.frames();
      watch.drawn(loop.window.now());
    }
  }
  EXPECT_TRUE(watch.wait([&] {
    loop.editor().document->session().step(1);
    std::unique_lock lock(mutex);
    woken.wait_for(lock, std::chrono::minutes(1), [&] { return is_woken; });
  }));
  EXPECT_TRUE(is_woken);
  EXPECT_TRUE(watch.is_due(loop.window.now()));
  loop.editor().document->session().settle();
  EXPECT_FALSE(watch.wait([] { ADD_FAILURE() << "what has come already is not waited for"; }));
}

TEST(FrameWatch, ASavedScriptIsReadAgainWithoutInput) {
  const auto folder = std::filesystem::temp_directory_path() / ("bl_frame_watch_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "lift.lua").string();
  const auto save = [&](const std::string& label) {
    ASSERT_TRUE(write_file(path, "return {id = 'lift', label = '" + label +
                                     "', doc = 'Lifts.', proposes = {move = {at = 'to', port = 'node.position'}},\n"
                                     "evaluate = function() return {move = point(0, 0, 1)} end}")
                    .ok());
  };
  Loop loop;
  save("Lift");
  loop.window.desktop().drop(path);
  loop.watch.touch();
  (void)loop.pass(8);
  const Loop::Passed minute = loop.pass(60);
  EXPECT_EQ(minute.frames, 0) << "to look at a file is no reason to draw";
  EXPECT_LE(minute.looks, 60 * 4);
  save("Raised");
  EXPECT_GE(loop.pass(1).frames, 1);
  EXPECT_EQ(loop.editor().types().link("lift")->label, "Raised");
  std::filesystem::remove_all(folder);
}

TEST(FrameWatch, ANoticeGoesAwayByItself) {
  Loop loop;
  loop.rest();
  loop.editor().notify(NoticeKind::told, "Done.");
  EXPECT_GE(loop.pass(1).frames, 1);
  EXPECT_EQ(loop.editor().notices.size(), 1u);
  EXPECT_EQ(loop.pass(3).frames, 0) << "it stands still until it goes";
  EXPECT_GE(loop.pass(3).frames, 1);
  EXPECT_TRUE(loop.editor().notices.empty());
  loop.rest();
}

TEST(FrameWatch, ACaretBlinksAndNothingMore) {
  Loop loop;
  loop.rest();
  loop.window.key(GLFW_KEY_K, true);
  loop.watch.touch();
  (void)loop.pass(2);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  const Loop::Passed passed = loop.pass(12);
  EXPECT_GE(passed.frames, 24) << "it shows and hides in each 1.2 s";
  EXPECT_LE(passed.frames, 32);
  loop.window.key(GLFW_KEY_ESCAPE);
  loop.watch.touch();
  loop.rest();
}

TEST(FrameWatch, TheCameraFliesToItsEnd) {
  Loop loop("scenes/start/quarter.json");
  loop.rest();
  loop.act([&] { loop.editor().view->look_from(SceneView::Side::plan); });
  EXPECT_GE(loop.pass(0.3).frames, 15);
  const Camera there = loop.editor().view->camera();
  EXPECT_LE(loop.pass(1).frames, 10) << "and the finer picture after it";
  EXPECT_NEAR(loop.editor().view->camera().elevation, there.elevation, 0.05);
  loop.rest();
  EXPECT_EQ(loop.editor().next_frame, kNoFrame);
}

}  // namespace
}  // namespace bl::desktop
