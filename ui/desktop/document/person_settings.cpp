// The person's settings as a small JSON file. Errors in it are ignored, so that the window always opens.
#include "ui/desktop/document/person_settings.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/file/private_file.h"

namespace bl::desktop {

namespace {

// One place says which members are kept under which key; reading and writing both walk it.
template <class Settings, class Visit>
void each_member(Settings& s, Visit visit) {
  visit("dark", s.is_dark);
  visit("scale", s.scale);
  visit("canvas_share", s.canvas_share);
  visit("side_width", s.side_width);
  visit("bottom_height", s.bottom_height);
  visit("shows_side", s.shows_side);
  visit("shows_bottom", s.shows_bottom);
  visit("colour_by", s.colour_by);
  visit("drawn_as", s.drawn_as);
  visit("navigation", s.navigation);
  visit("width", s.width);
  visit("height", s.height);
  visit("recent", s.recent);
  visit("recent_additions", s.recent_additions);
  visit("layers", s.layers);
  visit("seats", s.seats);
  visit("recent_rooms", s.recent_rooms);
  visit("plans", s.plans);
  visit("sections", s.sections);
}

}  // namespace

void PersonSettings::remember(std::vector<std::string>& list, const std::string& item, std::size_t most) {
  std::erase(list, item);
  list.insert(list.begin(), item);
  if (list.size() > most) list.resize(most);
}

Extent fitting_window(Extent wished, Extent room) {
  // What a title bar and edges take; nobody knows it before there is a window.
  constexpr int kTitleBar = 40, kEdges = 8;
  const auto fitted_length = [](int length, int most, int taken) {
    return most <= 0 || length <= most ? length : std::max(most - taken, 1);
  };
  return {fitted_length(wished.width, room.width, kEdges), fitted_length(wished.height, room.height, kTitleBar)};
}

PersonSettings read_person_settings(const std::string& file) {
  PersonSettings settings;
  settings.file = file;
  const auto text = read_file(file);
  const Json json = text ? Json::parse(*text, nullptr, false) : Json();
  if (!json.is_object()) return settings;
  each_member(settings, [&](const char* key, auto& member) {
    const auto found = json.find(key);
    if (found == json.end()) return;
    try {
      member = found->get<std::remove_reference_t<decltype(member)>>();
    } catch (const nlohmann::json::exception&) {
      return;  // of another kind than expected: the default stays
    }
  });
  settings.scale = std::clamp(settings.scale, 1.0f, 2.0f);
  settings.canvas_share = std::clamp(settings.canvas_share, 0.1f, 0.9f);
  settings.side_width = std::clamp(settings.side_width, 200.0f, 800.0f);
  settings.bottom_height = std::clamp(settings.bottom_height, 80.0f, 800.0f);
  settings.width = std::clamp(settings.width, 640, 16000);
  settings.height = std::clamp(settings.height, 400, 16000);
  return settings;
}

Result<void> write_person_settings(const PersonSettings& settings) {
  if (settings.file.empty()) return {};
  Json json = Json::object();
  each_member(settings, [&](const char* key, const auto& member) { json[key] = member; });
  return write_private_file(settings.file, write_json(json, 1) + "\n");  // it holds what opens seats
}

}  // namespace bl::desktop
