// Reads everything of a session file, and finds what of it is damaged.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/journal/database.h"
#include "core/journal/rows.h"

namespace bl::journal {

/// The one row of the room.
Result<RoomRow> read_room_row(Database& database);
/// Damage of rows is listed, in the order of the tables; a failure of the disk is an error.
Result<Loaded> read_all(Database& database, const RoomRow& room, const Registry& registry);
/// The hash of an entry and all before it; `before`: that of the entries before it, empty for the first.
std::string chain_after(const std::string& before, const room::EntryRecord& entry, const std::string& line);

}  // namespace bl::journal
