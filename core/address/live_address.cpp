// Takes addresses of live data apart, by hand: four forms, each with its own rules for what may stand in it.
#include "core/address/live_address.h"

#include <algorithm>
#include <charconv>

namespace bl::address {

namespace {

constexpr std::size_t kLongest = 1000;
constexpr int kMqttPort = 1883;

Error refused(std::string message) { return {ErrorCode::parse, "", std::move(message)}; }

bool is_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The port as a number from 1 to 65535, or 0.
int port_of(std::string_view text) {
  int port = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), port);
  return problem == std::errc() && end == text.data() + text.size() && port >= 1 && port <= 65535 ? port : 0;
}

// `host`, `host:port`, `[::1]:port` or `port` alone into the address.
Result<void> read_host(std::string_view text, LiveAddress& address) {
  if (text.find('@') != std::string_view::npos)
    return refused("names and passwords do not belong into an address: they would stand in the scene and in every log");
  std::string_view port;
  if (text.starts_with('[')) {
    const std::size_t close = text.find(']');
    if (close == std::string_view::npos) return refused("the bracket `[` of the host is not closed");
    address.host = text.substr(1, close - 1);
    const std::string_view rest = text.substr(close + 1);
    if (!rest.empty() && !rest.starts_with(':')) return refused("after `]` comes `:` and the port");
    if (!rest.empty()) port = rest.substr(1);
    if (!rest.empty() && port.empty()) return refused("there is no port after `:`");
  } else if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
    address.host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.empty()) return refused("there is no port after `:`");
  } else if (address.scheme == LiveAddress::Scheme::osc && is_digits(text)) {
    address.host = "127.0.0.1";
    port = text;
  } else {
    address.host = text;
  }
  if (address.host.empty()) return refused("names no host");
  if (address.host.find(' ') != std::string::npos) return refused("the host holds a space");
  if (!port.empty() && port_of(port) == 0)
    return refused("`" + std::string(port) + "` is no port: it is a number from 1 to 65535");
  address.port = port_of(port);
  return {};
}

Result<LiveAddress> mqtt(std::string_view rest) {
  LiveAddress address;
  address.scheme = LiveAddress::Scheme::mqtt;
  const std::size_t slash = rest.find('/');
  if (auto host = read_host(rest.substr(0, slash), address); !host) return host.error();
  if (address.port == 0) address.port = kMqttPort;
  if (slash == std::string_view::npos || slash + 1 == rest.size())
    return refused("names no topic: write `mqtt://host:1883/topic`");
  address.path = rest.substr(slash + 1);
  if (address.path.find_first_of("+#") != std::string::npos) return refused("the topic has to be one topic, without `+` and `#`");
  return address;
}

Result<LiveAddress> osc(std::string_view rest) {
  LiveAddress address;
  address.scheme = LiveAddress::Scheme::osc;
  const std::size_t slash = rest.find('/');
  if (auto host = read_host(rest.substr(0, slash), address); !host) return host.error();
  if (address.port == 0) return refused("names no port: write `osc://9000/path` or `osc://host:9000/path`");
  if (slash == std::string_view::npos || slash + 1 == rest.size()) return refused("names no path: write `osc://9000/path`");
  address.path = rest.substr(slash);
  if (address.path.find_first_of(" #*,?[]{}") != std::string::npos)
    return refused("the path has to be one path, without spaces and any of `#*,?[]{}`");
  return address;
}

Result<LiveAddress> http(std::string_view text, std::string_view rest) {
  LiveAddress address;
  address.scheme = LiveAddress::Scheme::http;
  if (auto host = read_host(rest.substr(0, rest.find_first_of("/?#")), address); !host) return host.error();
  address.path = text;
  return address;
}

Result<LiveAddress> replay(std::string_view rest) {
  LiveAddress address;
  address.scheme = LiveAddress::Scheme::replay;
  const std::size_t hash = rest.rfind('#');
  if (hash == std::string_view::npos || hash + 1 == rest.size())
    return refused("names no column: write `replay:table.csv#column`");
  address.column = rest.substr(hash + 1);
  rest = rest.substr(0, hash);
  const std::size_t question = std::min(rest.find('?'), rest.size());
  address.path = rest.substr(0, question);
  if (address.path.empty()) return refused("names no file: write `replay:table.csv#column`");
  rest = rest.substr(std::min(question + 1, rest.size()));
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find('&'));
    rest = rest.substr(std::min(part.size() + 1, rest.size()));
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || equals == 0)
      return refused("`" + std::string(part) + "` is not of the form `column=text`");
    const std::string name(part.substr(0, equals)), content(part.substr(equals + 1));
    if (name == "time") address.time = content;
    else if (!address.filters.emplace(name, content).second) return refused("the column `" + name + "` stands twice");
  }
  return address;
}

}  // namespace

Result<LiveAddress> parse_live_address(std::string_view text) {
  if (text.size() > kLongest) return refused("is longer than " + std::to_string(kLongest) + " characters");
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }))
    return refused("holds a control character");
  if (text.starts_with("mqtt://")) return mqtt(text.substr(7));
  if (text.starts_with("osc://")) return osc(text.substr(6));
  if (text.starts_with("http://")) return http(text, text.substr(7));
  if (text.starts_with("https://")) return http(text, text.substr(8));
  if (text.starts_with("replay:")) return replay(text.substr(7));
  return refused("begins with none of `mqtt://`, `osc://`, `http://`, `https://` and `replay:`");
}

}  // namespace bl::address
