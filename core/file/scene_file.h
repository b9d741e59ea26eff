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

/// What reading gave. Unknown typifications and link kinds are kept as ghosts and reported as warnings.
struct SceneReading {
  Scene scene;
  std::optional<SavedState> state;
  std::vector<Problem> problems;

  bool is_usable() const;
  /// The first error; the scene must not be usable.
  const Error& first_error() const;
};

/// Never fails as a whole: whatever is wrong is among the problems, each with its place.
SceneReading read_scene(std::string_view text, const Registry& registry);

/// `registry`, here and above: the types of the program; the scene brings the kinds of its scripts along. The canonical text:
/// fixed order of keys, ids ascending, only values that differ from their defaults, ends with a line feed.
std::string write_scene(const Scene& scene, const Registry& registry, const SavedState* state = nullptr);

/// Links that were kept as they are although their kind is known: what is wrong with each. So it is with links of a kind that was
/// added after they were read, and that they do not fit.
std::vector<Problem> unfit_links(const Scene& scene, const Registry& registry);

/// One node or link as it stands in a file, without its id: what add_node and add_link take.
Json node_to_json(const NodeRecord& node, const Registry& registry);
Result<NodeRecord> node_from_json(const Json& json, const Registry& registry, const std::string& place);
Json link_to_json(const LinkRecord& link, const Registry& registry);
Result<LinkRecord> link_from_json(const Json& json, const Registry& registry, const std::string& place);

}  // namespace bl
