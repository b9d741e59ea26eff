// Stop requests for long computations, without an argument in every function in between.
#pragma once

#include <functional>

namespace bl {

/// A stop request: returns true as soon as the work may be dropped. It is called from any thread while its scope exists.
using StopWish = std::function<bool()>;

/// While it exists, work on this thread may be stopped; scopes nest. Stopped work may return anything: the owner of the scope
/// checks the request afterwards, and drops the result.
class StopScope {
 public:
  explicit StopScope(StopWish wish);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  StopWish wish_;
  const StopWish* outer_;
};

/// The stop request of the innermost scope of this thread, or nullptr. Threads of a ThreadPool use that of the thread whose loop
/// they run; other threads take it over before they begin.
const StopWish* stop_wish();

/// While it exists, this thread uses the stop request of the thread that it works for (nullptr: none).
class InheritedStop {
 public:
  explicit InheritedStop(const StopWish* wish);
  ~InheritedStop();
  InheritedStop(const InheritedStop&) = delete;
  InheritedStop& operator=(const InheritedStop&) = delete;

 private:
  const StopWish* own_;
};

}  // namespace bl
