// Files of a room that runs, its minutes and its plan: who gets them, what they hold, and that one is made at a time.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>

#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/export/format.h"
#include "core/journal/journal.h"
#include "core/minutes/minutes.h"
#include "core/serve/pages.h"
#include "tests/support/place/source_folder.h"

namespace bl::serve {
namespace {

struct QuietGuest : Guest {
  void send(std::shared_ptr<const std::string> frame) override {
    const auto json = parse_json(*frame);
    if ((*json)["t"] == "welcome") token = (*json)["token"].get<std::string>();
    if ((*json)["t"] == "ack") ++answered;
  }
  void close(CloseCode, const std::string& why) override { reason = why; }
  std::size_t unsent() const override { return 0; }
  std::string token, reason;
  int answered = 0;
};

class FilesOfRooms : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_files_" + std::to_string(::getpid()) + "_" +
                                                        ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    RoomHostOptions options;
    options.wall_time = [this] { return at_ += 1000; };
    options.on_own_thread = [this](std::function<void()> task) {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
      wake_.notify_all();
    };
    auto opened = RoomHost::open(path(), "BKRT", test::source_folder() + "/scenes/start/quarter.json", options);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    rooms_.emplace("BKRT", std::move(*opened));
    lead_ = join("facilitator");
    guest_ = join("participant");
  }
  void TearDown() override {
    rooms_.clear();
    std::filesystem::remove_all(folder_);
  }

  std::string path() const { return folder_ / "room.blsession"; }
  RoomHost& room() { return *rooms_.at("BKRT"); }
  void run_until(const std::function<bool()>& is_over) {
    for (int k = 0; k < 2000 && !is_over(); ++k) {
      std::deque<std::function<void()>> tasks;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, std::chrono::milliseconds(10), [this] { return !tasks_.empty(); });
        tasks = std::exchange(tasks_, {});
      }
      for (auto& task : tasks) task();
      room().turn();
    }
    ASSERT_TRUE(is_over());
  }
  std::shared_ptr<QuietGuest> join(const std::string& role) {
    auto guest = std::make_shared<QuietGuest>();
    wire::Hello hello;
    hello.run = role;
    hello.invite = room().invites().at(role);
    EXPECT_TRUE(room().greet(guest, hello)) << guest->reason;
    run_until([&] { return !guest->token.empty(); });
    return guest;
  }
  void say(QuietGuest& guest, const std::string& message) {
    const int before = guest.answered;
    room().hear(guest, message);
    run_until([&] { return guest.answered > before; });
  }
  void close_room() { say(*lead_, R"({"t": "room", "id": 1, "e": {"event": "close_room"}})"); }

  // What comes of a form; nothing as long as there is no answer.
  std::shared_ptr<std::optional<Response>> post(const std::string& body, const std::string& target = "/minutes") {
    auto answer = std::make_shared<std::optional<Response>>();
    Pages(rooms_, "")
        .answer({.method = "POST", .target = target, .body = body, .host = "192.168.1.5"},
                [answer](Response response) { *answer = std::move(response); });
    return answer;
  }
  std::string form(const std::string& token, const std::string& file = "minutes.html") const {
    return "room=BKRT&file=" + file + "&token=" + token;
  }
  Response answered(const std::string& body, const std::string& target = "/minutes") {
    const auto answer = post(body, target);
    run_until([&] { return answer->has_value(); });
    return **answer;
  }

  std::filesystem::path folder_;
  Rooms rooms_;
  std::shared_ptr<QuietGuest> lead_, guest_;
  std::int64_t at_ = 1772357400000;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
};

