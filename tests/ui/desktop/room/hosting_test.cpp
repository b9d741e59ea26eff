// A room that is opened from the dialog of the window, by the real program, joined, led, left, and ended in order.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

#include <GLFW/glfw3.h>
#include <nlohmann/json.hpp>

#include "core/guest/room_guest.h"
#include "tests/support/deadline.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/room/hosting_window.h"
#include "ui/desktop/panels/invitation_sheet.h"

namespace bl::desktop {
namespace {

namespace fs = std::filesystem;

// A port of this computer that is held while the object lives.
class Port {
 public:
  Port() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in where{};
    where.sin_family = AF_INET;
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&where), sizeof where), 0);
    socklen_t size = sizeof where;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&where), &size);
    number_ = ntohs(where.sin_port);
    EXPECT_EQ(::listen(socket_, 1), 0);
  }
  ~Port() { free(); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  int number() const { return number_; }
  void free() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

 private:
  int socket_ = -1, number_ = 0;
};

class HostedRooms : public HostingWindow {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("behaviourlinks_hosting_" + std::to_string(::getpid()) + "_" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    fs::copy_file(test::source_folder() + "/scenes/start/quarter.json", folder_ / "quarter.json");
    desktop_ = std::make_unique<NullDesktop>();
    ASSERT_FALSE(command_line_program().empty()) << "the program `behaviourlinks` is not built";
    editor().server_program = command_line_program();
  }
  void TearDown() override {
    // A test that fails in the middle leaves no server behind; in the others it is gone by now.
    if (desktop_ && editor().hosting) ::kill(editor().hosting->number(), SIGKILL);
    desktop_.reset();
    fs::remove_all(folder_);
  }
  bool open_scene() { return editor().open((folder_ / "quarter.json").string()); }
  void plan(int port) {
    host().plan().bind = "127.0.0.1";
    host().plan().port = std::to_string(port);
  }
  // From the first page to the last one.
  void walk_to_check(int port) {
    editor().dialogs->show_host();
    desktop_->frames(3);
    for (const auto page : {HostDialog::Page::people, HostDialog::Page::phases, HostDialog::Page::place}) {
      press("host/next");
      ASSERT_EQ(host().page(), page);
    }
    plan(port);
    press("host/next");
    ASSERT_EQ(host().page(), HostDialog::Page::check);
    ASSERT_TRUE(frames_until([&] { return !host().is_checking(); }));
    EXPECT_GE(host().findings().size(), 10u) << host().told();
  }
  guest::RoomGuest* room() { return editor().document ? editor().document->room() : nullptr; }
  // The room is led from here, all that the dialog has sent is answered, and the dialog, which takes all keys, is gone.
  bool is_hosted() {
    return frames_until([&] {
      return room() != nullptr && room()->standing().has_scene && room()->role() == "facilitator" &&
             !editor().document->is_unsaved() && !is_drawn("host/next");
    });
  }
  // A room of the copied scene, which this window leads.
  void host_scene() {
    Port port;
    ASSERT_TRUE(open_scene());
    port.free();
    walk_to_check(port.number());
    press("host/next");
    ASSERT_TRUE(is_hosted()) << host().told();
    ASSERT_TRUE(editor().hosting);
  }
  std::string phase() {
    const auto& view = room()->view("room");
    const auto found = view.find("phase");
    const auto json = found == view.end() ? Result<const Json*>(Error{}) : found->second.read();
    return json ? guest::text_in(**json, "name") : "";
  }
  bool has_notice(const std::string& part) {
    for (const Notice& notice : editor().notices)
      if (notice.text.find(part) != std::string::npos) return true;
    return false;
  }

  fs::path folder_;
};

