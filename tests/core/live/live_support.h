// What tests of live connections need: programs that are started and stopped, waiting on conditions, a scene in step with its
// connections.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/live/connections.h"
#include "core/session/session.h"
#include "tests/support/world.h"

namespace bl::test {

/// Looks again and again until it is so, for a minute at most.
inline bool eventually(const std::function<bool()>& is_so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!is_so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// A socket of the test's own on the loopback.
class Loopback {
 public:
  explicit Loopback(int kind, int port = 0, bool is_listening = false) : handle_(socket(AF_INET, kind | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = at(port);
    EXPECT_EQ(bind(handle_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    getsockname(handle_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    if (is_listening) listen(handle_, 8);
  }
  ~Loopback() { close(handle_); }
  Loopback(const Loopback&) = delete;
  Loopback& operator=(const Loopback&) = delete;
  int port() const { return port_; }
  void send(int to, const std::string& bytes) const {
    const sockaddr_in address = at(to);
    sendto(handle_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  /// A datagram that has come, or an empty text.
  std::string received() const {
    std::string bytes(70000, '\0');
    const ssize_t size = recv(handle_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return bytes;
  }
  static bool is_open(int port) {
    const int handle = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = at(port);
    const bool is_open = connect(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(handle);
    return is_open;
  }

 private:
  static sockaddr_in at(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  int handle_, port_ = 0;
};

inline int free_port() { return Loopback(SOCK_STREAM).port(); }

/// A program of the system, ended with its owner.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments, const std::string& output = "/dev/null") {
    id_ = fork();
    if (id_ != 0) return;
    (void)!freopen(output.c_str(), "w", stdout);
    (void)!freopen("/dev/null", "w", stderr);
    std::vector<char*> raw;
    for (std::string& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    execvp(raw[0], raw.data());
    _exit(127);
  }
  ~Program() { stop(); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  void stop() {
    if (id_ <= 0) return;
    kill(id_, SIGTERM);
    wait();
  }
  /// Its exit code.
  int wait() {
    int status = 0;
    if (id_ > 0) waitpid(id_, &status, 0);
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t id_ = 0;
};

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "behaviourlinks-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path(const std::string& name = "") const { return (path_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name, std::ios::binary) << text; }

 private:
  std::filesystem::path path_;
};

/// A broker on a port of the loopback.
class Broker {
 public:
  Broker() : port_(free_port()) {}
  /// `rules`: who may enter, in the words of the broker's own file; `visitor`: how publish() enters.
  void start(const std::string& rules = "allow_anonymous true", std::vector<std::string> visitor = {}) {
    visitor_ = std::move(visitor);
    // The broker would give up its rights where it has them, and could not read the test's own files then.
    folder_.write("broker.conf",
                  "listener " + std::to_string(port_) + " 127.0.0.1\npersistence false\nuser root\n" + rules + "\n");
    program_ = std::make_unique<Program>(std::vector<std::string>{"/usr/sbin/mosquitto", "-c", folder_.path("broker.conf")});
    ASSERT_TRUE(eventually([&] { return Loopback::is_open(port_); })) << "is the package mosquitto installed?";
  }
  void stop() { program_.reset(); }
  void publish(const std::string& topic, const std::string& text, bool is_retained = false) const {
    folder_.write("message", text);
    std::vector<std::string> arguments{"mosquitto_pub", "-p", std::to_string(port_),  "-q", "1", "-t",
                                       topic,           "-f", folder_.path("message")};
    if (is_retained) arguments.push_back("-r");
    arguments.insert(arguments.end(), visitor_.begin(), visitor_.end());
    EXPECT_EQ(Program(arguments).wait(), 0) << "is the package mosquitto-clients installed?";
  }
  std::string address(const std::string& topic) const { return "mqtt://127.0.0.1:" + std::to_string(port_) + "/" + topic; }
  int port() const { return port_; }

 private:
  int port_;
  Folder folder_;
  std::vector<std::string> visitor_;
  std::unique_ptr<Program> program_;
};

/// A scene of nodes (JSON objects with commas between) that ticks in step with its connections and keeps its log.
class LiveWorld {
 public:
  explicit LiveWorld(const std::string& nodes, const std::string& links = "", live::LiveOptions options = {"", true, {0.02, 0.1}})
      : text_(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + R"(], "links": [)" + links + "]}"),
        world_(World::from_text(text_)),
        connections_(std::make_unique<live::Connections>(std::move(options))) {}

  void step() {
    connections_->follow(world_.session().scene());
    for (const live::Report& report : connections_->collect(world_.state().tick)) {
      ++reports_;
      EXPECT_TRUE(world_.session().submit(report.command, report.author).ok());
    }
    world_.tick();
    connections_->send(world_.state());
  }
  /// Steps until it is so.
  bool steps_until(const std::function<bool()>& is_so) {
    return eventually([&] {
      step();
      return is_so();
    });
  }
  /// Publishes until the sensor has heard it: who publishes before the subscription stands is not heard.
  bool hears(const Broker& broker, const std::string& topic, const std::string& text, const std::function<bool()>& is_so) {
    return eventually([&] {
      broker.publish(topic, text);
      for (int i = 0; i < 20 && !is_so(); ++i) {
        step();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      return is_so();
    });
  }
  /// The same, and nothing that was published is on its way any more: topics keep the order, and this number comes once.
  bool hears_last(const Broker& broker, const std::string& topic, const std::string& node, double value) {
    if (!hears(broker, topic, shortest(value - 1), [&] { return number(node) == value - 1; })) return false;
    broker.publish(topic, shortest(value));
    return steps_until([&] { return number(node) == value; });
  }
  double number(const std::string& node, const std::string& port = "sensor.value") const { return world_.number(node, port); }
  std::string text(const std::string& node, const std::string& port) const { return world_.text(node, port); }
  std::string quality(const std::string& node) const { return text(node, "sensor.quality"); }
  std::string message(const std::string& node) const { return text(node, "sensor.message"); }
  bool says(const std::string& node, const std::string& part) const { return message(node).find(part) != std::string::npos; }
  live::ConnectionStatus status(const std::string& node) const {
    for (live::ConnectionStatus& status : connections_->status())
      if (status.node == node) return status;
    return {};
  }
  World& world() { return world_; }
  int reports() const { return reports_; }

  /// The log played again without any connection, on so many threads: the hash at its end.
  std::string replayed(int threads) {
    std::string log = log_header(text_) + "\n";
    for (const LogEntry& entry : world_.session().log()) log += log_line(entry, full_registry()) + "\n";
    log += log_line(LogCheck{world_.state().tick, hex_digits(world_.state().hash), true}) + "\n";
    const auto file = read_log(log, full_registry());
    if (!file) return file.error().text();
    const auto report = replay(*file, full_registry(), threads);
    if (!report) return report.error().text();
    return report->first_mismatch ? "differs" : report->hash;
  }
  std::string hash() const { return hex_digits(world_.state().hash); }

 private:
  std::string text_;
  World world_;
  std::unique_ptr<live::Connections> connections_;
  int reports_ = 0;
};

inline std::string sensor(const std::string& id, const std::string& address, const std::string& more = "") {
  return R"({"id": ")" + id + R"(", "types": {"sensor": {"address": ")" + address + R"(")" + more + "}}}";
}

}  // namespace bl::test
