// Changes how the scene is laid out and looked at: boxes on the canvas, frames, comments, cameras. The tick never reads it.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/session/support.h"

namespace bl {

namespace {

// Puts a key where it stands in ascending order, so that the same view always has the same text, whatever the way to it.
void insert_sorted(Json& object, const std::string& key, Json value) {
  Json sorted = Json::object();
  bool is_placed = false;
  for (auto& [known, content] : object.items()) {
    if (!is_placed && key < known) {
      sorted[key] = std::move(value);
      is_placed = true;
    }
    sorted[known] = std::move(content);
  }
  if (!is_placed) sorted[key] = std::move(value);
  object = std::move(sorted);
}

// The merge patch of RFC 7396: objects merge, null removes, everything else replaces. Objects that become empty go as well.
void merge(Json& target, const Json& changes) {
  if (!target.is_object()) target = Json::object();
  for (const auto& [key, change] : changes.items()) {
    if (change.is_null()) {
      target.erase(key);
      continue;
    }
    Json value = target.contains(key) ? target[key] : Json();
    if (change.is_object()) merge(value, change);
    else value = change;
    const bool is_gone = change.is_object() && value.empty();
    if (is_gone) target.erase(key);
    else if (target.contains(key)) target[key] = std::move(value);
    else insert_sorted(target, key, std::move(value));
  }
}

// The patch that leads back from what `changes` make of `before`.
Json reversed(const Json& before, const Json& changes) {
  Json back = Json::object();
  for (const auto& [key, change] : changes.items()) {
    const auto found = before.is_object() ? before.find(key) : before.end();
    const bool is_known = before.is_object() && found != before.end();
    if (!is_known) back[key] = nullptr;
    else if (change.is_object() && found->is_object()) back[key] = reversed(*found, change);
    else back[key] = *found;
  }
  return back;
}

std::string text_of(const Json& view) { return view.empty() ? std::string() : write_json_line(view); }

}  // namespace

void SetView::declare(CommandBuilder<SetView>& c) {
  c.keeps_logic();
  c.id("set_view")
      .label("Arrange")
      .doc("Changes the layout of the canvas, frames, comments, or cameras. Nothing that is computed depends on it.");
  c.argument(&In::changes, "changes")
      .required()
      .doc("A JSON object that is merged into the view: objects merge, null removes, everything else replaces.");
  c.argument(&In::whole, "whole").doc("When on, `changes` is the whole view, and what was there before is gone.");
}

Inverse SetView::apply(SceneEdit& edit, const In& in) {
  auto changes = parse_json(in.changes.text);
  if (!changes) return changes.error().within("changes");
  if (!changes->is_object()) return Error{ErrorCode::wrong_kind, "changes", "expects an object"};
  std::string& view = edit.scene().view;
  const Json before = view.empty() ? Json::object() : Json::parse(view, nullptr, false);
  Json after = in.whole ? *changes : before;
  if (!in.whole) merge(after, *changes);
  Json back = reversed(before, *changes);
  if (in.whole) back.update(before);
  Json returned = after;
  merge(returned, back);
  // What a patch cannot bring back byte for byte (keys that stood in another order) comes back as a whole.
  const bool is_exact = text_of(returned) == view;
  std::vector inverse{is_exact ? command<SetView>({{write_json_line(back)}, false}) : command<SetView>({{view}, true})};
  view = in.whole ? write_json_line(after) : text_of(after);
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_view, SetView)