TEST_F(FilesOfRooms, MinutesAreThoseOfTheSessionFile) {
  say(*guest_, R"({"t": "room", "id": 1, "e": {"event": "comment", "arguments": {"id": "c1", "text": "Keep <the> willow"}}})");
  close_room();
  const std::vector<std::string> names = {"minutes.html", "decisions.csv", "comments.csv",
                                          "votes.csv",    "log.jsonl",     "scenes/end.json"};
  std::map<std::string, Response> served;
  for (const std::string& name : names) served[name] = answered(form(lead_->token, name));
  rooms_.clear();  // else the file is locked
  const auto journal = journal::Journal::open_to_read(path(), full_registry());
  ASSERT_TRUE(journal.ok()) << journal.error().text();
  const auto account = minutes::account_of((*journal)->room(), *(*journal)->load(), full_registry());
  ASSERT_TRUE(account.ok()) << account.error().text();
  for (const auto& [name, content] : minutes::files_of(*account)) {
    EXPECT_EQ(served[name].status, 200) << name;
    // These two may say more by now: the room has noted that its guests are gone, and the hash of its last tick.
    const bool may_differ = name == "log.jsonl" || name == "minutes.html";
    EXPECT_TRUE(may_differ || served[name].body == content) << name;
    EXPECT_EQ(served[name].fields.at("Cache-Control"), "no-store");
    EXPECT_EQ(served[name].fields.contains("Content-Disposition"), name != "minutes.html") << name;
  }
  EXPECT_NE(served["minutes.html"].body.find("Keep &lt;the&gt; willow"), std::string::npos);
  EXPECT_NE(served["minutes.html"].body.find("the room was closed"), std::string::npos);
  EXPECT_NE(served["comments.csv"].body.find("Keep <the> willow"), std::string::npos);
  // Its one style may be used; there is no script.
  EXPECT_NE(served["minutes.html"].inline_sources.find("'sha256-"), std::string::npos);
  EXPECT_EQ(served["minutes.html"].body.find("<script"), std::string::npos);
}

TEST_F(FilesOfRooms, MinutesAreForThoseWhoLead) {
  close_room();
  const Response refused = answered(form(guest_->token));
  EXPECT_EQ(refused.status, 403);
  EXPECT_EQ(answered(form("")).status, 403);
  EXPECT_EQ(answered(form(room().invites().at("facilitator"))).status, 403) << "an invitation is no seat";
  const Response elsewhere = answered("room=QQQQ&file=minutes.html&token=" + lead_->token);
  EXPECT_EQ(elsewhere.status, 403);
  EXPECT_EQ(elsewhere.body, refused.body) << "nobody learns here which rooms there are";
  EXPECT_EQ(answered(form(lead_->token, "../room.blsession")).status, 404);
  EXPECT_EQ(answered(form(lead_->token, "")).status, 404);
  // Nothing is done for a token in an address.
  const auto in_address = post("", "/minutes?" + form(lead_->token));
  run_until([&] { return in_address->has_value(); });
  EXPECT_EQ((*in_address)->status, 403);
}

TEST_F(FilesOfRooms, TheirPageIsSharedWhereTheCloseSaysSo) {
  const auto out = join("designer"), viewer = join("viewer");
  say(*lead_, R"({"t": "room", "id": 1, "e": {"event": "set_door", "arguments": {"door": "asks"}}})");
  const auto admitted = room().admit_by_code();
  const std::string waiting = std::get<room::Admission>(admitted).token;
  EXPECT_EQ(answered(form(guest_->token)).status, 403) << "the session goes on";
  say(*lead_, R"({"t": "room", "id": 2, "e": {"event": "remove_seat", "arguments": {"seat": 3}}})");
  say(*lead_, R"({"t": "room", "id": 3, "e": {"event": "close_room", "arguments": {"shares_minutes": true}}})");
  const Response page = answered(form(guest_->token));
  ASSERT_EQ(page.status, 200) << page.body;
  EXPECT_NE(page.body.find("the room was closed"), std::string::npos);
  EXPECT_EQ(answered(form(viewer->token)).status, 403) << "who only watches took no part, and may have come by the code alone";
  for (const std::string file :
       {"decisions.csv", "comments.csv", "votes.csv", "log.jsonl", "scenes/end.json", "", "../minutes.html"})
    EXPECT_EQ(answered(form(guest_->token, file)).status, 403) << file;
  EXPECT_EQ(answered(form(out->token)).status, 403) << "sent out";
  EXPECT_EQ(answered(form(waiting)).status, 403) << "never let in";
  EXPECT_EQ(answered(form("")).status, 403);
  EXPECT_EQ(answered(form(lead_->token, "log.jsonl")).status, 200);
}

