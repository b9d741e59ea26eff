// The command palette and the list of keys: every action by its name, with its key; and every role that a new node can have.
#include "ui/desktop/panels/dialogs.h"

#include <algorithm>
#include <functional>

#include <imgui_stdlib.h>

#include "ui/desktop/look/fuzzy.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {

namespace {

struct PaletteHit {
  std::string label, note;
  bool is_possible = true;
  std::function<void(Workbench&)> run;
  int score = 0;
};

std::string keys_of(const Action& action) {
  const std::string other = text_of(action.other);
  return text_of(action.chord) + (other.empty() ? "" : "  " + other);
}

// In the middle of what is seen of the canvas.
void add_in_sight(Workbench& editor, const std::string& role) {
  canvas::Board& board = editor.canvas->board();
  canvas::add_node(board, role, board.camera.sight().centre());
}

// Actions and roles of new nodes that fit what was typed, the best first; what cannot be done now stands at the end.
std::vector<PaletteHit> hits_of(const std::string& query, const Workbench& editor) {
  constexpr int kImpossible = 100000;
  std::vector<PaletteHit> hits;
  for (const Action& action : actions()) {
    const int score = fuzzy_score(query, std::string(action.label) + " " + action.menu);
    const bool is_possible = action.can == nullptr || action.can(editor);
    if (score >= 0)
      hits.push_back({action.label, std::string(action.menu) + "   " + keys_of(action), is_possible, action.run,
                      score - (is_possible ? 0 : kImpossible)});
  }
  if (editor.document && !editor.is_beamer)
    for (const auto& [id, type] : editor.types().typifications()) {
      const std::string label = "Add " + type.label;
      const int score = id == kBaseNode ? -1 : fuzzy_score(query, label + " " + id);
      if (score >= 0) hits.push_back({label, "new node", true, [role = id](Workbench& e) { add_in_sight(e, role); }, score});
    }
  std::stable_sort(hits.begin(), hits.end(), [](const PaletteHit& a, const PaletteHit& b) { return a.score > b.score; });
  return hits;
}

bool was_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

}  // namespace

void Dialogs::show_palette() { show(Kind::palette); }
void Dialogs::show_keys() { show(Kind::keys); }

void Dialogs::draw_palette() {
  if (!begin("Commands", 560, 420)) return;
  const Theme& theme = editor_->theme;
  if (is_fresh_) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool is_entered =
      ImGui::InputTextWithHint("##query", "what do you want to do?", &query_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemEdited()) marked_ = 0;
  const std::vector<PaletteHit> hits = hits_of(query_, *editor_);
  const int count = static_cast<int>(hits.size());
  if (was_pressed(ImGuiKey_DownArrow)) ++marked_;
  if (was_pressed(ImGuiKey_UpArrow)) --marked_;
  marked_ = std::clamp(marked_, 0, std::max(0, count - 1));
  const PaletteHit* chosen = is_entered && count > 0 ? &hits[static_cast<std::size_t>(marked_)] : nullptr;
  ImGui::BeginChild("hits");
  for (int k = 0; k < count; ++k) {
    const PaletteHit& hit = hits[static_cast<std::size_t>(k)];
    ImGui::PushID(k);
    ImGui::BeginDisabled(!hit.is_possible);
    if (ImGui::Selectable(hit.label.c_str(), k == marked_, ImGuiSelectableFlags_DontClosePopups)) chosen = &hit;
    ImGui::EndDisabled();
    if (k == marked_ && (was_pressed(ImGuiKey_DownArrow) || was_pressed(ImGuiKey_UpArrow))) ImGui::SetScrollHereY();
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(hit.note.c_str()).x - theme.px(8));
    ImGui::TextDisabled("%s", hit.note.c_str());
    ImGui::PopID();
  }
  if (count == 0) ImGui::TextDisabled("There is no command like that.");
  ImGui::EndChild();
  if (chosen != nullptr && chosen->is_possible) {
    close();
    ImGui::EndPopup();
    chosen->run(*editor_);
    return;
  }
  ImGui::EndPopup();
}

void Dialogs::draw_keys() {
  if (!begin("Keys and gestures", 760, 560)) return;
  const Theme& theme = editor_->theme;
  ImGui::SetNextItemWidth(theme.px(260));
  ImGui::InputTextWithHint("##query", "filter", &query_);
  ImGui::BeginChild("keys");
  constexpr auto kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (ImGui::BeginTable("table", 3, kFlags)) {
    for (const Action& action : actions()) {
      const std::string keys = keys_of(action);
      if (fuzzy_score(query_, std::string(action.label) + " " + action.menu + " " + keys) < 0) continue;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", action.menu);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(action.label);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keys.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
  ImGui::EndPopup();
}

}  // namespace bl::desktop
