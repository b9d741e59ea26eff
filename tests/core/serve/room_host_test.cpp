// A room that runs, without a network: guests that write down what they are sent, and a file that is closed and opened again.
#include "core/serve/room_host.h"

#include <algorithm>
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
#include "core/serve/readiness.h"
#include "tests/support/hand_clock.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl::serve {
namespace {

struct FakeGuest : Guest {
  void send(std::shared_ptr<const std::string> frame) override {
    frames.push_back(*parse_json(*frame));
    sizes.push_back(frame->size());
  }
  void close(CloseCode code, const std::string& why) override {
    if (closed == 0) closed = static_cast<int>(code), reason = why;
  }
  std::size_t unsent() const override { return is_stalled ? (2u << 20) : 0; }

  const Json* last(const char* t) const {
    for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
      if ((*frame)["t"] == t) return &*frame;
    return nullptr;
  }
  std::vector<Json> frames;
  std::vector<std::size_t> sizes;  // of the frames [bytes]
  int closed = 0;
  std::string reason;
  bool is_stalled = false;
};

constexpr double kStep = 0.1;  // of the clock that a test moves, for each turn of the room [s]

class RoomHosts : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_room_" + std::to_string(::getpid()) + "_" +
                                                        ::testing::UnitTest::GetInstance()->current_test_info()->name());
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
    options.addresses = addresses_;
    options.surroundings = surroundings_;
    options.clock = clock_;
    options.keys_renewed = [this](const RoomHost&) { ++renewals_; };
    options.on_own_thread = [this](std::function<void()> task) {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
      wake_.notify_all();
    };
    auto opened = RoomHost::open(path_, "BKRT", test::source_folder() + "/scenes/start/quarter.json", options);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    host_ = std::move(*opened);
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
      if (clock_ == &by_hand_) by_hand_.advance(kStep);
      for (auto& task : tasks) task();
      host_->turn();
    }
    ASSERT_TRUE(is_over());
  }
  std::shared_ptr<FakeGuest> join(const std::string& run, const std::string& role, std::vector<std::string> views,
                                  const std::string& token = "") {
    auto guest = std::make_shared<FakeGuest>();
    wire::Hello hello;
    hello.run = run;
    hello.token = token;
    hello.views = std::move(views);
    if (!role.empty()) hello.invite = host_->invites().at(role);
    EXPECT_TRUE(host_->greet(guest, hello));
    run_until([&] { return guest->last("welcome") != nullptr; });
    return guest;
  }

  // With the next number of that run.
  void renew(FakeGuest& lead, int id) {
    const int before = renewals_;
    host_->hear(lead, R"({"t": "room", "id": )" + std::to_string(id) + R"(, "e": {"event": "renew_keys"}})");
    run_until([&] { return renewals_ > before; });
  }
  // Why nobody gets a seat by this key.
  std::string refusal_of(const std::string& invite) {
    const auto stranger = std::make_shared<FakeGuest>();
    wire::Hello hello;
    hello.run = "stranger";
    hello.invite = invite;
    EXPECT_FALSE(host_->greet(stranger, hello));
    EXPECT_EQ(stranger->closed, 4401);
    return stranger->reason;
  }
  std::shared_ptr<FakeGuest> follow(const std::string& key) {
    auto laptop = std::make_shared<FakeGuest>();
    wire::Hello hello;
    hello.run = "second laptop";
    hello.kind = "follower";
    hello.token = key;
    host_->greet(laptop, hello);
    return laptop;
  }

  // From now on the time of the room passes only where the test lets it.
  test::HandClock& open_by_hand() {
    host_.reset();
    clock_ = &by_hand_;
    open();
    return by_hand_;
  }

  std::filesystem::path folder_, path_;
  test::HandClock by_hand_;
  host::Clock* clock_ = &host::real_clock();
  std::unique_ptr<RoomHost> host_;
  std::vector<std::string> addresses_;
  std::function<Surroundings()> surroundings_;
  int renewals_ = 0;  // that the host has told of
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  std::int64_t at_ = 1000;
};

