// A session file as a log of JSON lines, which `replay` runs again.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/journal/rows.h"

namespace bl::journal {

/// All entries with the hashes as checks between them. Where the last hash was taken after the last entry, it is the end of the
/// log. Rewinds that were called off are left out.
std::string log_text(const RoomRow& room, const Loaded& all, const Registry& registry);

}  // namespace bl::journal
