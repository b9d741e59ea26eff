// Legends in views of many widths: never over more than a third of the height, and none out of reach.
#include <algorithm>

#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

class ViewLegends {
 public:
  explicit ViewLegends(ImVec2 size) : desktop("scenes/studies/urban_mode.json", size) {
    desktop.editor().person.shows_side = desktop.editor().person.shows_bottom = false;
    desktop.ticks(3);
    desktop.frames(3);
  }
  const LegendPlaces& places() { return desktop.editor().view->legend_places(); }
  std::vector<std::string> titles(bool is_shown) {
    std::vector<std::string> titles;
    for (std::size_t k = 0; k < places().legends.size(); ++k) {
      const bool stands = std::any_of(places().shown.begin(), places().shown.end(),
                                      [k](const LegendPlaces::Shown& shown) { return shown.legend == k; });
      if (stands == is_shown) titles.push_back(places().legends[k].title);
    }
    return titles;
  }
  bool has(const std::string& key) { return memory_of(desktop.editor()).places.contains(key); }
  void press_on(const std::string& key) {
    ASSERT_TRUE(has(key)) << key;
    const ImVec4 p = memory_of(desktop.editor()).places[key];
    desktop.click({(p.x + p.z) / 2, (p.y + p.w) / 2});
    desktop.frames(3);
  }

  NullDesktop desktop;
};

TEST(Legends, CoverAThirdOfTheHeightAtMost) {
  for (const float width : {400.0f, 640.0f, 900.0f, 1280.0f, 1920.0f}) {
    ViewLegends view({width, 700});
    const LegendPlaces& places = view.places();
    EXPECT_GE(places.legends.size(), 3u) << "uses, streets, sun, shade";
    EXPECT_GE(places.top, places.highest - 1) << width;
    EXPECT_FALSE(places.shown.empty()) << width;
    // Each legend stands in the view, or waits.
    for (const std::string& title : view.titles(false)) {
      const bool waits = std::any_of(places.folded.begin(), places.folded.end(),
                                     [&](std::size_t k) { return places.legends[k].title == title; });
      EXPECT_TRUE(waits) << title;
    }
    EXPECT_EQ(view.has("view/legends"), !places.folded.empty()) << width;
  }
}

TEST(Legends, AFoldedOneComesWhenItIsPressed) {
  ViewLegends view({640, 700});
  const auto hidden = view.titles(false);
  ASSERT_FALSE(hidden.empty());
  view.press_on("view/legends");
  view.press_on("view/legends/" + hidden.back());
  const auto shown = view.titles(true);
  ASSERT_FALSE(shown.empty());
  EXPECT_EQ(shown.front(), hidden.back());
}

}  // namespace
}  // namespace bl::desktop
