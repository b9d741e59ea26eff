// The log of commands: undo, journal and replay are all made of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/registry.h"
#include "core/session/author.h"

namespace bl {

/// Where an entry came from: a window, a script, a connection; and its number there, so that one that is sent twice is taken
/// once.
struct Source {
  std::string origin;
  std::int64_t operation = 0;  ///< ascending within its origin; 0: none
  bool operator==(const Source&) const = default;
};

/// One command as somebody gave it, or a rewind. Entries of one gesture are undone together.
struct LogEntry {
  std::int64_t seq = 0, tick = 0, gesture = 0;
  Author author = {};
  Command command = {};
  std::int64_t undoes = 0, redoes = 0;  ///< the gesture that this entry takes back or brings back; 0: none
  Source source = {};
  std::string label = {};     ///< what the step is called in the history; empty: as its command says
  bool is_abandoned = false;  ///< an undo that forgets the gesture as if it had never been: nothing brings it back
  std::optional<std::int64_t> rewinds_to =
      {};  ///< the running state goes back to this tick, the scene stays; there is no command
};

/// A hash that was reached at a tick; replay must reach it too.
struct LogCheck {
  std::int64_t tick = 0;
  std::string hash;
  bool is_end = false;
  std::size_t entries = 0;  ///< how many entries of the log stand before it
};

/// What a log file holds: JSON lines, the first with the scene it starts from.
struct LogFile {
  std::string scene;      ///< text of the scene file
  std::int64_t base = 0;  ///< number of the last entry before the scene; 0 where the session began with it
  std::vector<LogEntry> entries;
  std::vector<LogCheck> checks;
  std::int64_t last_tick = 0;  ///< of the scene and all lines since the last rewind
  bool is_cut_off = false;     ///< the last line was incomplete, as after a crash; it is left out
  bool has_end = false;        ///< whoever wrote it came to the end; without it lines may be missing
};

/// No line of a log may lie farther than this after the line before it [ticks]: 58 days at twenty a second.
inline constexpr std::int64_t kMostTicksBetweenLines = 100000000;

/// A replay has to come to what the log says. A recovery wants what people did, whatever the ticks, also from logs of older
/// programs: undos of what the log does not hold are steps like any other for it.
enum class LogUse { replay, recovery };

/// `base`: the number of the last entry that the scene holds already.
std::string log_header(std::string_view scene_text, std::int64_t base = 0);
std::string log_line(const LogEntry& entry, const Registry& registry);
std::string log_line(const LogCheck& check);
/// Refuses lines out of order, beyond the end, far away in time, or that take back what is not there, each with its number.
Result<LogFile> read_log(std::string_view text, const Registry& registry, LogUse use = LogUse::replay);

}  // namespace bl
