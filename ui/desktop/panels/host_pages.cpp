// What stands on each page of the dialog that opens a room.
#include <algorithm>
#include <array>
#include <filesystem>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/reading/figures.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop {

namespace {

struct RoleOfPeople {
  const char *role, *label, *may;
};
constexpr std::array kPeople = {
    RoleOfPeople{"designer", "Designers", "change what lies in their areas"},
    RoleOfPeople{"stakeholder", "Stakeholders", "change the values that their role card names"},
    RoleOfPeople{"participant", "Participants", "comment, vote and make proposals"},
    RoleOfPeople{"viewer", "Viewers", "only look"},
};
constexpr std::array kMayDo = {"change", "draft", "comment", "vote"};
constexpr int kMostPeople = 500, kMostBots = 199;
constexpr double kShortestRehearsal = 3, kLongestRehearsal = 3600;  // [s]

ImU32 colour_of_verdict(const Colours& c, serve::Verdict verdict) {
  return verdict == serve::Verdict::good ? c.good : verdict == serve::Verdict::look ? c.warning : c.bad;
}

}  // namespace

void HostDialog::quiet(const std::string& words) const {
  ImGui::PushStyleColor(ImGuiCol_Text, editor_->theme.colours().text_soft);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void HostDialog::strong(const char* words) const {
  ImGui::PushFont(editor_->theme.fonts().strong);
  ImGui::TextUnformatted(words);
  ImGui::PopFont();
}

void HostDialog::draw_page() {
  switch (page_) {
    case Page::scene: return draw_scene();
    case Page::people: return draw_people();
    case Page::phases: return draw_phases();
    case Page::place: return draw_place();
    case Page::check: return draw_check();
  }
}

void HostDialog::draw_scene() {
  strong("Which scene is the session about?");
  quiet("A copy of the scene goes into the session file. What people change in the session does not change your scene file.");
  ImGui::Dummy({0, editor_->theme.px(8)});
  if (!editor_->document) {
    ImGui::TextUnformatted("No scene is open.");
    if (ImGui::Button("Open a scene ...")) editor_->dialogs->choose_scene();
    return note_place(*editor_, "host/open");
  }
  Document& document = *editor_->document;
  ImGui::TextUnformatted(document.name().c_str());
  if (document.room() != nullptr) return quiet("It runs in a room already. Leave that room first: File, Close the scene.");
  if (document.path().empty()) {
    quiet("The scene has no file of its own yet. The server reads it from a file.");
    if (ImGui::Button("Save as ...")) editor_->dialogs->ask_save_as();
    return note_place(*editor_, "host/save");
  }
  quiet(std::filesystem::absolute(document.path()).string());
  if (document.is_unsaved()) quiet("It has changes that are not saved. They are saved into this file when you go on.");
}

void HostDialog::draw_people() {
  strong("Who takes part?");
  quiet(
      "Everybody who opens the address of the room comes in as a participant, with a name such as Heron. An invitation opens a "
      "seat "
      "of another role. Say how many invitations you want to print of each. They are written beside the session file, with a QR "
      "code "
      "for each person. With 0 everywhere nothing is written.");
  ImGui::Dummy({0, editor_->theme.px(8)});
  for (const RoleOfPeople& one : kPeople) {
    int& count = plan_.people[one.role];
    ImGui::SetNextItemWidth(editor_->theme.px(120));
    ImGui::InputInt((std::string("##") + one.role).c_str(), &count, 1, 10);
    count = std::clamp(count, 0, kMostPeople);
    note_place(*editor_, std::string("host/people/") + one.role);
    ImGui::SameLine();
    ImGui::TextUnformatted(one.label);
    ImGui::SameLine();
    quiet(one.may);
  }
  ImGui::Dummy({0, editor_->theme.px(8)});
  strong("Role cards of the scene");
  std::string cards;
  for (const auto& [id, node] : editor_->scene().nodes)
    if (node.types.contains("stakeholder_group")) cards += (cards.empty() ? "" : ", ") + editor_->name_of(id);
  if (cards.empty())
    quiet(
        "None. A role card gives a stakeholder goals and values to change. Add it to the scene as a node: Add, Stakeholder "
        "group.");
  else quiet(cards + ". You deal them out in the tab Room: press a person there and choose a card.");
}

void HostDialog::draw_phase_row(std::size_t row, std::optional<std::size_t>& removed) {
  PlannedPhase& phase = plan_.phases[row];
  const std::string key = "host/phase/" + std::to_string(row);
  ImGui::PushID(static_cast<int>(row));
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##name", "title", &phase.name);
  note_place(*editor_, key + "/name");
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputInt("##minutes", &phase.minutes, 0);
  phase.minutes = std::clamp(phase.minutes, 0, 9999);
  for (const char* activity : kMayDo) {
    ImGui::TableNextColumn();
    bool is_on = phase.activities.contains(activity);
    if (ImGui::Checkbox((std::string("##") + activity).c_str(), &is_on)) {
      if (is_on) phase.activities.insert(activity);
      else phase.activities.erase(activity);
    }
    note_place(*editor_, key + "/" + activity);
  }
  ImGui::TableNextColumn();
  if (ImGui::SmallButton("Remove")) removed = row;
  ImGui::PopID();
}

void HostDialog::draw_phases() {
  strong("What happens when?");
  quiet(
      "A phase says what people may do. The first phase begins when the room opens. You begin the others in the tab Room. "
      "0 minutes means: no timer.");
  ImGui::Dummy({0, editor_->theme.px(4)});
  const auto& all = phase_templates();
  const auto held = std::find_if(all.begin(), all.end(), [&](const PhaseTemplate& one) { return one.phases == plan_.phases; });
  ImGui::SetNextItemWidth(editor_->theme.px(380));
  if (ImGui::BeginCombo("##template", held == all.end() ? "Your own" : held->label)) {
    for (const PhaseTemplate& one : all)
      if (ImGui::Selectable(one.label, &one == &*held)) plan_.phases = one.phases;
    ImGui::EndCombo();
  }
  note_place(*editor_, "host/template");
  ImGui::Dummy({0, editor_->theme.px(4)});
  std::optional<std::size_t> removed;
  if (!plan_.phases.empty() && ImGui::BeginTable("phases", 7)) {
    const float narrow = editor_->theme.px(80);
    ImGui::TableSetupColumn("Phase");
    for (const char* name : {"Minutes", "Change", "Draft", "Comment", "Vote", ""})
      ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed, narrow);
    ImGui::TableHeadersRow();
    for (std::size_t row = 0; row < plan_.phases.size(); ++row) draw_phase_row(row, removed);
    ImGui::EndTable();
  }
  if (removed) plan_.phases.erase(plan_.phases.begin() + static_cast<std::ptrdiff_t>(*removed));
  if (ImGui::Button("Add a phase")) plan_.phases.push_back({"", {"comment"}, 10});
  note_place(*editor_, "host/add_phase");
}

