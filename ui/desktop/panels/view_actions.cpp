// The commands of the 3D view and of the panes.
#include <GLFW/glfw3.h>

#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/hidden.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

bool is_editing(const Workbench& e) { return has_document(e) && !e.is_beamer; }
bool is_in_beamer(const Workbench& e) { return e.is_beamer; }

template <SceneView::Side side>
void look(Workbench& e) {
  e.view->look_from(side);
}

void add_camera_actions(std::vector<Action>& list) {
  using Side = SceneView::Side;
  list.push_back(
      {"View", "Frame selection, or all", {GLFW_KEY_F}, {GLFW_KEY_KP_DECIMAL}, Area::view, has_document, [](Workbench& e) {
         e.view->fit(false);
       }});
  list.push_back({"View", "Frame all", {GLFW_KEY_HOME}, {}, Area::view, has_document, [](Workbench& e) { e.view->fit(true); }});
  list.push_back({"View", "Plan, from above", {GLFW_KEY_1}, {}, Area::view, is_editing, look<Side::plan>});
  list.push_back({"View", "From the south", {GLFW_KEY_2}, {}, Area::view, is_editing, look<Side::south>});
  list.push_back({"View", "From the east", {GLFW_KEY_3}, {}, Area::view, is_editing, look<Side::east>});
  list.push_back({"View", "Axonometric", {GLFW_KEY_4}, {}, Area::view, is_editing, look<Side::axonometric>});
  list.push_back({"View",
                  "Perspective or parallel",
                  {GLFW_KEY_5},
                  {},
                  Area::view,
                  is_editing,
                  [](Workbench& e) { e.view->toggle_parallel(); },
                  false,
                  [](const Workbench& e) { return e.view != nullptr && !e.view->camera().is_parallel; }});
  list.push_back({"View",
                  "Walk (W A S D)",
                  {GLFW_KEY_6},
                  {},
                  Area::view,
                  is_editing,
                  [](Workbench& e) { e.view->toggle_walk(); },
                  false,
                  [](const Workbench& e) { return e.view != nullptr && e.view->is_walking(); }});
  list.push_back({"View",
                  "Section plane",
                  {GLFW_KEY_B, false, false, true},
                  {},
                  Area::view,
                  has_document,
                  [](Workbench& e) { e.view->toggle_section(); },
                  false,
                  [](const Workbench& e) { return e.view != nullptr && e.view->section().is_on; }});
  list.push_back(
      {"View", "Turn the section plane", {GLFW_KEY_B, false, true, true}, {}, Area::view, has_document, [](Workbench& e) {
         e.view->next_section();
       }});
  list.push_back({"View",
                  "Export this section ...",
                  {},
                  {},
                  Area::none,
                  [](const Workbench& e) { return has_document(e) && e.view != nullptr && e.view->section().is_on; },
                  [](Workbench& e) { e.dialogs->show_export(e.view->section_for_export()); }});
  list.push_back({"View",
                  "Move the selection",
                  {GLFW_KEY_G},
                  {},
                  Area::view,
                  [](const Workbench& e) { return is_editing(e) && !e.picks.nodes.empty(); },
                  [](Workbench& e) { e.view->begin_move_by_key(); }});
}

bool has_sun(const Workbench& e) { return has_document(e) && e.view != nullptr && e.view->has_sun(); }
bool is_previewing(const Workbench& e) { return has_sun(e) && e.view->preview().has_value(); }

// Half hours and days of the sun in the view; the scene has its own moment until somebody sets it.
void add_sun_actions(std::vector<Action>& list) {
  const auto add = [&](const char* label, Chord chord, bool (*can)(const Workbench&), void (*run)(Workbench&),
                       bool repeats = false) {
    list.push_back({"View", label, chord, {}, Area::view, can, run, repeats});
    list.back().submenu = "Sun";
  };
  constexpr double kHalfHour = 1800;
  add(
      "Sun: half an hour later", {GLFW_KEY_RIGHT, false, false, true}, has_sun,
      [](Workbench& e) { e.view->step_sun(kHalfHour, 0); }, true);
  add(
      "Sun: half an hour earlier", {GLFW_KEY_LEFT, false, false, true}, has_sun,
      [](Workbench& e) { e.view->step_sun(-kHalfHour, 0); }, true);
  add(
      "Sun: a day later", {GLFW_KEY_UP, false, false, true}, has_sun, [](Workbench& e) { e.view->step_sun(0, 1); }, true);
  add(
      "Sun: a day earlier", {GLFW_KEY_DOWN, false, false, true}, has_sun, [](Workbench& e) { e.view->step_sun(0, -1); }, true);
  add("Sun: run through the day", {}, has_sun, [](Workbench& e) { e.view->toggle_sun_run(); });
  list.back().is_on = [](const Workbench& e) { return e.view != nullptr && e.view->is_sun_running(); };
  add("Sun: set the previewed moment in the scene", {}, is_previewing, [](Workbench& e) { e.view->set_sun_in_scene(); });
  add(
      "Sun: back to the scene's moment", {GLFW_KEY_ESCAPE},
      [](const Workbench& e) { return is_previewing(e) && is_editing(e) && !e.view->is_moving() && !e.view->is_walking(); },
      [](Workbench& e) { e.view->end_preview(); });
}

