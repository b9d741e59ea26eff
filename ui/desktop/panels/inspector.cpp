// What is chosen, with all of its ports.
#include "ui/desktop/panels/inspector.h"

#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

namespace {

// A field can go while a hand is on it, by an undo: what is shown must not stand still for it for ever.
void forget_gone_fields(PanelMemory& memory) {
  const auto is_drawn = [&](const std::string& key) {
    // Fields of dialogs are drawn after these; their dialogs forget them.
    return key.starts_with("export/") || (memory.places_frame == ImGui::GetFrameCount() && memory.places.contains(key));
  };
  if (!memory.scrub.key.empty() && !is_drawn(memory.scrub.key) && !ImGui::IsMouseDown(0)) memory.scrub = {};
  if (!memory.typing.key.empty() && !is_drawn(memory.typing.key)) memory.typing = {};
}

}  // namespace

void draw_inspector(Workbench& editor) {
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
  forget_gone_fields(memory);
}

}  // namespace bl::desktop
