// Link scripts in the window: dropped files become link kinds, saved files are read again while the scene runs, mistakes are
// shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <unistd.h>

#include "core/file/file_io.h"
#include "core/reading/report_model.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/problems_list.h"

namespace bl::desktop {
namespace {

class Scripts : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  // A moment later than the last one, as if it had been saved a second after it.
  void save(const std::string& text) {
    ASSERT_TRUE(write_file(path_, text).ok());
    std::filesystem::last_write_time(path_,
                                     std::filesystem::file_time_type{} + std::chrono::hours(1) + std::chrono::seconds(++saved_));
  }
  static std::string lift(const std::string& height) {
    return "return {id = 'lift', label = 'Lift', doc = 'Lifts.',\nproposes = {move = {at = 'to', port = 'node.position'}},\n"
           "evaluate = function() return {move = point(0, 0, " +
           height + ")} end}";
  }
  std::string problem(Workbench& editor) {
    ProblemList list;
    list.refresh(editor, reading::ReportModel{});
    for (const ProblemItem& item : list.items())
      if (item.kind == ProblemKind::file) return item.subject + ": " + item.text;
    return "";
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("bl_scripts_" + std::to_string(::getpid()));
  std::string path_ = (folder_ / "Lift it.lua").string();
  int saved_ = 0;
};

TEST_F(Scripts, ADroppedFileIsALinkKindAndReadAgainWhenSaved) {
  NullDesktop window("scenes/links/ratio.json");
  Workbench& editor = window.editor();
  save(lift("1"));
  window.desktop().drop(path_);
  ASSERT_NE(editor.types().link("lift"), nullptr);
  EXPECT_EQ(editor.program.link("lift"), nullptr);
  ASSERT_TRUE(editor.submit(command<AddLink>({"up", {R"({"kind": "lift", "from": "housing", "to": "shop"})"}})));
  const auto height = [&] { return std::get<Vector3>(value_in(editor.state(), "shop", "node.position")).z; };
  window.ticks(1);
  EXPECT_NEAR(height(), 5, 0.5);
  const double before = height();

  save(lift("2 *"));  // a mistake: the old version goes on
  window.frames(60);
  EXPECT_TRUE(problem(editor).starts_with("lift_it.lua: lift_it.lua:3: ")) << problem(editor);
  window.ticks(1);
  EXPECT_NEAR(height(), before + 1, 0.3);

  save(lift("-2"));
  window.frames(60);
  EXPECT_EQ(problem(editor), "");
  const double high = height();
  window.ticks(1);
  EXPECT_NEAR(height(), high - 2, 0.3);
  editor.undo();
  EXPECT_EQ(editor.scene().scripts.texts().at("lift_it"), lift("1"));
  window.frames(3);
}

TEST_F(Scripts, WithoutASceneNothingIsDropped) {
  NullDesktop window;
  save(lift("1"));
  window.desktop().drop(path_);
  window.frames(3);
  EXPECT_FALSE(window.editor().document);
  ASSERT_FALSE(window.editor().notices.empty());
}

// Undo of a script while panels and canvas show its links: nothing may point to what is gone.
TEST_F(Scripts, PanelsOutliveAnUndoneScript) {
  NullDesktop window("scenes/studies/scripted_terraces.json");
  Workbench& editor = window.editor();
  save(project_file("links/scripts/lean_uphill.lua"));
  editor.picks.only_link("rise");
  window.frames(3);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(editor.submit(command<RemoveScript>({"lean_uphill"})));
    window.frames(2);
    editor.undo();
    window.frames(2);
    ASSERT_TRUE(editor.submit(command<SetScript>({"lean_uphill", project_file("links/scripts/lean_uphill.lua") + "\n", false})));
    window.ticks(1);
    editor.undo();
    window.ticks(1);
  }
  EXPECT_TRUE(editor.scene().links.at("rise").ghost.empty());
}

}  // namespace
}  // namespace bl::desktop
