// Makes media nodes of picture files, for the command line and for files dropped onto the window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::making {

struct MediaOptions {
  std::string scene;      ///< path of the scene file, which the picture's path becomes relative to; may be empty
  std::string placement;  ///< ground, billboard or camera; empty: a camera where the picture says where it looked
  std::string consent = "unknown";
  std::string licence, author;      ///< empty: what the picture says
  double size = 0;                  ///< [m]; 0: as the declaration has it
  std::optional<Vector3> position;  ///< [m]; nothing: where the picture was taken, or the origin
};

struct MadeMedia {
  std::string id;
  Command command;                 ///< adds the node
  std::vector<std::string> notes;  ///< one sentence for each thing that was assumed or left out
};

/// Reads the metadata of the file; the picture itself is not moved.
Result<MadeMedia> make_media(const std::string& file, const Scene& scene, const MediaOptions& options);

/// Does the name end like that of a known picture format?
bool is_picture_name(const std::string& file);

}  // namespace bl::making
