// How long work learns that nobody wants its result any more, without every function on the way knowing of it.
#pragma once

#include <functional>

namespace bl {

/// True as soon as the work may be dropped. Asked from any thread, as long as the scope that it was given to lives.
using StopWish = std::function<bool()>;

/// What is begun on this thread while it lives may be stopped; scopes nest. Work that looks at the wish may end early with
/// anything: whoever made the scope asks the wish again afterwards, and drops what came of it.
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

/// The wish of the innermost scope of this thread, or nullptr. Threads of a ThreadPool have that of the thread whose loop they
/// help with; other threads fetch it before they begin.
const StopWish* stop_wish();

/// While it lives, this thread stops by the wish of the thread that it works for (nullptr: by none).
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
