// Addresses are typed by hand, too: each error says which part is wrong.
#include "core/serve/room_address.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace bl::serve {

namespace {

constexpr std::size_t kLongestHost = 253, kLongestCode = 16, kLongestInvite = 128;
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

struct Scheme {
  std::string_view beginning;
  std::uint16_t port;
  bool is_secure;
};
constexpr std::array kSchemes = {Scheme{"room://", 8080, false}, Scheme{"http://", 80, false}, Scheme{"https://", 443, true}};

Error wrong(const std::string& why) { return {ErrorCode::parse, "the room's address", why}; }

bool holds_only(std::string_view text, std::string_view besides_letters) {
  return std::all_of(text.begin(), text.end(), [&](char letter) {
    return kLetters.find(letter) != std::string_view::npos || besides_letters.find(letter) != std::string_view::npos;
  });
}

Result<void> read_host(std::string_view text, RoomAddress& address) {
  std::string_view host = text, port;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return wrong("a bracket is opened and not closed");
    host = text.substr(1, end - 1);
    const std::string_view rest = text.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return wrong("`:` and a port come after the bracket");
    if (host.find(':') == std::string_view::npos || !holds_only(host, ":.%")) return wrong("no IPv6 address is in the brackets");
    if (!rest.empty()) port = rest.substr(1);
    if (!rest.empty() && port.empty()) return wrong("a port is missing after `:`");
  } else {
    if (const std::size_t colon = text.find(':'); colon != std::string_view::npos) {
      host = text.substr(0, colon);
      port = text.substr(colon + 1);
      if (port.empty()) return wrong("a port is missing after `:`");
      if (port.find(':') != std::string_view::npos)
        return wrong("an IPv6 address needs brackets, as in room://[fe80::1]:8080/CODE");
    }
    if (host.empty()) return wrong("the host is missing; an address is room://HOST:PORT/CODE");
    if (!holds_only(host, ".-_")) return wrong("`" + std::string(host) + "` is no host");
  }
  if (host.size() > kLongestHost) return wrong("the host is too long");
  address.host = host;
  if (port.empty()) return {};
  unsigned number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || number == 0 || number > 65535)
    return wrong("`" + std::string(port) + "` is no port; ports are whole numbers from 1 to 65535");
  address.port = static_cast<std::uint16_t>(number);
  return {};
}

}  // namespace

std::string RoomAddress::host_and_port() const {
  const bool has_colons = host.find(':') != std::string::npos;
  return (has_colons ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

Result<RoomAddress> room_address(std::string_view text) {
  RoomAddress address;
  const auto scheme =
      std::find_if(kSchemes.begin(), kSchemes.end(), [&](const Scheme& one) { return text.starts_with(one.beginning); });
  if (scheme == kSchemes.end()) return wrong("it begins with room://, http:// or https://");
  address.port = scheme->port;
  address.is_secure = scheme->is_secure;
  text.remove_prefix(scheme->beginning.size());
  if (const std::size_t mark = text.find('#'); mark != std::string_view::npos) {
    const std::string_view fragment = text.substr(mark + 1);
    if (!fragment.starts_with("k=")) return wrong("after `#` comes k= and the invitation");
    address.invite = fragment.substr(2);
    if (address.invite.empty() || address.invite.size() > kLongestInvite || !holds_only(address.invite, "-_"))
      return wrong("the invitation after #k= is not whole; copy it again");
    text = text.substr(0, mark);
  }
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return wrong("the code of the room is missing; it comes after `/`");
  if (auto read = read_host(text.substr(0, slash), address); !read) return read.error();
  std::string_view code = text.substr(slash + 1);
  if (code.ends_with('/')) code.remove_suffix(1);
  if (code.empty()) return wrong("the code of the room is missing; it comes after `/`");
  if (code.size() > kLongestCode || !holds_only(code, "")) return wrong("`" + std::string(code) + "` is no code of a room");
  address.code = code;
  for (char& letter : address.code)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  return address;
}

}  // namespace bl::serve
