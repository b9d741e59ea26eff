// Boxes keep their places: over undo, saving, reopening and crashes, whoever has placed them; and laying out is a step.
#include <filesystem>
#include <random>

#include <unistd.h>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/host/journal.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/canvas_support.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/stored_places.h"

namespace bl::desktop {
namespace {

using SeenPlaces = std::map<std::string, std::pair<float, float>>;

SeenPlaces places_on(const canvas::Model& model) {
  SeenPlaces places;
  for (const canvas::NodeBox& box : model.boxes) places[box.id] = {box.box.at.x, box.box.at.y};
  for (const canvas::Pill& pill : model.pills) places["set " + pill.key] = {pill.box.at.x, pill.box.at.y};
  return places;
}

// Of this process alone: tests run beside each other.
std::string path_of(const std::string& name) { return ::testing::TempDir() + name + "-" + std::to_string(getpid()) + ".json"; }

// A journal of this process as a crash would leave it: of one that is gone.
std::string leave_journal() {
  const std::filesystem::path folder = std::filesystem::path(host::person_folder()) / "journals";
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(std::to_string(getpid()) + "-") && entry.path().extension() == ".journal")
      if (last.empty() || std::filesystem::last_write_time(entry.path()) >= std::filesystem::last_write_time(last))
        last = entry.path();
  const std::filesystem::path gone = folder / ("2147483645-" + std::to_string(getpid()) + ".journal");
  std::filesystem::copy_file(last, gone, std::filesystem::copy_options::overwrite_existing);
  return gone.string();
}

class CanvasStored : public CanvasFixture {
 protected:
  CanvasStored() { desktop.move_to({300, 300}); }
  SeenPlaces places() { return places_on(board().model); }
  void lay_link() {
    ASSERT_TRUE(editor().submit(command<AddLink>({"fresh", {R"({"kind": "attract", "from": "theatre", "to": "library"})"}})));
    desktop.frames(2);
  }
  std::string label() {
    desktop.frames(1);
    const auto& steps = editor().document->history();
    return steps.empty() ? "" : steps.back().label;
  }
};

TEST_F(CanvasStored, LayingOutIsAStepAlsoWhereNothingWasStored) {
  ASSERT_TRUE(scene().view.empty());
  const std::string opened = desktop.scene_text();
  const SeenPlaces seen = places();
  desktop.key(GLFW_KEY_L, false, true);
  desktop.frames(30);
  ASSERT_EQ(editor().document->history().size(), 1u);
  EXPECT_EQ(label(), "Lay out all");
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), opened);
  EXPECT_EQ(places(), seen);
}

TEST_F(CanvasStored, UndoAfterLayingOutTakesBackTheLayoutAndNothingElse) {
  lay_link();
  choose_alone({"library"});
  const ImVec2 from = at("library");
  desktop.drag(from, {from.x - 60, from.y + 150});
  editor().picks.clear();
  const SeenPlaces seen = places();
  desktop.key(GLFW_KEY_L, false, true);
  desktop.frames(30);
  EXPECT_EQ(label(), "Lay out all");
  const SeenPlaces laid = places();
  EXPECT_NE(laid, seen);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_TRUE(scene().links.contains("fresh"));
  EXPECT_EQ(places(), seen) << "the boxes are where they were before";
  desktop.key(GLFW_KEY_Y, true);
  EXPECT_EQ(places(), laid);
}

TEST_F(CanvasStored, LayingOutWhatIsLaidOutChangesNothingAndSaysSo) {
  desktop.key(GLFW_KEY_L, false, true);
  desktop.frames(2);
  editor().notices.clear();
  desktop.key(GLFW_KEY_L, false, true);
  desktop.frames(2);
  EXPECT_EQ(editor().document->history().size(), 1u);
  ASSERT_FALSE(editor().notices.empty());
  EXPECT_NE(editor().notices.back().text.find("lies where"), std::string::npos) << editor().notices.back().text;
}