void add_hiding(std::vector<Action>& list) {
  list.push_back({"View",
                  "Hide from 3D, or show again",
                  {GLFW_KEY_H, false, true},
                  {},
                  Area::none,
                  [](const Workbench& e) { return is_editing(e) && !e.picks.nodes.empty(); },
                  hide_chosen,
                  false,
                  are_chosen_hidden});
  list.back().targets = on_node;
  list.back().begins_group = true;
  list.push_back({"View", "Show all in 3D", {GLFW_KEY_H, false, false, true}, {}, Area::none, has_hidden, show_all});
  list.back().targets = on_node | on_ground;
}

constexpr const char* kKeepLabels[] = {"Keep this view as 1", "Keep this view as 2", "Keep this view as 3",
                                       "Keep this view as 4", "Keep this view as 5", "Keep this view as 6",
                                       "Keep this view as 7", "Keep this view as 8", "Keep this view as 9"};
constexpr const char* kGoLabels[] = {"Go to kept view 1", "Go to kept view 2", "Go to kept view 3",
                                     "Go to kept view 4", "Go to kept view 5", "Go to kept view 6",
                                     "Go to kept view 7", "Go to kept view 8", "Go to kept view 9"};

template <int number>
void add_kept_view(std::vector<Action>& list) {
  list.push_back({"View", kKeepLabels[number - 1], {GLFW_KEY_0 + number, true}, {}, Area::view, has_document, [](Workbench& e) {
                    e.view->store_camera(number);
                  }});
  list.back().submenu = "Kept views";
  list.push_back({"View", kGoLabels[number - 1], {GLFW_KEY_0 + number}, {}, Area::view, is_in_beamer, [](Workbench& e) {
                    e.view->recall_camera(number);
                  }});
  list.back().submenu = "Kept views";
  if constexpr (number < 9) add_kept_view<number + 1>(list);
}

// A layer's switch; the action knows its layer by position, because actions are plain functions.
template <std::size_t index>
void add_layer_actions(std::vector<Action>& list) {
  static const std::string label = std::string("Layer: ") + layers()[index].label;
  list.push_back({"View",
                  label.c_str(),
                  {},
                  {},
                  Area::none,
                  has_document,
                  [](Workbench& e) { set_layer(e.person, layers()[index].id, !is_on(e.person, layers()[index].id)); },
                  false,
                  [](const Workbench& e) { return is_on(e.person, layers()[index].id); }});
  list.back().submenu = "Layers";
  if constexpr (index + 1 < kLayerCount) add_layer_actions<index + 1>(list);
}

template <int percent>
void add_scale(std::vector<Action>& list, const char* label) {
  list.push_back({"View",
                  label,
                  {},
                  {},
                  Area::none,
                  nullptr,
                  [](Workbench& e) { e.person.scale = percent / 100.0f; },
                  false,
                  [](const Workbench& e) { return e.person.scale == percent / 100.0f; }});
  list.back().submenu = "Scale";
}

template <std::size_t index>
void add_forms(std::vector<Action>& list) {
  static const std::string label = std::string("Draw as: ") + form_choices()[index].label;
  list.push_back({"View",
                  label.c_str(),
                  {},
                  {},
                  Area::none,
                  has_document,
                  [](Workbench& e) { e.person.drawn_as = form_choices()[index].id; },
                  false,
                  [](const Workbench& e) { return &form_of(e.person.drawn_as) == &form_choices()[index]; }});
  list.back().submenu = "Forms and storeys";
  if constexpr (index + 1 < kFormCount) add_forms<index + 1>(list);
}

bool has_storeys(const Workbench& e) { return has_document(e) && e.view != nullptr && e.view->storeys_in_all() > 1; }

