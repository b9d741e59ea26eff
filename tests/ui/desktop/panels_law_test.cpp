// Laws of the panels: whatever is registered or saved can be shown, unfolded and looked at, and looking changes nothing.
#include <filesystem>

#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/panels_support.h"

namespace bl::desktop {
namespace {

std::vector<std::string> scenes_below(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_folder() + "/" + folder))
    if (entry.path().extension() == ".json")
      found.push_back(std::filesystem::relative(entry.path(), test::source_folder()).string());
  std::sort(found.begin(), found.end());
  return found;
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, IsShownWithoutBeingChanged) {
  PanelDesktop desktop(GetParam());
  const std::string before = desktop.scene_text();
  const Scene scene = desktop.editor().scene();
  for (int round = 0; round < 2; ++round) {
    for (const auto& [id, node] : scene.nodes) {
      desktop.choose(id);
      // Every field is pointed at once, and every list of rows unfolded.
      const auto places = memory_of(desktop.editor()).places;
      for (const auto& [type, values] : node.types)
        for (const PortDefinition& port : full_registry().typification(type)->ports) {
          const std::string key = type + "." + port.id;
          if (!places.contains(key)) continue;
          desktop.move_to(desktop.middle(key));
          if (round == 0 && (port.kind == ValueKind::table || port.kind == ValueKind::points)) desktop.press_on(key);
        }
    }
    for (const auto& [id, link] : scene.links) desktop.choose_link(id);
    for (const auto& [id, node] : scene.nodes) desktop.editor().picks.nodes.insert(id);
    for (const auto& [id, link] : scene.links) desktop.editor().picks.links.insert(id);
    desktop.frames(2);
    desktop.editor().picks.clear();
    desktop.frames(2);
    desktop.ticks(2);
  }
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_EQ(desktop.steps(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Nodes, EveryScene, ::testing::ValuesIn(scenes_below("scenes/nodes")));
INSTANTIATE_TEST_SUITE_P(Links, EveryScene, ::testing::ValuesIn(scenes_below("scenes/links")));
INSTANTIATE_TEST_SUITE_P(Old, EveryScene, ::testing::ValuesIn(scenes_below("scenes/old")));

TEST(EveryType, CanBeGivenToANodeAndIsShown) {
  PanelDesktop desktop("scenes/nodes/control.json");
  const std::string id = desktop.editor().scene().nodes.begin()->first;
  for (const auto& [type, definition] : full_registry().typifications())
    if (!desktop.editor().scene().nodes.at(id).types.contains(type)) {
      ASSERT_TRUE(desktop.editor().submit(command<Typify>({id, type, {"{}"}}))) << type;
    }
  desktop.choose(id);
  desktop.ticks(2);
  for (const auto& [type, definition] : full_registry().typifications())
    for (const PortDefinition& port : definition.ports)
      if (!port.is_computed) {
        EXPECT_TRUE(desktop.has(type + "." + port.id) || desktop.has(type + "." + port.id + "/x") || port.kind == ValueKind::text)
            << type << "." << port.id;
      }
}

}  // namespace
}  // namespace bl::desktop
