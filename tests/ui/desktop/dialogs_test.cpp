// Dialogs by keyboard alone: palette, new scene, and the question before something is lost.
#include <filesystem>
#include <set>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/host/journal.h"
#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/look/fuzzy.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

bool is_asking() { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }

void save_as(NullDesktop& desktop, const std::string& name) {
  desktop.key(GLFW_KEY_S, true, true);
  desktop.frames(3);
  desktop.key(GLFW_KEY_A, true);
  desktop.type(::testing::TempDir() + name);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  if (is_asking()) desktop.key(GLFW_KEY_ENTER);  // an earlier run has left a file of this name
  desktop.frames(3);
}

// What a window has left that is gone: a scene, and one change to it.
std::vector<host::Journal::UnsavedJournal> remains_of(const std::string& scene, const Command& change) {
  const std::string folder = host::person_folder() + "/journals";
  std::filesystem::create_directories(folder);
  const std::string text = log_header(scene) + log_line(LogEntry{1, 0, 1, "somebody", change}, full_registry());
  EXPECT_TRUE(write_file(folder + "/2147483646-7.journal", text));
  return host::Journal::find(full_registry());
}

// The walk of keys starts at the first button; a step to the left, where nothing is, makes it be seen.
void press_first_button(NullDesktop& desktop) {
  desktop.frames(3);
  desktop.key(GLFW_KEY_LEFT);
  desktop.key(GLFW_KEY_SPACE);
  desktop.frames(3);
}

TEST(Dialogs, PaletteRunsWhatIsTyped) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_K, true);
  desktop.frames(3);
  desktop.type("one tick");
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.editor().document->session().settle();
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().state().tick, 1);
}

TEST(Dialogs, PaletteAddsNodesByTheirRole) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::size_t before = desktop.editor().scene().nodes.size();
  desktop.key(GLFW_KEY_K, true);
  desktop.frames(3);
  desktop.type("volume");
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  ASSERT_EQ(desktop.editor().scene().nodes.size(), before + 1);
  ASSERT_EQ(desktop.editor().picks.nodes.size(), 1u);
  EXPECT_TRUE(desktop.editor().scene().nodes.at(*desktop.editor().picks.nodes.begin()).types.contains("smart_volume"));
  NullDesktop start;  // nothing is open that anything could be added to
  start.key(GLFW_KEY_K, true);
  start.frames(3);
  start.type("smartvolume");
  start.frames(1);
  start.key(GLFW_KEY_ENTER);
  start.frames(3);
  EXPECT_FALSE(start.editor().document);
}

TEST(Dialogs, AFileThatCannotBeOpenedPointsToWhereItIsSaidWhy) {
  const std::string path = ::testing::TempDir() + "wrong_kind.json";
  ASSERT_TRUE(write_file(path, R"({"type": "FeatureCollection"})"));
  NullDesktop start, open("scenes/start/quarter.json");
  const auto told = [&](NullDesktop& desktop) {
    desktop.frames(1);
    EXPECT_FALSE(desktop.editor().open(path));
    desktop.frames(1);
    return desktop.editor().notices.empty() ? std::string() : desktop.editor().notices.back().text;
  };
  EXPECT_EQ(told(start), "This scene could not be opened; the start page says why.");
  EXPECT_EQ(told(open), "This scene could not be opened; the problems list says why.");
}

// The plan is typed; the field of the brief has the keys.
void begin_new_scene(NullDesktop& desktop) {
  desktop.key(GLFW_KEY_N, true);
  desktop.frames(3);
  desktop.type(test::source_folder() + "/tests/data/plan_dutch.geojson");
  desktop.key(GLFW_KEY_TAB);
  desktop.frames(2);
}

TEST(Dialogs, AFileThatIsNotThereIsNamedOnce) {
  NullDesktop desktop;
  begin_new_scene(desktop);
  const std::string missing = "/nowhere/programme.csv";
  desktop.type(missing);
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  ASSERT_FALSE(desktop.editor().document);
  std::string told;
  for (const std::string& line : desktop.editor().dialogs->told()) told += line + "\n";
  const std::size_t first = told.find(missing);
  ASSERT_NE(first, std::string::npos) << told;
  EXPECT_EQ(told.find(missing, first + 1), std::string::npos) << told;
}

