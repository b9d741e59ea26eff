// A place of a scene that a command changes, named so that the changes of two people can be compared.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace bl {

enum class ScenePart : std::uint8_t { setting, node, link, script, view };

/// Who touches a place has written all that lies inside it: to remove a node is to write each of its ports.
struct Touch {
  ScenePart part = ScenePart::setting;
  std::string id;    ///< of the setting, node, link or script; empty for the view
  std::string path;  ///< inside it; empty for all of it, else such as `name`, `types/plot/floors`, `locked/node.position`

  auto operator<=>(const Touch&) const = default;
};

/// Does `inner` lie inside `outer`, and is another place?
bool lies_inside(const Touch& inner, const Touch& outer);
/// Makes `place` the next larger place that it lies in; false where there is none.
bool widen(Touch& place);
/// A name as one step of a path: slashes and tildes as in RFC 6901.
std::string step_of(std::string_view name);
/// As messages name it: `nodes/tower/types/plot/floors`.
std::string text_of(const Touch& place);

}  // namespace bl
