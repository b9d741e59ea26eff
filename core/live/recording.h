// Plays a recorded table as a sensor, at the ticks that follow from its times.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/address/live_address.h"
#include "core/base/result.h"

namespace bl::live {

struct RecordedReading {
  double seconds = 0;  ///< since 1970, or since whatever the table counts from
  double value = 0;
  std::string problem;  ///< why the row holds no number; empty where it does
  std::string time;     ///< as it stood in the table
};

struct Recording {
  std::vector<RecordedReading> readings;  ///< ascending time; rows of one time in their order in the table
  // Every row of the table is accounted for: readings, and
  std::size_t filtered = 0;  ///< rows of others
  std::size_t empty = 0;     ///< rows without a reading: the device said nothing
};

/// The column of `address` out of a CSV text. Rows whose time cannot be read are errors with their line.
Result<Recording> read_recording(std::string_view text, const address::LiveAddress& address);

/// The tick that a reading belongs to: the first one belongs to tick 1, and the others to the tick nearest to their time.
std::int64_t tick_of(const Recording& recording, const RecordedReading& reading, double tick_length);

}  // namespace bl::live
