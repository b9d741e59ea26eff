// What this computer says of itself: power, Wi-Fi, memory, free disk, its clock and its addresses.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace bl::serve {

/// What was not said is missing.
struct Machine {
  std::optional<double> battery;            ///< how full it is, 0 to 1; of several the mean; missing: there is none
  std::optional<bool> is_on_mains;          ///< missing: nothing says so
  std::map<std::string, double> wireless;   ///< by interface with a radio link: its quality, 0 to 1
  std::optional<std::int64_t> memory_free;  ///< what programs may still take [bytes]
  std::optional<std::int64_t> disk_free;    ///< where the session file lies [bytes]
};

/// Reads /sys/class/power_supply, /proc/net/wireless and /proc/meminfo below `root`, which is empty but for tests; and how much
/// is free on the disk of `folder`. What cannot be read is missing.
Machine read_machine(const std::string& root, const std::string& folder);

/// An address of this computer in one of its networks.
struct NetworkAddress {
  std::string interface, address;
  bool is_private = false;  ///< of RFC 1918, RFC 4193 or link-local: nobody outside of the network reaches it
  bool operator==(const NetworkAddress&) const = default;
};
/// IPv4 of all interfaces that are up, without those of this computer alone.
std::vector<NetworkAddress> network_addresses();
/// As above of an address in text, IPv4 or IPv6.
bool is_private_address(const std::string& address);
/// Of an address that only this computer can open: 127.0.0.1, ::1, localhost.
bool is_own_address(const std::string& address);
/// Does the clock follow a time server? Missing: the system does not say.
std::optional<bool> is_clock_set();

/// Who has come to a server from elsewhere, by own address. In memory only, and of each address only so many.
class Reach {
 public:
  static constexpr std::size_t kMost = 1000;
  /// A connection to the address `own`. Those of this computer itself show nothing of the network, and do not count.
  void note(const std::string& own, const std::string& other);
  /// By own address: how many other devices.
  std::map<std::string, std::size_t> counts() const;

 private:
  std::map<std::string, std::set<std::string>> others_;
};

/// What a room hears of where it runs.
struct Surroundings {
  Machine machine;
  std::map<std::string, std::size_t> reached;  ///< by own address: how many other devices have come by it
};

/// Reads the machine every few seconds on a thread of its own: some batteries take long to answer.
class MachineWatch {
 public:
  static constexpr double kBetween = 5;  // [s]
  explicit MachineWatch(std::string folder, std::string root = "");
  ~MachineWatch();
  MachineWatch(const MachineWatch&) = delete;
  MachineWatch& operator=(const MachineWatch&) = delete;
  /// The last reading, from any thread.
  Machine latest() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Machine latest_;
  bool is_ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace bl::serve
