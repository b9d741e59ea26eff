// From page to page of the dialog, and from the last one to a room that is open and joined.
#include "ui/desktop/panels/host_dialog.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/guest/room_guest.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/invitation_sheet.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

namespace {

constexpr std::array kSteps = {"Scene", "People", "Phases", "Address and file", "Check"};
constexpr double kBetweenLooks = 0.1;  // at the server's files [s]

std::int64_t hosting_clock() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

std::vector<serve::Finding> findings_in(const std::string& text) {
  std::vector<serve::Finding> findings;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (auto finding = serve::finding_of_line(text.substr(begin, end - begin))) findings.push_back(std::move(*finding));
    begin = end + 1;
  }
  return findings;
}

std::string program_of(const Workbench& editor) {
  return editor.server_program.empty() ? server_program() : editor.server_program;
}

}  // namespace

HostDialog::HostDialog(Workbench& editor) : editor_(&editor) {
  plan_.phases = phase_templates().front().phases;
  plan_.people = {{"designer", 0}, {"stakeholder", 0}, {"participant", 0}, {"viewer", 0}};
}

HostDialog::~HostDialog() = default;

void HostDialog::begin() {
  stop();
  page_ = Page::scene;
  told_.clear();
  findings_.clear();
  rehearsed_.clear();
  addresses_ = serve::network_addresses();
}

void HostDialog::stop() {
  if (checking_) checking_->interrupt();
  checking_.reset();
  opening_.reset();
  rehearsing_.reset();
}

// A file of another scene is not taken for this one.
void HostDialog::name_files() {
  const std::string& scene = editor_->document->path();
  plan_.scene = scene;
  if (planned_scene_ == scene) return;
  planned_scene_ = scene;
  plan_.journal = std::filesystem::path(scene).replace_extension(".blsession").string();
}

std::string HostDialog::missing() const {
  if (opening_) return "The room is being opened.";
  switch (page_) {
    case Page::scene:
      if (!editor_->document) return "Open a scene first.";
      if (editor_->document->room() != nullptr) return "This scene runs in a room already.";
      return editor_->document->path().empty() ? "Save the scene first." : "";
    case Page::people: return "";
    case Page::phases:
      for (const PlannedPhase& phase : plan_.phases)
        if (phase.name.empty()) return "Each phase needs a title.";
      return "";
    case Page::place: return fault_of_place(plan_);
    case Page::check: return checking_ ? "The check is running." : rehearsing_ ? "The rehearsal is running." : "";
  }
  return "";
}

void HostDialog::go(Page page) {
  page_ = page;
  told_.clear();
  rehearsing_.reset();
  if (page_ == Page::check) begin_check();
  else if (checking_) checking_->interrupt(), checking_.reset();
}

void HostDialog::next() {
  if (page_ == Page::check) return open_room();
  const auto step = [this] { go(static_cast<Page>(static_cast<int>(page_) + 1)); };
  if (page_ != Page::scene) return step();
  if (!editor_->document->is_unsaved()) {
    name_files();
    return step();
  }
  editor_->dialogs->save([this, step] {
    name_files();
    step();
  });
}

// --- The check ------------------------------------------------------------------------------------------------------

void HostDialog::begin_check() {
  findings_.clear();
  auto process = ServerProcess::start(program_of(*editor_), words_of(plan_, true));
  if (!process) told_ = process.error().text();
  else checking_ = std::move(*process);
}

void HostDialog::turn_check() {
  if (!checking_) return;
  editor_->wake_at(editor_->now + kBetweenLooks);
  if (!checking_->exit_code()) return;
  findings_ = findings_in(checking_->output());
  if (findings_.empty()) told_ = "The check could not run: " + checking_->complaints();
  // What needs somebody comes first.
  std::stable_sort(findings_.begin(), findings_.end(), [](const auto& a, const auto& b) { return a.verdict > b.verdict; });
  checking_.reset();
}

// --- The rehearsal --------------------------------------------------------------------------------------------------

void HostDialog::begin_rehearsal() {
  rehearsed_.clear();
  told_.clear();
  auto run = RehearsalRun::begin(program_of(*editor_), plan_, rehearsal_);
  if (!run) told_ = run.error().text();
  else rehearsing_ = std::move(*run);
}

void HostDialog::turn_rehearsal() {
  if (!rehearsing_) return;
  editor_->wake_at(editor_->now + kBetweenLooks);
  if (rehearsing_->turn() != RehearsalRun::Stage::ended) return;
  if (!rehearsing_->is_cancelled()) rehearsed_ = findings_in(rehearsing_->output());
  if (!rehearsing_->why().empty()) told_ = rehearsing_->why();
  else if (rehearsed_.empty() && !rehearsing_->is_cancelled()) told_ = "The rehearsal has ended without a result.";
  rehearsing_.reset();
}

// --- The room -------------------------------------------------------------------------------------------------------

void HostDialog::open_room() {
  told_.clear();
  auto hosting = Hosting::begin(program_of(*editor_), plan_);
  if (!hosting) told_ = hosting.error().text();
  else opening_ = std::move(*hosting);
}

