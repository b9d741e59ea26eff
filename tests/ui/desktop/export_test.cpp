// Exports through the window: the state that is shown, in all chosen formats or in none; what stands there is asked about first.
#include "core/export/read_proposal.h"
#include "core/export/write_files.h"
#include "core/graph/sums_of_now.h"
#include "tests/ui/desktop/import_support.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

class ExportDesktop : public ImportDesktop {
 public:
  explicit ExportDesktop(const Folder& folder) : ImportDesktop("scenes/start/standing.json"), folder_(folder.at("")) {
    ticks(3);
    key(GLFW_KEY_E, true);
    frames(3);
    type_over("export/folder", folder_);
  }
  void type_over(const std::string& field, const std::string& text) {
    press_on(field);
    frames(3);
    key(GLFW_KEY_A, true);
    type(text);
    frames(2);
  }
  void press(const std::string& place) {
    press_on(place);
    frames(3);
  }

 private:
  std::string folder_;
};

std::string bytes_of(const std::string& path) {
  const auto read = read_file(path);
  return read ? *read : "";
}

TEST(WindowExport, AllFormatsAreChosenAtOnce) {
  const Folder folder("export_every");
  ExportDesktop desktop(folder);
  desktop.press("export/all");
  for (const char* lacking : {"export/html", "export/geojson"}) desktop.press(lacking);  // a built page, a place on Earth
  desktop.press("export/write");
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  for (const exporting::FormatDefinition& format : exporting::all_formats())
    EXPECT_EQ(std::filesystem::exists(folder.at("standing" + format.ending)), format.id != "html" && format.id != "geojson")
        << format.id;
}

TEST(WindowExport, WritesTheStateThatIsShownInEachFormat) {
  const Folder folder("export_all");
  ExportDesktop desktop(folder);
  for (const char* format : {"csv", "dxf", "ifc"}) desktop.press(std::string("export/") + format);
  desktop.press("export/write");
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_NE(desktop.notices().find(" into " + std::filesystem::path(folder.at("x")).parent_path().string() + "."),
            std::string::npos)
      << desktop.notices();
  const auto proposal = exporting::read_proposal(with_sums_of_now(desktop.editor().state()), "standing.json");
  ASSERT_TRUE(proposal);
  for (const char* id : {"csv", "dxf", "ifc"}) {
    const exporting::FormatDefinition& format = *exporting::find_format(id);
    std::vector<Value> options;
    for (const PortDefinition& option : format.ports) options.push_back(option.default_value);
    const auto made = format.write(*proposal, options, false);
    ASSERT_TRUE(made) << id;
    EXPECT_EQ(bytes_of(folder.at("standing" + format.ending)), made->files.front().content) << id;
  }
}

TEST(WindowExport, AsksBeforeItReplacesAndLeavesTheWorkOfOthersAlone) {
  const Folder folder("export_again");
  ExportDesktop desktop(folder);
  desktop.press("export/csv");
  desktop.press("export/write");
  ASSERT_FALSE(desktop.is_open()) << desktop.told();
  const std::string first = bytes_of(folder.at("standing.csv"));
  ASSERT_FALSE(first.empty());
  desktop.ticks(2);
  desktop.key(GLFW_KEY_E, true);
  desktop.frames(3);
  desktop.press("export/write");
  EXPECT_TRUE(desktop.is_open());
  EXPECT_NE(desktop.told().find("standing.csv exists already. Press again to replace it."), std::string::npos) << desktop.told();
  EXPECT_EQ(bytes_of(folder.at("standing.csv")), first);
  // A file of another kind beside it: then nothing is written, not even what could be.
  folder.write("standing.dxf", "somebody's drawing");
  desktop.press("export/dxf");
  desktop.press("export/write");
  EXPECT_TRUE(desktop.is_open());
  EXPECT_NE(desktop.told().find("was not exported as dxf"), std::string::npos) << desktop.told();
  EXPECT_EQ(bytes_of(folder.at("standing.csv")), first);
  EXPECT_EQ(bytes_of(folder.at("standing.dxf")), "somebody's drawing");
  desktop.press("export/dxf");
  desktop.press("export/write");
  desktop.press("export/write");
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_FALSE(bytes_of(folder.at("standing.csv")).empty());
}

TEST(WindowExport, OptionsAreThoseOfTheDeclaration) {
  const Folder folder("export_options");
  ExportDesktop desktop(folder);
  desktop.press("export/csv");
  EXPECT_TRUE(desktop.has("export/csv/storeys"));
  desktop.press("export/csv/storeys");  // off
  desktop.press("export/write");
  ASSERT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_EQ(bytes_of(folder.at("standing.csv")).find("\nstorey,"), std::string::npos);
  desktop.key(GLFW_KEY_E, true);
  desktop.frames(3);
  desktop.press("export/dxf/look");
  desktop.press("export/dxf/text_height");
  EXPECT_EQ(memory_of(desktop.editor()).typing.key, "export/dxf/text_height");
  desktop.key(GLFW_KEY_A, true);
  desktop.type("900 m");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(2);
  EXPECT_TRUE(desktop.is_open()) << "Enter has left the field, not the dialog";
  EXPECT_EQ(memory_of(desktop.editor()).complaint_key, "export/dxf/text_height");
}

TEST(WindowExport, MeasuresTheFormThatIsSeen) {
  const Folder folder("export_form");
  ExportDesktop desktop(folder);
  desktop.press("export/csv");
  desktop.press("export/write");
  ASSERT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_NE(bytes_of(folder.at("standing.csv")).find("as they are"), std::string::npos);
  desktop.editor().view->draw_as("balls");
  desktop.frames(3);
  desktop.key(GLFW_KEY_E, true);
  desktop.frames(3);
  desktop.press("export/write");
  desktop.press("export/write");  // the first one is replaced
  ASSERT_FALSE(desktop.is_open()) << desktop.told();
  EXPECT_NE(bytes_of(folder.at("standing.csv")).find("as balls"), std::string::npos);
  // A format that cannot say it refuses, and nothing is written.
  desktop.key(GLFW_KEY_E, true);
  desktop.frames(3);
  desktop.press("export/ifc");
  desktop.press("export/write");
  EXPECT_TRUE(desktop.is_open());
  EXPECT_NE(desktop.told().find("a ball has no storeys that could be built"), std::string::npos) << desktop.told();
  EXPECT_TRUE(bytes_of(folder.at("standing.ifc")).empty());
}

TEST(WindowExport, SaysWhyNothingCanBeWritten) {
  const Folder folder("export_nowhere");
  ExportDesktop desktop(folder);
  desktop.press("export/write");
  EXPECT_TRUE(desktop.is_open()) << "no format was chosen";
  desktop.press("export/svg");
  folder.write("taken", "a file");
  desktop.type_over("export/folder", folder.at("taken/inside"));
  desktop.press("export/write");
  EXPECT_TRUE(desktop.is_open());
  EXPECT_NE(desktop.told().find("is a file, not a folder"), std::string::npos) << desktop.told();
  // Several files go into a folder of their own, which is made.
  desktop.type_over("export/folder", folder.at(""));
  desktop.press("export/svg/folder");
  desktop.press("export/write");
  EXPECT_FALSE(desktop.is_open()) << desktop.told();
  std::size_t sheets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.at("standing_svg")))
    sheets += entry.path().extension() == ".svg" ? 1 : 0;
  EXPECT_GE(sheets, 2u);
}

}  // namespace
}  // namespace bl::desktop
