// Asks the system for the addresses of its networks.
#include "ui/cli/own_addresses.h"

#include "core/serve/machine.h"

namespace bl::cli {

namespace {

// Those that others can reach; 127.0.0.1 where there is none.
std::vector<std::string> hosts() {
  std::vector<std::string> found;
  for (const serve::NetworkAddress& one : serve::network_addresses()) found.push_back(one.address);
  if (found.empty()) found.emplace_back("127.0.0.1");
  return found;
}

}  // namespace

std::vector<std::string> own_hosts(const ServeOptions& options) {
  if (!options.name.empty()) return {options.name};
  const bool is_everywhere = options.bind == "0.0.0.0" || options.bind == "::";
  return is_everywhere ? hosts() : std::vector{options.bind};
}

std::string url_of(const ServeOptions& options, const std::string& host, int port) {
  const bool is_long = host.find(':') != std::string::npos;  // IPv6
  return (options.certificate.empty() ? "http://" : "https://") + (is_long ? "[" + host + "]" : host) + ":" +
         std::to_string(port);
}

std::vector<std::string> own_addresses(const ServeOptions& options, int port) {
  std::vector<std::string> all = own_hosts(options);
  for (std::string& one : all) one = url_of(options, one, port);
  return all;
}

}  // namespace bl::cli
