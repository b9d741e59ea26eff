// A volume that is added in the window fits the brief: a use from its list, and no size of its own that would pull against it.
#include <algorithm>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/reading/account.h"
#include "tests/ui/desktop/panels_support.h"
#include "ui/desktop/panels/brief_uses.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {
namespace {

class NewVolumeDesktop : public PanelDesktop {
 public:
  using PanelDesktop::PanelDesktop;
  // By the search box of the canvas, as a person would; its id.
  std::string add(const std::string& role = "smartvol") {
    const std::set<std::string> before = ids();
    move_to(editor().canvas->to_screen(editor().canvas->to_plane({40, 200})));
    key(GLFW_KEY_TAB);
    frames(3);
    type(role);
    key(GLFW_KEY_ENTER);
    frames(2);
    for (const std::string& id : ids())
      if (!before.contains(id)) return id;
    ADD_FAILURE() << "nothing was added";
    return "";
  }
  std::string use_of(const std::string& node) { return std::get<std::string>(setting(node, "smart_volume", "use")); }
  bool says(const std::string& node, const std::string& port) {
    return editor().scene().nodes.at(node).types.at("smart_volume").contains(port);
  }
  bool is_told(const std::string& words) {
    return std::any_of(editor().notices.begin(), editor().notices.end(),
                       [&](const Notice& notice) { return notice.text.find(words) != std::string::npos; });
  }
  std::set<std::string> ids() {
    std::set<std::string> all;
    for (const auto& [id, node] : editor().scene().nodes) all.insert(id);
    return all;
  }
};

TEST(NewVolume, TakesTheUseThatIsMostShort) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(30);
  ASSERT_TRUE(desktop.editor().submit(command<RemoveNode>({"theatre"})));
  desktop.ticks(2);
  const std::string fresh = desktop.add();
  EXPECT_EQ(desktop.use_of(fresh), "theatre") << "nobody else has it";
  const std::string next = desktop.add();
  EXPECT_NE(desktop.use_of(next), "theatre") << "the theatre is seen to, also before a tick has passed";
  EXPECT_NE(desktop.use_of(next), "");
}

TEST(NewVolume, SaysWhichUseItTakes) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(30);
  ASSERT_TRUE(desktop.editor().submit(command<RemoveNode>({"theatre"})));
  desktop.ticks(2);
  desktop.add();
  EXPECT_TRUE(desktop.is_told("use `theatre`, which lacks the most"));
  EXPECT_TRUE(desktop.is_told("inspector"));
  NewVolumeDesktop without("scenes/studies/sixty_volumes.json");
  without.ticks(1);
  without.add();
  EXPECT_FALSE(without.is_told("takes the use"));
}

TEST(NewVolume, AUseWhoseOnlyVolumeStarvesLacksMost) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  std::string members;
  for (const auto& [id, node] : desktop.editor().scene().nodes)
    if (node.types.contains("smart_volume") && id != "theatre") members += (members.empty() ? "\"" : ", \"") + id + "\"";
  ASSERT_TRUE(desktop.editor().submit(command<SetPort>({"solver", {"smart_volumes_solver.members"}, {"[" + members + "]"}})));
  desktop.ticks(30);
  ASSERT_EQ(uses_by_need(desktop.editor()).front(), "theatre") << "it has a volume, and that has nothing";
  EXPECT_EQ(desktop.use_of(desktop.add()), "theatre");
  EXPECT_NE(desktop.use_of(desktop.add()), "theatre") << "that one is seen to now";
}

TEST(NewVolume, BeforeTheFirstTickTheLargestUseLacksMost) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  const std::vector<std::string> uses = uses_by_need(desktop.editor());
  const auto brief = reading::brief_of(desktop.editor().state());
  const auto area_of = [&](const std::string& use) {
    for (const auto& [name, row] : brief)
      if (name == use) return row.area;
    return 0.0;
  };
  ASSERT_GT(uses.size(), 3u);
  for (std::size_t k = 1; k < uses.size(); ++k) EXPECT_GE(area_of(uses[k - 1]), area_of(uses[k])) << uses[k];
}

TEST(NewVolume, SaysNothingOfItsSize) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(5);
  const std::string fresh = desktop.add();
  EXPECT_FALSE(desktop.says(fresh, "demand"));
  EXPECT_FALSE(desktop.says(fresh, "storey_height"));
  desktop.ticks(3);
  const State& state = desktop.editor().state();
  const std::uint32_t node = desktop.editor().index_of(fresh);
  const auto demand = state.plan->find(node, PortPath{"smart_volume", "demand", ""});
  ASSERT_TRUE(demand);
  EXPECT_EQ(state.nodes[node].types[demand->type].tension[demand->port], 0) << "the brief alone speaks of its demand";
  EXPECT_NE(as_number(state.value(*demand)), 1000);
}

TEST(NewVolume, ARoleThatIsGivenToANodeTakesAUseToo) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(5);
  ASSERT_TRUE(desktop.editor().submit(command<AddNode>({"plain", {R"({"name": "Plain"})"}})));
  ASSERT_TRUE(desktop.editor().submit(command<AddNode>({"bare", {R"({"name": "Bare"})"}})));
  desktop.choose("plain");
  desktop.press_on("add role");
  desktop.frames(3);
  desktop.type("smartvolume");
  desktop.frames(2);
  desktop.press_on("entry/SmartVolume");
  desktop.frames(2);
  ASSERT_TRUE(desktop.editor().scene().nodes.at("plain").types.contains("smart_volume"));
  EXPECT_NE(desktop.use_of("plain"), "");
  EXPECT_FALSE(desktop.says("plain", "demand"));
}

TEST(NewVolume, WithoutABriefItHasNoUse) {
  NewVolumeDesktop desktop("scenes/studies/sixty_volumes.json");
  desktop.ticks(1);
  ASSERT_TRUE(uses_by_need(desktop.editor()).empty());
  const std::string fresh = desktop.add();
  EXPECT_FALSE(desktop.says(fresh, "use"));
  EXPECT_FALSE(desktop.says(fresh, "demand"));
}

TEST(NewVolume, TheInspectorOffersTheUsesOfTheBrief) {
  NewVolumeDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(2);
  desktop.choose("library");
  const std::vector<std::string> uses = known_uses(desktop.editor().scene());
  ASSERT_GT(uses.size(), 3u);
  desktop.press_on("smart_volume.use/list");
  desktop.frames(2);
  for (const std::string& use : uses) EXPECT_TRUE(desktop.has("entry/" + use)) << use;
  desktop.press_on("entry/theatre");
  desktop.frames(2);
  EXPECT_EQ(desktop.use_of("library"), "theatre");
  EXPECT_EQ(desktop.steps(), 1u);
  // Typing goes on as before.
  desktop.type_into("smart_volume.use", "reading room");
  EXPECT_EQ(desktop.use_of("library"), "reading room");
  EXPECT_EQ(known_uses(desktop.editor().scene()).back(), "reading room") << "what a volume has is offered as well";
  // The link that deals the brief out has the same list.
  std::string link;
  for (const auto& [id, record] : desktop.editor().scene().links)
    if (record.kind == "demand") link = id;
  ASSERT_FALSE(link.empty());
  desktop.choose_link(link);
  EXPECT_TRUE(desktop.has("parameter.use/list"));
}

}  // namespace
}  // namespace bl::desktop
