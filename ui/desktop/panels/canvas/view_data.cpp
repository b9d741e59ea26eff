// Reads the view's JSON forgivingly: people and other programs may have written anything there.
#include "ui/desktop/panels/canvas/view_data.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bl::desktop::canvas {

namespace {

// Further out nobody could ever find it again, and floats have no hundredths left.
constexpr double kFarthest = 1e5;
constexpr std::size_t kMostDots = 64;

std::optional<double> number_in(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const double number = json.get<double>();
  if (!std::isfinite(number)) return std::nullopt;
  return std::clamp(number, -kFarthest, kFarthest);
}

std::optional<ImVec2> point_of(const Json& json) {
  if (!json.is_array() || json.size() != 2) return std::nullopt;
  const auto x = number_in(json[0]), y = number_in(json[1]);
  if (!x || !y) return std::nullopt;
  return ImVec2(static_cast<float>(*x), static_cast<float>(*y));
}

// Calls `take` for each member of the object under `key`, if there is one.
template <class Take>
void each(const Json& object, const char* key, Take take) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_object()) return;
  for (const auto& [id, content] : found->items()) take(id, content);
}

std::set<std::string> names_in(const Json& object, const char* key) {
  std::set<std::string> names;
  each(object, key, [&](const std::string& id, const Json& is_in) {
    if (is_in.is_boolean() && is_in.get<bool>()) names.insert(id);
  });
  return names;
}

Frame frame_in(const Json& json) {
  Frame frame{text_in(json, "name"), 0, names_in(json, "nodes"), names_in(json, "comments"), text_in(json, "in")};
  if (const auto found = json.find("colour"); found != json.end())
    if (const auto number = number_in(*found)) frame.colour = static_cast<std::size_t>(std::clamp(*number, 0.0, 99.0));
  return frame;
}

std::optional<Comment> comment_in(const Json& json) {
  const auto place = point_in(json, "at");
  if (!place) return std::nullopt;
  const ImVec2 wanted = point_in(json, "size").value_or(ImVec2(200, 60));
  return Comment{text_in(json, "text"), {*place, {std::clamp(wanted.x, 40.0f, 2000.0f), std::clamp(wanted.y, 20.0f, 2000.0f)}}};
}

std::vector<ImVec2> dots_in(const Json& json) {
  std::vector<ImVec2> dots;
  if (!json.is_array()) return dots;
  for (const Json& item : json) {
    const auto p = point_of(item);
    if (p && dots.size() < kMostDots) dots.push_back(*p);
  }
  return dots;
}

}  // namespace

std::optional<ImVec2> point_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : point_of(*found);
}

std::string text_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

ViewData read_view(const std::string& text) {
  ViewData view;
  const Json json = text.empty() ? Json() : Json::parse(text, nullptr, false);
  if (!json.is_object()) return view;
  each(json, "boxes", [&](const std::string& id, const Json& place) {
    if (const auto p = point_of(place)) view.boxes[id] = *p;
  });
  each(json, "sets", [&](const std::string& key, const Json& place) {
    if (const auto p = point_of(place)) view.sets[key] = *p;
  });
  view.collapsed = names_in(json, "collapsed");
  view.hidden = names_in(json, "hidden");
  each(json, "frames", [&](const std::string& id, const Json& frame) {
    if (frame.is_object()) view.frames[id] = frame_in(frame);
  });
  each(json, "comments", [&](const std::string& id, const Json& comment) {
    if (comment.is_object())
      if (auto read = comment_in(comment)) view.comments[id] = std::move(*read);
  });
  each(json, "dots", [&](const std::string& link, const Json& list) {
    if (auto dots = dots_in(list); !dots.empty()) view.dots[link] = std::move(dots);
  });
  return view;
}

bool ViewData::is_within(const std::string& inner, const std::string& outer) const {
  std::string at = inner;
  // A ring of frames in each other ends after as many steps as there are frames.
  for (std::size_t step = 0; step <= frames.size() && !at.empty(); ++step) {
    if (at == outer) return true;
    const auto found = frames.find(at);
    if (found == frames.end()) return false;
    at = found->second.in;
  }
  return false;
}

std::string ViewData::frame_of_node(const std::string& node) const {
  for (const auto& [id, frame] : frames)
    if (frame.nodes.contains(node)) return id;
  return "";
}

std::string ViewData::frame_of_comment(const std::string& comment) const {
  for (const auto& [id, frame] : frames)
    if (frame.comments.contains(comment)) return id;
  return "";
}

bool ViewData::holds_node(const std::string& frame, const std::string& node) const {
  return std::any_of(frames.begin(), frames.end(),
                     [&](const auto& entry) { return entry.second.nodes.contains(node) && is_within(entry.first, frame); });
}

bool ViewData::holds_comment(const std::string& frame, const std::string& comment) const {
  return std::any_of(frames.begin(), frames.end(),
                     [&](const auto& entry) { return entry.second.comments.contains(comment) && is_within(entry.first, frame); });
}

std::vector<std::string> ViewData::way_to(const std::string& frame) const {
  std::vector<std::string> way;
  // Frames in a ring are entered once each.
  for (std::string at = frame; frames.contains(at) && std::find(way.begin(), way.end(), at) == way.end(); at = frames.at(at).in)
    way.push_back(at);
  std::reverse(way.begin(), way.end());
  return way;
}

Json place_json(ImVec2 p) {
  // Whole tenths: what cannot be seen need not be in the file.
  const auto rounded = [](float v) { return std::round(static_cast<double>(v) * 10) / 10; };
  return Json::array({rounded(p.x), rounded(p.y)});
}

}  // namespace bl::desktop::canvas
