// Hiding and showing are changes of the view: undone with everything else, and nothing that a tick reads.
#include "ui/desktop/panels/hidden.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/canvas/view_data.h"

namespace bl::desktop {

namespace {

std::set<std::string> hidden_in(const Workbench& editor) { return canvas::read_view(editor.scene().view).hidden; }

void arrange_hidden(Workbench& editor, const std::set<std::string>& nodes, bool hides) {
  Json patch = Json::object();
  for (const std::string& id : nodes) patch["hidden"][id] = hides ? Json(true) : Json();
  if (!patch.empty()) editor.arrange(JsonValue::of(patch), editor.new_gesture());
}

}  // namespace

const std::set<std::string>& HiddenNodes::of(const Workbench& editor) {
  if (editor.scene().view == read_from_) return nodes_;
  read_from_ = editor.scene().view;
  nodes_ = hidden_in(editor);
  return nodes_;
}

std::string HiddenNodes::text(const Workbench& editor) {
  std::size_t count = 0, volumes = 0;
  for (const std::string& id : of(editor))
    if (const auto node = editor.scene().nodes.find(id); node != editor.scene().nodes.end())
      ++count, volumes += reading::is_a<reading::VolumeFigures>(node->second) ? 1 : 0;
  return count == 0 ? "" : reading::counted(count, volumes == count ? "volume" : "node") + " hidden";
}

void hide_chosen(Workbench& editor) { arrange_hidden(editor, editor.picks.nodes, !are_chosen_hidden(editor)); }

// Also those that stand in the view and have gone from the scene.
void show_all(Workbench& editor) { arrange_hidden(editor, hidden_in(editor), false); }

bool are_chosen_hidden(const Workbench& editor) {
  const auto& nodes = editor.picks.nodes;
  if (!editor.document || nodes.empty()) return false;
  const std::set<std::string> hidden = hidden_in(editor);
  return std::all_of(nodes.begin(), nodes.end(), [&](const std::string& id) { return hidden.contains(id); });
}

bool has_hidden(const Workbench& editor) { return editor.document != nullptr && !hidden_in(editor).empty(); }

}  // namespace bl::desktop
