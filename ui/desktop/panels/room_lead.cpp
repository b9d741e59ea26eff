// The tab Room for facilitators: pace and phase, what waits for a decision, people, door, beamer, minutes, the end.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

constexpr double kTakenBack = 30;           // [s]
constexpr std::int64_t kMoreTime = 300000;  // [ms]
constexpr const char* kRolesOfPeople[] = {"facilitator", "designer", "stakeholder", "participant", "viewer", "recorder"};
struct NamedChoice {
  const char *id, *label;
};
constexpr NamedChoice kActivities[] = {{"change", "change"}, {"draft", "draft"}, {"comment", "comment"}, {"vote", "vote"}};
constexpr NamedChoice kDoors[] = {{"open", "open"}, {"asks", "asks"}, {"shut", "shut"}};
constexpr NamedChoice kLayouts[] = {{"plan", "plan"},         {"compare", "comparison"},      {"vote", "vote"},
                                    {"comments", "comments"}, {"marks", "numbered comments"}, {"space", "3D"},
                                    {"code", "code"}};

std::int64_t phase_clock() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

void set_phase(const RoomDesk& desk, const std::string& name, const std::set<std::string>& activities, std::int64_t ends_at) {
  desk.say("set_phase",
           JsonValue::of({{"name", name}, {"activities", activities}, {"forms", desk.agenda.forms}, {"ends_at", ends_at}}));
}

void draw_pace(const RoomDesk& desk) {
  const guest::People& people = desk.room.people();
  if (desk.button(people.is_paused ? "Go on" : "Pause", "roompanel/pause")) desk.room.play(people.is_paused);
  desk.same_line_for("Take back the last 30 s");
  const bool can_rewind = desk.room.can_rewind();
  const std::string why = can_rewind ? "" : "Nothing has been changed yet.";
  if (desk.button("Take back the last 30 s", "roompanel/rewind", why))
    desk.room.rewind(static_cast<std::int64_t>(std::lround(kTakenBack * people.rate)));
  if (desk.agenda.ends_at > 0 && desk.button("5 minutes more", "roompanel/more_time"))
    set_phase(desk, desk.agenda.phase, desk.agenda.may, std::max(desk.agenda.ends_at, phase_clock()) + kMoreTime);
}

// The form of the next phase. Until something is chosen, it shows what holds now.
void draw_next_phase(const RoomDesk& desk) {
  ImGui::Spacing();
  desk.heading("Next phase");
  PanelMemory& memory = memory_of(desk.editor);
  std::set<std::string> chosen = memory.room_activities ? *memory.room_activities : desk.agenda.may;
  for (const NamedChoice& activity : kActivities) {
    bool is_on = chosen.contains(activity.id);
    if (&activity != kActivities) desk.same_line_for(activity.label);
    if (ImGui::Checkbox(activity.label, &is_on)) {
      if (is_on) chosen.insert(activity.id);
      else chosen.erase(activity.id);
      memory.room_activities = chosen;
    }
    note_place(desk.editor, std::string("roompanel/may/") + activity.id);
  }
  std::string &title = desk.text("phase"), &minutes = desk.text("minutes");
  ImGui::SetNextItemWidth(-desk.editor.theme.px(90));
  ImGui::InputTextWithHint("##phase", "title", &title);
  note_place(desk.editor, "roompanel/phase");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##minutes", "minutes", &minutes);
  note_place(desk.editor, "roompanel/minutes");
  char* end = nullptr;
  const double count = std::strtod(minutes.c_str(), &end);
  const bool is_time = *end == '\0' && count >= 0 && count < 1e4;
  std::string why = title.empty() ? "Type a title for the phase." : "";
  if (!is_time) why = "Type a number of minutes, or none.";
  if (!desk.button("Begin this phase", "roompanel/begin", why)) return;
  set_phase(desk, title, chosen, count > 0 ? phase_clock() + static_cast<std::int64_t>(count * 60000) : 0);
  title.clear();
  memory.room_activities.reset();
}

void draw_comment(const RoomDesk& desk, const AgendaComment& comment) {
  const std::string key = "roompanel/comment/" + comment.id;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(comment.text.c_str());
  ImGui::PopTextWrapPos();
  desk.quiet(desk.seat_name(comment.seat) + (comment.node.empty() ? "" : ", about " + desk.editor.name_of(comment.node)) + ", " +
             std::to_string(comment.plus) + " agree, " + std::to_string(comment.minus) + " disagree");
  std::string& answer = desk.text(key);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##answer", "reason", &answer);
  const auto decide = [&](const char* state) {
    desk.say("answer_comment", JsonValue::of({{"comment", comment.id}, {"state", state}, {"answer", answer}}));
  };
  if (desk.button("We follow it", key + "/follow")) decide("accepted");
  desk.same_line_for("We do not follow it");
  if (desk.button("We do not follow it", key + "/leave")) decide("rejected");
}

