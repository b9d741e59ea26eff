// Scenes that come with the program are opened as copies: nothing that people do in the window changes their files.
#include <filesystem>

#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/import_support.h"

namespace bl::desktop {
namespace {

namespace files = std::filesystem;

const std::string kMedia = test::source_folder() + "/scenes/nodes/media.json";

std::string media_file(Workbench& editor, const std::string& node) {
  return std::get<std::string>(editor.scene().nodes.at(node).types.at("media").at("file"));
}

void type_path(NullDesktop& desktop, const std::string& path) {
  desktop.key(GLFW_KEY_A, true);
  desktop.type(path);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(4);
}

TEST(Copies, AShippedSceneIsNeverWrittenOver) {
  const Folder folder("copies_save");
  const std::string before = read_file(kMedia).value();
  ImportDesktop desktop("scenes/nodes/media.json");
  Workbench& editor = desktop.editor();
  EXPECT_TRUE(editor.document->path().empty());
  EXPECT_EQ(editor.document->source(), kMedia);
  EXPECT_EQ(desktop.desktop().title(), "media (copy, not saved yet) - BehaviourLinks");
  EXPECT_FALSE(editor.document->is_unsaved()) << "nothing is lost where nothing was changed";
  ASSERT_TRUE(editor.submit(command<RenameNode>({"board", "Panel"})));
  desktop.key(GLFW_KEY_S, true);
  desktop.frames(4);
  ASSERT_TRUE(editor.dialogs->is_choosing_file()) << "Save asks where";
  type_path(desktop, kMedia);
  desktop.key(GLFW_KEY_ENTER);  // it is there: replace it?
  desktop.frames(4);
  EXPECT_TRUE(editor.dialogs->is_choosing_file()) << "the folder of shipped scenes is refused";
  EXPECT_EQ(read_file(kMedia).value(), before);
  type_path(desktop, test::source_folder() + "/scenes/nodes/my_own.json");
  EXPECT_FALSE(files::exists(test::source_folder() + "/scenes/nodes/my_own.json"));
  type_path(desktop, folder.at("mine.json"));
  EXPECT_FALSE(editor.dialogs->is_choosing_file());
  EXPECT_EQ(editor.document->path(), folder.at("mine.json"));
  EXPECT_EQ(desktop.desktop().title(), "mine.json - BehaviourLinks");
  EXPECT_EQ(read_file(kMedia).value(), before);
}

TEST(Copies, FilesThatASceneNamesAreFoundFromItsNewFolder) {
  const Folder folder("copies_files");
  ImportDesktop desktop("scenes/nodes/media.json");
  Workbench& editor = desktop.editor();
  EXPECT_EQ(editor.document->folder(), files::path(kMedia).parent_path().string())
      << "until it is saved, pictures are those of the original";
  ASSERT_TRUE(editor.document->save(folder.at("mine.json")));
  const std::string named = media_file(editor, "board");
  EXPECT_TRUE(files::path(named).is_absolute()) << named;
  EXPECT_TRUE(files::exists(named)) << named;
  EXPECT_EQ(media_file(editor, "lost"), "../media/lost.png") << "what was not there before is named as it was";
  EXPECT_NE(editor.document->save_note().find("stayed in place"), std::string::npos) << editor.document->save_note();
  EXPECT_FALSE(editor.document->is_unsaved());
  ImportDesktop other;
  ASSERT_TRUE(other.editor().open(folder.at("mine.json")));
  EXPECT_EQ(media_file(other.editor(), "board"), named);
}

TEST(Copies, RecordedTablesAndPicturesBelowTheNewFolderAreNamedRelativeToIt) {
  const Folder folder("copies_below");
  files::create_directories(folder.at("a/data"));
  folder.write("a/data/table.csv", "time,t\n0,1\n");
  folder.write("a/scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "warmth", "types": {"sensor": {"address": "replay:data/table.csv?site=7#t"}}}], "links": []})");
  ImportDesktop desktop;
  Workbench& editor = desktop.editor();
  ASSERT_TRUE(editor.open(folder.at("a/scene.json")));
  const auto address = [&] { return std::get<std::string>(editor.scene().nodes.at("warmth").types.at("sensor").at("address")); };
  ASSERT_TRUE(editor.document->save(folder.at("a/again.json")));
  EXPECT_EQ(address(), "replay:data/table.csv?site=7#t") << "the folder is the same";
  ASSERT_TRUE(editor.document->save(folder.at("above.json")));
  EXPECT_EQ(address(), "replay:a/data/table.csv?site=7#t");
  EXPECT_EQ(editor.document->history().back().label, "Name files from the new folder");
}

TEST(Copies, RecordedTablesGoAlongToAFolderBesideTheOldOne) {
  const Folder folder("copies_beside");
  files::create_directories(folder.at("a"));
  files::create_directories(folder.at("b"));
  folder.write("a/table.csv", "time,t\n0,1\n");
  folder.write("b/table.csv", "another one\n");
  folder.write("a/ours.password", "secret\n");
  folder.write("a/scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "broker", "types": {"mqtt_broker": {"password_from": "file:ours.password"}}},
    {"id": "warmth", "types": {"sensor": {"address": "replay:table.csv#t"}}}], "links": []})");
  ImportDesktop desktop;
  Workbench& editor = desktop.editor();
  ASSERT_TRUE(editor.open(folder.at("a/scene.json")));
  for (int i = 0; i < 2; ++i) {  // saved there again it is the same table, and no third one
    ASSERT_TRUE(editor.document->save(folder.at("b/mine.json")));
    EXPECT_EQ(std::get<std::string>(editor.scene().nodes.at("warmth").types.at("sensor").at("address")), "replay:table_2.csv#t");
    EXPECT_EQ(read_file(folder.at("b/table_2.csv")).value(), "time,t\n0,1\n");
    EXPECT_EQ(read_file(folder.at("b/table.csv")).value(), "another one\n");
    const bool is_told = editor.document->save_note().find("put ours.password beside") != std::string::npos;
    EXPECT_EQ(is_told, i == 0) << editor.document->save_note();
  }
  EXPECT_FALSE(files::exists(folder.at("b/ours.password")));
}

TEST(Copies, AFailedSaveLeavesTheNamesAsTheyWere) {
  ImportDesktop desktop("scenes/nodes/media.json");
  Workbench& editor = desktop.editor();
  const std::string before = desktop.scene_text();
  EXPECT_FALSE(editor.document->save("/proc/nowhere/mine.json"));
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_TRUE(editor.document->path().empty());
  EXPECT_TRUE(editor.document->history().empty());
}

TEST(Copies, AnotherNameOfAShippedFileIsNoCopyOfIt) {
  const Folder folder("copies_links");
  files::create_symlink(kMedia, folder.at("link.json"));
  files::create_directory_symlink(test::source_folder() + "/scenes", folder.at("scenes"));
  EXPECT_TRUE(is_shipped(folder.at("link.json")));
  EXPECT_TRUE(is_shipped(folder.at("scenes/start/new.json")));
  EXPECT_TRUE(is_shipped(test::source_folder() + "/scenes/../scenes/start/quarter.json"));
  EXPECT_FALSE(is_shipped(test::source_folder() + "/scenes_of_mine/quarter.json"));
  EXPECT_FALSE(is_shipped(folder.at("own.json")));
  ImportDesktop desktop;
  ASSERT_TRUE(desktop.editor().open(folder.at("link.json")));
  EXPECT_TRUE(desktop.editor().document->path().empty());
  // A copy in a folder of one's own is one's own.
  files::copy_file(kMedia, folder.at("own.json"));
  ASSERT_TRUE(desktop.editor().open(folder.at("own.json")));
  EXPECT_EQ(desktop.editor().document->path(), folder.at("own.json"));
}

TEST(Copies, WhatACrashLeavesIsACopyAgain) {
  ImportDesktop desktop;
  const std::string scene = read_file(kMedia).value();
  const std::string text =
      log_header(scene) + log_line(LogEntry{1, 0, 1, "desk", command<RenameNode>({"board", "Panel"})}, full_registry());
  auto log = read_log(text, full_registry());
  ASSERT_TRUE(log);
  std::vector<Problem> problems;
  auto document = Document::recover(full_registry(), {"", kMedia, std::move(*log)}, 1, problems);
  ASSERT_TRUE(document);
  EXPECT_TRUE(document->path().empty()) << "Save must not write over the original";
  EXPECT_EQ(document->source(), kMedia) << "its pictures are found";
  EXPECT_TRUE(document->is_unsaved());
  EXPECT_EQ(document->scene().nodes.at("board").name, "Panel");
}

}  // namespace
}  // namespace bl::desktop
