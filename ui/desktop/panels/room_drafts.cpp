// The own drafts in the tab Room. While somebody works in one, the whole window shows it.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/room_panel.h"

namespace bl::desktop {

namespace {

constexpr const char* kNoSteps = "Change something in the draft first.";

std::string title_of_draft(const std::string& title) { return title.empty() ? "Draft without a title" : title; }

// What went wrong is told as everywhere else.
void tell_of_draft(const RoomDesk& desk, const Result<void>& done) {
  if (!done) desk.editor.notify(NoticeKind::error, done.error().text());
}

void draw_steps(const RoomDesk& desk, const AgendaProposal& draft) {
  for (const AgendaStep& step : draft.steps)
    ImGui::TextWrapped("%s", (step.words + (step.misfit.empty() ? "" : " - fits no more: " + step.misfit)).c_str());
  draw_trial(desk, draft);
}

// A draft is proposed under its title, which can be another one by now.
void draw_proposing(const RoomDesk& desk, const std::string& draft, const std::string& title, bool has_steps,
                    const std::string& why) {
  const std::string key = "roompanel/draft/" + draft;
  std::string &words = desk.text(key + "/why"), &name = desk.text(key + "/title");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##title", title.empty() ? "title of the proposal" : title.c_str(), &name);
  note_place(desk.editor, key + "/title");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##why", "what it is good for", &words);
  note_place(desk.editor, key + "/why");
  if (desk.button("Propose", key + "/propose", has_steps ? why : kNoSteps)) {
    desk.room.propose_draft(draft, name.empty() ? title : name, words);
    name.clear();
    words.clear();
  }
  ImGui::SameLine();
  if (desk.sure_button("Discard", key + "/discard", "The draft and all of its changes will be gone.", "Discard it"))
    desk.room.drop_draft(draft);
}

void draw_present(const RoomDesk& desk, const std::string& why) {
  const guest::DraftWork& work = *desk.room.draft();
  const std::string id = work.id(), title = work.title();  // a press below may end the work
  const std::size_t steps = work.step_count();
  ImGui::PushStyleColor(ImGuiCol_Text, desk.editor.theme.colours().accent);
  ImGui::TextWrapped("%s", ("You are in the draft: " + title_of_draft(title) + ", " + reading::counted(steps, "change")).c_str());
  ImGui::PopStyleColor();
  desk.quiet(work.has_ticks()
                 ? "What you change is a step of it. The view shows what comes of it. Nobody else sees it."
                 : "What you change is a step of it, and nobody else sees it. This window does not compute what comes "
                   "of it; the figures below are the server's.");
  for (const AgendaProposal& draft : desk.agenda.drafts)
    if (draft.draft == id) draw_steps(desk, draft);
  if (desk.button("Take the last step back", "roompanel/draft/undo", steps == 0 ? kNoSteps : why)) {
    const auto undone = desk.room.undo();
    if (!undone) desk.editor.notify(NoticeKind::error, undone.error().text());
  }
  ImGui::SameLine();
  if (desk.button("Bring it back", "roompanel/draft/redo", why)) {
    const auto redone = desk.room.redo();
    if (!redone) desk.editor.notify(NoticeKind::error, redone.error().text());
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("Leave the draft")) {
    desk.room.leave_draft();
    note_place(desk.editor, "roompanel/draft/leave");
    return;
  }
  note_place(desk.editor, "roompanel/draft/leave");
  draw_proposing(desk, id, title, steps > 0, why);
}

void draw_other(const RoomDesk& desk, const AgendaProposal& draft, const std::string& why) {
  ImGui::PushID(draft.draft.c_str());
  ImGui::TextWrapped("%s", (title_of_draft(draft.title) + ", " + reading::counted(draft.steps.size(), "change")).c_str());
  if (desk.button("Work in it", "roompanel/draft/" + draft.draft + "/enter", why))
    tell_of_draft(desk, desk.room.enter_draft(draft.draft));
  ImGui::SameLine();
  if (desk.sure_button("Discard", "roompanel/draft/" + draft.draft + "/discard", "The draft and all of its changes will be gone.",
                       "Discard it"))
    desk.room.drop_draft(draft.draft);
  ImGui::PopID();
}

}  // namespace

void draw_drafts(const RoomDesk& desk) {
  if (desk.room.role() == "viewer") return;
  desk.heading("Drafts");
  const std::string why = desk.leads || desk.agenda.may.contains("draft") ? "" : "In this phase nobody can work on drafts.";
  if (desk.room.draft() != nullptr) return draw_present(desk, why);
  desk.quiet("In a draft you change the scene for yourself alone, and propose it when you like.");
  std::string& title = desk.text("roompanel/draft/new");
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##new", "title of the draft", &title);
  note_place(desk.editor, "roompanel/draft/new");
  if (desk.button("Begin a draft", "roompanel/draft/begin", why)) {
    const auto begun = desk.room.begin_draft(title);
    tell_of_draft(desk, begun);
    if (begun) title.clear();
    return;
  }
  for (const AgendaProposal& draft : desk.agenda.drafts) draw_other(desk, draft, why);
}

}  // namespace bl::desktop
