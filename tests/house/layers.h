// The table core/layers.txt as the tests of the house read it: includes, namespaces, and how long a file may be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bl::house {

/// One folder of the tree, with the folders that its files may include besides their own.
struct Room {
  std::string folder;
  int lines = 0;
  std::vector<std::string> sees;
  std::string names = "bl";  ///< the namespace that its files open; others may lie within it
  bool is_alone = false;     ///< its files do not include each other
};

/// One file that may be longer than its room allows.
struct LongFile {
  std::string path;
  int lines = 0;
  std::string reason;
};

struct Layers {
  std::vector<Room> rooms;
  std::vector<LongFile> files;
  std::vector<std::string> faults;  ///< lines of the table that say nothing, "line 3: ..."

  /// The room with the longest folder that `path` lies in, or nothing.
  const Room* room_of(std::string_view path) const;
  /// The largest number of lines that the file may have; 0 where it lies in no room.
  int line_limit(std::string_view path) const;
};

Layers read_layers(std::string_view text);
/// The table of this checkout.
const Layers& layers();

/// The rooms but `tests` as a list, one line each: what a room includes after it, without what that includes anyway.
std::string list_of(const Layers& layers);
/// The same as a picture: a flow chart in the language of Mermaid, which Markdown viewers draw.
std::string picture_of(const Layers& layers);

/// Does `path` lie in `folder`, or is it the folder itself?
bool lies_in(std::string_view path, std::string_view folder);

}  // namespace bl::house
