// Operations from the frames that pages send, and answers as frames.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/room/answer.h"
#include "core/room/operation.h"
#include "core/wire/messages.h"

namespace bl::wire {

/// JSON of frames is nested no deeper than this.
inline constexpr std::size_t kFrameDepth = 16;

/// A frame as JSON with its `t`; an error where it is no object with a text `t`, or nested too deeply.
Result<Json> read_frame(std::string_view text);

/// Is it one of the messages that have an `id` and an answer?
bool is_operation(const std::string& t);
/// The operation of such a frame; `unreadable` where its form is wrong. Its number is 0 where not even that is there.
room::Operation read_operation(const Json& frame, const std::string& run);

/// `ack` or `nack`.
std::string write_answer(std::int64_t operation, const room::Answer& answer);

}  // namespace bl::wire
