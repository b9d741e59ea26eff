// The tabs below canvas and 3D view.
#include "core/reading/figures.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

void watch_run(Workbench& editor) {
  PanelMemory& memory = memory_of(editor);
  // Nobody pays for times that nobody sees.
  editor.document->running().watch_times(memory.times_frame >= ImGui::GetFrameCount() - 1);
  const std::shared_ptr<const State>& state = editor.moment->state;
  const bool is_the_same_scene = memory.watched && memory.watched->plan->dependents == state->plan->dependents &&
                                 memory.watched_problems == editor.problems_revision;
  if (is_the_same_scene && editor.now < memory.watch_at) {
    if (memory.watched != state) editor.wake_at(memory.watch_at);
    return;
  }
  if (memory.watched != state) memory.watch_at = editor.now + figures_pause(state->nodes.size());
  memory.watched = state;
  memory.watched_problems = editor.problems_revision;
  memory.record->sample(editor);
  memory.problems->refresh(editor, memory.record->figures(editor));
}

void draw_bottom(Workbench& editor) {
  PanelMemory& memory = memory_of(editor);
  if (!ImGui::BeginTabBar("bottom")) return;
  const auto flags = [&](const char* name) {
    return memory.wanted_tab == name ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
  };
  const std::size_t pressing = memory.problems->pressing();
  const std::string problems =
      "Problems" + (pressing > 0 ? "  " + reading::grouped(static_cast<double>(pressing)) : std::string()) + "###Problems";
  if (ImGui::BeginTabItem(problems.c_str(), nullptr, flags("Problems"))) {
    draw_problems(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("Statistics", nullptr, flags("Statistics"))) {
    draw_statistics(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("Time", nullptr, flags("Time"))) {
    draw_times(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("History", nullptr, flags("History"))) {
    draw_history(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("Import", nullptr, flags("Import"))) {
    draw_imports(editor);
    ImGui::EndTabItem();
  }
  if (editor.document && editor.document->room() != nullptr && ImGui::BeginTabItem("Room", nullptr, flags("Room"))) {
    draw_room_panel(editor);
    ImGui::EndTabItem();
  }
  memory.wanted_tab.clear();
  ImGui::EndTabBar();
}

}  // namespace bl::desktop
