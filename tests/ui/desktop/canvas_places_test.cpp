// Boxes that nobody has placed: whatever is added or removed, those that are seen stay where they are.
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {
namespace {

struct Places {
  std::map<std::string, canvas::Box> boxes, pills;
};

Places places_of(const canvas::Model& model) {
  Places places;
  for (const canvas::NodeBox& box : model.boxes) places.boxes[box.id] = box.box;
  for (const canvas::Pill& pill : model.pills) places.pills[pill.key] = pill.box;
  return places;
}

void expect_still(const std::map<std::string, canvas::Box>& before, const std::map<std::string, canvas::Box>& after,
                  const std::string& deed) {
  for (const auto& [id, box] : after) {
    const auto known = before.find(id);
    if (known == before.end()) continue;
    EXPECT_EQ(known->second.at.x, box.at.x) << id << " moved by " << deed;
    EXPECT_EQ(known->second.at.y, box.at.y) << id << " moved by " << deed;
  }
}

class Editing {
 public:
  Editing(unsigned seed, const std::string& scene) : random_(seed), desktop_(scene) { desktop_.ticks(1); }
  canvas::Model& model() { return desktop_.editor().canvas->board().model; }

  // One random edit of the scene, as it may come from any panel; what it was.
  std::string act() {
    Workbench& editor = desktop_.editor();
    const int deed = static_cast<int>(draw(6));
    const std::string number = std::to_string(++count_);
    bool is_done = false;
    std::string what;
    if (deed == 0) {
      what = "a new node";
      const char* types[] = {R"({"smart_volume": {}})", R"({"control": {}})", R"({})"};
      is_done = editor.submit(
          command<AddNode>({"new" + number, {std::string(R"({"tags": ["some"], "types": )") + types[draw(3)] + "}"}}));
    } else if (deed == 1) {
      what = "a node that goes";
      is_done = editor.submit(command<RemoveNode>({node()}));
    } else if (deed == 2) {
      what = "a new link";
      const Json link = {{"kind", "attract"}, {"from", node()}, {"to", node()}};
      is_done = editor.submit(command<AddLink>({"link" + number, {link.dump()}}));
    } else if (deed == 3) {
      what = "a new link to a set";
      const Json link = {{"kind", "attract"}, {"from", node()}, {"to", {{"typification", "smart_volume"}}}};
      is_done = editor.submit(command<AddLink>({"link" + number, {link.dump()}}));
    } else if (deed == 4 && !editor.scene().links.empty()) {
      what = "a link that goes";
      auto link = editor.scene().links.begin();
      std::advance(link, static_cast<std::ptrdiff_t>(draw(editor.scene().links.size())));
      is_done = editor.submit(command<RemoveLink>({link->first}));
    } else {
      what = "undo";
      editor.undo();
      is_done = true;
    }
    editor.notices.clear();
    if (is_done) ++done_[what];
    desktop_.frames(1);
    return what;
  }
  const std::map<std::string, int>& done() const { return done_; }

 private:
  std::size_t draw(std::size_t below) { return static_cast<std::size_t>(random_() % below); }
  std::string node() {
    const auto& nodes = desktop_.editor().scene().nodes;
    if (nodes.empty()) return "nobody";
    auto at = nodes.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(draw(nodes.size())));
    return at->first;
  }

  std::minstd_rand random_;
  NullDesktop desktop_;
  int count_ = 0;
  std::map<std::string, int> done_;
};

class CanvasPlaces : public ::testing::TestWithParam<unsigned> {};

TEST_P(CanvasPlaces, NoEditMovesABoxThatIsSeen) {
  Editing editing(GetParam(), GetParam() % 2 == 0 ? "scenes/start/quarter.json" : "scenes/studies/sixty_volumes.json");
  for (int k = 0; k < 120; ++k) {
    const Places before = places_of(editing.model());
    const std::string deed = editing.act();
    const Places after = places_of(editing.model());
    expect_still(before.boxes, after.boxes, deed);
    expect_still(before.pills, after.pills, deed);
    // What is new lies upon nothing that was there.
    for (const auto& [id, box] : after.boxes) {
      if (before.boxes.contains(id)) continue;
      for (const auto& [other, known] : after.boxes)
        if (other != id) { EXPECT_FALSE(box.touches(known)) << id << " lies on " << other << " after " << deed; }
      for (const auto& [key, known] : after.pills)
        EXPECT_FALSE(box.touches(known)) << id << " lies on " << key << " after " << deed;
    }
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GE(editing.done().size(), 5u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CanvasPlaces, ::testing::Values(1u, 2u, 4u, 6u));

}  // namespace
}  // namespace bl::desktop
