// The question that long loops ask once in a while: does anybody still want what comes of this?
#pragma once

#include "core/base/stop.h"

namespace bl {

/// Whether the innermost scope of this thread wants its work dropped. Some ten nanoseconds: for every hundredth element, not for each.
inline bool is_stop_wished() {
  const StopWish* wish = stop_wish();
  return wish != nullptr && (*wish)();
}

}  // namespace bl