TEST_F(RoomHosts, AnAnswerComesAfterTheDisk) {
  const auto lead = join("a", "facilitator", {"room", "plan"});
  EXPECT_EQ((*lead->last("welcome"))["you"]["role"], "facilitator");
  const std::string frame = R"({"t": "room", "id": 1, "e": {"event": "mark", "arguments": {"text": "Begin"}}})";
  host_->hear(*lead, frame);
  EXPECT_EQ(lead->last("ack"), nullptr) << "not before it is stored";
  run_until([&] { return lead->last("ack") != nullptr; });
  const Json first = *lead->last("ack");
  host_->hear(*lead, frame);
  run_until([&] { return std::count(lead->frames.begin(), lead->frames.end(), first) == 2; });
  run_until([&] { return lead->last("state") != nullptr; });
}

// Pages take the first of each view after the welcome for the whole of it.
TEST_F(RoomHosts, NothingIsShownBeforeTheWelcome) {
  const auto lead = join("a", "facilitator", {"room"});
  for (int k = 0; k < 10; ++k) {
    auto guest = std::make_shared<FakeGuest>();
    wire::Hello hello;
    hello.run = "guest " + std::to_string(k);
    hello.views = {"room", "plan"};
    host_->hear(*lead,
                R"({"t": "room", "id": )" + std::to_string(k + 1) + R"(, "e": {"event": "mark", "arguments": {"text": "x"}}})");
    ASSERT_TRUE(host_->greet(guest, hello));
    run_until([&] {
      return std::any_of(guest->frames.begin(), guest->frames.end(),
                         [](const Json& frame) { return frame["t"] == "state" && frame["view"] == "room"; });
    });
    EXPECT_EQ(guest->frames.front()["t"], "welcome");
  }
}

TEST_F(RoomHosts, ItGoesOnWhereItWas) {
  auto lead = join("a", "facilitator", {"room"});
  const std::string token = (*lead->last("welcome"))["token"], invite = host_->invites().at("designer");
  host_->hear(*lead,
              R"({"t": "op", "id": 1, "c": {"command": "set_setting", "arguments": {"setting": "title", "value": "Ours"}}})");
  host_->hear(*lead, R"({"t": "room", "id": 2, "e": {"event": "set_phase", "arguments": {"name": "Look"}}})");
  run_until([&] { return lead->last("ack") != nullptr && (*lead->last("ack"))["id"] == 2; });
  host_->hear(*lead, R"({"t": "room", "id": 3, "e": {"event": "set_pace", "arguments": {"rate": 20}}})");
  run_until([&] { return host_->health().tick > 70; });
  const std::int64_t seq = host_->health().seq;
  host_.reset();
  open();
  EXPECT_EQ(host_->invites().at("designer"), invite);
  EXPECT_GE(host_->health().tick, 60) << "the hash of the sixtieth tick was stored";
  EXPECT_GE(host_->health().seq, seq);
  lead = join("a", "", {"room"}, token);
  EXPECT_EQ((*lead->last("welcome"))["done"], 3);
  EXPECT_FALSE(lead->last("welcome")->contains("token"));
  run_until([&] { return lead->last("state") != nullptr; });
  EXPECT_EQ((*lead->last("state"))["set"]["phase"]["name"], "Look");
}

// A view as a guest sees it, from all that it was sent.
std::map<std::string, Json> view_of(const FakeGuest& guest, std::string_view name) {
  std::map<std::string, Json> seen;
  for (const Json& frame : guest.frames) {
    if (frame["t"] != "state" || frame["view"] != name) continue;
    if (frame.contains("whole")) seen.clear();
    for (const auto& [key, content] : frame["set"].items()) seen[key] = content;
    for (const Json& key : frame.value("drop", Json::array())) seen.erase(key.get<std::string>());
  }
  return seen;
}

std::map<std::string, Json> comments_of(const FakeGuest& guest) { return view_of(guest, "comments"); }

