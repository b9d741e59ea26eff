// A rehearsal from the dialog of the window, by the real program: bots take part, and nothing is left of their room.
#include "ui/desktop/document/rehearsal.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "tests/support/deadline.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// build/X/tests/ui/desktop/room_window_tests and build/X/ui/cli/behaviourlinks, or wherever both lie in one tree.
std::string command_line_program() {
  fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (; folder != folder.root_path(); folder = folder.parent_path())
    if (fs::exists(folder / "ui/cli/behaviourlinks")) return (folder / "ui/cli/behaviourlinks").string();
  return "";
}

class RehearsedRooms : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("behaviourlinks_rehearsal_" + std::to_string(::getpid()) + "_" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    fs::copy_file(BL_SOURCE_DIR "/scenes/start/quarter.json", folder_ / "quarter.json");
    ASSERT_TRUE(write_file((folder_ / "quarter.blsession").string(), "the session of last week"));
    before_ = files();
    desktop_ = std::make_unique<NullDesktop>();
    editor().server_program = command_line_program();
    ASSERT_FALSE(editor().server_program.empty()) << "the program `behaviourlinks` is not built";
    ASSERT_TRUE(editor().open((folder_ / "quarter.json").string()));
    walk_to_check();
  }
  void TearDown() override {
    desktop_.reset();
    EXPECT_EQ(files(), before_) << "nothing is changed, and nothing is left";
    fs::remove_all(folder_);
  }
  // Their names with what stands in them.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& one : fs::recursive_directory_iterator(folder_)) {
      const auto text = one.is_regular_file() ? read_file(one.path().string()) : Result<std::string>(std::string());
      all[one.path().string()] = text ? *text : "unreadable";
    }
    return all;
  }
  void walk_to_check() {
    editor().dialogs->show_host();
    desktop_->frames(3);
    for (int k = 0; k < 3; ++k) press("host/next");
    host().plan().bind = "127.0.0.1";
    press("host/next");
    ASSERT_EQ(host().page(), HostDialog::Page::check);
    ASSERT_TRUE(frames_until([&] { return !host().is_checking(); }));
  }
  Workbench& editor() { return desktop_->editor(); }
  HostDialog& host() { return editor().dialogs->host(); }
  template <class IsOver>
  bool frames_until(const IsOver& is_over) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < end) {
      desktop_->frames(1);
      if (is_over()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  bool is_there(const std::string& key) { return memory_of(editor()).places.contains(key); }
  void press(const std::string& key) {
    desktop_->frames(2);
    ASSERT_TRUE(frames_until([&] { return is_there(key); })) << key;
    const ImVec4 place = memory_of(editor()).places.at(key);
    desktop_->click({(place.x + place.z) / 2, (place.y + place.w) / 2});
    desktop_->frames(2);
  }
  void begin(int bots, double seconds) {
    host().rehearsal() = {.bots = bots, .seconds = seconds};
    press("host/rehearse");
    ASSERT_TRUE(host().is_rehearsing()) << host().told();
  }

  fs::path folder_;
  std::map<std::string, std::string> before_;
  std::unique_ptr<NullDesktop> desktop_;
};

TEST_F(RehearsedRooms, BotsTakePartAndTheResultIsShown) {
  const Deadline deadline(300, "a rehearsal from the window");
  begin(3, 4);
  EXPECT_NE(files(), before_) << "the room has a folder while it is open";
  EXPECT_FALSE(is_there("host/rehearse")) << "one at a time";
  press("host/next");
  EXPECT_FALSE(host().is_opening()) << "the room is not opened meanwhile";
  ASSERT_TRUE(frames_until([&] { return !host().is_rehearsing(); }));
  EXPECT_EQ(host().told(), "");
  std::map<std::string, serve::Finding> found;
  for (const serve::Finding& finding : host().rehearsed()) found[finding.subject] = finding;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found["people"].verdict, serve::Verdict::good) << found["people"].text;
  EXPECT_NE(found["people"].text.find("4 of 4 bots came in"), std::string::npos) << "three, and the one who leads";
  EXPECT_EQ(found["stored"].verdict, serve::Verdict::good) << found["stored"].text;
  EXPECT_NE(found["answers"].text.find(" 0 without an answer"), std::string::npos) << found["answers"].text;
  EXPECT_FALSE(found["answers"].text.starts_with("0 operations")) << "they have said something";
  EXPECT_TRUE(found.contains("screens"));
  EXPECT_EQ(editor().document->room(), nullptr) << "the scene is still open here";
  EXPECT_FALSE(editor().hosting);
}

TEST_F(RehearsedRooms, AServerThatCannotBeStartedIsTold) {
  editor().server_program = "/nowhere/behaviourlinks";
  press("host/rehearse");
  ASSERT_TRUE(frames_until([&] { return !host().is_rehearsing(); }));
  EXPECT_FALSE(host().told().empty());
  EXPECT_TRUE(host().rehearsed().empty());
}

TEST_F(RehearsedRooms, CanBeStopped) {
  const Deadline deadline(300, "a rehearsal that is stopped");
  begin(2, 600);
  ASSERT_TRUE(frames_until([&] { return is_there("host/rehearse/stop"); }));
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begun < 1s) desktop_->frames(1);
  press("host/rehearse/stop");
  ASSERT_TRUE(frames_until([&] { return !host().is_rehearsing(); }));
  EXPECT_TRUE(host().rehearsed().empty());
  EXPECT_EQ(host().told(), "");
  EXPECT_EQ(files(), before_);
  // Another one at once, which ends with its dialog.
  begin(2, 600);
  press("host/cancel");
  EXPECT_FALSE(host().is_rehearsing());
}

TEST_F(RehearsedRooms, ASceneThatCannotBeServedIsToldWithItsReason) {
  const Deadline deadline(300, "a rehearsal that cannot begin");
  host().plan().scene = (folder_ / "gone.json").string();
  begin(2, 5);
  ASSERT_TRUE(frames_until([&] { return !host().is_rehearsing(); }));
  EXPECT_TRUE(host().rehearsed().empty());
  EXPECT_NE(host().told().find("gone.json"), std::string::npos) << host().told();
}

}  // namespace
}  // namespace bl::desktop
