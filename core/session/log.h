// The log of commands, which undo, journal and replay use.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/payload.h"
#include "core/define/registry.h"
#include "core/graph/state.h"
#include "core/session/author.h"

namespace bl {

/// The origin of an entry (a window, a script, a connection) and its number there, so that an entry sent twice is applied once.
struct Source {
  std::string origin;
  std::int64_t operation = 0;  ///< ascending within its origin; 0: none
  bool operator==(const Source&) const = default;
};

/// One command of an author, a rewind or another return, or an event of the room around the session. Entries of one gesture are
/// undone together.
struct LogEntry {
  std::int64_t seq = 0, tick = 0, gesture = 0;
  Author author = {};
  Command command = {};
  std::int64_t undoes = 0, redoes = 0;  ///< the gesture that this entry undoes or redoes; 0: none
  Source source = {};
  std::string label = {};     ///< the name of the step in the history; empty: derived from its command
  bool is_abandoned = false;  ///< an undo for good: the gesture cannot be redone
  std::optional<std::int64_t> rewinds_to =
      {};  ///< the running state goes back to this tick, the scene stays; there is no command
  /// The running state goes back to the one with which that entry was made, under the present scene; there is no command. Unlike
  /// a rewind it takes in first what was said in its own tick, such as the commands that bring the scene of that entry back.
  std::optional<std::int64_t> restarts_from = {};
  std::string state_hash = {};  ///< of the state that a restart goes back to
  bool is_called_off = false;   ///< a rewind that could not take place: it stays where it is, but no log file has it
  /// What happened among the people, such as a poll that was opened: {"event": id, "arguments": {...}}. It has its number and its
  /// tick, and changes no scene; what it means is not the session's to know.
  std::optional<JsonValue> event = {};

  bool is_command() const { return !is_return() && !event; }
  /// Do the ticks go back?
  bool is_return() const { return rewinds_to || restarts_from; }
};

/// A hash that was reached at a tick; a replay must reach the same one.
struct LogCheck {
  std::int64_t tick = 0;
  std::string hash;
  bool is_end = false;
  std::size_t entries = 0;  ///< how many entries of the log stand before it
};

/// The content of a log file: JSON lines, of which the first holds the initial scene.
struct LogFile {
  std::string scene;      ///< text of the scene file
  int hash_scheme = 1;    ///< of its checks (`kHashScheme`)
  std::int64_t base = 0;  ///< number of the last entry before the scene; 0 where the session began with it
  std::vector<LogEntry> entries;
  std::vector<LogCheck> checks;
  std::int64_t last_tick = 0;  ///< of the scene and all lines since the last rewind
  bool is_cut_off = false;     ///< the last line was incomplete, as after a crash; it is left out
  bool has_end = false;        ///< the writer reached the end; without it, lines may be missing
};

/// No line of a log may lie farther than this after the line before it [ticks]: 58 days at twenty a second.
inline constexpr std::int64_t kMostTicksBetweenLines = 100000000;

/// A replay must reach the hashes of the log. A recovery applies what people did, whatever the ticks, also from logs of older
/// programs; for it, an undo of an entry that the log does not hold is an ordinary step.
enum class LogUse { replay, recovery };

/// `base`: the number of the last entry that the scene holds already. `hash_scheme`: of the checks that follow.
std::string log_header(std::string_view scene_text, std::int64_t base = 0, int hash_scheme = kHashScheme);
std::string log_line(const LogEntry& entry, const Registry& registry);
/// What `log_line` has written of an entry, read again by itself: whether it fits those before it is not checked.
Result<LogEntry> log_entry_of(std::string_view line, const Registry& registry);
std::string log_line(const LogCheck& check);
/// Refuses lines that are out of order, after the end or far away in time, and undos of missing entries, each with its line
/// number.
Result<LogFile> read_log(std::string_view text, const Registry& registry, LogUse use = LogUse::replay);

}  // namespace bl
