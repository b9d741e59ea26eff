// The tab Room: its blocks in their columns; people, what may be done now, and the address.
#include "ui/desktop/panels/room_panel.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/serve/qr_code.h"
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
    // Beside the name where there is room, else below it.
    ImGui::SameLine();
    if (ImGui::CalcTextSize(words.c_str()).x > ImGui::GetContentRegionAvail().x) {
      ImGui::NewLine();
      ImGui::SetCursorScreenPos({at.x + 3 * r + ImGui::GetStyle().ItemSpacing.x, ImGui::GetCursorScreenPos().y});
    }
    ImGui::PushStyleColor(ImGuiCol_Text, c.text_soft);
    ImGui::TextWrapped("%s", words.c_str());
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

void RoomDesk::same_line_for(const std::string& label) const {
  const float wide = ImGui::CalcTextSize(label.c_str()).x + ImGui::GetFrameHeight() + editor.theme.px(16);
  if (ImGui::GetItemRectMax().x + wide < ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x) ImGui::SameLine();
}

std::string RoomDesk::seat_name(std::int64_t seat) const {
  const auto found =
      std::find_if(agenda.seats.begin(), agenda.seats.end(), [&](const AgendaSeat& s) { return s.number == seat; });
  return found == agenda.seats.end() ? "seat " + std::to_string(seat) : found->name;
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

namespace {

// What stands in the tab, from the left to the right, and from the top to the bottom. Another block is another line.
struct RoomBlock {
  const char* column;
  bool is_for_leaders, is_for_others;
  void (*draw)(const RoomDesk&);
};
constexpr RoomBlock kBlocks[] = {
    {"people", true, true, draw_seats},
    {"people", true, true, [](const RoomDesk& desk) { draw_pens(desk.editor, desk.room); }},
    {"now", true, true, draw_now},
    {"now", true, false, draw_plan},
    {"now", true, false, draw_leading},
    {"now", false, true, draw_drafts},
    {"now", false, true, draw_votes},
    {"votes", true, false, draw_votes},
    {"votes", true, false, draw_new_vote},
    {"queue", true, false, draw_proposals},
    {"queue", true, false, draw_comments},
    {"room", true, true, draw_address},
    {"room", true, false, draw_health},
    {"room", true, false, draw_drafts},
    {"house", true, false, draw_house},
};

void draw_columns(const RoomDesk& desk) {
  const auto is_shown = [&](const RoomBlock& block) { return desk.leads ? block.is_for_leaders : block.is_for_others; };
  std::vector<std::string> columns;
  for (const RoomBlock& block : kBlocks)
    if (is_shown(block) && std::find(columns.begin(), columns.end(), block.column) == columns.end())
      columns.push_back(block.column);
  const ImVec2 size = ImGui::GetContentRegionAvail();
  constexpr ImGuiTableFlags kLook = ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV;
  if (!ImGui::BeginTable("room", static_cast<int>(columns.size()), kLook, size)) return;
  // Votes and proposals need more words than the others.
  for (const std::string& column : columns)
    ImGui::TableSetupColumn(column.c_str(), ImGuiTableColumnFlags_WidthStretch,
                            column == "votes" || column == "queue" || (column == "now" && !desk.leads) ? 1.5f : 1);
  for (const std::string& column : columns) {
    ImGui::TableNextColumn();
    ImGui::BeginChild(column.c_str(), {0, size.y - desk.editor.theme.px(8)});
    for (const RoomBlock& block : kBlocks)
      if (is_shown(block) && block.column == column) block.draw(desk);
    ImGui::EndChild();
  }
  ImGui::EndTable();
}

}  // namespace

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
  draw_columns(desk);
}

}  // namespace bl::desktop
