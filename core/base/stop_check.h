// A cheap check of the stop request, for long loops.
#pragma once

#include "core/base/stop.h"

namespace bl {

/// Whether the innermost scope of this thread requests to stop. It takes some ten nanoseconds: call it for every hundredth
/// element, not for each.
inline bool is_stop_wished() {
  const StopWish* wish = stop_wish();
  return wish != nullptr && (*wish)();
}

}  // namespace bl
