// How many connections, and how many failed attempts, one address may have; and who is asking, where a proxy stands between.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace bl::serve {

struct GateLimits {
  std::size_t half_open = 32;      ///< connections of an address that have not said yet what they want; more of them wait
  std::size_t connections = 256;   ///< of an address; more are refused. A school may stand behind one address.
  double patience = 5;             ///< so long one waits for its turn [s]
  double failures = 60;            ///< wrong codes at once,
  double failures_per_second = 1;  ///< and afterwards
};

/// Not for several threads.
class Gate {
 public:
  struct State;
  /// A connection's place; it is given back with the object.
  class Pass {
   public:
    Pass(std::shared_ptr<State> state, std::string address);
    ~Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;
    const std::string& address() const { return address_; }
    /// Calls `begin` when few enough of this address are half open: now, later, or never.
    void begin(std::function<void()> begin, double now);
    /// It has said what it wants.
    void open();
    /// The proxy says for whom it asks: that address counts from now on. False where it has too many connections already.
    bool move_to(const std::string& address);

   private:
    friend class Gate;
    void leave();
    std::shared_ptr<State> state_;
    std::string address_;
    bool is_half_open_ = false;
  };

  explicit Gate(GateLimits limits = {});
  ~Gate();
  /// Nothing where the address has as many connections as it may have. `is_free`: of the proxy, which has no limit itself.
  std::unique_ptr<Pass> enter(const std::string& address, bool is_free = false);
  /// Lets those begin whose turn it is, and sends away who has waited too long. Called often.
  void turn(double now);

  /// False after too many failures: nothing more is tried for this address.
  bool may_try(const std::string& address, double now);
  void note_failure(const std::string& address, double now);

 private:
  std::shared_ptr<State> state_;
};

/// Who asks, by what name they know this server, and by which protocol.
struct Asking {
  std::string address, host, scheme;
};
/// The fields of a request that a proxy adds, as they came; empty where they are not there.
struct ForwardedFields {
  std::string_view address, host, scheme;  ///< X-Forwarded-For, -Host, -Proto
};
/// The last address of a list is the one that the proxy has seen itself; those before it are what it was told.
Asking asked_by(Asking direct, const ForwardedFields& forwarded);

/// The host goes into a header: what is no host name becomes nothing.
std::string plain_host(std::string_view text);
/// The page of another site may not talk to us in the name of somebody who has both open. `scheme`: empty where it is not known.
bool is_own_origin(std::string_view origin, std::string_view host, std::string_view scheme);
/// A path that tries the code of a room: `/BKRT`.
bool tries_a_code(std::string_view target);

}  // namespace bl::serve