TEST(Dialogs, NewSceneFromFilesByKeyboard) {
  NullDesktop desktop;
  begin_new_scene(desktop);
  desktop.type(test::source_folder() + "/tests/data/functions.csv");
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  ASSERT_TRUE(desktop.editor().document);
  EXPECT_GT(desktop.editor().scene().nodes.size(), 5u);
  EXPECT_EQ(desktop.desktop().title(), "* Untitled scene - BehaviourLinks") << "no file holds it";
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  EXPECT_TRUE(desktop.editor().document) << "closing it asks first";
}

TEST(Dialogs, EachFileThatWouldBeReplacedIsAskedAbout) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::string folder = ::testing::TempDir();
  for (const char* name : {"asked_one.json", "asked_two.json"}) ASSERT_TRUE(write_file(folder + "/" + name, "old\n"));
  desktop.key(GLFW_KEY_S, true, true);
  desktop.frames(3);
  const auto enter = [&](const std::string& name) {
    desktop.key(GLFW_KEY_A, true);
    desktop.type(folder + "/" + name);
    desktop.frames(1);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(3);
  };
  const auto content = [&](const std::string& name) { return read_file(folder + "/" + name).value(); };
  enter("asked_one.json");
  enter("asked_two.json");
  EXPECT_EQ(content("asked_one.json"), "old\n");
  EXPECT_EQ(content("asked_two.json"), "old\n") << "the question was about the other one";
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  EXPECT_EQ(content("asked_one.json"), "old\n");
  EXPECT_NE(content("asked_two.json"), "old\n");
  EXPECT_EQ(desktop.editor().document->name(), "asked_two.json");
}

TEST(Dialogs, AFileThatCannotBeWrittenLeavesTheDialogWithItsName) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_S, true, true);
  desktop.frames(3);
  desktop.key(GLFW_KEY_A, true);
  desktop.type("/proc/nowhere/scene.json");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(4);
  EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  EXPECT_EQ(desktop.editor().document->name(), "quarter (copy, not saved yet)");
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(3);
  EXPECT_FALSE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
}

TEST(Dialogs, NothingOfAClosedSceneIsKept) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(2);
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  ASSERT_FALSE(desktop.editor().document);
  EXPECT_EQ(desktop.editor().view->facts(), nullptr);
  EXPECT_EQ(desktop.editor().panels, nullptr);
}

TEST(Dialogs, QuittingWithUnsavedChangesAsks) {
  NullDesktop desktop("scenes/start/quarter.json");
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.key(GLFW_KEY_Q, true);
  desktop.frames(2);
  EXPECT_FALSE(desktop.editor().wants_quit);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.editor().undo();
  desktop.key(GLFW_KEY_Q, true);
  EXPECT_TRUE(desktop.editor().wants_quit);
}

// What a question was asked for is forgotten with the question.
TEST(Dialogs, CancellingAQuestionCancelsWhatItWasAskedFor) {
  NullDesktop desktop("scenes/start/quarter.json");
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  ASSERT_TRUE(is_asking());
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(2);
  ASSERT_FALSE(is_asking());
  save_as(desktop, "kept_open.json");
  ASSERT_TRUE(desktop.editor().document) << "saving closed the scene that nobody wanted closed any more";
  EXPECT_EQ(desktop.editor().document->name(), "kept_open.json");
}

TEST(Dialogs, CancellingTheFileOfAQuestionCancelsWhatItWasAskedFor) {
  NullDesktop desktop;
  std::vector<Problem> problems;
  const std::string scene = read_file(test::source_folder() + "/scenes/start/quarter.json").value();
  desktop.editor().take(Document::from_text(full_registry(), scene, "", 1, problems));
  desktop.frames(2);
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  desktop.key(GLFW_KEY_ENTER);  // Save: there is no file yet, so one is asked for
  desktop.frames(3);
  ASSERT_TRUE(desktop.editor().dialogs->is_choosing_file());
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(3);
  ASSERT_FALSE(desktop.editor().dialogs->is_choosing_file());
  save_as(desktop, "kept_open_too.json");
  EXPECT_TRUE(desktop.editor().document);
  // Where the file is chosen at once, the scene is saved and then closed.
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  EXPECT_FALSE(desktop.editor().document);
}