// Thousands of places would be read and written with every drag: laying out forgets what was stored, and the layout stands again.
TEST(CanvasStoredMany, LayingOutALargeSceneStoresNoPlaces) {
  std::string text = R"({"format": "behaviourlinks", "version": 1, "view": {"boxes": {"n7": [9000, 4000]}}, "nodes": [)";
  for (int k = 0; k < 3100; ++k) text += (k > 0 ? "," : "") + std::string(R"({"id": "n)") + std::to_string(k) + R"("})";
  const std::string path = path_of("many_places");
  ASSERT_TRUE(write_file(path, text + R"(], "links": []})").ok());
  NullDesktop desktop;
  ASSERT_TRUE(desktop.editor().open(path));
  desktop.frames(2);
  canvas::Board& board = desktop.editor().canvas->board();
  ASSERT_EQ(board.model.view.boxes.size(), 1u);
  canvas::lay_out_all(board);
  desktop.frames(3);
  EXPECT_EQ(board.model.view.boxes.size(), 0u);
  EXPECT_NE(places_on(board.model).at("n7"), (std::pair<float, float>(9000, 4000)));
  std::filesystem::remove(path);
}

TEST_F(CanvasStored, TheFirstChangeStoresWhatIsSeenAndUndoForgetsIt) {
  const std::string opened = desktop.scene_text();
  const SeenPlaces seen = places();
  lay_link();
  EXPECT_EQ(board().model.view.boxes.size(), scene().nodes.size());
  EXPECT_EQ(editor().document->history().size(), 1u) << "no step of its own";
  EXPECT_EQ(label().find("Arrange"), std::string::npos) << label();
  EXPECT_EQ(places(), seen);
  editor().undo();
  desktop.frames(2);
  EXPECT_EQ(desktop.scene_text(), opened) << "byte for byte";
  EXPECT_EQ(places(), seen);
}

TEST_F(CanvasStored, WhoOnlyLooksAndSavesKeepsTheFile) {
  const std::string path = path_of("looked_at");
  ASSERT_TRUE(write_file(path, read_file(test::source_folder() + "/scenes/start/quarter.json").value()).ok());
  ASSERT_TRUE(editor().open(path));
  desktop.frames(3);
  EXPECT_FALSE(editor().document->is_unsaved()) << "an opened scene counts as saved";
  ASSERT_TRUE(editor().save(path).ok());
  EXPECT_EQ(read_file(path).value(), read_file(test::source_folder() + "/scenes/start/quarter.json").value());
}

TEST_F(CanvasStored, SavedInTheSameFrameAsTheChangeItHasThePlacesToo) {
  const std::string path = path_of("at_once");
  ASSERT_TRUE(editor().submit(command<RemoveNode>({"cafe"})));
  ASSERT_TRUE(editor().save(path).ok());
  desktop.frames(3);
  EXPECT_FALSE(editor().document->is_unsaved());
  const SeenPlaces seen = places();
  ASSERT_TRUE(editor().open(path));
  desktop.frames(2);
  EXPECT_EQ(places(), seen);
}

TEST_F(CanvasStored, WhatIsNewGivesWayToWhatTheFileHasPlaced) {
  lay_link();
  const std::string path = path_of("grown_elsewhere");
  ASSERT_TRUE(editor().save(path).ok());
  const SeenPlaces seen = places();
  // Another program adds nodes to the file, as `import --into` does.
  auto file = Json::parse(read_file(path).value());
  for (int k = 0; k < 12; ++k)
    file["nodes"].push_back({{"id", "zz-" + std::to_string(k)}, {"types", {{"smart_volume", Json::object()}}}});
  ASSERT_TRUE(write_file(path, file.dump()).ok());
  ASSERT_TRUE(editor().open(path));
  desktop.frames(2);
  const SeenPlaces now = places();
  for (const auto& [id, place] : seen) EXPECT_EQ(now.at(id), place) << id;
  const auto& boxes = board().model.boxes;
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      EXPECT_FALSE(boxes[a].box.touches(boxes[b].box)) << boxes[a].id << " lies on " << boxes[b].id;
}

// One random edit, as it may come from any panel.
void edit_somehow(Workbench& editor, std::minstd_rand& random, int number) {
  const auto draw = [&](std::size_t below) { return static_cast<std::size_t>(random() % below); };
  const auto node = [&] {
    auto at = editor.scene().nodes.begin();
    std::advance(at, static_cast<std::ptrdiff_t>(draw(editor.scene().nodes.size())));
    return at->first;
  };
  const std::string name = std::to_string(number);
  switch (draw(7)) {
    case 0: editor.submit(command<AddNode>({"new" + name, {R"({"types": {"smart_volume": {"use": "aaa"}}})"}})); break;
    case 1: editor.submit(command<RemoveNode>({node()})); break;
    case 2:
      editor.submit(command<AddLink>(
          {"link" + name, {Json({{"kind", "attract"}, {"from", node()}, {"to", {{"typification", "smart_volume"}}}}).dump()}}));
      break;
    case 3: editor.submit(command<RenameNode>({node(), "Name " + name})); break;
    case 4: editor.arrange(Json({{"boxes", {{node(), {draw(2000), draw(2000)}}}}}).dump()); break;
    case 5: editor.undo(); break;
    default: editor.redo(); break;
  }
  editor.notices.clear();
}

class CanvasStoredLaw : public ::testing::TestWithParam<unsigned> {};

// Whatever people have done: what they see is what the file, and the journal, give again; and all undone is what was opened.
TEST_P(CanvasStoredLaw, ThePictureOutlivesTheWindow) {
  std::minstd_rand random(GetParam());
  NullDesktop desktop(GetParam() % 2 == 0 ? "scenes/start/quarter.json" : "scenes/studies/sixty_volumes.json");
  Workbench& editor = desktop.editor();
  canvas::Model& model = editor.canvas->board().model;
  const std::string opened = desktop.scene_text();
  const SeenPlaces first = places_on(model);
  const std::string path = path_of("law_of_places");
  for (int round = 0; round < 6; ++round) {
    for (int k = 0; k < 7; ++k) {
      edit_somehow(editor, random, 100 * round + k);
      desktop.frames(1);
    }
    const SeenPlaces seen = places_on(model);
    const std::string left = leave_journal();
    ASSERT_TRUE(editor.save(path).ok());
    NullDesktop again("");
    ASSERT_TRUE(again.editor().open(path));
    again.frames(2);
    EXPECT_EQ(places_on(again.editor().canvas->board().model), seen) << "reopened after round " << round;
    if (round == 0) {  // later journals begin with what was saved
      const auto remains = host::Journal::find(full_registry());
      ASSERT_EQ(remains.size(), 1u);
      std::vector<Problem> problems;
      again.editor().take(Document::recover(full_registry(), remains.front(), 1, problems));
      again.frames(2);
      EXPECT_EQ(places_on(again.editor().canvas->board().model), seen) << "recovered";
    }
    std::filesystem::remove(left);
    if (::testing::Test::HasFailure()) return;
  }
  for (int k = 0; k < 100; ++k) editor.undo();
  editor.notices.clear();
  desktop.frames(2);
  EXPECT_EQ(desktop.scene_text(), opened);
  EXPECT_EQ(places_on(model), first) << "the canvas is the one that was opened";
}

INSTANTIATE_TEST_SUITE_P(Seeds, CanvasStoredLaw, ::testing::Values(1u, 2u, 3u, 4u, 5u, 6u));

}  // namespace
}  // namespace bl::desktop
