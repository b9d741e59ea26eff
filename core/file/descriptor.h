// Shared by reading and writing through POSIX calls: an open file that is always closed, and system errors as sentences.
#pragma once

#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/base/result.h"

namespace bl {

/// "what: the system's reason", of the call that failed last.
inline Error io_error(const std::string& path, const std::string& what) {
  return {ErrorCode::io, path, what + ": " + std::strerror(errno)};
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// Hands the open file over to the caller.
  int release() {
    const int number = number_;
    number_ = -1;
    return number;
  }

 private:
  int number_;
};

}  // namespace bl