// A row of buttons of which one holds; the id of the one that was pressed, or nothing.
template <std::size_t N>
std::string choose(const RoomDesk& desk, const NamedChoice (&choices)[N], const std::string& held, const std::string& key) {
  std::string pressed;
  for (const NamedChoice& choice : choices) {
    if (&choice != choices) desk.same_line_for(choice.label);
    ImGui::BeginDisabled(!desk.why_not.empty());
    if (ImGui::RadioButton((std::string(choice.label) + "##" + key).c_str(), held == choice.id) && held != choice.id)
      pressed = choice.id;
    ImGui::EndDisabled();
    note_place(desk.editor, key + "/" + choice.id);
  }
  return pressed;
}

}  // namespace

void draw_leading(const RoomDesk& desk) {
  draw_pace(desk);
  draw_next_phase(desk);
}

void draw_comments(const RoomDesk& desk) {
  if (desk.agenda.comments.empty()) return desk.quiet("No comment waits for an answer.");
  desk.heading(("Comments, " + std::to_string(desk.agenda.comments.size()) + " to answer").c_str());
  for (const AgendaComment& comment : desk.agenda.comments) {
    ImGui::PushID(comment.id.c_str());
    draw_comment(desk, comment);
    ImGui::Separator();
    ImGui::PopID();
  }
}

void draw_house(const RoomDesk& desk) {
  desk.heading("Door");
  if (const std::string door = choose(desk, kDoors, desk.agenda.door, "roompanel/door"); !door.empty())
    desk.say("set_door", JsonValue::of({{"door", door}}));
  desk.heading("On the beamer");
  const std::string layout = desk.agenda.layout.empty() ? "plan" : desk.agenda.layout;
  if (const std::string shown = choose(desk, kLayouts, layout, "roompanel/show"); !shown.empty())
    desk.say("show", JsonValue::of({{"layout", shown}}));
  desk.heading("Minutes");
  std::string& decision = desk.text("decision");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##decision", "what was decided", &decision);
  note_place(desk.editor, "roompanel/decision");
  if (desk.button("Put into the minutes", "roompanel/mark", decision.empty() ? "Type what was decided." : "")) {
    desk.say("mark", JsonValue::of({{"kind", "decision"}, {"text", decision}}));
    decision.clear();
  }
  bool& shares = memory_of(desk.editor).room_shares_minutes;
  ImGui::Checkbox("Everybody who took part may open the minutes afterwards", &shares);
  note_place(desk.editor, "roompanel/share_minutes");
  if (desk.sure_button("End the session", "roompanel/end", "From then on nothing is changed or said. End it?", "End the session"))
    desk.say("close_room", JsonValue::of({{"shares_minutes", shares}}));
}

void draw_seat_menu(const RoomDesk& desk, const AgendaSeat& seat) {
  const auto set_role = [&](const std::string& role, const std::string& card) {
    desk.say("set_role", JsonValue::of({{"seat", seat.number}, {"role", role}, {"areas", seat.areas}, {"card", card}}));
  };
  const std::string key = "roompanel/seat/" + std::to_string(seat.number);
  desk.heading(seat.name.c_str());
  for (const char* role : kRolesOfPeople) {
    if (ImGui::RadioButton(role, seat.role == role) && seat.role != role && desk.why_not.empty()) set_role(role, seat.card);
    note_place(desk.editor, key + "/" + role);
  }
  if (!desk.agenda.cards.empty()) desk.heading("Role card");
  for (const auto& [id, name] : desk.agenda.cards)
    // A card makes a participant a stakeholder: others may not use its values.
    if (ImGui::RadioButton((name + "##" + id).c_str(), seat.card == id) && seat.card != id && desk.why_not.empty())
      set_role(seat.role == "participant" ? "stakeholder" : seat.role, id);
  const std::string why = seat.number == desk.room.seat() ? "This is you." : "";
  if (desk.button(seat.is_muted ? "Let speak" : "Mute", key + "/mute", why))
    desk.say("mute", JsonValue::of({{"seat", seat.number}, {"is_muted", !seat.is_muted}}));
  if (why.empty() &&
      desk.sure_button("Remove", key + "/remove", "Send " + seat.name + " out? What they have said stays.", "Remove"))
    desk.say("remove_seat", JsonValue::of({{"seat", seat.number}}));
}

}  // namespace bl::desktop