// Everybody sees the button in the same moment.
TEST_F(FilesOfRooms, WhoeverTookPartWaitsForTheSharedPage) {
  say(*lead_, R"({"t": "room", "id": 1, "e": {"event": "close_room", "arguments": {"shares_minutes": true}}})");
  const auto own = post(form(lead_->token));
  std::vector<std::shared_ptr<std::optional<Response>>> pages;
  for (int k = 0; k < 30; ++k) pages.push_back(post(form(guest_->token)));
  const auto again = post(form(lead_->token));
  run_until([&] {
    return own->has_value() && std::all_of(pages.begin(), pages.end(), [](const auto& one) { return one->has_value(); });
  });
  EXPECT_EQ((*own)->status, 200);
  EXPECT_EQ((*again)->status, 409) << "who leads is told at once";
  for (const auto& page : pages) {
    EXPECT_EQ((*page)->status, 200);
    EXPECT_EQ((*page)->body, (**pages.front()).body);
  }
}

TEST_F(FilesOfRooms, OneIsMadeAtATime) {
  const auto first = post(form(lead_->token)), second = post(form(lead_->token));
  ASSERT_TRUE(second->has_value()) << "it is told at once";
  EXPECT_EQ((*second)->status, 409);
  EXPECT_NE((*second)->body.find("try again"), std::string::npos);
  EXPECT_FALSE(first->has_value());
  // The room goes on meanwhile.
  say(*guest_, R"({"t": "room", "id": 1, "e": {"event": "comment", "arguments": {"id": "c1", "text": "Still here"}}})");
  run_until([&] { return first->has_value(); });
  EXPECT_EQ((*first)->status, 200);
  EXPECT_EQ((*first)->body.find("Still here"), std::string::npos) << "of what was stored when they were asked for";
  EXPECT_NE(answered(form(lead_->token)).body.find("Still here"), std::string::npos);
}

TEST_F(FilesOfRooms, ARoomThatEndsMeanwhileEndsInOrder) {
  const auto answer = post(form(lead_->token));
  room().turn();
  const bool was_answered = answer->has_value();
  rooms_.clear();
  for (auto& task : std::exchange(tasks_, {})) task();
  EXPECT_EQ(answer->has_value(), was_answered) << "nothing of a room is touched that is gone";
}

std::string plan_form(const std::string& token, const std::string& format, const std::string& more = "") {
  return "room=BKRT&token=" + token + "&format=" + format + more;
}

TEST_F(FilesOfRooms, ThePlanComesInEveryFormat) {
  const auto designer = join("designer");
  for (const exporting::FormatDefinition& format : exporting::all_formats()) {
    const std::string own_metres =
        format.id == "geojson" ? "&option.coordinates=scene" : "";  // the quarter lies nowhere on Earth
    const Response got = answered(plan_form(designer->token, format.id, own_metres), "/export");
    if (!format.shell.empty()) {  // the built page is not there
      EXPECT_EQ(got.status, 400) << format.id;
      EXPECT_NE(got.body.find("page"), std::string::npos) << got.body;
      continue;
    }
    ASSERT_EQ(got.status, 200) << format.id << ": " << got.body;
    EXPECT_TRUE(exporting::has_mark(format, got.body, got.body)) << format.id << ": " << got.body.substr(0, 40);
    EXPECT_EQ(got.fields.at("Content-Disposition"), "attachment; filename=\"plan" + format.ending + "\"");
    EXPECT_EQ(got.fields.at("Cache-Control"), "no-store");
  }
}

