// What is chosen, with all of its ports.
#include "ui/desktop/panels/inspector.h"

#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

void draw_inspector(Editor& editor) {
  PanelMemory& memory = memory_of(editor);
  if (!memory.view) memory.view = std::make_unique<InspectorView>();
  // A press elsewhere ends typing and may choose something else in one frame: what was typed still goes where it was meant to.
  bool is_fresh = false;
  if (memory.typing.key.empty() && memory.scrub.key.empty()) {
    is_fresh = memory.shown.nodes != editor.picks.nodes || memory.shown.links != editor.picks.links;
    if (is_fresh) memory.complaint_key.clear();
    memory.shown = editor.picks;
  }
  InspectorView& view = *memory.view;
  view.refresh(editor, memory.shown);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {editor.theme.px(8), editor.theme.px(3)});
  ImGui::BeginChild("inspected", {0, 0}, false);
  if (is_fresh) ImGui::SetScrollY(0);
  if (!view.nodes().empty()) inspect_nodes(editor, view);
  if (!view.links().empty()) {
    if (!view.nodes().empty()) ImGui::Separator();
    inspect_links(editor, view);
  }
  if (view.nodes().empty() && view.links().empty()) inspect_scene(editor);
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

}  // namespace bl::desktop
