// Scene files: JSON text to a scene and back, byte for byte.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/json_text.h"
#include "core/graph/state.h"

namespace bl {

inline constexpr int kSceneVersion = 1;

/// The result of reading. Unknown typifications and link kinds are kept as ghosts and reported as warnings.
struct SceneReading {
  Scene scene;
  std::optional<SavedState> state;
  std::vector<Problem> problems;

  bool is_usable() const;
  /// The first error; call it only where the scene is not usable.
  const Error& first_error() const;
};

/// Never fails as a whole: each error is among the problems, with its place.
SceneReading read_scene(std::string_view text, const Registry& registry);

/// The canonical text: fixed order of keys, ids ascending, only values that differ from their defaults, a line feed at the end.
/// `registry`, here and above: the types of the program; the scene adds the kinds of its scripts.
std::string write_scene(const Scene& scene, const Registry& registry, const SavedState* state = nullptr);

/// The errors of links that are kept as ghosts although their kind is known. This happens where the kind was added after the
/// links were read, and they do not fit it.
std::vector<Problem> unfit_links(const Scene& scene, const Registry& registry);

/// One node or link in the form of a file, without its id, as add_node and add_link take it.
Json node_to_json(const NodeRecord& node, const Registry& registry);
Result<NodeRecord> node_from_json(const Json& json, const Registry& registry, const std::string& place);
Json link_to_json(const LinkRecord& link, const Registry& registry);
Result<LinkRecord> link_from_json(const Json& json, const Registry& registry, const std::string& place);

}  // namespace bl
