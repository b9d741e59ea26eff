// A room and its guests in one process, on a clock that is moved by hand, with connections that lose, delay and break.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/define/json_text.h"
#include "core/file/scene_file.h"
#include "core/guest/room_guest.h"
#include "core/serve/room_host.h"
#include "core/wire/operations.h"
#include "tests/support/hand_clock.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"

namespace bl::guest {

/// How bad the network is.
struct Weather {
  double lost = 0;     ///< part of the frames after the welcome
  double doubled = 0;  ///< part of the frames from the guest
  double cut = 0;      ///< of a connection, in each turn
  int most_delay = 0;  ///< turns
  /// Views are told as differences from those before. TCP loses none of them, and after a break they come whole; nothing else
  /// would bring one back.
  bool keeps_views = false;
};

/// Both ends of one connection.
class Wire final : public serve::Guest, public std::enable_shared_from_this<Wire> {
 public:
  Wire(Random& random, const Weather& weather) : random_(&random), weather_(&weather) {}

  // The server's end.
  void send(std::shared_ptr<const std::string> frame) override { to_guest_.push_back({due(), *frame}); }
  void close(serve::CloseCode code, const std::string& why) override {
    if (!is_closed) closed_code_ = static_cast<int>(code), closed_why_ = why;
    is_closed = true;
  }
  std::size_t unsent() const override { return 0; }

  struct Later {
    int turn = 0;
    std::string frame;
  };
  int due() {
    last_due_ =
        std::max(last_due_, now + (weather_->most_delay == 0
                                       ? 0
                                       : static_cast<int>(random_->below(static_cast<std::uint64_t>(weather_->most_delay) + 1))));
    return last_due_;
  }
  bool is_lost(const std::string& frame) {
    const bool is_greeting = frame.find("\"hello\"") != std::string::npos || frame.find("\"welcome\"") != std::string::npos;
    const bool is_kept = weather_->keeps_views && frame.find("\"t\": \"state\"") != std::string::npos;
    return !is_greeting && !is_kept && random_->uniform() < weather_->lost;
  }
  /// Changes what the guest is sent.
  std::function<void(std::string&)> on_way;

  std::deque<Later> to_guest_, to_server_;
  int now = 0, last_due_ = 0, closed_code_ = 0;
  bool is_closed = false, is_greeted = false, is_opened = false, is_heard_of = false;
  std::string closed_why_;

 private:
  Random* random_;
  const Weather* weather_;
};

class GuestEnd final : public Link {
 public:
  explicit GuestEnd(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) {}
  ~GuestEnd() override { wire_->is_closed = true; }
  void send(std::string frame) override { wire_->to_server_.push_back({wire_->due(), std::move(frame)}); }
  bool has_news() const override { return true; }
  std::vector<Heard> take() override {
    std::vector<Heard> heard;
    if (!std::exchange(wire_->is_opened, true)) heard.push_back({Heard::What::opened, {}, 0});
    while (!wire_->to_guest_.empty() && wire_->to_guest_.front().turn <= wire_->now) {
      std::string frame = std::move(wire_->to_guest_.front().frame);
      wire_->to_guest_.pop_front();
      if (wire_->is_lost(frame)) continue;
      if (wire_->on_way) wire_->on_way(frame);
      heard.push_back({Heard::What::frame, std::move(frame), 0});
    }
    if (wire_->is_closed && !std::exchange(wire_->is_heard_of, true))
      heard.push_back({Heard::What::closed, wire_->closed_why_, wire_->closed_code_});
    return heard;
  }

 private:
  std::shared_ptr<Wire> wire_;
};

class MemoryRoom {
 public:
  explicit MemoryRoom(const std::string& scene, std::uint64_t seed = 1) : scene_(scene), random_(seed) {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_guests_" + std::to_string(::getpid()) + "_" +
                                                        ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    open();
  }
  ~MemoryRoom() {
    guests.clear();
    host.reset();
    std::filesystem::remove_all(folder_);
  }

  const std::filesystem::path& folder() const { return folder_; }
  std::string path() const { return folder_ / "room.blsession"; }
  void open() {
    serve::RoomHostOptions options;
    options.clock = &clock;
    options.wall_time = [this] { return at_ += 10; };
    options.on_own_thread = [this](std::function<void()> task) {
      const std::lock_guard lock(mutex_);
      tasks_.push_back({turns_ + slowness, std::move(task)});
    };
    auto opened = serve::RoomHost::open(path(), "BKRT", test::source_folder() + "/" + scene_, options);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    host = std::move(*opened);
  }
  /// All connections break, and whatever the room's process had in memory is gone.
  void restart() {
    for (auto& wire : wires) wire->is_closed = true;
    wires.clear();
    host.reset();
    {
      const std::lock_guard lock(mutex_);
      tasks_.clear();
    }
    open();
  }

  RoomGuest& join(const std::string& role, host::SelfTest self = host::self_test()) {
    RoomGuestOptions options;
    options.code = "BKRT";
    options.invite = host->invites().at(role);
    options.new_run = [this] { return "run-" + std::to_string(++runs_); };
    options.outbox = outbox;
    options.self = std::move(self);
    options.clock = &clock;
    options.random = [this] { return random_.uniform(); };
    options.connect = [this](const std::function<void()>&) -> std::unique_ptr<Link> {
      wires.push_back(std::make_shared<Wire>(random_, weather));
      wires.back()->on_way = on_way;
      return std::make_unique<GuestEnd>(wires.back());
    };
    if (before_joining) before_joining(options);
    guests.push_back(std::make_unique<RoomGuest>(full_registry(), std::move(options)));
    return *guests.back();
  }

