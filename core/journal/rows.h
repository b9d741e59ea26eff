// What a journal holds besides the rows that a room hands over: the room itself, snapshots, hashes, and all of it as it is read.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/state.h"
#include "core/journal/packed.h"
#include "core/room/record.h"

namespace bl::journal {

/// The room that a file belongs to. Times are those of the host's clock [ms since 1970]; 0: none.
struct RoomRow {
  std::string code = {}, title = {};
  std::int64_t epoch = 1;         ///< grows each time the room begins anew
  std::string build = {};         ///< of the program that wrote the file last
  std::string registry = {};      ///< a hash of the types that it knew
  int hash_scheme = kHashScheme;  ///< of the rows of hashes
  std::int64_t base = 0;          ///< number of the last entry before the scene
  std::string scene = {};         ///< the scene file of the beginning, as text
  std::int64_t created = 0, closes = 0, erase_on = 0;
};

/// A hash that the state had after a tick; a replay must reach the same one.
struct HashRow {
  std::int64_t seq = 0, tick = 0;  ///< `seq`: the last entry that the tick has read
  std::string hash;                ///< 16 hexadecimal digits
  bool operator==(const HashRow&) const = default;
};

/// A scene with its running state, from which a room can begin without the ticks before. It is packed by whoever makes it, so
/// that no commit waits for that.
struct Snapshot {
  std::int64_t seq = 0, tick = 0, epoch = 1;
  std::string hash;       ///< of the state; it is kept among the other hashes as well
  std::string name = {};  ///< of a scenario; a snapshot with a name is kept for ever, of the others the newest two
  Packed scene;           ///< the text of the scene file, with its state
};

/// Everything of a file.
struct Loaded {
  room::Stored room;
  std::optional<Snapshot> snapshot;           ///< the newest one that is whole
  std::map<std::string, Snapshot> scenarios;  ///< by scenario: its scene with its running state
  std::vector<HashRow> hashes;                ///< in the order of entries, then of ticks
  std::string chain;                          ///< a hash of all entries; equal where the same things were said in the same order
  /// Of a file that is open for reading only: what is damaged, with its place. It is left out, and of the entries all after the
  /// first damaged one. Of a file that is open for more there is none.
  std::vector<Error> damage;
  std::vector<Error> unusable_snapshots;  ///< newer ones that were passed over, because they are damaged
};

}  // namespace bl::journal
