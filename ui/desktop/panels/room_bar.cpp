// The room at the end of the toolbar: its name, whether everything is stored there, who is in it, and who has which pen.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

struct Told {
  std::string text;
  ImU32 colour = 0;
};

Told standing_of(const Workbench& editor, const guest::RoomGuest& room) {
  const Colours& c = editor.theme.colours();
  const guest::Standing standing = room.standing();
  if (!standing.end.empty()) return {"ended", c.bad};
  if (!standing.is_connected) {
    const double seconds = std::floor(host::real_clock().now() - standing.lost_since);
    editor.wake_at(editor.now + 1);
    const std::string since = standing.has_scene ? "no connection since " + std::to_string(static_cast<int>(seconds)) + " s"
                                                 : "connecting since " + std::to_string(static_cast<int>(seconds)) + " s";
    return {standing.waiting == 0 ? since : since + ", " + std::to_string(standing.waiting) + " wait", c.warning};
  }
  if (!standing.has_scene) return {"the scene is coming", c.warning};
  if (standing.waiting > 0) return {std::to_string(standing.waiting) + " wait", c.warning};
  if (const guest::DraftWork* draft = room.draft())
    return {"in your draft, " + reading::counted(draft->step_count(), "change"), c.accent};
  return {standing.takes_ticks ? "saved" : "saved; the server's values", c.good};
}

std::string name_of_seat(const guest::RoomGuest& room, std::int64_t seat) {
  const auto found = room.people().seats.find(seat);
  return found == room.people().seats.end() ? "seat " + std::to_string(seat) : found->second.name;
}

void draw_people(Workbench& editor, const guest::RoomGuest& room) {
  const Colours& c = editor.theme.colours();
  for (const auto& [seat, person] : room.people().seats) {
    if (!person.is_here) continue;
    ImGui::PushID(static_cast<int>(seat));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float r = editor.theme.px(5), line = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + r, at.y + line / 2}, r, colour_of_text(person.colour, c.text_soft), 16);
    ImGui::Dummy({3 * r, line});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted((person.name + (seat == room.seat() ? " (you)" : "") + ", " + person.role).c_str());
    const bool has_camera = std::any_of(editor.others.begin(), editor.others.end(), [&, who = seat](const Other& other) {
      return other.seat == who && !other.camera.empty();
    });
    if (seat != room.seat() && (has_camera || editor.followed == seat)) {
      ImGui::SameLine();
      const bool is_followed = editor.followed == seat;
      if (ImGui::SmallButton(is_followed ? "Stop following" : ("Follow " + person.name).c_str()))
        editor.followed = is_followed ? 0 : seat;
      note_place(editor, "room/follow/" + std::to_string(seat));
    }
    ImGui::PopID();
  }
}

}  // namespace

void draw_pens(Workbench& editor, guest::RoomGuest& room) {
  if (room.people().areas.empty()) return;
  ImGui::Separator();
  ImGui::TextUnformatted("Pens");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Who has the pen of an area alone may change it.");
  for (const auto& [name, area] : room.people().areas) {
    ImGui::PushID(name.c_str());
    ImGui::AlignTextToFramePadding();
    std::string text = name + ": " + (area.holder == 0 ? "nobody" : name_of_seat(room, area.holder));
    if (!area.asking.empty()) text += ", asked for by " + name_of_seat(room, area.asking.front());
    ImGui::TextUnformatted(text.c_str());
    const bool may_give = area.holder == room.seat() || room.role() == "facilitator";
    ImGui::SameLine();
    if (!area.asking.empty() && may_give) {
      if (ImGui::SmallButton(("Give to " + name_of_seat(room, area.asking.front())).c_str()))
        room.say_event("give_pen", JsonValue::of({{"area", name}, {"seat", area.asking.front()}}));
    } else if (area.holder == room.seat()) {
      if (ImGui::SmallButton("Give back")) room.say_event("give_pen", JsonValue::of({{"area", name}, {"seat", 0}}));
    } else if (std::find(area.asking.begin(), area.asking.end(), room.seat()) == area.asking.end()) {
      if (ImGui::SmallButton("Ask for the pen")) room.say_event("ask_pen", JsonValue::of({{"area", name}}));
      note_place(editor, "room/pen/" + name);
    } else {
      ImGui::TextDisabled("asked");
    }
    ImGui::PopID();
  }
}

void draw_room(Workbench& editor) {
  guest::RoomGuest* room = editor.document->room();
  if (room == nullptr) return;
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const Told told = standing_of(editor, *room);
  const std::string label = editor.document->name() + ":";
  const float pad = theme.px(10), dot = theme.px(4);
  const float wide = ImGui::CalcTextSize((label + " " + told.text).c_str()).x + 4 * pad;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - wide - theme.px(12)));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::Button("##room", {wide, theme.px(28)})) ImGui::OpenPopup("room");
  note_place(editor, "room");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Who is here, and who has which pen");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + theme.px(14), y = middle - ImGui::GetFontSize() / 2;
  list.AddCircleFilled({at.x + pad, middle}, dot, told.colour, 12);
  const float x = at.x + 2 * pad;
  list.AddText({x, y}, c.text, label.c_str());
  list.AddText({x + ImGui::CalcTextSize((label + " ").c_str()).x, y}, told.colour, told.text.c_str());
  if (!ImGui::BeginPopup("room")) return;
  const guest::Standing standing = room->standing();
  if (!standing.end.empty()) ImGui::TextUnformatted(standing.end.c_str());
  if (!standing.is_connected && standing.end.empty())
    ImGui::TextUnformatted("What you change now is sent when the connection is back.");
  if (!standing.takes_ticks)
    ImGui::TextUnformatted(
        "This program computes other results than the room's server.\nIt shows the server's values, a second old at most.");
  if (room->draft() != nullptr) {
    ImGui::TextUnformatted("What you change now is a step of your draft. Nobody else sees it.");
    if (ImGui::SmallButton("Leave the draft")) room->leave_draft();
    note_place(editor, "room/draft/leave");
  }
  draw_people(editor, *room);
  if (ImGui::SmallButton("Show the tab Room")) {
    editor.person.shows_bottom = true;
    memory_of(editor).wanted_tab = "Room";
    ImGui::CloseCurrentPopup();
  }
  note_place(editor, "room/tab");
  draw_pens(editor, *room);
  ImGui::EndPopup();
}

}  // namespace bl::desktop
