// The queue of proposals: what would come of them, what stands against them, and the decision, also on a part.
#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/plan_picture.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

constexpr std::size_t kDecidedShown = 5;

void draw_figures(const RoomDesk& desk, const AgendaProposal& proposal) {
  if (!proposal.trial.empty()) desk.quiet(proposal.trial);
  if (proposal.figures.empty() || !ImGui::BeginTable("figures", 3, ImGuiTableFlags_RowBg)) return;
  const auto told = [](const std::optional<double>& value, const std::string& unit) {
    return value ? reading::readable(*value) + (unit.empty() ? "" : " " + unit) : std::string("none");
  };
  for (const char* title : {"Figure", "Now", "With it"}) {
    ImGui::TableNextColumn();
    desk.quiet(title);
  }
  const Colours& c = desk.editor.theme.colours();
  for (const AgendaFigure& figure : proposal.figures) {
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", figure.name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", told(figure.before, figure.unit).c_str());
    ImGui::TableNextColumn();
    const ImU32 colour = figure.status == "met" ? c.good : figure.status == "far" ? c.bad : c.warning;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", (told(figure.after, figure.unit) + (figure.status.empty() ? "" : ", " + figure.status)).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndTable();
}

void draw_conflicts(const RoomDesk& desk, const AgendaProposal& proposal) {
  if (proposal.conflicts.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, desk.editor.theme.colours().warning);
  ImGui::TextWrapped("Others have changed the same since:");
  ImGui::PopStyleColor();
  for (const AgendaConflict& one : proposal.conflicts) {
    std::string text = one.label + ", by " + one.by;
    if (!one.live.empty() && !one.drafted.empty()) text += ": now " + one.live + ", in the proposal " + one.drafted;
    desk.quiet(text);
  }
}

// The plan of now is made anew once a second, because a scene of a thousand volumes takes a while.
void draw_trial_plan(const RoomDesk& desk, const std::string& draft) {
  constexpr double kBetweenPlans = 1;  // [s]
  PlanPictures& plans = *memory_of(desk.editor).plans;
  if (plans.revision != desk.room.views_revision()) plans.with.clear();
  plans.revision = desk.room.views_revision();
  if (!plans.with.contains(draft)) plans.with[draft] = plan_in(desk.room.view("draft_plans"), draft + "/");
  const PlanPicture& with = plans.with[draft];
  if (with.empty()) return;
  if (desk.editor.now - plans.made_at >= kBetweenPlans) {
    plans.now = plan_in(desk.room.plan(), "");
    plans.made_at = desk.editor.now;
  }
  ImGui::BeginGroup();
  draw_two_plans(desk.editor.theme, plans.now, with);
  ImGui::EndGroup();
  note_place(desk.editor, "roompanel/plan_of/" + draft);
  const std::size_t count = differing_volumes(plans.now, with).size();
  desk.quiet(count == 0 ? "No volume differs in the plan."
                        : "Thick outlines: " + reading::counted(count, "volume") + " that differ in the plan.");
}

// The steps with a tick each; the numbers of those that are taken.
std::vector<std::int64_t> choose_steps(const RoomDesk& desk, const AgendaProposal& proposal) {
  std::set<std::int64_t>& left_out = memory_of(desk.editor).left_out[proposal.draft];
  std::vector<std::int64_t> kept;
  desk.quiet("Steps. Take the tick off those that you leave out.");
  for (const AgendaStep& step : proposal.steps) {
    ImGui::PushID(static_cast<int>(step.number));
    const bool fits = step.misfit.empty();
    bool is_kept = fits && !left_out.contains(step.number);
    ImGui::BeginDisabled(!fits || !desk.why_not.empty());
    if (ImGui::Checkbox("##step", &is_kept)) {
      if (is_kept) left_out.erase(step.number);
      else left_out.insert(step.number);
    }
    ImGui::EndDisabled();
    note_place(desk.editor, "roompanel/proposal/" + proposal.draft + "/step/" + std::to_string(step.number));
    ImGui::SameLine();
    ImGui::TextWrapped("%s", (step.words + (fits ? "" : " - fits no more: " + step.misfit)).c_str());
    if (is_kept) kept.push_back(step.number);
    ImGui::PopID();
  }
  return kept;
}