void add_storeys(std::vector<Action>& list) {
  const auto add = [&](const char* label, Chord chord, void (*run)(Workbench&), bool repeats) {
    list.push_back({"View", label, chord, {}, Area::view, has_storeys, run, repeats});
    list.back().submenu = "Forms and storeys";
  };
  add(
      "Storeys: one more", {GLFW_KEY_PAGE_UP}, [](Workbench& e) { e.view->step_storeys(1); }, true);
  list.back().begins_group = true;
  add(
      "Storeys: one fewer", {GLFW_KEY_PAGE_DOWN}, [](Workbench& e) { e.view->step_storeys(-1); }, true);
  add(
      "Storeys: all", {GLFW_KEY_PAGE_UP, false, true}, [](Workbench& e) { e.view->show_storeys(0); }, false);
}

constexpr const char *kRhino = "rhino", *kBlender = "blender", *kSketchUp = "sketchup", *kPolyscope = "polyscope";

template <const char* const& habit>
void add_habit(std::vector<Action>& list, const char* label) {
  list.push_back({"View",
                  label,
                  {},
                  {},
                  Area::none,
                  nullptr,
                  [](Workbench& e) { e.person.navigation = habit; },
                  false,
                  [](const Workbench& e) { return e.person.navigation == habit; }});
  list.back().submenu = "Mouse";
}

void add_navigation(std::vector<Action>& list) {
  add_habit<kRhino>(list, "Mouse as in Rhino");
  add_habit<kBlender>(list, "Mouse as in Blender");
  add_habit<kSketchUp>(list, "Mouse as in SketchUp");
  add_habit<kPolyscope>(list, "Mouse as in Polyscope");
}

// Canvas, 3D view, fields, and round again: for those who work without a mouse.
void next_pane(Workbench& e) {
  const bool has_fields = e.person.shows_side || e.person.shows_bottom;
  const char* name = "canvas";
  switch (e.area) {
    case Area::canvas: e.area = Area::view, name = "3D view"; break;
    case Area::view: e.area = has_fields ? Area::panels : Area::canvas; break;
    default: e.area = Area::canvas; break;
  }
  if (e.area == Area::panels) name = "fields: arrows walk, Enter types";
  e.notify(NoticeKind::told, std::string("Keys go to the ") + name + ".");
}

void add_window_actions(std::vector<Action>& list) {
  list.push_back({"View",
                  "Beamer mode",
                  {GLFW_KEY_F1},
                  {},
                  Area::none,
                  has_document,
                  [](Workbench& e) { e.is_beamer = !e.is_beamer; },
                  false,
                  is_in_beamer});
  list.push_back(
      {"View", "Leave beamer mode", {GLFW_KEY_ESCAPE}, {}, Area::none, is_in_beamer, [](Workbench& e) { e.is_beamer = false; }});
  list.push_back({"View", "Keys to the next pane", {GLFW_KEY_F6}, {}, Area::none, is_editing, next_pane});
  list.push_back({"View",
                  "Show inspector",
                  {GLFW_KEY_N},
                  {},
                  Area::view,
                  has_document,
                  [](Workbench& e) { e.person.shows_side = !e.person.shows_side; },
                  false,
                  [](const Workbench& e) { return e.person.shows_side; }});
  list.push_back({"View",
                  "Show lists",
                  {GLFW_KEY_T},
                  {},
                  Area::view,
                  has_document,
                  [](Workbench& e) { e.person.shows_bottom = !e.person.shows_bottom; },
                  false,
                  [](const Workbench& e) { return e.person.shows_bottom; }});
  list.push_back({"View",
                  "Dark colours",
                  {},
                  {},
                  Area::none,
                  nullptr,
                  [](Workbench& e) { e.person.is_dark = !e.person.is_dark; },
                  false,
                  [](const Workbench& e) { return e.person.is_dark; }});
  add_scale<100>(list, "Scale 100 %");
  add_scale<125>(list, "Scale 125 %");
  add_scale<150>(list, "Scale 150 %");
  add_scale<200>(list, "Scale 200 %");
  add_navigation(list);
}

}  // namespace

void add_view_actions(std::vector<Action>& list) {
  add_window_actions(list);
  add_camera_actions(list);
  add_sun_actions(list);
  add_hiding(list);
  add_forms<0>(list);
  add_storeys(list);
  add_layer_actions<0>(list);
  add_kept_view<1>(list);
}

}  // namespace bl::desktop