  void turn(double seconds = 0.01) {
    clock.advance(seconds);
    for (std::size_t k = 0; k < wires.size(); ++k) serve_wire(wires[k]);
    std::erase_if(wires, [](const auto& wire) { return wire->is_closed && wire->is_heard_of; });
    do_tasks();
    if (turns_++ % 10 == 0) host->turn();
    // On a busy machine this clock would run away from threads that get no processor, and what they do would look slow.
    const auto is_storing = [this] { return !has_tasks() && host->health().waiting > 0; };
    for (const Patience patience; is_storing() && patience.is_left(); do_tasks()) {
      patience.wait();
      clock.advance(0.001);  // the disk gathers by this clock
    }
    for (auto& guest : guests) (void)guest->keep_up();
    // Who is behind ticks without a pause.
    for (auto& guest : guests)
      for (const Patience patience; guest->follower().behind() > 2 * Follower::kFarBehind && patience.is_left();) patience.wait();
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  /// Gives up after so many turns and a minute of real time: turns may be done before the threads that tick have had a processor.
  bool turn_until(const std::function<bool()>& is_over, int most = 6000) {
    const double end = host::real_clock().now() + 60;
    for (int k = 0; !is_over(); ++k) {
      if (k >= most && host::real_clock().now() > end) return false;
      turn();
    }
    return true;
  }
  /// Everybody has everything, and the ticks have stopped at the same one.
  bool come_to_rest() {
    weather = {};
    const bool is_still = turn_until([&] {
      return std::all_of(guests.begin(), guests.end(), [&](const auto& guest) {
        const Standing standing = guest->standing();
        return standing.is_connected && standing.has_scene && standing.waiting == 0 && guest->fold().seq() == host->health().seq;
      });
    });
    if (!is_still) return false;
    guests.front()->play(false);
    // A tick that is computed when the clock is stopped comes to its end.
    std::int64_t last = -1;
    int still = 0;
    return turn_until([&] {
      const auto health = host->health();
      still = health.tick == last ? still + 1 : 0;
      last = health.tick;
      return still >= 100 && std::all_of(guests.begin(), guests.end(), [&](const auto& guest) {
               return guest->standing().waiting == 0 && guest->people().is_paused && guest->fold().seq() == health.seq &&
                      guest->moment()->ticked->tick == health.tick;
             });
    });
  }

  Weather weather;
  std::atomic<int> slowness = 0;  ///< turns until the room hears that something is stored, or that there is another tick
  test::HandClock clock;
  std::unique_ptr<serve::RoomHost> host;
  std::vector<std::unique_ptr<RoomGuest>> guests;
  std::vector<std::shared_ptr<Wire>> wires;
  std::function<void(std::string&)> on_way;
  std::string outbox;                                     ///< folder of the guests that join; empty: none
  std::function<void(RoomGuestOptions&)> before_joining;  ///< what else a guest is given
  Random& random() { return random_; }

 private:
  /// What is waited for at most [s of real time].
  struct Patience {
    double end = host::real_clock().now() + 10;
    bool is_left() const { return host::real_clock().now() < end; }
    void wait() const { std::this_thread::sleep_for(std::chrono::microseconds(300)); }
  };
  bool has_tasks() {
    const std::lock_guard lock(mutex_);
    return !tasks_.empty();
  }
  void do_tasks() {
    std::deque<std::function<void()>> tasks;
    {
      const std::lock_guard lock(mutex_);
      for (; !tasks_.empty() && tasks_.front().first <= turns_; tasks_.pop_front())
        tasks.push_back(std::move(tasks_.front().second));
    }
    for (auto& task : tasks) task();
  }
  void serve_wire(const std::shared_ptr<Wire>& wire) {
    ++wire->now;
    if (!wire->is_closed && wire->is_greeted && random_.uniform() < weather.cut) wire->is_closed = true;
    if (wire->is_closed) {
      host->leave(*wire);
      return;
    }
    while (!wire->to_server_.empty() && wire->to_server_.front().turn <= wire->now && !wire->is_closed) {
      const std::string frame = std::move(wire->to_server_.front().frame);
      wire->to_server_.pop_front();
      if (wire->is_lost(frame)) continue;
      if (!wire->is_greeted) {
        const auto hello = wire::read_message<wire::Hello>(*parse_json(frame));
        ASSERT_TRUE(hello.ok()) << hello.error().text();
        wire->is_greeted = true;
        host->greet(wire, *hello);
        continue;
      }
      host->hear(*wire, frame);
      if (random_.uniform() < weather.doubled) host->hear(*wire, frame);
    }
  }

  std::filesystem::path folder_;
  std::string scene_;
  Random random_;
  std::mutex mutex_;
  std::deque<std::pair<int, std::function<void()>>> tasks_;  // with the turn in which each is due
  std::int64_t at_ = 1000;
  std::atomic<int> turns_ = 0;
  int runs_ = 0;
};

}  // namespace bl::guest
