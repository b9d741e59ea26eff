// Reads the rows `room FOLDER: LINES namespace folders...` and `file PATH: LINES reason`; blank lines and those that begin with #
// are free.
#include "tests/house/layers.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/support/place/source_folder.h"

namespace bl::house {

namespace {

// What a room includes without what these include anyway: the arrows of the drawing.
std::vector<std::string> arrows(const Layers& layers, const Room& room) {
  std::set<std::string> indirect;
  for (const std::string& seen : room.sees)
    if (const Room* below = layers.room_of(seen)) indirect.insert(below->sees.begin(), below->sees.end());
  std::vector<std::string> direct;
  for (const std::string& seen : room.sees)
    if (!indirect.contains(seen)) direct.push_back(seen);
  return direct;
}

}  // namespace

bool lies_in(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

const Room* Layers::room_of(std::string_view path) const {
  const Room* best = nullptr;
  for (const Room& room : rooms)
    if (lies_in(path, room.folder) && (best == nullptr || room.folder.size() > best->folder.size())) best = &room;
  return best;
}

int Layers::line_limit(std::string_view path) const {
  for (const LongFile& file : files)
    if (file.path == path) return file.lines;
  const Room* room = room_of(path);
  return room == nullptr ? 0 : room->lines;
}

Layers read_layers(std::string_view text) {
  Layers layers;
  std::istringstream stream{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string kind, name;
    int lines = 0;
    words >> kind >> name >> lines;
    const bool is_complete = !words.fail() && name.size() > 1 && name.back() == ':' && lines > 0;
    if (is_complete) name.pop_back();
    if (is_complete && kind == "room") {
      Room room;
      room.folder = name;
      room.lines = lines;
      for (std::string seen; words >> seen;) {
        if (seen == "alone") room.is_alone = true;
        else if (seen.starts_with("bl::")) room.names = seen;
        else room.sees.push_back(seen);
      }
      layers.rooms.push_back(std::move(room));
    } else if (std::string reason; is_complete && kind == "file" && std::getline(words >> std::ws, reason)) {
      layers.files.push_back({name, lines, reason});
    } else {
      layers.faults.push_back("line " + std::to_string(number) +
                              ": neither `room FOLDER: LINES namespace folders` nor `file PATH: LINES reason`");
    }
  }
  return layers;
}

const Layers& layers() {
  static const Layers read = [] {
    std::ifstream stream(test::source_folder() + "/core/layers.txt", std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return read_layers(text.str());
  }();
  return read;
}

std::string list_of(const Layers& layers) {
  std::size_t width = 0;
  for (const Room& room : layers.rooms) width = std::max(width, room.folder.size());
  std::string drawing;
  for (const Room& room : layers.rooms) {
    if (room.folder == "tests") continue;
    std::string line = room.folder;
    const std::vector<std::string> direct = arrows(layers, room);
    if (!direct.empty()) line += std::string(width - room.folder.size(), ' ') + " ->";
    for (const std::string& seen : direct) line += " " + seen;
    drawing += line + "\n";
  }
  return drawing;
}

std::string picture_of(const Layers& layers) {
  std::string picture = "flowchart BT\n";
  for (const Room& room : layers.rooms)
    if (room.folder != "tests")
      for (const std::string& seen : arrows(layers, room)) picture += "  " + room.folder + " --> " + seen + "\n";
  return picture;
}

}  // namespace bl::house