// Who types what planners call it finds the table of wishes.
TEST(Dialogs, ThePaletteFindsTheBrief) {
  for (const char* word : {"brief", "programme the"}) {
    NullDesktop desktop("scenes/start/quarter.json");
    desktop.key(GLFW_KEY_K, true);
    desktop.frames(3);
    desktop.type(word);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(3);
    EXPECT_FALSE(is_asking()) << word;
    ASSERT_EQ(desktop.editor().picks.nodes.size(), 1u) << word;
    const NodeRecord& node = desktop.editor().document->scene().nodes.at(*desktop.editor().picks.nodes.begin());
    EXPECT_TRUE(node.types.contains("programme")) << word;
  }
}

TEST(Dialogs, OneDialogOpensAnother) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_K, true);
  desktop.frames(3);
  desktop.type("keys and gestures");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  EXPECT_TRUE(is_asking()) << "the list of keys, from the palette";
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(3);
  ASSERT_FALSE(is_asking());
}

TEST(Dialogs, AJournalThatCannotBeRecoveredStays) {
  NullDesktop desktop;
  auto remains = remains_of(R"({"format": "behaviourlinks", "version": 999})", command<RenameNode>({"library", "Reading room"}));
  ASSERT_EQ(remains.size(), 1u);
  const std::string path = remains.front().path;
  desktop.editor().dialogs->offer_recovery(std::move(remains));
  press_first_button(desktop);
  EXPECT_FALSE(desktop.editor().document);
  ASSERT_FALSE(desktop.editor().notices.empty()) << "it was not tried";
  EXPECT_TRUE(std::filesystem::exists(path)) << "the only copy is gone";
  EXPECT_TRUE(is_asking()) << "it can still be discarded";
  host::Journal::discard({path, "", {}});
}

TEST(Dialogs, AJournalThatWasRecoveredInPartStays) {
  const std::string scene = read_file(test::source_folder() + "/scenes/start/quarter.json").value();
  for (const bool is_whole : {false, true}) {
    NullDesktop desktop;
    auto remains = remains_of(scene, command<RenameNode>({is_whole ? "library" : "nobody", "Reading room"}));
    ASSERT_EQ(remains.size(), 1u);
    const std::string path = remains.front().path;
    desktop.editor().dialogs->offer_recovery(std::move(remains));
    press_first_button(desktop);
    ASSERT_TRUE(desktop.editor().document);
    EXPECT_EQ(std::filesystem::exists(path), !is_whole);
    host::Journal::discard({path, "", {}});
  }
}

// A key that means two things at one place and time is a trap.
TEST(Actions, KeysAreUniqueWhereTheyCount) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  editor.picks.only_node("library");
  for (const bool is_beamer : {false, true})
    for (const Area area : {Area::canvas, Area::view}) {
      editor.is_beamer = is_beamer;
      if (is_beamer && area == Area::canvas) continue;  // there is no canvas then
      std::set<std::string> taken;
      for (const Action& action : actions())
        for (const Chord& chord : {action.chord, action.other}) {
          const bool counts = action.area == Area::none || action.area == area;
          if (chord.key == 0 || !counts || (action.can != nullptr && !action.can(editor))) continue;
          EXPECT_TRUE(taken.insert(text_of(chord)).second) << text_of(chord) << " of " << action.label;
        }
    }
}

TEST(Actions, EachSaysWhatItDoesAndCanBeRun) {
  for (const Action& action : actions()) {
    EXPECT_NE(action.run, nullptr) << action.label;
    EXPECT_FALSE(std::string(action.label).empty());
    EXPECT_EQ(text_of(action.chord).find('?'), std::string::npos) << action.label;
  }
}

TEST(Fuzzy, StartsOfWordsComeFirst) {
  EXPECT_LT(fuzzy_score("xyz", "Set value"), 0);
  EXPECT_GT(fuzzy_score("sv", "Set value"), fuzzy_score("sv", "absolve"));
  EXPECT_GT(fuzzy_score("rew", "Rewind five seconds"), fuzzy_score("rew", "Take a picture of the window"));
  EXPECT_LT(fuzzy_score("a", ""), 0);
}

}  // namespace
}  // namespace bl::desktop
