// A running room that goes back to a scenario: everybody is told, a replay of its log agrees, and the file knows the way as well.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>

#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/journal/export.h"
#include "core/serve/room_host.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"

namespace bl::serve {
namespace {

struct Listener : Guest {
  void send(std::shared_ptr<const std::string> frame) override {
    frames.push_back(*parse_json(*frame));
    if (frames.back()["t"] != "state") return;
    Json& view = views[frames.back()["view"].get<std::string>()];
    for (const auto& [key, content] : frames.back()["set"].items()) view[key] = content;
  }
  void close(CloseCode, const std::string&) override {}
  std::size_t unsent() const override { return 0; }
  std::vector<Json> frames;
  std::map<std::string, Json> views;
};

class Restarting : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_restart_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / "room.blsession";
    open();
  }
  void TearDown() override {
    host_.reset();
    std::filesystem::remove_all(folder_);
  }
  void open() {
    RoomHostOptions options;
    options.wall_time = [this] { return at_ += 10; };
    options.on_own_thread = [this](std::function<void()> task) {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
      wake_.notify_all();
    };
    auto opened = RoomHost::open(path_, "BKRT", test::source_folder() + "/scenes/start/quarter.json", options);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    host_ = std::move(*opened);
    lead_ = std::make_shared<Listener>();
    wire::Hello hello;
    hello.run = "run " + std::to_string(++runs_);
    hello.views = {"room"};
    hello.kind = "desktop";
    hello.invite = host_->invites().at("facilitator");
    ASSERT_TRUE(host_->greet(lead_, hello));
    operations_ = 0;
  }
  void run_until(const std::function<bool()>& is_over) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!is_over() && std::chrono::steady_clock::now() < end) {
      std::deque<std::function<void()>> tasks;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, std::chrono::milliseconds(10), [this] { return !tasks_.empty(); });
        tasks = std::exchange(tasks_, {});
      }
      for (auto& task : tasks) task();
      host_->turn();
    }
    ASSERT_TRUE(is_over());
  }
  void run_for(int milliseconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    run_until([&] { return std::chrono::steady_clock::now() > end; });
  }
  // The answer, once it is there.
  Json say(Json message) {
    message["id"] = ++operations_;
    host_->hear(*lead_, write_json_line(message));
    Json answer;
    run_until([&] {
      for (const Json& frame : lead_->frames)
        if ((frame["t"] == "ack" || frame["t"] == "nack") && frame["id"] == operations_) answer = frame;
      return !answer.is_null();
    });
    return answer;
  }
  Json event(const char* name, const Json& arguments) {
    return say({{"t", "room"}, {"e", {{"event", name}, {"arguments", arguments}}}});
  }
  Json demand(double value) {
    return say(
        {{"t", "op"},
         {"c",
          {{"command", "set_port"}, {"arguments", {{"node", "library"}, {"port", "smart_volume.demand"}, {"value", value}}}}}});
  }
  // The file as a log, run again.
  void expect_replay() {
    host_.reset();
    auto journal = journal::Journal::open_to_read(path_, full_registry());
    ASSERT_TRUE(journal.ok()) << journal.error().text();
    const auto loaded = (*journal)->load();
    ASSERT_TRUE(loaded.ok());
    const auto log = read_log(journal::log_text((*journal)->room(), *loaded, full_registry()), full_registry());
    ASSERT_TRUE(log.ok()) << log.error().text();
    EXPECT_TRUE(log->has_end) << "an orderly end is told from a crash";
    const auto report = replay(*log, full_registry(), 1);
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_GT(report->checks, 0u);
    EXPECT_FALSE(report->first_mismatch.has_value()) << report->first_mismatch->tick;
  }

  std::filesystem::path folder_, path_;
  std::unique_ptr<RoomHost> host_;
  std::shared_ptr<Listener> lead_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  std::int64_t at_ = 1000;
  int runs_ = 0, operations_ = 0;
};

