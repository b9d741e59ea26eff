// Messages of a room as frames, which all who get the same one share.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/room/record.h"
#include "core/wire/messages.h"

namespace bl::serve {

inline std::shared_ptr<const std::string> frame_of(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

template <class M>
std::shared_ptr<const std::string> frame_of_message(const M& message) {
  return frame_of(wire::write_message(message));
}

/// `stored`: the number of the last entry that is on the disk.
std::shared_ptr<const std::string> frame_of_entries(const std::vector<room::EntryRecord>& records, std::int64_t stored,
                                                    std::int64_t epoch);

}  // namespace bl::serve
