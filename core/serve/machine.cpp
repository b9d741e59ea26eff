// Linux says these things in small text files; each may be missing, as in containers and on desktop computers.
#include "core/serve/machine.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/timex.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace bl::serve {

namespace {

namespace fs = std::filesystem;

// The kernel's scale of link quality where a driver does not say its own (include/net/iw_handler.h of Linux).
constexpr double kFullQuality = 70;

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.pop_back();
  return line;
}

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !(value >= 0) || value > 1e15) return std::nullopt;
  return value;
}

// Kernel documentation, ABI/testing/sysfs-class-power. Batteries of mice and pens have the scope `Device`.
void read_power(const std::string& root, Machine& machine) {
  double charge = 0;
  int batteries = 0;
  bool has_mains = false, is_online = false, is_discharging = false;
  std::error_code none;
  for (const auto& supply : fs::directory_iterator(root + "/sys/class/power_supply", none)) {
    const std::string type = first_line(supply.path() / "type");
    if (type == "Mains" || type == "USB") {
      has_mains = has_mains || type == "Mains";
      is_online = is_online || first_line(supply.path() / "online") == "1";
    }
    if (type != "Battery" || first_line(supply.path() / "scope") == "Device") continue;
    const auto percent = number_in(first_line(supply.path() / "capacity"));
    if (!percent) continue;
    ++batteries;
    charge += std::min(1.0, *percent / 100);
    is_discharging = is_discharging || first_line(supply.path() / "status") == "Discharging";
  }
  if (batteries > 0) {
    machine.battery = charge / batteries;
    machine.is_on_mains = is_online || !is_discharging;
  } else if (has_mains) {
    machine.is_on_mains = is_online;
  }
}

// Two lines of headings, then `wlan0: 0000   54.  -56.  -256 ...`: status, quality of the link, level, noise.
void read_wireless(const std::string& root, Machine& machine) {
  std::ifstream file(root + "/proc/net/wireless");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 1));
    std::string status, quality;
    if (!(words >> status >> quality)) continue;
    const auto value = number_in(quality);
    const std::size_t begin = line.find_first_not_of(' ');
    if (value && begin < colon) machine.wireless[line.substr(begin, colon - begin)] = std::min(1.0, *value / kFullQuality);
  }
}

void read_memory(const std::string& root, Machine& machine) {
  std::ifstream file(root + "/proc/meminfo");
  std::string word;
  while (file >> word) {
    if (word != "MemAvailable:") continue;
    std::string amount;
    file >> amount;
    if (const auto kilobytes = number_in(amount)) machine.memory_free = static_cast<std::int64_t>(*kilobytes) * 1024;
    return;
  }
}

bool is_private_v4(std::uint32_t a) {
  const auto is_in = [a](std::uint32_t network, int bits) { return (a >> (32 - bits)) == (network >> (32 - bits)); };
  return is_in(0x0a000000, 8) || is_in(0xac100000, 12) || is_in(0xc0a80000, 16) || is_in(0xa9fe0000, 16) || is_in(0x7f000000, 8);
}

}  // namespace

Machine read_machine(const std::string& root, const std::string& folder) {
  Machine machine;
  read_power(root, machine);
  read_wireless(root, machine);
  read_memory(root, machine);
  std::error_code error;
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, error);
  if (!error) machine.disk_free = static_cast<std::int64_t>(space.available);
  return machine;
}

std::vector<NetworkAddress> network_addresses() {
  std::vector<NetworkAddress> found;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return found;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    const bool is_usable = one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET && (one->ifa_flags & IFF_UP) != 0 &&
                           (one->ifa_flags & IFF_LOOPBACK) == 0;
    std::array<char, NI_MAXHOST> text{};
    if (is_usable && getnameinfo(one->ifa_addr, sizeof(sockaddr_in), text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0)
      found.push_back({one->ifa_name, text.data(), is_private_address(text.data())});
  }
  freeifaddrs(all);
  return found;
}

bool is_private_address(const std::string& address) {
  in_addr four{};
  if (inet_pton(AF_INET, address.c_str(), &four) == 1) return is_private_v4(ntohl(four.s_addr));
  in6_addr six{};
  if (inet_pton(AF_INET6, address.c_str(), &six) != 1) return false;
  const bool is_unique_local = (six.s6_addr[0] & 0xfe) == 0xfc;
  const bool is_link_local = six.s6_addr[0] == 0xfe && (six.s6_addr[1] & 0xc0) == 0x80;
  return is_unique_local || is_link_local || is_own_address(address);
}

bool is_own_address(const std::string& address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

std::optional<bool> is_clock_set() {
  timex asked{};  // no modes: nothing is changed
  const int state = adjtimex(&asked);
  if (state < 0) return std::nullopt;
  return state != TIME_ERROR && (asked.status & STA_UNSYNC) == 0;
}

void Reach::note(const std::string& own, const std::string& other) {
  if (other == own || is_own_address(other)) return;
  std::set<std::string>& others = others_[own];
  if (others.size() < kMost) others.insert(other);
}

std::map<std::string, std::size_t> Reach::counts() const {
  std::map<std::string, std::size_t> counts;
  for (const auto& [own, others] : others_) counts[own] = others.size();
  return counts;
}

MachineWatch::MachineWatch(std::string folder, std::string root)
    : latest_(read_machine(root, folder)), thread_([this, folder = std::move(folder), root = std::move(root)] {
        std::unique_lock lock(mutex_);
        while (!wake_.wait_for(lock, std::chrono::duration<double>(kBetween), [this] { return is_ending_; })) {
          lock.unlock();
          const Machine read = read_machine(root, folder);
          lock.lock();
          latest_ = read;
        }
      }) {}

MachineWatch::~MachineWatch() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

Machine MachineWatch::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

}  // namespace bl::serve
