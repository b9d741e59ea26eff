// An OpenGL context without any window or display, for tests of what shaders compute.
#pragma once

#include <string>

namespace bl::desktop {

class OffscreenGl {
 public:
  OffscreenGl();
  ~OffscreenGl();
  OffscreenGl(const OffscreenGl&) = delete;
  OffscreenGl& operator=(const OffscreenGl&) = delete;

  /// False where this computer has no OpenGL 3.3 at all; `failure` says why.
  bool is_there() const { return context_ != nullptr; }
  const std::string& failure() const { return failure_; }

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string failure_;
};

}  // namespace bl::desktop
