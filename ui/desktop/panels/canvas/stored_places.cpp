// Places as patches of the view.
#include "ui/desktop/panels/canvas/stored_places.h"

#include <nlohmann/json.hpp>

#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/edits.h"

namespace bl::desktop::canvas {

namespace {

// Of larger scenes, such as those with every building of a town, the view would be read and written by megabytes with each drag.
constexpr std::size_t kMostStored = 3000;

// What of the view's places and dots does not fit the new layout: of things that have gone, and on curves that run otherwise now.
void drop_stale(const Model& model, Json& patch) {
  for (const auto& [id, at] : model.view.boxes)
    if (model.find_box(id) == model.boxes.size()) patch["boxes"][id] = nullptr;
  for (const auto& [key, at] : model.view.sets)
    if (std::none_of(model.pills.begin(), model.pills.end(), [&](const Pill& pill) { return pill.key == key; }))
      patch["sets"][key] = nullptr;
  for (const auto& [id, dots] : model.view.dots) patch["dots"][id] = nullptr;
}

}  // namespace

void lay_out_all(Board& board) {
  const Model& model = board.model;
  const std::vector<ImVec2> places = model.automatic_places(board.editor);
  const auto is_new = [](bool is_stored, ImVec2 from, ImVec2 to) { return !is_stored || length(to - from) > 0.01f; };
  Json patch = Json::object();
  const bool is_too_large = model.boxes.size() + model.pills.size() > kMostStored;
  // Without stored places the layout gives its own: a scene that is too large forgets those that it has.
  if (is_too_large)
    for (const auto& [id, at] : model.view.boxes) patch["boxes"][id] = nullptr;
  for (std::size_t k = 0; k < model.boxes.size() && !is_too_large; ++k)
    if (const NodeBox& box = model.boxes[k]; is_new(box.is_stored, box.box.at, places[k]))
      patch["boxes"][box.id] = place_json(places[k]);
  if (is_too_large)
    for (const auto& [key, at] : model.view.sets) patch["sets"][key] = nullptr;
  for (std::size_t k = 0; k < model.pills.size() && !is_too_large; ++k)
    if (const Pill& pill = model.pills[k]; is_new(pill.is_stored, pill.box.at, places[model.boxes.size() + k]))
      patch["sets"][pill.key] = place_json(places[model.boxes.size() + k]);
  drop_stale(model, patch);
  std::vector<Command> commands;
  add_view_patch(commands, patch);
  if (commands.empty()) board.editor.notify(NoticeKind::told, "Everything lies where the layout puts it.");
  else submit_as(board, commands, "Lay out all");
  board.after_frame = [](Board& b) {
    b.model.update(b.editor);
    fit_all(b, true);
  };
}

// A scene that was merely opened is left as it is: the layout gives the same places for the same scene. With the first change it
// would not any more, so that from there on what is seen is stored: it outlives the window, a crash, and changes from elsewhere.
bool store_places(Board& board) {
  const Model& model = board.model;
  const std::size_t count = model.unstored_boxes.size() + model.unstored_sets.size();
  if (count == 0 || count + model.view.boxes.size() > kMostStored) return false;
  Document& document = *board.editor.document;
  const std::int64_t gesture = document.last_step();
  if (gesture == 0 || !document.is_unsaved()) return false;
  Json patch = Json::object();
  for (const auto& [id, at] : model.unstored_boxes) patch["boxes"][id] = place_json(at);
  for (const auto& [key, at] : model.unstored_sets) patch["sets"][key] = place_json(at);
  return board.editor.arrange(JsonValue::of(patch), gesture);
}

}  // namespace bl::desktop::canvas
