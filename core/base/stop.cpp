// One stop request for each thread.
#include "core/base/stop.h"

#include <utility>

namespace bl {

namespace {

thread_local const StopWish* innermost = nullptr;

}  // namespace

StopScope::StopScope(StopWish wish) : wish_(std::move(wish)), outer_(std::exchange(innermost, &wish_)) {}

StopScope::~StopScope() { innermost = outer_; }

const StopWish* stop_wish() { return innermost; }

InheritedStop::InheritedStop(const StopWish* wish) : own_(std::exchange(innermost, wish)) {}

InheritedStop::~InheritedStop() { innermost = own_; }

}  // namespace bl
