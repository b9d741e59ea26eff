// A second laptop over the loopback: it has what the first has confirmed, and goes on with it.
#include "core/serve/second.h"

#include <atomic>
#include <fstream>
#include <future>

#include "core/serve/following.h"
#include "tests/core/serve/talk.h"
#include "tests/support/deadline.h"

namespace bl::serve {
namespace {

// A second laptop on a thread of its own.
class Laptop {
 public:
  Laptop(const RunningServer& first, const std::string& token, const std::string& path, bool is_safe = false) {
    options_.first = address_of(first);
    options_.token = token;
    options_.path = path;
    options_.is_safe = is_safe;
    options_.is_over = [this] { return is_over_.load(); };
    options_.is_told_to_take_over = [this] { return takes_over_.exchange(false); };
    options_.say = [this](const std::string& sentence) {
      const std::lock_guard lock(mutex_);
      said_ += sentence + "\n";
    };
    end_ = std::async(std::launch::async, [this] { return follow(options_); });
  }
  ~Laptop() { is_over_ = true; }
  Result<SecondEnd> end() { return end_.get(); }
  void take_over() { takes_over_ = true; }
  void stop() { is_over_ = true; }
  bool has_said(const std::string& words, std::chrono::seconds most = 60s) {
    const auto end = std::chrono::steady_clock::now() + most;
    while (std::chrono::steady_clock::now() < end) {
      {
        const std::lock_guard lock(mutex_);
        if (said_.find(words) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    ADD_FAILURE() << "not said: " << words << "\nbut:\n" << said_;
    return false;
  }

 private:
  SecondOptions options_;
  std::mutex mutex_;
  std::string said_;
  std::atomic<bool> is_over_{false}, takes_over_{false};
  std::future<Result<SecondEnd>> end_;
};

std::string mark(int id) {
  return R"({"t": "room", "id": )" + std::to_string(id) + R"(, "e": {"event": "mark", "arguments": {"text": "number )" +
         std::to_string(id) + R"("}}})";
}

TEST(SecondLaptop, HasWhatTheFirstHasConfirmed) {
  const Deadline deadline(200, "a second laptop");
  RunningServer first;
  Talk lead(address_of(first));
  lead.client.send(hello(first.invite("facilitator")));
  ASSERT_TRUE(lead.wait_for("welcome"));
  const std::string token = (*lead.last("welcome"))["token"], copy = first.folder() / "copy.blsession";
  Laptop second(first, first.follow_key(), copy, true);
  ASSERT_TRUE(second.has_said("follows room BKRT"));
  second.take_over();
  ASSERT_TRUE(second.has_said("The first laptop is there"));
  for (int id = 1; id <= 40; ++id) lead.client.send(mark(id));
  ASSERT_TRUE(lead.wait([&] { return lead.last("ack") != nullptr && (*lead.last("ack"))["id"] == 40; }));
  const std::int64_t seq = (*lead.last("ack"))["s"];
  first.stop();
  ASSERT_TRUE(second.has_said("is away"));
  second.take_over();
  const auto end = second.end();
  ASSERT_TRUE(end) << end.error().text();
  ASSERT_EQ(*end, SecondEnd::takes_over);
  RoomHostOptions how;
  how.wall_time = [] { return std::int64_t{1}; };
  how.on_own_thread = [](const std::function<void()>&) {};
  how.takes_over = true;
  const auto host = RoomHost::open(copy, "", "", how);
  ASSERT_TRUE(host) << host.error().text();
  EXPECT_GE((*host)->health().seq, seq);
  EXPECT_EQ((*host)->seat_of_token(token), 1);
  EXPECT_EQ((*host)->invites().at("designer"), first.invite("designer"));
}

TEST(SecondLaptop, ComesBackAndBeginsAnew) {
  const Deadline deadline(200, "a second laptop that comes back");
  RunningServer first;
  const std::string copy = first.folder() / "copy.blsession";
  Talk lead(address_of(first));
  lead.client.send(hello(first.invite("facilitator")));
  ASSERT_TRUE(lead.wait_for("welcome"));
  for (int round = 0; round < 3; ++round) {
    // The second time by the token of the facilitator's seat.
    Laptop second(first, round == 1 ? (*lead.last("welcome"))["token"].get<std::string>() : first.follow_key(), copy);
    ASSERT_TRUE(second.has_said("follows room BKRT"));
    lead.client.send(mark(round + 1));
    ASSERT_TRUE(lead.wait([&] { return lead.last("ack") != nullptr && (*lead.last("ack"))["id"] == round + 1; }));
    second.stop();
    const auto end = second.end();
    ASSERT_TRUE(end) << end.error().text();
    EXPECT_EQ(*end, SecondEnd::over);
  }
}

TEST(SecondLaptop, IsRefusedWithoutTheKeyOrWithAnotherFile) {
  const Deadline deadline(200, "a second laptop that is refused");
  RunningServer first;
  for (const std::string& key : {std::string("0123456789abcdef"), first.invite("facilitator")}) {
    Laptop stranger(first, key, first.folder() / "copy.blsession");
    const auto end = stranger.end();
    ASSERT_FALSE(end);
    EXPECT_NE(end.error().text().find("followed by the token"), std::string::npos) << end.error().text();
  }
  const std::string letter = first.folder() / "letter";
  std::ofstream(letter) << "Dear all, this is a letter and no session file at all.";
  Laptop writer(first, first.follow_key(), letter);
  ASSERT_FALSE(writer.end());
}

}  // namespace
}  // namespace bl::serve
