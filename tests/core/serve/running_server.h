// A server of rooms in this process, on a thread of its own and at a free port.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>

#include "core/serve/server.h"
#include "tests/support/place/source_folder.h"

namespace bl::serve {

class RunningServer {
 public:
  explicit RunningServer(ServerOptions options = {}, std::string scene = "/scenes/start/quarter.json") {
    folder_ = std::filesystem::temp_directory_path() /
              ("behaviourlinks_server_" + std::to_string(::getpid()) + "_" + std::to_string(++count()));
    std::filesystem::create_directories(folder_);
    options.address = options.address == "0.0.0.0" ? "127.0.0.1" : options.address;
    options.port = 0;
    auto opened = Server::open(options);
    if (!opened) throw std::runtime_error(opened.error().text());
    server_ = std::move(*opened);
    RoomHostOptions how;
    how.wall_time = [] {
      using namespace std::chrono;
      return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
    };
    how.on_own_thread = [this](std::function<void()> task) { server_->post(std::move(task)); };
    auto room = RoomHost::open(folder_ / "room.blsession", "BKRT", test::source_folder() + scene, how);
    if (!room) throw std::runtime_error(room.error().text());
    invites_ = (*room)->invites();
    follow_key_ = (*room)->follow_key();
    server_->rooms().emplace("BKRT", std::move(*room));
    port_ = server_->port();
    thread_ = std::thread([this] { server_->run(); });
  }
  ~RunningServer() {
    stop();
    std::filesystem::remove_all(folder_);
  }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  void stop() {
    if (!thread_.joinable()) return;
    server_->stop();
    thread_.join();
  }
  std::uint16_t port() const { return port_; }
  const std::string& invite(const std::string& role) const { return invites_.at(role); }
  const std::string& follow_key() const { return follow_key_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  static int& count() {
    static int number = 0;
    return number;
  }

  std::filesystem::path folder_;
  std::unique_ptr<Server> server_;
  std::map<std::string, std::string> invites_;
  std::string follow_key_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

/// Waits for what a client tells, and wakes up for it.
class Bell {
 public:
  std::function<void()> ring() {
    return [this] {
      const std::lock_guard lock(mutex_);
      has_rung_ = true;
      wake_.notify_all();
    };
  }
  /// False if nobody has rung for so long.
  bool wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    const bool rung = wake_.wait_for(lock, most, [this] { return has_rung_; });
    has_rung_ = false;
    return rung;
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool has_rung_ = false;
};

}  // namespace bl::serve
