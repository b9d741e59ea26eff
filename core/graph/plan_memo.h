// A cache of what readers derive from the structure of a plan.
#pragma once

#include <map>
#include <memory>
#include <mutex>

namespace bl {

/// It is no part of the plan's content, since it follows from the indices of nodes, typifications and ports. Any thread may use
/// it.
class PlanMemo {
 public:
  /// The object for `key`, which always belongs to one T; `make` is called where there is none yet.
  template <class T, class Make>
  std::shared_ptr<const T> of(const void* key, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = kept_.find(key); found != kept_.end()) return std::static_pointer_cast<const T>(found->second);
    }
    auto made = std::make_shared<const T>(make());
    const std::lock_guard lock(mutex_);
    return std::static_pointer_cast<const T>(kept_.emplace(key, std::move(made)).first->second);
  }

 private:
  std::mutex mutex_;
  std::map<const void*, std::shared_ptr<const void>> kept_;  // looked up only, never walked
};

}  // namespace bl