TEST_F(Restarting, GoesBackAndTellsEverybodyAndTheFileAgrees) {
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  const Json saved = event("save_scenario", {{"id", "before"}, {"name", "Before"}});
  ASSERT_EQ(saved["t"], "ack");
  const std::int64_t tick = saved["k"];
  EXPECT_EQ(event("restart", {{"scenario", "other"}})["why"], "gone");
  ASSERT_EQ(demand(9000)["t"], "ack");
  run_for(400);
  const Json back = event("restart", {{"scenario", "before"}});
  ASSERT_EQ(back["t"], "ack") << back;
  EXPECT_EQ(back["k"], tick) << "from here on the ticks count from there";
  run_until([&] { return lead_->views["room"].contains("epoch") && lead_->views["room"]["epoch"] == 2; });
  EXPECT_EQ(lead_->views["room"]["scenarios"]["before"]["name"], "Before");
  const Json* told = nullptr;
  for (const Json& frame : lead_->frames)
    if (frame["t"] == "ops")
      for (const Json& entry : frame["e"])
        if (entry.contains("back")) told = &frame;
  ASSERT_NE(told, nullptr);
  EXPECT_EQ((*told)["epoch"], 2);
  ASSERT_EQ(demand(5000)["t"], "ack");
  run_for(1500);
  expect_replay();
}

// Its last words are read by no tick of its clock.
TEST_F(Restarting, ARoomThatStandsStillIsComparedToItsEnd) {
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  ASSERT_EQ(event("set_pace", {{"rate", 20}, {"is_paused", true}})["t"], "ack");
  run_for(200);
  ASSERT_EQ(demand(9000)["t"], "ack");
  const std::int64_t tick = host_->health().tick;
  expect_replay();
  open();
  run_for(200);
  EXPECT_EQ(host_->health().tick, tick + 1) << "it goes on with the tick that has read them";
  expect_replay();
}

TEST_F(Restarting, TheWayBackIsInTheFile) {
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(200);
  const std::int64_t tick = event("save_scenario", {{"id", "early"}})["k"];
  ASSERT_EQ(demand(9000)["t"], "ack");
  run_for(400);
  ASSERT_EQ(event("restart", {{"scenario", "early"}})["t"], "ack");
  run_for(300);
  // Closed and opened after a return, and again after one that came from the file.
  for (int again = 0; again < 2; ++again) {
    const std::string hash = host_->health().hash;
    host_.reset();
    open();
    if (::testing::Test::HasFatalFailure()) return;
    EXPECT_GE(host_->health().tick, tick);
    Json welcome;
    run_until([&] {
      for (const Json& frame : lead_->frames)
        if (frame["t"] == "welcome") welcome = frame;
      return !welcome.is_null();
    });
    EXPECT_EQ(welcome["epoch"], 2 + again);
    ASSERT_EQ(demand(7000 + 100 * again)["t"], "ack");
    run_for(200);
    const Json back = event("restart", {{"scenario", "early"}});
    ASSERT_EQ(back["t"], "ack") << back;
    EXPECT_EQ(back["k"], tick);
    run_for(400);
  }
  // One undo brings back what the return has taken away.
  ASSERT_EQ(say({{"t", "undo"}})["t"], "ack");
  run_for(1300);
  expect_replay();
}

// A tick reads the scene that stands before it: what is taken away and brought back between two ticks keeps its state.
TEST_F(Restarting, AVolumeThatIsBroughtBackAfterTheRoomWasOpenedAgainIsAsTheFileHasIt) {
  const auto change = [&](const Json& command, const Json& arguments) {
    return say({{"t", "op"}, {"c", {{"command", command}, {"arguments", arguments}}}})["t"];
  };
  const Json library = {{"id", "library"}, {"node", {{"types", {{"smart_volume", {{"demand", 9000}}}}}}}};
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  ASSERT_EQ(event("set_pace", {{"rate", 20}, {"is_paused", true}})["t"], "ack");
  ASSERT_EQ(change("remove_node", {{"id", "library"}}), "ack");
  host_.reset();
  open();
  if (::testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(change("add_node", library), "ack");
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  // The same where the file has a snapshot from between the two.
  ASSERT_EQ(event("set_pace", {{"rate", 20}, {"is_paused", true}})["t"], "ack");
  ASSERT_EQ(change("remove_node", {{"id", "library"}}), "ack");
  for (int k = 0; k < 500; ++k)
    ASSERT_EQ(change("set_setting", {{"setting", "title"}, {"value", "Title " + std::to_string(k)}}), "ack");
  run_for(100);
  ASSERT_EQ(change("add_node", library), "ack");
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  host_.reset();
  open();
  if (::testing::Test::HasFatalFailure()) return;
  ASSERT_EQ(event("set_pace", {{"rate", 20}})["t"], "ack");
  run_for(300);
  expect_replay();
}

}  // namespace
}  // namespace bl::serve
