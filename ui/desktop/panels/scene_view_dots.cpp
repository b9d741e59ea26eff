// Dots of a vote in the 3D view: a click sets one, or takes it away again; the ballot is cast in the tab Room.
#include <algorithm>
#include <cmath>

#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr float kDotRadius = 10;  // [points]

// By what they say; two may look alike, and the number on them tells them apart.
ImU32 dot_colour(const Colours& colours, const std::string& option, std::size_t index) {
  if (option == "plus") return colours.good;
  if (option == "minus") return colours.bad;
  const ImU32 kInTurn[] = {colours.good, colours.bad, colours.accent, colours.warning};
  return kInTurn[index % 4];
}

}  // namespace

bool SceneView::is_placing() const { return memory_of(*editor_).placing.has_value(); }

bool SceneView::take_dot(const ImVec2& mouse) {
  PanelMemory& memory = memory_of(*editor_);
  if (!memory.placing) return false;
  vote::Ballot& ballot = memory.ballots[memory.placing->vote];
  for (std::size_t k = 0; k < ballot.places.size(); ++k) {
    const Seen at = seen(ballot.places[k]);
    const ImVec2 p = on_screen(at);
    if (!at.is_in_front || std::hypot(p.x - mouse.x, p.y - mouse.y) > editor_->theme.px(kDotRadius)) continue;
    ballot.places.erase(ballot.places.begin() + static_cast<std::ptrdiff_t>(k));
    ballot.options.erase(ballot.options.begin() + static_cast<std::ptrdiff_t>(k));
    return true;
  }
  if (ballot.places.size() >= memory.placing->most) {
    editor_->notify(NoticeKind::told, "No dot is left. Click a dot to take it away.");
    return true;
  }
  ballot.options.push_back(memory.placing->option);
  ballot.places.push_back(place_under(mouse));
  return true;
}

void SceneView::draw_dots() {
  PanelMemory& memory = memory_of(*editor_);
  if (!memory.placing) return;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) && !ImGui::GetIO().WantTextInput)
    return memory.placing.reset();
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const vote::Ballot& ballot = memory.ballots[memory.placing->vote];
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < ballot.places.size(); ++k) {
    const Seen at = seen(ballot.places[k]);
    if (!at.is_in_front) continue;
    const auto& options = memory.placing->options;
    const auto index = static_cast<std::size_t>(std::find(options.begin(), options.end(), ballot.options[k]) - options.begin());
    const std::string sign = ballot.options[k] == "plus" ? "+" : ballot.options[k] == "minus" ? "-" : std::to_string(index + 1);
    const ImVec2 p = on_screen(at), extent = ImGui::CalcTextSize(sign.c_str());
    list.AddCircleFilled(p, theme.px(kDotRadius), dot_colour(c, ballot.options[k], index), 32);
    list.AddCircle(p, theme.px(kDotRadius), IM_COL32_WHITE, 32, theme.px(1.5f));
    list.AddText({p.x - extent.x / 2, p.y - extent.y / 2}, IM_COL32_WHITE, sign.c_str());
  }
  const std::size_t left = memory.placing->most - std::min(memory.placing->most, ballot.places.size());
  draw_hint("Click to set a dot: " + memory.placing->words + ". " + std::to_string(left) + " of " +
            std::to_string(memory.placing->most) + " left. Click a dot to take it away. Esc ends this.");
}

}  // namespace bl::desktop
