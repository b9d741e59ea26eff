// One connection with a thread of its own: a broker, a listening port, a receiver, or a page that is requested.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/access.h"
#include "core/live/station.h"

namespace bl::live {

/// A sensor that an endpoint serves.
struct Subscriber {
  std::string path;   ///< topic, OSC path or URL
  double period = 0;  ///< [s] between two questions; HTTP only
  std::shared_ptr<Station> station;
  bool operator==(const Subscriber&) const = default;
};

/// A message of an actuator on its way out.
struct Outgoing {
  std::string path, text;
  std::optional<double> number;  ///< where the message is nothing but a number
  std::shared_ptr<Station> station;
};

/// Pauses between attempts to connect: each is twice the one before [s].
struct Pauses {
  double first = 0.5, longest = 30;
};

class Endpoint {
 public:
  /// What the thread does until is_ending().
  using Body = void (*)(Endpoint&);

  Endpoint(Body body, std::string host, int port, std::vector<Subscriber> subscribers, Pauses pauses, Access access);
  /// Waits for the thread; ask_to_end() several of them first, and they end at the same time.
  ~Endpoint();
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  void ask_to_end();
  /// From now on these; the connection stays as it is.
  void serve(std::vector<Subscriber> subscribers);
  /// The newest message for each path waits until it can go out.
  void send(Outgoing message);

  // Of the thread.
  const std::string& host() const { return host_; }
  int port() const { return port_; }
  /// "host:port", as sentences name it.
  std::string place() const;
  std::vector<Subscriber> subscribers() const;
  const Access& access() const { return access_; }
  bool is_ending() const;
  /// The messages that wait.
  std::vector<Outgoing> outgoing();
  /// Waits so long, or until a message waits or the end is asked for [s].
  void wait_for_work(double seconds);
  /// Tells all sensors and actuators of the connection what is wrong with it; empty where it works.
  void say(const std::string& sentence);
  /// Reports a failed attempt, and waits longer each time.
  void fail(const std::string& sentence);
  /// The connection works: the next failure begins with the first pause again.
  void succeed();

 private:
  void run(Body body);

  const std::string host_;
  const int port_;
  std::vector<Subscriber> subscribers_;
  const Pauses pauses_;
  const Access access_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool is_ending_ = false;
  std::map<std::string, Outgoing> waiting_;                  // by path
  std::map<std::string, std::shared_ptr<Station>> senders_;  // by path: whom failures are told besides
  std::string line_;
  bool is_line_known_ = false;
  double pause_;
  std::thread thread_;
};

// The bodies, each in a file of its own.
void run_mqtt(Endpoint& endpoint);
void run_osc_input(Endpoint& endpoint);
void run_osc_output(Endpoint& endpoint);
void run_http(Endpoint& endpoint);

}  // namespace bl::live
