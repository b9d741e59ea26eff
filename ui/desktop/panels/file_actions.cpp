// The commands of the menus File, Edit and Help.
#include <GLFW/glfw3.h>

#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

void close_document(Workbench& editor) {
  editor.dialogs->guard([&editor] {
    editor.document.reset();
    editor.moment.reset();
    editor.picks = {};
    editor.panels.reset();
    editor.view->forget();
    editor.list_problems("", {});
  });
}

void back_to_saved(Workbench& editor) {
  if (editor.document->source().empty()) return;
  const std::string path = editor.document->source();
  editor.dialogs->guard([&editor, path] { editor.open(path, true); });
}

bool can_host(const Workbench& editor) { return !has_document(editor) || editor.document->room() == nullptr; }
bool has_hosted(const Workbench& editor) { return editor.hosting != nullptr; }
bool has_imports(const Workbench& editor) { return has_document(editor) && !editor.document->imports().empty(); }
bool has_log(const Workbench& editor) { return has_document(editor) && editor.document->room() == nullptr; }
bool has_file(const Workbench& editor) { return has_document(editor) && !editor.document->source().empty(); }

std::string programme_of(const Workbench& editor) {
  if (!has_document(editor)) return "";
  for (const auto& [id, node] : editor.document->scene().nodes)
    if (node.types.contains("programme")) return id;
  return "";
}
bool has_programme(const Workbench& editor) { return !programme_of(editor).empty(); }

// Its rows stand in the inspector, what came of them in the statistics.
void show_programme(Workbench& editor) {
  editor.picks.only_node(programme_of(editor));
  memory_of(editor).wanted_tab = "Statistics";
}

}  // namespace

void add_file_actions(std::vector<Action>& list) {
  auto file = [&](const char* label, Chord chord, bool (*can)(const Workbench&), void (*run)(Workbench&)) {
    list.push_back({"File", label, chord, {}, Area::none, can, run});
  };
  file("New from boundary and programme ...", {GLFW_KEY_N, true}, nullptr, [](Workbench& e) { e.dialogs->show_new_scene(); });
  file("Open ...", {GLFW_KEY_O, true}, nullptr, [](Workbench& e) { e.dialogs->ask_open(); });
  file("Join a room ...", {GLFW_KEY_J, true}, nullptr, [](Workbench& e) { e.dialogs->ask_join(); });
  file("Host a session ...", {}, can_host, [](Workbench& e) { e.dialogs->show_host(); });
  file("End the hosted session ...", {}, has_hosted, [](Workbench& e) { close_document(e); });
  file("Import surroundings ...", {GLFW_KEY_I, true}, nullptr, [](Workbench& e) { e.dialogs->show_import(); });
  file("Add link script ...", {}, has_document, [](Workbench& e) { e.dialogs->ask_script(); });
  file("Save", {GLFW_KEY_S, true}, has_document, [](Workbench& e) { e.dialogs->save(); });
  file("Save as ...", {GLFW_KEY_S, true, true}, has_document, [](Workbench& e) { e.dialogs->ask_save_as(); });
  file("Back to the saved scene", {}, has_file, back_to_saved);
  file("Export ...", {GLFW_KEY_E, true}, has_document, [](Workbench& e) { e.dialogs->show_export(); });
  file("Write the report ...", {GLFW_KEY_E, true, true}, has_document, [](Workbench& e) { e.dialogs->ask_report(); });
  file("Write the import report ...", {}, has_imports, [](Workbench& e) { e.dialogs->ask_import_report(); });
  file("Save the log for replay ...", {}, has_log, [](Workbench& e) { e.dialogs->ask_log(); });
  file("Take a picture of the window", {GLFW_KEY_F12}, nullptr, [](Workbench& e) { e.wants_picture = true; });
  list.back().is_always = true;
  file("Close the scene", {GLFW_KEY_W, true}, has_document, close_document);
  file("Quit", {GLFW_KEY_Q, true}, nullptr, [](Workbench& e) { e.dialogs->guard([&e] { e.wants_quit = true; }); });
}

void add_edit_actions(std::vector<Action>& list) {
  list.push_back({"Edit", "Undo", {GLFW_KEY_Z, true}, {}, Area::none, has_document, [](Workbench& e) { e.undo(); }, true});
  list.push_back({"Edit",
                  "Redo",
                  {GLFW_KEY_Y, true},
                  {GLFW_KEY_Z, true, true},
                  Area::none,
                  has_document,
                  [](Workbench& e) { e.redo(); },
                  true});
  list.push_back({"Edit", "Programme (the brief)", {}, {}, Area::none, has_programme, show_programme});
  list.push_back(
      {"Edit", "Commands ...", {GLFW_KEY_K, true}, {}, Area::none, nullptr, [](Workbench& e) { e.dialogs->show_palette(); }});
}

void add_help_actions(std::vector<Action>& list) {
  list.push_back({"Help", "Keys and gestures", {GLFW_KEY_SLASH, false, true}, {}, Area::none, nullptr, [](Workbench& e) {
                    e.dialogs->show_keys();
                  }});
}

}  // namespace bl::desktop
