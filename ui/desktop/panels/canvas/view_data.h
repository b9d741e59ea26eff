// What a scene's view says about the canvas: where boxes lie, frames, comments and the dots of links.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/define/json_text.h"
#include "ui/desktop/panels/canvas/plane.h"

namespace bl::desktop::canvas {

/// Nodes that belong together. Its outline follows from what is in it.
struct Frame {
  std::string name;
  std::size_t colour = 0;
  std::set<std::string> nodes, comments;
  std::string in;  ///< the frame that it lies in, or empty
};

struct Comment {
  std::string text;
  Box box;
};

struct ViewData {
  std::map<std::string, ImVec2> boxes;  ///< upper left corners, by node
  std::map<std::string, ImVec2> sets;   ///< the same of whole sets, by their key
  std::set<std::string> collapsed;
  std::set<std::string> hidden;  ///< nodes that the 3D view leaves out
  std::map<std::string, Frame> frames;
  std::map<std::string, Comment> comments;
  std::map<std::string, std::vector<ImVec2>> dots;  ///< by link, from its first end on

  /// Is `inner` that frame, or in it at whatever depth?
  bool is_within(const std::string& inner, const std::string& outer) const;
  /// The frame that names the node, or nothing.
  std::string frame_of_node(const std::string& node) const;
  std::string frame_of_comment(const std::string& comment) const;
  /// Does the node, or the comment, lie in the frame, at whatever depth?
  bool holds_node(const std::string& frame, const std::string& node) const;
  bool holds_comment(const std::string& frame, const std::string& comment) const;
  /// From the outermost frame to this one.
  std::vector<std::string> way_to(const std::string& frame) const;
};

/// Takes what it understands; whatever else stands in the text is left alone, and never harms.
ViewData read_view(const std::string& text);

/// What stands under a key of an object: a place within reach, a text; nothing, or no text, where there is something else.
std::optional<ImVec2> point_in(const Json& object, const char* key);
std::string text_in(const Json& object, const char* key);

/// A place as the view keeps it.
Json place_json(ImVec2 p);

}  // namespace bl::desktop::canvas
