// A rehearsal from the dialog of the window, by the real program: bots take part, and nothing is left of their room.
#include "ui/desktop/document/rehearsal.h"

#include <unistd.h>

#include <chrono>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "tests/support/deadline.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/room/hosting_window.h"

namespace bl::desktop {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class RehearsedRooms : public HostingWindow {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("behaviourlinks_rehearsal_" + std::to_string(::getpid()) + "_" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    fs::copy_file(test::source_folder() + "/scenes/start/quarter.json", folder_ / "quarter.json");
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
  void begin(int bots, double seconds) {
    host().rehearsal() = {.bots = bots, .seconds = seconds};
    press("host/rehearse");
    ASSERT_TRUE(host().is_rehearsing()) << host().told();
  }

  fs::path folder_;
  std::map<std::string, std::string> before_;
};

TEST_F(RehearsedRooms, BotsTakePartAndTheResultIsShown) {
  const Deadline deadline(300, "a rehearsal from the window");
  begin(3, 4);
  EXPECT_NE(files(), before_) << "the room has a folder while it is open";
  EXPECT_FALSE(is_drawn("host/rehearse")) << "one at a time";
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
  ASSERT_TRUE(frames_until([&] { return is_drawn("host/rehearse/stop"); }));
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
