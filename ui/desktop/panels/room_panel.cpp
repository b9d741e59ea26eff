// The tab Room: who is here, what may be done now, votes and pens; what facilitators see besides stands in room_lead.cpp.
#include "ui/desktop/panels/room_panel.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/serve/qr_code.h"
#include "core/session/commands.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

namespace {

constexpr float kLeastModule = 2, kLargeModule = 9;  // of a QR code, in points

// People read a countdown; nothing that is computed depends on it. [ms since 1970]
std::int64_t wall_clock() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

std::string minutes_and_seconds(std::int64_t milliseconds) {
  const std::int64_t seconds = (milliseconds + 999) / 1000;
  const std::string rest = std::to_string(seconds % 60);
  return std::to_string(seconds / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

const char* words_for(const std::string& activity) {
  if (activity == "change") return "change the scene";
  if (activity == "draft") return "work on drafts";
  if (activity == "comment") return "comment";
  return "vote";
}

// Away is without a connection. With one, the page may still lie in a pocket.
std::string presence_of(const RoomDesk& desk, const AgendaSeat& seat) {
  if (!seat.is_here) return "away";
  const auto& everybody = desk.room.people().whereabouts;
  const auto where = everybody.find(seat.number);
  if (where == everybody.end()) return "here";
  if (where->second.is_hidden) return "here, not looking";
  return where->second.holds.empty() ? "active" : "at " + desk.editor.name_of(where->second.holds.front());
}

void draw_seats(const RoomDesk& desk) {
  const Colours& c = desk.editor.theme.colours();
  const auto here =
      std::count_if(desk.agenda.seats.begin(), desk.agenda.seats.end(), [](const AgendaSeat& s) { return s.is_here; });
  desk.heading(("People, " + std::to_string(here) + " here").c_str());
  for (const AgendaSeat& seat : desk.agenda.seats) {
    ImGui::PushID(static_cast<int>(seat.number));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float r = desk.editor.theme.px(5), line = ImGui::GetTextLineHeight();
    const ImU32 colour = colour_of_text(seat.colour, c.text_soft);
    if (seat.is_here) ImGui::GetWindowDrawList()->AddCircleFilled({at.x + r, at.y + line / 2}, r, colour, 16);
    else ImGui::GetWindowDrawList()->AddCircle({at.x + r, at.y + line / 2}, r, colour, 16);
    ImGui::Dummy({3 * r, line});
    ImGui::SameLine();
    const auto card = desk.agenda.cards.find(seat.card);
    const std::string name = seat.name + (seat.number == desk.room.seat() ? " (you)" : "");
    const std::string words = seat.role + (card == desk.agenda.cards.end() ? "" : ", " + card->second) + ", " +
                              presence_of(desk, seat) + (seat.is_muted ? ", muted" : "");
    if (desk.leads) {
      if (ImGui::SmallButton(name.c_str())) ImGui::OpenPopup("seat");
      note_place(desk.editor, "roompanel/seat/" + std::to_string(seat.number));
      if (ImGui::BeginPopup("seat")) {
        draw_seat_menu(desk, seat);
        ImGui::EndPopup();
      }
    } else {
      ImGui::TextUnformatted(name.c_str());
    }
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, c.text_soft);
    ImGui::TextUnformatted(words.c_str());
    ImGui::PopStyleColor();
    ImGui::PopID();
  }
}

void draw_now(const RoomDesk& desk) {
  desk.heading(desk.agenda.phase.empty() ? "No phase has begun" : ("Phase: " + desk.agenda.phase).c_str());
  std::string may;
  for (const char* activity : {"change", "draft", "comment", "vote"})
    if (desk.agenda.may.contains(activity)) may += (may.empty() ? "" : ", ") + std::string(words_for(activity));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(may.empty() ? "People only look now." : ("People may now: " + may + ".").c_str());
  if (desk.room.people().is_paused) ImGui::TextUnformatted("The facilitator has paused the model.");
  ImGui::PopTextWrapPos();
  if (desk.agenda.ends_at == 0) return;
  const std::int64_t left = desk.agenda.ends_at - wall_clock();
  if (left > 0) desk.editor.wake_at(desk.editor.now + 1);
  ImGui::TextUnformatted(left > 0 ? ("Time left: " + minutes_and_seconds(left)).c_str() : "The time is over.");
}

void cast(const RoomDesk& desk, const AgendaVote& vote, const Json& ballot) {
  (void)desk.editor.submit(command<CastVote>({vote.id, desk.room.author(), JsonValue::of(ballot)}));
}

std::string why_no_ballot(const RoomDesk& desk) {
  const std::string& role = desk.room.role();
  if (role == "viewer" || role == "recorder" || role == "device") return "A " + role + " does not vote.";
  if (!desk.leads && !desk.agenda.may.contains("vote")) return "In this phase nobody can vote.";
  return "";
}

void draw_ballot(const RoomDesk& desk, const AgendaVote& vote) {
  const std::string why = why_no_ballot(desk);
  if (vote.kind == "yes_no") {
    if (desk.button("Yes", "roompanel/yes/" + vote.id, why)) cast(desk, vote, "yes");
    ImGui::SameLine();
    if (desk.button("No", "roompanel/no/" + vote.id, why)) cast(desk, vote, "no");
  } else if (vote.kind == "slider") {
    std::string& typed = desk.text("ballot/" + vote.id);
    ImGui::SetNextItemWidth(desk.editor.theme.px(80));
    ImGui::InputTextWithHint("##ballot", (reading::readable(vote.least) + " to " + reading::readable(vote.most)).c_str(), &typed);
    note_place(desk.editor, "roompanel/ballot/" + vote.id);
    char* end = nullptr;
    const double value = std::strtod(typed.c_str(), &end);
    const bool is_number = !typed.empty() && *end == '\0' && value >= vote.least && value <= vote.most;
    ImGui::SameLine();
    if (desk.button("Vote", "roompanel/cast/" + vote.id, why.empty() && !is_number ? "Type a number of the range." : why))
      cast(desk, vote, value);
  } else {
    desk.quiet("A ballot of this kind is cast on the page of the room.");
  }
  if (!vote.mine.empty()) desk.quiet("Your vote: " + vote.mine + ".");
}

}  // namespace

// --- What the parts share -------------------------------------------------------------------------------------------

bool RoomDesk::button(const std::string& label, const std::string& key, const std::string& why) const {
  const std::string& reason = why_not.empty() ? why : why_not;
  ImGui::BeginDisabled(!reason.empty());
  const bool is_pressed = ImGui::SmallButton((label + "##" + key).c_str());
  ImGui::EndDisabled();
  note_place(editor, key);
  if (!reason.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", reason.c_str());
  return is_pressed && reason.empty();
}

bool RoomDesk::sure_button(const std::string& label, const std::string& key, const std::string& question,
                           const std::string& yes) const {
  if (button(label, key)) ImGui::OpenPopup(key.c_str());
  if (!ImGui::BeginPopup(key.c_str())) return false;
  ImGui::TextUnformatted(question.c_str());
  const bool is_sure = button(yes, key + "/yes");
  ImGui::SameLine();
  if (ImGui::SmallButton("Cancel") || is_sure) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return is_sure;
}

std::string& RoomDesk::text(const std::string& field) const { return memory_of(editor).room_texts[field]; }

void RoomDesk::heading(const char* words) const {
  ImGui::PushFont(editor.theme.fonts().strong);
  ImGui::TextUnformatted(words);
  ImGui::PopFont();
}

void RoomDesk::quiet(const std::string& words) const {
  ImGui::PushStyleColor(ImGuiCol_Text, editor.theme.colours().text_soft);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

std::string RoomDesk::seat_name(std::int64_t seat) const {
  const auto found =
      std::find_if(agenda.seats.begin(), agenda.seats.end(), [&](const AgendaSeat& s) { return s.number == seat; });
  return found == agenda.seats.end() ? "seat " + std::to_string(seat) : found->name;
}

void draw_votes(const RoomDesk& desk) {
  for (const AgendaVote& vote : desk.agenda.votes) {
    if (!vote.is_open && !desk.leads && vote.result.empty()) continue;
    ImGui::PushID(vote.id.c_str());
    ImGui::Spacing();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(vote.question.c_str());
    ImGui::PopTextWrapPos();
    desk.quiet(std::string(vote.is_open ? "Open" : "Closed") + (vote.is_secret ? ", secret, " : ", ") +
               reading::counted(static_cast<std::size_t>(std::max<std::int64_t>(0, vote.count)), "ballot") +
               (vote.electorate > 0 ? " of " + std::to_string(vote.electorate) : "") + ".");
    if (vote.is_open) draw_ballot(desk, vote);
    for (const auto& [label, share] : vote.result)
      desk.quiet(label + ": " + std::to_string(static_cast<int>(std::lround(100 * share))) + " %");
    if (desk.leads && vote.is_open) {
      if (desk.button("Close the vote", "roompanel/close/" + vote.id)) desk.say("close_vote", JsonValue::of({{"vote", vote.id}}));
    } else if (desk.leads && desk.button("Open the vote", "roompanel/open/" + vote.id)) {
      // Ballots are taken in phases that name them.
      if (!desk.agenda.may.contains("vote")) {
        Json activities = desk.agenda.may;
        activities.push_back("vote");
        desk.say("set_phase", JsonValue::of({{"name", desk.agenda.phase},
                                             {"activities", activities},
                                             {"forms", desk.agenda.forms},
                                             {"ends_at", desk.agenda.ends_at}}));
      }
      desk.say("open_vote", JsonValue::of({{"vote", vote.id}, {"ends_at", 0}}));
    }
    ImGui::PopID();
  }
  if (desk.leads && desk.agenda.votes.empty()) desk.quiet("The scene has no votes. Votes are nodes of the scene.");
}

namespace {

void draw_code(const RoomDesk& desk, float module) {
  const auto modules = serve::qr_modules(desk.room.page());
  if (!modules) return desk.quiet(modules.error().text());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = module * static_cast<float>(modules->size());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  // Readers want dark on light, whatever the theme is.
  list.AddRectFilled(at, {at.x + side, at.y + side}, IM_COL32_WHITE);
  for (std::size_t y = 0; y < modules->size(); ++y)
    for (std::size_t x = 0; x < modules->size(); ++x) {
      const ImVec2 corner{at.x + module * static_cast<float>(x), at.y + module * static_cast<float>(y)};
      if ((*modules)[y][x]) list.AddRectFilled(corner, {corner.x + module, corner.y + module}, IM_COL32_BLACK);
    }
  ImGui::Dummy({side, side});
  note_place(desk.editor, "roompanel/code");
}

}  // namespace

void draw_address(const RoomDesk& desk) {
  desk.heading(("Room " + desk.room.code()).c_str());
  desk.quiet(desk.room.page());
  if (desk.room.page().find("//127.") != std::string::npos || desk.room.page().find("//localhost") != std::string::npos)
    desk.quiet("This is an address of this computer alone, which no phone can open.");
  draw_code(desk, std::max(1.0f, std::round(desk.editor.theme.px(kLeastModule))));
  if (ImGui::SmallButton("Show large")) ImGui::OpenPopup("large code");
  if (ImGui::BeginPopup("large code")) {
    draw_code(desk, std::round(desk.editor.theme.px(kLargeModule)));
    desk.heading(desk.room.code().c_str());
    ImGui::TextUnformatted(desk.room.page().c_str());
    ImGui::EndPopup();
  }
}

void draw_room_panel(Workbench& editor) {
  guest::RoomGuest* room = editor.document ? editor.document->room() : nullptr;
  if (room == nullptr) return;
  PanelMemory& memory = memory_of(editor);
  if (!memory.agenda || memory.agenda_revision != room->views_revision()) {
    memory.agenda = std::make_unique<Agenda>(agenda_of(*room));
    memory.agenda_revision = room->views_revision();
  }
  if (!memory.agenda->is_known) return ImGui::TextUnformatted("The room has not said anything yet.");
  RoomDesk desk{.editor = editor, .room = *room, .agenda = *memory.agenda, .leads = room->role() == "facilitator", .why_not = {}};
  const guest::Standing standing = room->standing();
  if (!standing.end.empty()) desk.why_not = standing.end;
  else if (!standing.is_connected) desk.why_not = "There is no connection to the room.";
  else if (room->people().is_closed) desk.why_not = "The session is over.";
  if (!desk.why_not.empty()) desk.quiet(desk.why_not);
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (!ImGui::BeginTable("room", desk.leads ? 6 : 3, ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV, size)) return;
  const auto column = [&](const char* name, void (*draw)(const RoomDesk&)) {
    ImGui::TableNextColumn();
    ImGui::BeginChild(name, {0, size.y - editor.theme.px(8)});
    draw(desk);
    ImGui::EndChild();
  };
  column("people", [](const RoomDesk& all) {
    draw_seats(all);
    draw_pens(all.editor, all.room);
  });
  column("now", [](const RoomDesk& all) {
    draw_now(all);
    if (all.leads) {
      draw_plan(all);
      draw_leading(all);
    } else {
      draw_votes(all);
    }
  });
  if (desk.leads) {
    column("votes", [](const RoomDesk& all) {
      all.heading("Votes");
      draw_votes(all);
    });
    column("queue", draw_queue);
    column("room", [](const RoomDesk& all) {
      draw_address(all);
      draw_health(all);
    });
    column("house", draw_house);
  } else {
    column("address", draw_address);
  }
  ImGui::EndTable();
}

}  // namespace bl::desktop
