// Asks the system for the addresses of its networks.
#include "ui/cli/own_addresses.h"

#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <sys/socket.h>

namespace bl::cli {

namespace {

// Those that others can reach; 127.0.0.1 where there is none.
std::vector<std::string> hosts() {
  ifaddrs* all = nullptr;
  std::vector<std::string> found;
  if (getifaddrs(&all) == 0) {
    for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
      const bool is_usable = one->ifa_addr != nullptr && one->ifa_addr->sa_family == AF_INET && (one->ifa_flags & IFF_UP) != 0 &&
                             (one->ifa_flags & IFF_LOOPBACK) == 0;
      char text[NI_MAXHOST] = "";
      if (is_usable && getnameinfo(one->ifa_addr, sizeof(sockaddr_in), text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0)
        found.emplace_back(text);
    }
    freeifaddrs(all);
  }
  if (found.empty()) found.emplace_back("127.0.0.1");
  return found;
}

}  // namespace

std::vector<std::string> own_addresses(const ServeOptions& options, int port) {
  const bool is_everywhere = options.bind == "0.0.0.0" || options.bind == "::";
  const std::string scheme = options.certificate.empty() ? "http://" : "https://";
  std::vector<std::string> all = is_everywhere ? hosts() : std::vector{options.bind};
  for (std::string& one : all) {
    const bool is_long = one.find(':') != std::string::npos;  // IPv6
    one = scheme + (is_long ? "[" + one + "]" : one) + ":" + std::to_string(port);
  }
  return all;
}

}  // namespace bl::cli
