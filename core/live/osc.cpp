// Open Sound Control by UDP: hears the messages of sensors on a port, and sends those of actuators.
#include <lo/lo.h>

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/base/text.h"
#include "core/live/endpoint.h"
#include "core/live/message.h"
#include "core/live/socket.h"

namespace bl::live {

namespace {

constexpr int kOscSlice = 50;            // [ms] between two looks at whether the end is asked for
constexpr std::size_t kBuffer = 65536;   // no datagram is longer
constexpr int kDeepest = 4;              // bundles inside bundles
constexpr std::size_t kBundleHead = 16;  // "#bundle", a zero and the time

using Message = std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(&lo_message_free)>;

// Hands one argument over; which one, the field says.
void hand_over(lo_message message, const Subscriber& subscriber) {
  Station& station = *subscriber.station;
  const std::string field = station.field();
  const auto index = field.empty() ? std::optional(0.0) : parse_number(field);
  if (!index || *index < 0 || *index > 1000)
    return station.problem("the field " + in_quotes(field) + " is no number of an argument: write 0 for the first");
  const int at = static_cast<int>(*index), count = lo_message_get_argc(message);
  if (at >= count)
    return station.problem("the message has " + std::to_string(count) + " arguments, and number " + std::to_string(at) +
                           " (counted from 0) is wanted");
  const char type = lo_message_get_types(message)[at];
  // Arguments lie at multiples of four bytes, which is no place for numbers of eight.
  const void* bytes = lo_message_get_argv(message)[at];
  const auto read = [bytes](auto number) {
    std::memcpy(&number, bytes, sizeof number);
    return number;
  };
  const auto put = [&](double number) {
    if (number - number != 0) station.problem("the message holds a number that is not finite");
    else station.number(number);
  };
  switch (type) {
    case LO_INT32: return put(read(std::int32_t{}));
    case LO_INT64: return put(static_cast<double>(read(std::int64_t{})));
    case LO_FLOAT: return put(static_cast<double>(read(float{})));
    case LO_DOUBLE: return put(read(double{}));
    case LO_TRUE: return put(1);
    case LO_FALSE: return put(0);
    case LO_STRING:
    case LO_SYMBOL: {
      const auto number = number_in(static_cast<const char*>(bytes), "");
      return number ? put(*number) : station.problem(number.error().message);
    }
    default: return station.problem(std::string("an argument of the OSC type `") + type + "` holds no number");
  }
}

std::uint32_t big_endian(const char* bytes) {
  std::uint32_t number = 0;
  for (int i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

bool deliver_message(Endpoint& endpoint, std::span<const char> bytes) {
  // The path ends with a zero inside the packet, or the packet is none.
  if (bytes.empty() || bytes.front() != '/' || std::memchr(bytes.data(), 0, bytes.size()) == nullptr) return false;
  std::vector<char> packet(bytes.begin(), bytes.end());  // the library reads numbers where they stand, which has to be aligned
  const std::string path(packet.data());
  int problem = 0;
  const Message message(lo_message_deserialise(packet.data(), packet.size(), &problem), lo_message_free);
  if (!message) return false;
  for (const Subscriber& subscriber : endpoint.subscribers())
    if (subscriber.path == path) hand_over(message.get(), subscriber);
  return true;
}

// Whether all of it could be read; its messages are handed to the sensors that they name.
bool deliver(Endpoint& endpoint, std::span<const char> packet, int depth) {
  if (packet.size() < kBundleHead || std::memcmp(packet.data(), "#bundle", 8) != 0) return deliver_message(endpoint, packet);
  if (depth == kDeepest) return false;
  for (std::size_t at = kBundleHead; at < packet.size();) {
    if (packet.size() - at < 4) return false;
    const std::size_t size = big_endian(packet.data() + at);
    at += 4;
    if (size == 0 || size > packet.size() - at) return false;
    if (!deliver(endpoint, packet.subspan(at, size), depth + 1)) return false;
    at += size;
  }
  return true;
}

void hear(Endpoint& endpoint, const Socket& socket) {
  std::vector<char> buffer(kBuffer);
  while (!endpoint.is_ending()) {
    pollfd watched{socket.handle(), POLLIN, 0};
    if (poll(&watched, 1, kOscSlice) <= 0) continue;
    const ssize_t size = recv(socket.handle(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size < 0) continue;
    // Noise names no sensor, so all on this port hear of it.
    if (!deliver(endpoint, std::span(buffer).first(static_cast<std::size_t>(size)), 0))
      for (const Subscriber& subscriber : endpoint.subscribers())
        subscriber.station->problem("a packet on the port " + std::to_string(endpoint.port()) + " is no OSC message");
  }
}

// Empty, or why the message could not go out.
std::string send(const Outgoing& message, lo_address target) {
  const Message osc(lo_message_new(), lo_message_free);
  if (!osc) return "there is no memory for a message";
  if (message.number) lo_message_add_float(osc.get(), static_cast<float>(*message.number));
  else lo_message_add_string(osc.get(), message.text.c_str());
  if (lo_send_message(target, message.path.c_str(), osc.get()) >= 0) return "";
  const char* reason = lo_address_errstr(target);
  return std::string("a message could not be sent: ") + (reason != nullptr ? reason : "no reason given");
}

}  // namespace

void run_osc_input(Endpoint& endpoint) {
  while (!endpoint.is_ending()) {
    const auto socket = listen_udp(endpoint);
    if (!socket) {
      endpoint.fail(socket.error().message);
      continue;
    }
    endpoint.succeed();
    hear(endpoint, *socket);
  }
}

void run_osc_output(Endpoint& endpoint) {
  const std::unique_ptr<std::remove_pointer_t<lo_address>, decltype(&lo_address_free)> target(
      lo_address_new(endpoint.host().c_str(), std::to_string(endpoint.port()).c_str()), lo_address_free);
  while (!endpoint.is_ending()) {
    for (const Outgoing& message : endpoint.outgoing()) {
      const std::string problem = target ? send(message, target.get()) : "the address cannot be used";
      if (problem.empty()) message.station->count(&Traffic::sent);
      message.station->line(problem);
    }
    endpoint.wait_for_work(1);
  }
}

}  // namespace bl::live
