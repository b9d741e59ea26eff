// Entries of the log as windows get them.
#include "core/serve/room_frames.h"

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/define/registry.h"

namespace bl::serve {

namespace {

Json entry_to_json(const LogEntry& entry, std::int64_t by, const std::string& draft) {
  Json json = {{"s", entry.seq}, {"k", entry.tick}, {"a", entry.author.id}, {"g", entry.gesture}};
  if (entry.author.kind != AuthorKind::person) json["kind"] = entry.author.kind == AuthorKind::device ? "device" : "program";
  if (entry.undoes != 0) json["u"] = entry.undoes;
  if (entry.redoes != 0) json["r"] = entry.redoes;
  if (!entry.label.empty()) json["l"] = entry.label;
  if (entry.restarts_from) json["back"] = *entry.restarts_from, json["state"] = entry.state_hash;
  else if (entry.event) json["v"] = **entry.event->read();
  else json["c"] = command_to_json(full_registry(), entry.command);
  if (by != 0) json["by"] = by;
  if (!draft.empty()) json["d"] = draft;
  return json;
}

}  // namespace

std::shared_ptr<const std::string> frame_of_entries(const std::vector<room::EntryRecord>& records, std::int64_t stored,
                                                    std::int64_t epoch) {
  Json list = Json::array();
  for (const room::EntryRecord& record : records) list.push_back(entry_to_json(record.entry, record.by, record.draft));
  return frame_of_message(wire::Ops{JsonValue::of(std::move(list)), stored, epoch});
}

}  // namespace bl::serve