// The state of the room as it is: a volume that somebody has added a moment ago is in it, and the hash is the one of the room.
TEST_F(FilesOfRooms, ThePlanIsTheOneOfNow) {
  say(*lead_,
      R"({"t": "op", "id": 1, "c": {"command": "rename_node", "arguments": {"id": "library", "name": "Reading \u4e66 room"}}})");
  const Response got = answered(plan_form(lead_->token, "csv"), "/export");
  ASSERT_EQ(got.status, 200) << got.body;
  EXPECT_NE(got.body.find("Reading \u4e66 room"), std::string::npos) << got.body.substr(0, 400);
}

TEST_F(FilesOfRooms, ThePlanIsForThoseWhoMay) {
  EXPECT_EQ(answered(plan_form(lead_->token, "csv"), "/export").status, 200);
  const Response refused = answered(plan_form(guest_->token, "csv"), "/export");
  EXPECT_EQ(refused.status, 403);
  EXPECT_EQ(answered(plan_form("", "csv"), "/export").status, 403);
  // Whoever was sent out gets nothing more.
  const auto designer = join("designer");
  EXPECT_EQ(answered(plan_form(designer->token, "csv"), "/export").status, 200);
  say(*lead_, R"({"t": "room", "id": 1, "e": {"event": "remove_seat", "arguments": {"seat": 3}}})");
  EXPECT_EQ(answered(plan_form(designer->token, "csv"), "/export").status, 403);
  EXPECT_EQ(answered("room=QQQQ&format=csv&token=" + lead_->token, "/export").body, refused.body);
  const auto said = [&](const std::string& format, const std::string& more) {
    const Response got = answered(plan_form(lead_->token, format, more), "/export");
    EXPECT_EQ(got.status, 400) << format << more;
    return got.body;
  };
  EXPECT_NE(said("dwg", "").find("there is no format `dwg`"), std::string::npos);
  EXPECT_NE(said("svg", "&option.scale=tall").find("`tall`"), std::string::npos);
  EXPECT_NE(said("svg", "&option.scal=200").find("did you mean `scale`"), std::string::npos) << said("svg", "&option.scal=200");
}

TEST_F(FilesOfRooms, OptionsAreThoseOfTheDeclaration) {
  std::optional<Response> list;
  Pages(rooms_, "").answer({.method = "GET", .target = "/formats", .body = "", .host = "192.168.1.5"}, [&](Response response) {
    list = std::move(response);
  });
  ASSERT_TRUE(list.has_value());
  const auto formats = parse_json(list->body);
  ASSERT_TRUE(formats.ok());
  ASSERT_EQ(formats->size(), exporting::all_formats().size());
  std::map<std::string, Json> options;
  for (const Json& format : *formats) {
    EXPECT_FALSE(format.at("label").get<std::string>().empty() || format.at("doc").get<std::string>().empty());
    if (format.at("id") == "svg")
      for (const Json& option : format.at("options")) options[option.at("id").get<std::string>()] = option;
  }
  ASSERT_TRUE(options.contains("scale")) << list->body;
  EXPECT_EQ(options.at("scale").at("kind"), "number");
  EXPECT_EQ(options.at("labels").at("kind"), "boolean");
  EXPECT_EQ(options.at("paper").at("kind"), "choice");
  EXPECT_TRUE(options.at("paper").contains("choices"));
  const Response usual = answered(plan_form(lead_->token, "svg"), "/export"),
                 smaller = answered(plan_form(lead_->token, "svg", "&option.scale=1000"), "/export");
  ASSERT_EQ(smaller.status, 200) << smaller.body;
  EXPECT_EQ(usual.body.find("scale 1:1000"), std::string::npos);
  EXPECT_NE(smaller.body.find("scale 1:1000"), std::string::npos);
  EXPECT_NE(smaller.body.find("room.blsession"), std::string::npos) << "it says where it comes from";
}

TEST(FormTexts, ComeBackAsTheyWere) {
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  EXPECT_EQ(form_fields("a=" + form_text(all)).at("a"), all);
  EXPECT_EQ(form_text("für A"), "f%C3%BCr%20A");
}

}  // namespace
}  // namespace bl::serve