// Who has rated nothing sees what all others of these see, and whoever rates one sees it as their own from then on.
TEST_F(RoomHosts, CommentsComeToAllAndARatingIsOnesOwn) {
  auto lead = join("a", "facilitator", {"comments"}), anna = join("b", "participant", {"comments"});
  const auto says = [&](FakeGuest& who, int id, const Json& event) {
    host_->hear(who, Json{{"t", "room"}, {"id", id}, {"e", event}}.dump());
  };
  says(*lead, 1, {{"event", "set_phase"}, {"arguments", {{"name", "Say it"}, {"activities", {"comment"}}}}});
  says(*lead, 2, {{"event", "comment"}, {"arguments", {{"id", "first"}, {"text", "A bench"}}}});
  run_until([&] { return comments_of(*lead).contains("first") && comments_of(*anna).contains("first"); });
  says(*anna, 1, {{"event", "rate_comment"}, {"arguments", {{"comment", "first"}, {"rating", 1}}}});
  run_until([&] { return comments_of(*lead)["first"]["plus"] == 1 && comments_of(*anna)["first"]["plus"] == 1; });
  EXPECT_EQ(comments_of(*anna)["first"]["mine"], 1);
  EXPECT_EQ(comments_of(*lead)["first"]["mine"], 0);
  // Who comes later has all of them, with what they have rated before.
  auto late = join("c", "participant", {"comments"});
  says(*lead, 3, {{"event", "comment"}, {"arguments", {{"id", "second"}, {"text", "A tree"}}}});
  for (const auto& guest : {lead, anna, late}) run_until([&] { return comments_of(*guest).contains("second"); });
  EXPECT_EQ(comments_of(*late)["first"]["mine"], 0);
  EXPECT_EQ(comments_of(*anna)["first"]["mine"], 1);
  // A command and its ticks bring no comments once more.
  const auto count = [&] {
    return std::count_if(anna->frames.begin(), anna->frames.end(), [](const Json& frame) { return frame["t"] == "state"; });
  };
  const auto before = count();
  host_->hear(*lead,
              R"({"t": "op", "id": 4, "c": {"command": "set_setting", "arguments": {"setting": "title", "value": "Ours"}}})");
  run_until([&] { return lead->last("ack") != nullptr && (*lead->last("ack"))["id"] == 4; });
  const std::int64_t tick = host_->health().tick;
  run_until([&] { return host_->health().tick > tick + 3; });
  EXPECT_EQ(count(), before);
}

// Who comes late can look at the plan as it was when something was decided.
TEST_F(RoomHosts, ThePlanOfEachDecisionIsThatOfJustBeforeIt) {
  auto lead = join("a", "facilitator", {"plan", "past", "decisions"});
  const std::string token = (*lead->last("welcome"))["token"];
  // Before the first tick there are no volumes on it.
  std::string key, name;
  run_until([&] {
    for (const auto& [one, content] : view_of(*lead, "plan"))
      if (key.empty() && one.starts_with("n/") && content["kind"] == "volume") key = one, name = content["name"];
    return !key.empty();
  });
  const auto decide = [&](int id) {
    const std::size_t before = view_of(*lead, "decisions").size();
    host_->hear(*lead,
                R"({"t": "room", "id": )" + std::to_string(id) + R"(, "e": {"event": "mark", "arguments": {"text": "x"}}})");
    run_until([&] { return view_of(*lead, "decisions").size() > before; });
    return view_of(*lead, "decisions").rbegin()->first + "/" + key;  // entries have one digit here
  };
  const std::string first = decide(1);
  run_until([&] { return view_of(*lead, "past").contains(first); });
  EXPECT_EQ(view_of(*lead, "past")[first]["name"], name);
  host_->hear(*lead, R"({"t": "op", "id": 2, "c": {"command": "rename_node", "arguments": {"id": ")" + key.substr(2) +
                         R"(", "name": "Another"}}})");
  run_until([&] { return view_of(*lead, "plan")[key]["name"] == "Another"; });
  const std::string second = decide(3);
  run_until([&] { return view_of(*lead, "past").contains(second); });
  EXPECT_EQ(view_of(*lead, "past")[second]["name"], "Another");
  EXPECT_EQ(view_of(*lead, "past")[first]["name"], name) << "those of before stay";
  // A server that is started again knows the decisions, and has not seen the plans.
  host_.reset();
  open();
  lead = join("a", "", {"past", "decisions"}, token);
  run_until([&] { return !view_of(*lead, "decisions").empty(); });
  EXPECT_TRUE(view_of(*lead, "past").empty());
}

