// Counts by address. An entry goes when nobody of that address is there, and its failures are forgotten.
#include "core/serve/gate.h"

#include <algorithm>
#include <deque>
#include <map>
#include <vector>

namespace bl::serve {

struct Gate::State {
  struct Waiting {
    Pass* pass;
    std::function<void()> begin;
    double since;
  };
  struct Address {
    std::size_t connections = 0, half_open = 0;
    std::deque<Waiting> waiting;
    double failures = 0, failures_at = 0;  // how many were not forgotten yet, and when that was
  };
  GateLimits limits;
  std::map<std::string, Address> addresses;

  double failures_of(const Address& address, double now) const {
    return std::max(0.0, address.failures - (now - address.failures_at) * limits.failures_per_second);
  }
};

Gate::Pass::Pass(std::shared_ptr<State> state, std::string address) : state_(std::move(state)), address_(std::move(address)) {}

Gate::Pass::~Pass() { leave(); }

void Gate::Pass::leave() {
  if (address_.empty()) return;
  const auto found = state_->addresses.find(address_);
  if (found == state_->addresses.end()) return;
  State::Address& address = found->second;
  --address.connections;
  if (is_half_open_) --address.half_open;
  is_half_open_ = false;
  std::erase_if(address.waiting, [this](const State::Waiting& one) { return one.pass == this; });
}

void Gate::Pass::begin(std::function<void()> begin, double now) {
  if (address_.empty()) return begin();
  State::Address& address = state_->addresses[address_];
  if (address.half_open >= state_->limits.half_open || !address.waiting.empty()) {
    address.waiting.push_back({this, std::move(begin), now});
    return;
  }
  ++address.half_open;
  is_half_open_ = true;
  begin();
}

void Gate::Pass::open() {
  if (!is_half_open_) return;
  is_half_open_ = false;
  --state_->addresses[address_].half_open;
}

bool Gate::Pass::move_to(const std::string& address) {
  if (address == address_) return true;
  State::Address& place = state_->addresses[address];
  if (place.connections >= state_->limits.connections) return false;
  leave();
  ++place.connections;
  address_ = address;
  return true;
}

Gate::Gate(GateLimits limits) : state_(std::make_shared<State>()) { state_->limits = limits; }

// Those who wait hold their passes, which hold the state.
Gate::~Gate() {
  auto addresses = std::move(state_->addresses);
  state_->addresses.clear();
}

std::unique_ptr<Gate::Pass> Gate::enter(const std::string& address, bool is_free) {
  if (is_free) return std::make_unique<Pass>(state_, "");
  State::Address& place = state_->addresses[address];
  if (place.connections >= state_->limits.connections) return nullptr;
  ++place.connections;
  return std::make_unique<Pass>(state_, address);
}

void Gate::turn(double now) {
  std::vector<std::function<void()>> ready, late;
  for (auto& [name, address] : state_->addresses) {
    while (!address.waiting.empty() && now - address.waiting.front().since > state_->limits.patience) {
      late.push_back(std::move(address.waiting.front().begin));
      address.waiting.pop_front();
    }
    while (!address.waiting.empty() && address.half_open < state_->limits.half_open) {
      ++address.half_open;
      address.waiting.front().pass->is_half_open_ = true;
      ready.push_back(std::move(address.waiting.front().begin));
      address.waiting.pop_front();
    }
  }
  for (const auto& begin : ready) begin();
  ready.clear();
  late.clear();  // whoever waited there goes with it
  std::erase_if(state_->addresses, [&](const auto& one) {
    return one.second.connections == 0 && one.second.waiting.empty() && state_->failures_of(one.second, now) == 0;
  });
}

// A try needs room for a whole failure: else whoever is at the limit could go on at once.
bool Gate::may_try(const std::string& address, double now) {
  const auto found = state_->addresses.find(address);
  return found == state_->addresses.end() || state_->failures_of(found->second, now) + 1 <= state_->limits.failures;
}

void Gate::note_failure(const std::string& address, double now) {
  State::Address& place = state_->addresses[address];
  place.failures = state_->failures_of(place, now) + 1;
  place.failures_at = now;
}

// --- Who asks -------------------------------------------------------------------------------------------------------

Asking asked_by(Asking direct, const ForwardedFields& forwarded) {
  if (!forwarded.address.empty()) {
    std::string_view last = forwarded.address.substr(forwarded.address.rfind(',') + 1);
    while (last.starts_with(' ')) last.remove_prefix(1);
    while (last.ends_with(' ')) last.remove_suffix(1);
    const bool is_address =
        !last.empty() && last.size() < 64 && last.find_first_not_of("0123456789abcdefABCDEF.:[]") == std::string_view::npos;
    if (is_address) direct.address = last;
  }
  if (const std::string host = plain_host(forwarded.host); !host.empty()) direct.host = host;
  if (forwarded.scheme == "http" || forwarded.scheme == "https") direct.scheme = forwarded.scheme;
  return direct;
}

std::string plain_host(std::string_view text) {
  const bool is_plain =
      text.size() < 256 &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-:[]") == std::string_view::npos;
  return is_plain ? std::string(text) : std::string();
}

bool is_own_origin(std::string_view origin, std::string_view host, std::string_view scheme) {
  const std::size_t end = origin.find("://");
  return end != std::string_view::npos && !host.empty() && origin.substr(end + 3) == host &&
         (scheme.empty() || origin.substr(0, end) == scheme);
}

bool tries_a_code(std::string_view target) {
  const std::string_view code = target.substr(0, target.find_first_of("?#"));
  return code.size() == 5 && code.front() == '/' &&
         std::all_of(code.begin() + 1, code.end(), [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
}

}  // namespace bl::serve
