// Changes the view of the scene: boxes on the canvas, frames, comments, cameras. The tick never reads it.
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/session/support.h"
#include "core/session/view_paths.h"

namespace bl {

namespace {

void merge(Json& target, const Json& changes);

// What a change makes of a value; nothing where nothing is left of it.
Json merged_value(Json value, const Json& change) {
  if (!change.is_object()) return change;
  merge(value, change);
  return value.empty() ? Json() : value;
}

// The merge patch of RFC 7396: objects merge, null removes, everything else replaces. Objects that become empty go as well. What
// is new stands before the first key that is greater, so that the same view always has the same text, whatever the way to it. In
// one walk along both: a patch may speak of thousands of boxes.
void merge(Json& target, const Json& changes) {
  if (!target.is_object()) target = Json::object();
  std::map<std::string, const Json*> waiting;
  for (const auto& [key, change] : changes.items()) waiting.emplace(key, &change);
  std::vector<std::pair<std::string, Json>> kept;
  for (auto& [key, content] : target.items()) {
    const auto change = waiting.find(key);
    if (change == waiting.end()) {
      kept.emplace_back(key, std::move(content));
      continue;
    }
    if (Json value = merged_value(std::move(content), *change->second); !value.is_null())
      kept.emplace_back(key, std::move(value));
    waiting.erase(change);
  }
  Json merged = Json::object();
  auto& members = merged.get_ref<Json::object_t&>();  // at its end no key has to be looked for
  auto next = waiting.begin();
  const auto add_before = [&](const std::string* key) {
    for (; next != waiting.end() && (key == nullptr || next->first < *key); ++next)
      if (Json value = merged_value(Json(), *next->second); !value.is_null()) members.emplace_back(next->first, std::move(value));
  };
  for (auto& [key, content] : kept) {
    add_before(&key);
    members.emplace_back(key, std::move(content));
  }
  add_before(nullptr);
  target = std::move(merged);
}

// By key, because an ordered object is looked through from its beginning for each of them.
std::map<std::string_view, const Json*> by_key(const Json& object) {
  std::map<std::string_view, const Json*> members;
  if (object.is_object())
    for (const auto& [key, content] : object.get_ref<const Json::object_t&>()) members.emplace(key, &content);
  return members;
}

// The patch that leads back from what `changes` make of `before`; where they take its place as a whole, all of it comes back.
Json reversed(const Json& before, const Json& changes, bool is_whole) {
  std::map<std::string_view, const Json*> old = by_key(before);
  Json back = Json::object();
  for (const auto& [key, change] : changes.get_ref<const Json::object_t&>()) {
    const auto found = old.find(key);
    if (found == old.end()) {
      append_field(back, key) = nullptr;
      continue;
    }
    const Json& content = *found->second;
    const bool is_patched = !is_whole && change.is_object() && content.is_object();
    append_field(back, key) = is_patched ? reversed(content, change, false) : content;
    old.erase(found);
  }
  if (is_whole)
    for (const auto& [key, content] : before.get_ref<const Json::object_t&>())
      if (old.contains(key)) append_field(back, key) = content;
  return back;
}

// Ours, because the library's own builder takes n² for n boxes; but it reads no more once a stop is wished.
Json read_view(const std::string& view) {
  if (view.empty()) return Json::object();
  auto read = parse_json(view);
  return read ? std::move(*read) : Json::parse(view, nullptr, false);
}

std::string text_of(const Json& view) { return view.empty() ? std::string() : write_json_line(view); }

}  // namespace

void SetView::declare(CommandBuilder<SetView>& c) {
  c.id("set_view")
      .label("Arrange")
      .doc("Changes the layout of the canvas, frames, comments, or cameras. Results do not depend on it.");
  c.argument(&In::changes, "changes")
      .required()
      .doc("A JSON object that is merged into the view: objects merge, null removes, everything else replaces.");
  c.argument(&In::whole, "whole").doc("When on, `changes` replaces the whole view.");
}

Inverse SetView::apply(SceneEdit& edit, const In& in) {
  const auto read = in.changes.read();
  if (!read) return read.error().within("changes");
  const Json& changes = **read;
  if (!changes.is_object()) return Error{ErrorCode::wrong_kind, "changes", "expects an object"};
  const std::string& view = edit.scene().view;
  const Json before = read_view(view);
  Json after = in.whole ? changes : before;
  if (!in.whole) merge(after, changes);
  const Json back = reversed(before, changes, in.whole);
  Json returned = after;
  merge(returned, back);
  // What a patch cannot bring back byte for byte (keys that stood in another order) comes back as a whole.
  const bool is_exact = text_of(returned) == view;
  std::vector inverse{is_exact ? command<SetView>({JsonValue::of(back), false}) : command<SetView>({view, true})};
  const auto paths = view_differences(before, after, in.whole ? nullptr : &changes);
  edit.set_view(in.whole ? write_json_line(after) : text_of(after), paths);
  return inverse;
}

Command SetView::narrow(const Scene& done, const std::set<Touch>& places) {
  std::set<std::string> paths;
  for (const Touch& place : places)
    if (place.part == ScenePart::view) paths.insert(place.path);
  return command<SetView>({JsonValue::of(patch_at(read_view(done.view), paths)), false});
}

}  // namespace bl

BL_COMMAND(set_view, SetView)