// The indices of the frames that bring shapes.
std::vector<std::size_t> shapes_of(const FakeGuest& guest) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < guest.frames.size(); ++k)
    if (guest.frames[k]["t"] == "state" && guest.frames[k]["view"] == "shapes") found.push_back(k);
  return found;
}

constexpr double kBytesOfShapes = 12000;  // that a phone can take [1/s]

// Volumes of the quarter move for a while after it is opened.
TEST_F(RoomHosts, ShapesInMotionComeNoFasterThanAPhoneCanTake) {
  test::HandClock& clock = open_by_hand();
  const auto guest = join("phone", "", {"room", "shapes"});
  double after = 0;
  std::size_t seen = 0;
  run_until([&] {
    const std::vector<std::size_t> shapes = shapes_of(*guest);
    for (; seen < shapes.size(); ++seen) {
      EXPECT_GE(clock.now(), after);
      EXPECT_EQ(guest->frames[shapes[seen]].contains("whole"), seen == 0);
      after = clock.now() + static_cast<double>(guest->sizes[shapes[seen]]) / kBytesOfShapes;
    }
    return seen >= 4;
  });
}

// Else the room would hold an old view for each of them, and make what leads on from it for each.
TEST_F(RoomHosts, WhoComesLaterSeesTheSameShapesAtTheSameTimesAsAllOthers) {
  open_by_hand();
  const auto first = join("first", "", {"shapes"});
  const auto run_until_shapes = [&](const FakeGuest& guest, std::size_t count) {
    run_until([&] { return shapes_of(guest).size() >= count; });
  };
  run_until_shapes(*first, 2);
  const auto second = join("second", "", {"shapes"});
  run_until_shapes(*second, 1);
  EXPECT_TRUE(second->frames[shapes_of(*second).front()].contains("whole"));
  const std::size_t before = shapes_of(*first).size();
  run_until_shapes(*first, before + 2);
  const std::vector<std::size_t> of_first = shapes_of(*first), of_second = shapes_of(*second);
  ASSERT_EQ(of_second.size(), 3u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(first->frames[of_first[before + k]], second->frames[of_second[1 + k]]) << k;
}

TEST_F(RoomHosts, AGuestThatTakesNothingIsSentAwayAndNobodyElse) {
  const auto lead = join("a", "facilitator", {"room"}), slow = join("b", "", {"room"});
  slow->is_stalled = true;
  run_until([&] { return slow->closed != 0; });
  EXPECT_EQ(slow->closed, 4503);
  EXPECT_EQ(lead->closed, 0);
  host_->leave(*slow);
  host_->leave(*slow);
}

TEST_F(RoomHosts, WhoIsRemovedIsToldSo) {
  const auto lead = join("a", "facilitator", {}), guest = join("b", "", {"room"});
  host_->hear(*lead, R"({"t": "room", "id": 1, "e": {"event": "remove_seat", "arguments": {"seat": 2}}})");
  run_until([&] { return guest->closed != 0; });
  EXPECT_EQ(guest->closed, 4403);
}

TEST_F(RoomHosts, ARoomAtRestLetsTheTicksSleep) {
  if (test::kIsSanitized) GTEST_SKIP() << "it takes minutes to settle";
  const auto lead = join("a", "facilitator", {"room", "plan"});
  host_->hear(*lead, R"({"t": "room", "id": 1, "e": {"event": "set_pace", "arguments": {"rate": 20}}})");
  std::int64_t before = -1;
  // Settled: the tick counts on without new moments, and nothing more is sent.
  for (int quiet = 0; quiet < 3;) {
    const std::size_t sent = lead->frames.size();
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
    run_until([&] { return std::chrono::steady_clock::now() > end; });
    quiet = lead->frames.size() == sent ? quiet + 1 : 0;
    ASSERT_LT(++before, 200) << "it never comes to rest";
  }
}

// --- Keys -----------------------------------------------------------------------------------------------------------

TEST_F(RoomHosts, RenewedKeysVoidTheInvitationsOfBeforeAndNothingElse) {
  const auto lead = join("a", "facilitator", {"keys"}), guest = join("b", "designer", {"keys"});
  const std::string token = (*guest->last("welcome"))["token"], follow = host_->follow_key();
  const auto first = host_->invites();
  const auto is_shown = [&](const std::map<std::string, std::string>& keys) {
    const Json* state = lead->last("state");
    return state != nullptr && (*state)["set"] == Json(keys);
  };
  run_until([&] { return is_shown(first); });
  host_->hear(*guest, R"({"t": "room", "id": 1, "e": {"event": "renew_keys"}})");
  run_until([&] { return guest->last("nack") != nullptr; });
  EXPECT_EQ((*guest->last("nack"))["why"], "right");
  EXPECT_EQ(host_->invites(), first);

  renew(*lead, 1);
  const auto second = host_->invites();
  for (const auto& [role, key] : second)
    for (const auto& [other, old] : first) EXPECT_NE(key, old) << role << " " << other;
  EXPECT_NE(host_->follow_key(), follow);
  EXPECT_EQ(renewals_, 1) << "told once, when it is stored";
  run_until([&] { return is_shown(second); });
  for (const Json& frame : guest->frames)
    if (frame["t"] == "state") { EXPECT_EQ(frame["set"], Json::object()) << "only who leads sees keys"; }

  EXPECT_EQ(refusal_of(first.at("designer")), "the facilitator has renewed the keys: ask for a new invitation");
  EXPECT_EQ(refusal_of("0123456789abcdef"), "this invitation is not one of this room");
  EXPECT_EQ((*join("c", "designer", {})->last("welcome"))["you"]["role"], "designer");
  EXPECT_EQ((*join("d", "", {}, token)->last("welcome"))["you"]["seat"], 2);

  // Another server on the same file has the same keys, and the next ones differ from all before.
  const std::string followed = host_->follow_key();
  host_.reset();
  open();
  EXPECT_EQ(host_->invites(), second);
  EXPECT_EQ(host_->follow_key(), followed);
  EXPECT_EQ(refusal_of(first.at("facilitator")), "the facilitator has renewed the keys: ask for a new invitation");
  renew(*join("e", "facilitator", {}), 1);
  EXPECT_EQ(refusal_of(first.at("viewer")), refusal_of(second.at("viewer")));
  EXPECT_EQ(renewals_, 2);
}

TEST_F(RoomHosts, KeysStandInNoLog) {
  const auto lead = join("a", "facilitator", {"keys"});
  renew(*lead, 1);
  const auto invites = host_->invites();
  host_.reset();
  const auto journal = journal::Journal::open_to_read(path_, full_registry());
  ASSERT_TRUE(journal.ok()) << journal.error().text();
  const auto loaded = (*journal)->load();
  ASSERT_TRUE(loaded.ok());
  const std::string log = journal::log_text((*journal)->room(), *loaded, full_registry());
  EXPECT_NE(log.find("renew_keys"), std::string::npos);
  for (const auto& [role, key] : invites) EXPECT_EQ(log.find(key), std::string::npos) << role;
}

TEST_F(RoomHosts, ALaptopThatFollowsByTheOldKeyIsSentAway) {
  addresses_ = {"http://192.168.1.5:8080"};
  host_.reset();
  open();
  const auto lead = join("a", "facilitator", {"room"});
  EXPECT_EQ((*lead->last("welcome"))["addresses"], Json(addresses_));
  const auto by_key = follow(host_->follow_key()), by_token = follow((*lead->last("welcome"))["token"]);
  host_->hear(*by_key, R"({"t": "follow", "address": "http://192.168.1.7:8080"})");
  host_->hear(*by_token, R"({"t": "follow"})");
  const Json all = {"http://192.168.1.5:8080", "http://192.168.1.7:8080"};
  ASSERT_NE(lead->last("say"), nullptr) << "who is here already learns the address";
  EXPECT_EQ((*lead->last("say"))["args"]["addresses"], all);
  run_until([&] { return by_key->last("copy") != nullptr && by_token->last("copy") != nullptr; });
  const std::string old = host_->follow_key();
  renew(*lead, 1);
  EXPECT_EQ(by_key->closed, 4401);
  EXPECT_EQ(by_key->reason, "the facilitator has renewed the keys");
  EXPECT_EQ(by_token->closed, 0);
  EXPECT_EQ(host_->health().followers, 1u);
  EXPECT_EQ(follow(old)->closed, 4401);
  EXPECT_EQ(follow(host_->follow_key())->closed, 0);
  EXPECT_EQ((*join("b", "", {})->last("welcome"))["addresses"], all) << "also of a laptop that is away";
}

TEST_F(RoomHosts, AnAddressOfALaptopIsNothingElse) {
  for (const char* bad :
       {"javascript:alert(1)", "http://a b", "http://x/y", "http://a@b", "ftp://x", "http://", "x", "http://x\"y"}) {
    const auto laptop = follow(host_->follow_key());
    host_->hear(*laptop, write_json_line({{"t", "follow"}, {"address", bad}}));
    EXPECT_EQ(laptop->closed, 4400) << bad;
    host_->leave(*laptop);
  }
  EXPECT_FALSE(join("a", "", {})->last("welcome")->contains("addresses"));
}

TEST_F(RoomHosts, OnlyFacilitatorsHearHowTheRoomIs) {
  const auto lead = join("lead", "facilitator", {"room"}), other = join("other", "designer", {"room"});
  run_until([&] { return lead->last("health") != nullptr; });
  const Json& health = *lead->last("health");
  const auto read = wire::read_message<wire::HealthOut>(health);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_GT(read->wanted, 0);
  EXPECT_GT(read->journal, 0);
  EXPECT_EQ(read->file, path_.string());
  EXPECT_EQ(read->battery, -1) << "nobody has said anything of this computer";
  const Finding pace = judge_pace(read->tick_ms / 1000, read->wanted, false),
                storing = judge_storing(read->disk_ms / 1000, read->disk_slow_ms / 1000);
  EXPECT_EQ(health["verdicts"], (Json{{"ticks", word_of(pace.verdict)}, {"disk", word_of(storing.verdict)}}))
      << "what nobody knows has no verdict";
  EXPECT_EQ(other->last("health"), nullptr);
}

TEST_F(RoomHosts, HealthJudgesWhatTheComputerSays) {
  host_.reset();
  addresses_ = {"http://192.168.1.5:8080", "http://10.0.0.2:8080"};
  surroundings_ = [] {
    Surroundings around;
    around.machine.battery = 0.1;
    around.machine.is_on_mains = false;
    around.machine.disk_free = 1 << 20;
    around.reached["10.0.0.2"] = 3;
    around.machine.wireless["wlan0"] = 0.2;
    return around;
  };
  open();
  const auto lead = join("lead", "facilitator", {"room"});
  run_until([&] { return lead->last("health") != nullptr; });
  Json verdicts = (*lead->last("health"))["verdicts"];
  EXPECT_TRUE(verdicts.contains("ticks") && verdicts.contains("disk"));
  verdicts.erase("ticks"), verdicts.erase("disk");
  EXPECT_EQ(verdicts, (Json{{"power", "bad"},
                            {"space", "bad"},
                            {"wireless/wlan0", "look"},
                            {"reached/http://10.0.0.2:8080", "good"},
                            {"reached/http://192.168.1.5:8080", "look"}}));
}

}  // namespace
}  // namespace bl::serve
