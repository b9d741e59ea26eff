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

/// Writes replies, each of whoever has the port to itself. What stands there already is left alone. Replies to one typification
/// come one after the other, so that it is looked up once; nobody else edits it meanwhile.
class ReplyWriter {
 public:
  explicit ReplyWriter(StateDraft& next) : next_(next) {}
  void write(PortRef target, Value&& value);

 private:
  StateDraft& next_;
  PortRef at_;                      // the typification that was written to last, and any of its ports
  const TypeState* now_ = nullptr;  // as it stands; nullptr: none yet
  TypeState* own_ = nullptr;        // the same, once something in it has changed
};

/// Where two write to one port the first one has it, and the other one says so.
void write_replies(StateDraft& next, std::vector<Reply>& replies);
/// Shapes that a failing solver leaves standing are state like any value, and saved: their zeros have no sign, either. Recipes
/// see to that, and nothing is made for it.
void keep_shapes(StateDraft& next, const SetGroup& group);

}  // namespace bl
