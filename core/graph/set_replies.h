// What typifications over sets write to their members at the end of phase 6.
#pragma once

#include <cstdint>
#include <vector>

#include "core/graph/state.h"

namespace bl {

struct Reply {
  PortRef target;
  Value value;
  std::uint32_t node = 0, type = 0;  ///< who wrote it
};

/// One reply, of whoever has the port to itself. What stands there already is left alone.
void write_reply(StateDraft& next, PortRef target, Value&& value);
/// Where two write to one port the first one has it, and the other one says so.
void write_replies(StateDraft& next, std::vector<Reply>& replies);
/// Shapes that a failing solver leaves standing are state like any value, and saved: their zeros have no sign, either. Recipes
/// see to that, and nothing is made for it.
void keep_shapes(StateDraft& next, const SetGroup& group);

}  // namespace bl