bool HostDialog::turn_opening() {
  if (!opening_) return false;
  editor_->wake_at(editor_->now + kBetweenLooks);
  const Hosting::Stage stage = opening_->turn();
  if (stage == Hosting::Stage::ended) {
    told_ = opening_->why();
    opening_.reset();
  }
  if (stage != Hosting::Stage::open) return false;
  if (!editor_->join(opening_->address())) {
    told_ = "The room is open, but this window could not join it.";
    return false;
  }
  editor_->person.plans[opening_->code()] = text_of_plan(plan_.phases);
  (void)write_person_settings(editor_->person);  // a plan that is not kept is made anew
  write_sheet(*opening_);
  editor_->hosting = std::move(opening_);
  constexpr float kHighEnough = 320;  // for the address with its code, the phases and the health [points]
  editor_->person.shows_bottom = true;
  editor_->person.bottom_height = std::max(editor_->person.bottom_height, kHighEnough);
  memory_of(*editor_).wanted_tab = "Room";
  return true;
}

void HostDialog::write_sheet(const Hosting& room) {
  if (std::none_of(plan_.people.begin(), plan_.people.end(), [](const auto& one) { return one.second > 0; })) return;
  const std::string path = std::filesystem::path(plan_.journal).replace_extension(".invitations.html").string();
  if (auto written = write_invitations(path, room.page(), room.keys(), plan_.people); !written)
    editor_->notify(NoticeKind::error, "The invitations could not be written: " + written.error().text());
  else editor_->notify(NoticeKind::told, "Wrote the invitations " + path + ". Open it in a browser to print them.");
}

// The first phase begins where nobody has begun one: a session that goes on is in its own.
void watch_hosting(Workbench& editor) {
  Hosting* hosting = editor.hosting.get();
  if (hosting == nullptr) return;
  constexpr double kBetweenTurns = 0.5;  // [s]
  const bool was_ending = hosting->stage() == Hosting::Stage::ending;
  editor.wake_at(editor.now + kBetweenTurns);
  if (hosting->turn() == Hosting::Stage::ended) {
    if (was_ending) editor.notify(NoticeKind::told, "The room is closed, and everything is in " + hosting->plan().journal + ".");
    else editor.notify(NoticeKind::error, "The server of the room has ended: " + hosting->why());
    editor.hosting.reset();
    return;
  }
  guest::RoomGuest* room = editor.document ? editor.document->room() : nullptr;
  if (room == nullptr || hosting->has_begun_phases || room->code() != hosting->code()) return;
  const auto& view = room->view("room");
  const auto phase = view.find("phase");
  if (!room->standing().is_connected || room->role() != "facilitator" || phase == view.end()) return;
  hosting->has_begun_phases = true;
  const auto json = phase->second.read();
  const bool has_begun = json && !guest::text_in(**json, "name").empty();
  if (!has_begun && !hosting->plan().phases.empty()) begin_phase(*room, hosting->plan().phases.front());
}

void begin_phase(guest::RoomGuest& room, const PlannedPhase& phase, const std::vector<std::string>& forms) {
  constexpr std::int64_t kMinute = 60000;  // [ms]
  const std::int64_t ends_at = phase.minutes > 0 ? hosting_clock() + phase.minutes * kMinute : 0;
  room.say_event("set_phase",
                 JsonValue::of({{"name", phase.name}, {"activities", phase.activities}, {"forms", forms}, {"ends_at", ends_at}}));
}

// --- The frame of the pages -----------------------------------------------------------------------------------------

bool HostDialog::draw(bool takes_enter) {
  turn_check();
  turn_rehearsal();
  if (turn_opening()) return true;
  draw_steps();
  const float foot = ImGui::GetFrameHeightWithSpacing() + editor_->theme.px(54);
  ImGui::BeginChild("page", {0, -foot});
  draw_page();
  ImGui::EndChild();
  return draw_foot(takes_enter);
}

void HostDialog::draw_steps() {
  const Colours& c = editor_->theme.colours();
  for (std::size_t k = 0; k < kSteps.size(); ++k) {
    if (k > 0) ImGui::SameLine(0, editor_->theme.px(18));
    const bool is_here = static_cast<std::size_t>(page_) == k;
    ImGui::PushStyleColor(ImGuiCol_Text, is_here ? c.text : c.text_faint);
    ImGui::PushFont(is_here ? editor_->theme.fonts().strong : editor_->theme.fonts().body);
    ImGui::TextUnformatted((std::to_string(k + 1) + "  " + kSteps[k]).c_str());
    ImGui::PopFont();
    ImGui::PopStyleColor();
  }
  ImGui::Separator();
  ImGui::Dummy({0, editor_->theme.px(4)});
}

bool HostDialog::draw_foot(bool takes_enter) {
  const Theme& theme = editor_->theme;
  ImGui::Separator();
  ImGui::PushStyleColor(ImGuiCol_Text, theme.colours().bad);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(told_.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  const std::string why = missing();
  ImGui::BeginDisabled(page_ == Page::scene || opening_);
  if (ImGui::Button("Back", {theme.px(110), 0}) && !opening_) go(static_cast<Page>(static_cast<int>(page_) - 1));
  ImGui::EndDisabled();
  note_place(*editor_, "host/back");
  ImGui::SameLine();
  ImGui::BeginDisabled(!why.empty());
  const bool is_entered = takes_enter && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  const bool is_next = chief_button(theme, page_ == Page::check ? "Open the room" : "Next", {theme.px(150), 0}) || is_entered;
  note_place(*editor_, "host/next");
  ImGui::EndDisabled();
  ImGui::SameLine();
  const bool is_cancelled = ImGui::Button("Cancel", {theme.px(110), 0});
  note_place(*editor_, "host/cancel");
  if (!why.empty()) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    quiet(why);
  }
  if (is_next && why.empty()) next();
  if (is_cancelled) stop();
  return is_cancelled;
}

}  // namespace bl::desktop