TEST_F(HostedRooms, AreOpenedJoinedLedAndEndedInOrder) {
  const Deadline deadline(300, "a room that is opened from the window");
  Port port;
  ASSERT_TRUE(open_scene());
  port.free();
  walk_to_check(port.number());
  host().plan().people["designer"] = 2;
  press("host/next");
  ASSERT_TRUE(is_hosted()) << host().told();
  ASSERT_TRUE(editor().hosting);
  const pid_t server = editor().hosting->number();
  EXPECT_EQ(::kill(server, 0), 0);
  // The first planned phase begins by itself, and the tab offers the others.
  ASSERT_TRUE(frames_until([&] { return phase() == "Look"; }));
  ASSERT_TRUE(frames_until([&] { return is_drawn("roompanel/plan/1"); }));
  press("roompanel/plan/1");
  ASSERT_TRUE(frames_until([&] { return phase() == "Comment"; }));
  ASSERT_TRUE(frames_until([&] { return room()->health().has_value(); }));
  EXPECT_GT(room()->health()->disk_free, 0);
  EXPECT_TRUE(is_drawn("roompanel/health"));
  // Keys lie in one file, which only this person can read.
  struct stat status {};
  ASSERT_EQ(::stat((folder_ / "quarter.invitations.html").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  // The question is asked before the window closes; the end is waited for.
  desktop_->desktop().ask_to_quit();
  desktop_->frames(3);
  EXPECT_FALSE(editor().wants_quit);
  press("leave/cancel");
  EXPECT_FALSE(editor().wants_quit);
  desktop_->desktop().ask_to_quit();
  desktop_->frames(3);
  press("leave/end");
  ASSERT_TRUE(frames_until([&] { return editor().wants_quit; }));
  EXPECT_FALSE(editor().hosting);
  EXPECT_NE(::kill(server, 0), 0) << "the server is gone";
  EXPECT_TRUE(fs::exists(folder_ / "quarter.blsession"));
  EXPECT_FALSE(fs::exists(folder_ / "quarter.blsession-wal")) << "it was closed in order";
}

TEST_F(HostedRooms, AreFoundAgainWhereTheyWereLeftOpen) {
  const Deadline deadline(300, "a room that is left open");
  ASSERT_NO_FATAL_FAILURE(host_scene());
  const pid_t server = editor().hosting->number();
  const std::string code = room()->code(), address = editor().hosting->address();
  const std::int64_t seat = room()->seat();
  desktop_->key(GLFW_KEY_W, true);
  desktop_->frames(3);
  press("leave/open");
  ASSERT_TRUE(frames_until([&] { return !editor().document; }));
  EXPECT_FALSE(editor().hosting);
  EXPECT_EQ(::kill(server, 0), 0) << "the room goes on";
  ASSERT_FALSE(editor().person.recent_rooms.empty());
  ASSERT_TRUE(editor().open(editor().person.recent_rooms.front()));
  ASSERT_TRUE(is_hosted());
  EXPECT_EQ(room()->seat(), seat);
  EXPECT_TRUE(frames_until([&] { return is_drawn("roompanel/plan/1"); })) << "the plan is kept";
  ASSERT_EQ(::kill(server, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(server, &status, 0), server);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST_F(HostedRooms, APortInUseIsToldBeforeAndAtTheOpening) {
  const Deadline deadline(300, "a port in use");
  Port port;
  ASSERT_TRUE(open_scene());
  walk_to_check(port.number());
  const auto& found = host().findings();
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [](const auto& f) { return f.verdict == serve::Verdict::bad && f.subject == "port"; }));
  EXPECT_EQ(found.front().verdict, serve::Verdict::bad) << "what is bad comes first";
  press("host/next");
  ASSERT_TRUE(frames_until([&] { return !host().is_opening(); }));
  EXPECT_NE(host().told().find("Port " + std::to_string(port.number()) + " is in use"), std::string::npos) << host().told();
  EXPECT_EQ(room(), nullptr) << "the scene is still open here";
  EXPECT_FALSE(editor().hosting);
  // Another port will do, without closing the dialog.
  port.free();
  press("host/next");
  ASSERT_TRUE(is_hosted()) << host().told();
  editor().hosting->end();
  ASSERT_TRUE(frames_until([&] { return !editor().hosting; }));
  EXPECT_TRUE(has_notice("The room is closed"));
}

TEST_F(HostedRooms, AServerThatDiesIsTold) {
  const Deadline deadline(300, "a server that dies");
  ASSERT_NO_FATAL_FAILURE(host_scene());
  ::kill(editor().hosting->number(), SIGKILL);
  ASSERT_TRUE(frames_until([&] { return !editor().hosting; }));
  EXPECT_TRUE(has_notice("The server of the room has ended"));
}

TEST_F(HostedRooms, ASceneWithoutAFileIsSavedFirst) {
  ASSERT_TRUE(editor().open(test::source_folder() + "/scenes/start/quarter.json"));
  editor().dialogs->show_host();
  desktop_->frames(3);
  press("host/next");
  EXPECT_EQ(host().page(), HostDialog::Page::scene) << "a shipped scene opens as a copy without a file";
  press("host/save");
  EXPECT_TRUE(editor().dialogs->is_choosing_file());
  desktop_->key(GLFW_KEY_A, true);
  desktop_->type((folder_ / "mine.json").string());
  desktop_->frames(1);
  desktop_->key(GLFW_KEY_ENTER);
  desktop_->frames(3);
  press("host/next");
  EXPECT_EQ(host().page(), HostDialog::Page::people);
  EXPECT_EQ(host().plan().scene, (folder_ / "mine.json").string());
  EXPECT_EQ(host().plan().journal, (folder_ / "mine.blsession").string());
}

TEST_F(HostedRooms, ChangesAreSavedBeforeTheServerReadsThem) {
  ASSERT_TRUE(open_scene());
  ASSERT_TRUE(editor().submit(command<RenameNode>({"cafe", "Corner"})));
  ASSERT_TRUE(editor().document->is_unsaved());
  editor().dialogs->show_host();
  desktop_->frames(3);
  press("host/next");
  EXPECT_EQ(host().page(), HostDialog::Page::people);
  EXPECT_FALSE(editor().document->is_unsaved());
}

TEST(HostingPlans, WrongPlacesHaveASentence) {
  HostingPlan plan;
  plan.journal = ::testing::TempDir() + "room.blsession";
  EXPECT_EQ(fault_of_place(plan), "");
  for (const char* port : {"", "0", "65536", "70000", "-1", "80x", " 80", "1e3", "99999999999999999999"}) {
    HostingPlan wrong = plan;
    wrong.port = port;
    EXPECT_NE(fault_of_place(wrong), "") << port;
  }
  for (const char* journal : {"", "/nowhere/room.blsession", "room.json"}) {
    HostingPlan wrong = plan;
    wrong.journal = journal;
    EXPECT_NE(fault_of_place(wrong), "") << journal;
  }
  HostingPlan half = plan;
  half.certificate = "/etc/hostname";
  EXPECT_NE(fault_of_place(half), "");
  EXPECT_EQ(words_of(plan, true).back(), "--check");
}

TEST(HostingPlans, PhasesAreReadAsTheyWereWritten) {
  for (const PhaseTemplate& one : phase_templates()) EXPECT_EQ(plan_of_text(text_of_plan(one.phases)), one.phases) << one.label;
  EXPECT_TRUE(phase_templates().back().phases.empty());
  for (const char* text : {"", "{}", "[1, {}, {\"name\": 3}]", "[[", "null"}) EXPECT_TRUE(plan_of_text(text).empty()) << text;
  EXPECT_EQ(plan_of_text(R"([{"name": "A", "minutes": -4, "activities": [1, "vote"]}])"), (PhasePlan{{"A", {"vote"}, 0}}));
}

TEST(Invitations, HaveACardForEachPersonAndNoOther) {
  const std::map<std::string, std::string> keys = {{"designer", "abc1"}, {"facilitator", "fff2"}};
  const auto page = invitation_page("http://192.168.1.5:8080/BKRT", keys, {{"designer", 3}, {"viewer", 2}});
  ASSERT_TRUE(page) << page.error().text();
  std::size_t cards = 0;
  for (std::size_t at = page->find("class=\"card\""); at != std::string::npos; at = page->find("class=\"card\"", at + 1)) ++cards;
  EXPECT_EQ(cards, 3u);
  EXPECT_NE(page->find("/BKRT#k=abc1"), std::string::npos);
  EXPECT_EQ(page->find("fff2"), std::string::npos) << "the facilitator's key is on no card";
}

}  // namespace
}  // namespace bl::desktop
