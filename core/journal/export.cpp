// Entries and hashes merged by the number of the entry.
#include "core/journal/export.h"

namespace bl::journal {

std::string log_text(const RoomRow& room, const Loaded& all, const Registry& registry) {
  std::string text = log_header(room.scene, room.base, room.hash_scheme);
  const auto& entries = all.room.stored.entries;
  const std::int64_t last = entries.empty() ? room.base : entries.back().entry.seq;
  auto hash = all.hashes.begin();
  // Those that were taken before the entry with this number.
  const auto write_hashes = [&](std::int64_t before) {
    for (; hash != all.hashes.end() && hash->seq < before; ++hash) {
      const bool is_end = std::next(hash) == all.hashes.end() && hash->seq == last;
      text += log_line(LogCheck{.tick = hash->tick, .hash = hash->hash, .is_end = is_end});
    }
  };
  for (const room::EntryRecord& record : entries) {
    write_hashes(record.entry.seq);
    if (!record.entry.is_called_off) text += log_line(record.entry, registry);
  }
  write_hashes(last + 1);
  return text;
}

}  // namespace bl::journal
