// How far proposals disagree at the ports of one typification.
#pragma once

#include <cstddef>
#include <vector>

namespace bl {

/// One number for each port. Of most nodes nobody disagrees about anything, and each change of a node copies it: without a
/// tension there is nothing to hold.
class Tensions {
 public:
  Tensions() = default;
  /// None at any of so many ports.
  explicit Tensions(std::size_t ports) : ports_(ports) {}

  std::size_t size() const { return ports_; }
  double operator[](std::size_t port) const { return some_.empty() ? 0 : some_[port]; }
  void set(std::size_t port, double tension) {
    if (some_.empty()) {
      if (tension == 0) return;
      some_.resize(ports_);
    }
    some_[port] = tension;
  }
  /// Once all are set: what has gone is held no longer.
  void tidy() {
    for (const double tension : some_)
      if (tension != 0) return;
    some_ = {};
  }
  bool operator==(const Tensions& other) const {
    if (ports_ != other.ports_) return false;
    for (std::size_t port = 0; port < ports_ && !(some_.empty() && other.some_.empty()); ++port)
      if ((*this)[port] != other[port]) return false;
    return true;
  }

 private:
  std::size_t ports_ = 0;
  std::vector<double> some_;  // by port; empty: no tension at all
};

}  // namespace bl
