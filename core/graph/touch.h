// A place of a scene that a command changes, named so that the changes of two people can be compared.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace bl {

enum class ScenePart : std::uint8_t { setting, node, link, script, view };

/// A change of a place also changes everything inside it: removing a node writes each of its ports.
struct Touch {
  ScenePart part = ScenePart::setting;
  std::string id;    ///< of the setting, node, link or script; empty for the view
  std::string path;  ///< path inside it; empty for the whole, else such as `name`, `types/plot/floors`, `locked/node.position`

  auto operator<=>(const Touch&) const = default;
};

/// Does `inner` lie inside `outer`, and differ from it?
bool lies_inside(const Touch& inner, const Touch& outer);
/// Replaces `place` by the next larger place around it; false where there is none.
bool widen(Touch& place);
/// A name as one step of a path: slashes and tildes as in RFC 6901.
std::string step_of(std::string_view name);
/// As messages name it: `nodes/tower/types/plot/floors`.
std::string text_of(const Touch& place);

}  // namespace bl