void HostDialog::draw_file(const char* label, const char* key, std::string& path, FileChooser::Purpose purpose,
                           std::vector<std::string> endings) {
  ImGui::PushID(key);
  ImGui::TextUnformatted(label);
  ImGui::SetNextItemWidth(-editor_->theme.px(110));
  ImGui::InputText("##path", &path);
  note_place(*editor_, std::string("host/") + key);
  ImGui::SameLine();
  if (ImGui::Button("Choose ..."))
    editor_->dialogs->choose(purpose, label, std::move(endings), path, [&path](const std::string& chosen) { path = chosen; });
  ImGui::PopID();
}

void HostDialog::draw_certificate() {
  if (!ImGui::CollapsingHeader("Encryption by a certificate (optional)")) return;
  quiet(
      "Without one everybody in the same network can read along. A certificate is made by an authority for a host name, which "
      "phones must be able to find.");
  draw_file("Certificate (PEM)", "certificate", plan_.certificate, FileChooser::Purpose::open_file, {".pem", ".crt"});
  draw_file("Its key (PEM)", "key", plan_.key, FileChooser::Purpose::open_file, {".pem", ".key"});
  ImGui::SetNextItemWidth(editor_->theme.px(300));
  ImGui::InputTextWithHint("Host name", "session.example.org", &plan_.name);
}

