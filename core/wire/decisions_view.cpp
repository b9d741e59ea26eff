// The words of decisions, as far as they have not been erased.
#include "core/wire/decisions_view.h"

#include <nlohmann/json.hpp>

#include "core/wire/view_parts.h"

namespace bl::wire {

View decisions_view(const ViewSources& sources) {
  View view;
  const room::RoomState& state = sources.room.state();
  for (const room::Decision& decision : sources.room.decisions()) {
    Json json = {{"kind", decision.kind}, {"seat", decision.seat}, {"at", decision.at}};
    if (decision.kind == "proposal") {
      const auto proposal = state.proposals.find(decision.what);
      if (proposal == state.proposals.end()) continue;
      json["title"] = sources.room.words(proposal->second.title);
      json["of"] = proposal->second.seat;
      if (!proposal->second.answer.empty()) json["text"] = text_of(sources.room, proposal->second.answer);
    } else if (decision.kind == "vote") {
      json["vote"] = decision.what;
    } else if (decision.kind == "phase") {
      json["title"] = sources.room.words(decision.what);
    } else if (decision.kind == "restart") {
      const auto scenario = state.scenarios.find(decision.what);
      json["title"] = scenario == state.scenarios.end() ? decision.what : sources.room.words(scenario->second.name);
    } else if (decision.kind == "mark") {
      json["text"] = text_of(sources.room, decision.what);
    }
    view[std::to_string(decision.seq)] = write_json_line(json);
  }
  return view;
}

}  // namespace bl::wire