void draw_proposal(const RoomDesk& desk, const AgendaProposal& proposal) {
  const std::string key = "roompanel/proposal/" + proposal.draft;
  desk.heading((proposal.title.empty() ? "Proposal" : proposal.title).c_str());
  desk.quiet("By " + desk.seat_name(proposal.seat) + (proposal.why.empty() ? "." : ": " + proposal.why));
  draw_trial(desk, proposal);
  const std::vector<std::int64_t> kept = choose_steps(desk, proposal);
  std::string& answer = desk.text(key);
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##answer", "a word to who proposed it", &answer);
  note_place(desk.editor, key);
  const bool is_whole = kept.size() == proposal.steps.size();
  const auto decide = [&](bool is_accepted) {
    Json arguments = {{"draft", proposal.draft}, {"is_accepted", is_accepted}, {"answer", answer}};
    if (is_accepted && !is_whole) arguments["keep"] = kept;
    desk.say("decide_proposal", JsonValue::of(std::move(arguments)));
    answer.clear();
    memory_of(desk.editor).left_out.erase(proposal.draft);
  };
  const std::string part = "Accept " + std::to_string(kept.size()) + " of " + std::to_string(proposal.steps.size()) + " steps";
  if (desk.button(is_whole ? "Accept" : part, key + "/accept", kept.empty() ? "Tick at least one step, or refuse it." : ""))
    decide(true);
  ImGui::SameLine();
  if (desk.button("Refuse", key + "/refuse")) decide(false);
}

// One undo takes back all that was accepted of it. Steps from before this window has joined are not known here.
void draw_decided(const RoomDesk& desk, const AgendaProposal& proposal) {
  const std::string title = proposal.title.empty() ? "Proposal" : proposal.title;
  const std::string kept = proposal.kept < proposal.count
                               ? std::to_string(proposal.kept) + " of " + std::to_string(proposal.count) + " steps accepted"
                               : "accepted";
  ImGui::TextWrapped(
      "%s", (title + ", by " + desk.seat_name(proposal.seat) + ": " + (proposal.is_accepted ? kept : "refused")).c_str());
  if (!proposal.is_accepted) return;
  const auto& steps = desk.room.history();
  const auto step = std::find_if(steps.rbegin(), steps.rend(),
                                 [&](const host::HistoryStep& one) { return one.label == "Draft " + proposal.draft; });
  if (step == steps.rend()) return;
  if (step->is_undone) return desk.quiet("This was taken back.");
  if (desk.button("Take back", "roompanel/proposal/" + proposal.draft + "/undo")) desk.room.undo_of(proposal.seat, step->gesture);
}

}  // namespace

void draw_trial(const RoomDesk& desk, const AgendaProposal& draft) {
  draw_figures(desk, draft);
  draw_trial_plan(desk, draft.draft);
  draw_conflicts(desk, draft);
}

void draw_proposals(const RoomDesk& desk) {
  desk.heading("Proposals");
  std::vector<std::string> open;
  std::size_t decided = 0;
  for (const AgendaProposal& proposal : desk.agenda.proposals) {
    if (!proposal.is_decided) open.push_back(proposal.draft);
    else if (++decided > kDecidedShown) break;
    ImGui::PushID(proposal.draft.c_str());
    if (proposal.is_decided) draw_decided(desk, proposal);
    else draw_proposal(desk, proposal);
    ImGui::Separator();
    ImGui::PopID();
  }
  if (open.empty()) desk.quiet("No proposal waits for a decision.");
  desk.room.look_at(open);
}

}  // namespace bl::desktop