void HostDialog::draw_place() {
  strong("Where is the room?");
  const Theme& theme = editor_->theme;
  const auto label_of = [this](const std::string& bind) {
    for (const serve::NetworkAddress& one : addresses_)
      if (one.address == bind) return one.address + "  (" + one.interface + ")";
    return std::string(bind == "127.0.0.1" ? "127.0.0.1  (this computer only, to try it out)" : "All networks of this computer");
  };
  ImGui::SetNextItemWidth(theme.px(330));
  if (ImGui::BeginCombo("Network", label_of(plan_.bind).c_str())) {
    std::vector<std::string> choices{"0.0.0.0"};
    for (const serve::NetworkAddress& one : addresses_) choices.push_back(one.address);
    choices.emplace_back("127.0.0.1");
    for (const std::string& choice : choices)
      if (ImGui::Selectable(label_of(choice).c_str(), choice == plan_.bind)) plan_.bind = choice;
    ImGui::EndCombo();
  }
  note_place(*editor_, "host/bind");
  ImGui::SetNextItemWidth(theme.px(120));
  ImGui::InputText("Port", &plan_.port);
  note_place(*editor_, "host/port");
  if (addresses_.empty() && plan_.bind == "0.0.0.0")
    quiet("This computer is in no network now, so phones could not reach the room.");
  else if (plan_.bind == "0.0.0.0") quiet("Phones will open http://" + addresses_.front().address + ":" + plan_.port + ".");
  ImGui::Dummy({0, theme.px(6)});
  draw_file("Session file: everything that people say and change is stored here", "journal", plan_.journal,
            FileChooser::Purpose::save_file, {".blsession"});
  if (std::error_code ignored; std::filesystem::exists(plan_.journal, ignored)) {
    ImGui::PushStyleColor(ImGuiCol_Text, theme.colours().warning);
    ImGui::TextWrapped(
        "This file is there already. Its session goes on, with its people, votes and scene. For a new session type "
        "another name.");
    ImGui::PopStyleColor();
  }
  ImGui::Dummy({0, theme.px(6)});
  ImGui::Checkbox("Connect the sensors and actuators of the scene", &plan_.is_live);
  ImGui::Checkbox("Let designers write link kinds in Lua", &plan_.scripts);
  draw_certificate();
}

void HostDialog::draw_check() {
  strong("Is this computer ready?");
  if (checking_) return quiet("Measuring the disk and the scene. This takes a few seconds.");
  if (opening_) return quiet("The room is being opened ...");
  quiet("Red things will harm the session. Have a look at yellow ones. You can open the room with any of them.");
  if (ImGui::Button("Check again")) begin_check();
  note_place(*editor_, "host/again");
  ImGui::Dummy({0, editor_->theme.px(4)});
  draw_rehearsal();
  draw_findings("findings", findings_);
}

void HostDialog::draw_rehearsal() {
  const Theme& theme = editor_->theme;
  strong("Rehearse with bots");
  if (rehearsing_) {
    ImGui::ProgressBar(static_cast<float>(rehearsing_->part()), {theme.px(300), 0});
    ImGui::SameLine();
    if (ImGui::Button("Stop the rehearsal")) rehearsing_->cancel();
    note_place(*editor_, "host/rehearse/stop");
    quiet(rehearsing_->progress().empty() ? "The room of the rehearsal is opened." : rehearsing_->progress());
    return ImGui::Dummy({0, theme.px(6)});
  }
  quiet(
      "Bots take part in a room of their own on this computer, over the same protocol as people. They comment, vote, move the "
      "values "
      "of role cards and propose. The room is thrown away: your session file and your scene file stay as they are. Wi-Fi and "
      "phones "
      "are not tried.");
  ImGui::SetNextItemWidth(theme.px(110));
  ImGui::InputInt("bots", &rehearsal_.bots, 1, 10);
  rehearsal_.bots = std::clamp(rehearsal_.bots, 1, kMostBots);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(theme.px(110));
  ImGui::InputDouble("seconds", &rehearsal_.seconds, 10, 60, "%.0f");
  rehearsal_.seconds = std::clamp(rehearsal_.seconds, kShortestRehearsal, kLongestRehearsal);
  ImGui::SameLine();
  if (ImGui::Button("Rehearse")) begin_rehearsal();
  note_place(*editor_, "host/rehearse");
  draw_findings("rehearsed", rehearsed_);
  ImGui::Dummy({0, theme.px(6)});
}

void HostDialog::draw_findings(const char* id, const std::vector<serve::Finding>& findings) {
  if (findings.empty() || !ImGui::BeginTable(id, 3)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, editor_->theme.px(52));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, editor_->theme.px(90));
  ImGui::TableSetupColumn("");
  for (const serve::Finding& finding : findings) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, colour_of_verdict(editor_->theme.colours(), finding.verdict));
    ImGui::TextUnformatted(serve::word_of(finding.verdict));
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(finding.subject.c_str());
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(finding.text.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
}

}  // namespace bl::desktop
