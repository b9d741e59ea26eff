// Places inside places: paths are cut at their slashes.
#include "core/graph/touch.h"

namespace bl {

bool lies_inside(const Touch& inner, const Touch& outer) {
  if (inner.part != outer.part || inner.id != outer.id || inner.path.size() <= outer.path.size()) return false;
  return outer.path.empty() || (inner.path.starts_with(outer.path) && inner.path[outer.path.size()] == '/');
}

bool widen(Touch& place) {
  if (place.path.empty()) return false;
  const std::size_t slash = place.path.rfind('/');
  place.path.resize(slash == std::string::npos ? 0 : slash);
  return true;
}

std::string step_of(std::string_view name) {
  std::string step;
  for (const char c : name) step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return step;
}

std::string text_of(const Touch& place) {
  static constexpr const char* kParts[] = {"settings", "nodes", "links", "scripts", "view"};
  std::string text = kParts[static_cast<std::size_t>(place.part)];
  for (const std::string* step : {&place.id, &place.path})
    if (!step->empty()) text += "/" + *step;
  return text;
}

}  // namespace bl
