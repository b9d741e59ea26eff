// Says where things are in the window: the same desktop as in the real window, laid out without one, so that scripts know where
// to press. Usage: desktop_places SCENE WIDTH HEIGHT [choose=NODE] WHAT..., where WHAT is node:ID, handle:ID or field:KEY.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {
namespace {

// Smooth movements have ended by then.
constexpr int kSettledFrames = 240;

std::optional<ImVec2> place_of(NullDesktop& desktop, const std::string& kind, const std::string& name) {
  if (kind == "node") return desktop.editor().canvas->screen_of(name);
  if (kind == "handle") return desktop.editor().canvas->handle_of(name);
  const auto& places = memory_of(desktop.editor()).places;
  const auto found = places.find(name);
  if (found == places.end()) return std::nullopt;
  return ImVec2{(found->second.x + found->second.z) / 2, (found->second.y + found->second.w) / 2};
}

int run(int count, char** arguments) {
  if (count < 5) return 2;
  NullDesktop desktop("", {static_cast<float>(std::atof(arguments[2])), static_cast<float>(std::atof(arguments[3]))});
  if (!desktop.editor().open(arguments[1])) return 2;
  desktop.frames(kSettledFrames);
  for (int k = 4; k < count; ++k) {
    const std::string word = arguments[k];
    if (word.starts_with("choose=")) {
      desktop.editor().picks.only_node(word.substr(7));
      desktop.frames(4);
      continue;
    }
    const std::size_t colon = word.find(':');
    const auto place = place_of(desktop, word.substr(0, colon), word.substr(colon + 1));
    if (!place) {
      std::fprintf(stderr, "there is no %s\n", word.c_str());
      return 1;
    }
    std::printf("%.0f %.0f\n", place->x, place->y);
  }
  return 0;
}

}  // namespace
}  // namespace bl::desktop

int main(int count, char** arguments) { return bl::desktop::run(count, arguments); }
