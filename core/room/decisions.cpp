// What somebody who comes late has missed: it follows from the log, so that a room that goes on knows it again.
#include <tuple>

#include <nlohmann/json.hpp>

#include "core/room/room.h"

namespace bl::room {

namespace {

// The kind and the subject of a decision; without a kind it is none.
std::pair<std::string, std::string> decision_of(const std::string& event, const Json& arguments) {
  const auto text = [&](const char* name, const char* otherwise = "") { return arguments.value(name, std::string(otherwise)); };
  if (event == "decide_proposal" && arguments.value("is_accepted", false)) return {"proposal", text("draft")};
  if (event == "close_vote") return {"vote", text("vote")};
  if (event == "set_phase") return {"phase", text("name")};
  if (event == "restart") return {"restart", text("scenario")};
  if (event == "mark" && text("kind", "decision") == "decision") return {"mark", text("text")};
  return {};
}

}  // namespace

void Room::remember(const EntryRecord& record) {
  const LogEntry& entry = record.entry;
  Decision decision{.seq = entry.seq, .seat = RoomState::seat_of_author(entry.author.id), .at = record.at};
  if (entry.event) {
    const auto content = entry.event->read();
    if (!content) return;
    std::tie(decision.kind, decision.what) = decision_of((**content).value("event", ""), (**content)["arguments"]);
  } else if (entry.label.starts_with(kBackLabel)) {
    decision.kind = "rewind";
  }
  if (decision.kind.empty()) return;
  decisions_.push_front(std::move(decision));
  if (decisions_.size() > kKeptDecisions) decisions_.pop_back();
}

}  // namespace bl::room
