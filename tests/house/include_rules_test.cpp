// Holds the tree to the rules of the house, and the checkers to samples with planted faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/house/layers.h"
#include "tests/house/rules.h"
#include "tests/support/place/source_folder.h"

namespace bl::house {
namespace {

namespace fs = std::filesystem;

struct SourceFile {
  std::string path, text;
};

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool is_foreign(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with(".") || name == "node_modules" || name == "dist";
}

// All .h and .cpp files below the named folders, in ascending order of their paths.
std::vector<SourceFile> sources(std::initializer_list<const char*> tops) {
  const fs::path root = test::source_folder();
  std::vector<SourceFile> files;
  for (const char* top : tops) {
    if (!fs::exists(root / top)) continue;
    for (auto entry = fs::recursive_directory_iterator(root / top); entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->is_directory() && is_foreign(entry->path())) entry.disable_recursion_pending();
      const fs::path extension = entry->path().extension();
      if (!entry->is_regular_file() || (extension != ".h" && extension != ".cpp")) continue;
      files.push_back({fs::relative(entry->path(), root).generic_string(), read(entry->path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

void expect_none(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) ADD_FAILURE() << finding.place << ": " << finding.sentence;
}

// Does any file lie in the folder or below it? Folders without are not part of the checkout.
bool holds_files(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) return true;
  return false;
}

std::vector<std::string> sentences(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  all.reserve(findings.size());
  for (const Finding& finding : findings) all.push_back(finding.place + ": " + finding.sentence);
  return all;
}

// --- The tree -------------------------------------------------------------------------------------------------------

TEST(House, IncludesFollowTheDesign) {
  const auto files = sources({"core", "nodes", "links", "ui"});
  ASSERT_GT(files.size(), 10u) << "too few sources found below " << test::source_folder();
  for (const SourceFile& file : files) expect_none(check_includes(file.path, file.text));
}

TEST(House, NothingMakesResultsDependOnLibraryClockOrHashOrder) {
  for (const SourceFile& file : sources({"core", "nodes", "links", "ui"})) expect_none(check_words(file.path, file.text));
}

TEST(House, FilesBeginWithASentence) {
  for (const SourceFile& file : sources({"core", "nodes", "links", "ui", "tests"})) expect_none(check_form(file.path, file.text));
}

TEST(House, EveryLibraryHasItsOwnNamespace) {
  for (const SourceFile& file : sources({"core", "nodes", "links", "ui"})) expect_none(check_names(file.path, file.text));
}

TEST(House, TheTableOfLayersHasNoFaults) {
  for (const std::string& fault : layers().faults) ADD_FAILURE() << "core/layers.txt: " << fault;
  std::vector<std::string> known;
  for (const Room& room : layers().rooms) {
    EXPECT_TRUE(fs::is_directory(fs::path(test::source_folder()) / room.folder))
        << "core/layers.txt: there is no folder " << room.folder;
    for (const std::string& seen : room.sees)
      EXPECT_TRUE(room.folder == "tests" || std::find(known.begin(), known.end(), seen) != known.end())
          << "core/layers.txt: " << room.folder << " includes " << seen << ", which has no row above it";
    known.push_back(room.folder);
  }
}

TEST(House, FilesStaySmall) {
  std::vector<std::string> needed;
  for (const SourceFile& file : sources({"core", "nodes", "links", "ui"})) {
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    const Room* room = layers().room_of(file.path);
    if (room != nullptr && lines > room->lines) needed.push_back(file.path);
    EXPECT_LE(lines, layers().line_limit(file.path))
        << file.path << ": split it, or give it a row with a reason in core/layers.txt";
  }
  for (const LongFile& file : layers().files)
    EXPECT_NE(std::find(needed.begin(), needed.end(), file.path), needed.end())
        << file.path << " needs no row in core/layers.txt";
}

TEST(House, FunctionsStaySmall) {
  for (const SourceFile& file : sources({"core", "nodes", "links", "ui"})) expect_none(check_functions(file.path, file.text, 60));
}

TEST(House, TheReadmesShowTheTableOfLayers) {
  const fs::path root = test::source_folder();
  const std::string list = "```\n" + list_of(layers()) + "```\n", picture = "```mermaid\n" + picture_of(layers()) + "```\n";
  EXPECT_NE(read(root / "core/README.md").find(list), std::string::npos)
      << "core/README.md has another list of the folders than core/layers.txt; it reads now:\n"
      << list;
  EXPECT_NE(read(root / "README.md").find(picture), std::string::npos)
      << "README.md has another picture of the folders than core/layers.txt; it reads now:\n"
      << picture;
}

TEST(House, EveryFolderHasAReadme) {
  const fs::path root = test::source_folder();
  std::vector<fs::path> folders = {root / "tests"};
  for (const char* top : {"core", "nodes", "links", "ui", "scenes"}) {
    if (!fs::exists(root / top)) continue;
    folders.push_back(root / top);
    for (auto entry = fs::recursive_directory_iterator(root / top); entry != fs::recursive_directory_iterator(); ++entry) {
      if (!entry->is_directory()) continue;
      if (is_foreign(entry->path()) || entry->path() == root / "scenes/old") entry.disable_recursion_pending();
      if (!is_foreign(entry->path()) && holds_files(entry->path())) folders.push_back(entry->path());
    }
  }
  for (const fs::path& folder : folders)
    EXPECT_TRUE(fs::exists(folder / "README.md")) << fs::relative(folder, root) << " has no README.md: say what it holds";
}

// --- The checkers, on planted faults --------------------------------------------------------------------------------

struct Sample {
  const char *path, *line, *expected;  // a part of the finding; empty: no finding
};

TEST(HouseRules, IncludesOfSamples) {
  const Sample samples[] = {
      {"core/define/a.cpp", "#include \"core/base/text.h\"", ""},
      {"core/define/a.cpp", "#include \"core/geometry/cell.h\"", "core/define may not include core/geometry/cell.h"},
      {"core/base/a.h", "#include \"core/define/port.h\"", "may not include"},
      {"core/graph/a.cpp", "#include \"core/geometry/cell.h\"", "may not include"},
      {"core/graph/a.cpp", "#include \"nodes/volume.h\"", "may not include"},
      {"core/session/commands/a.cpp", "#include \"core/file/scene_file.h\"", ""},
      {"core/session/a.cpp", "#include \"core/import/dxf.h\"", "may not include"},
      {"core/import/a.cpp", "#include \"core/geometry/cell.h\"", ""},
      {"core/import/a.cpp", "#include \"core/session/log.h\"", "may not include"},
      {"core/geometry/a.cpp", "#include \"core/graph/scene.h\"", "may not include"},
      {"core/geometry/a.h", "#include \"core/geometry/inside/clipper.h\"", ""},
      {"core/sun/a.cpp", "#include \"core/geometry/inside/clipper.h\"", "private to core/geometry"},
      {"core/sun/a.cpp", "#include \"core/traffic/network.h\"", "may not include"},
      {"nodes/a.cpp", "#include \"core/geometry/cell.h\"", ""},
      {"nodes/a.cpp", "#include \"core/graph/scene.h\"", "may not include"},
      {"nodes/a.cpp", "#include \"nodes/b.h\"", "may not include"},
      {"links/a.cpp", "#include \"links/b.h\"", "may not include"},
      {"links/a.cpp", "  #  include   \"core/session/log.h\"  // why", "may not include"},
      {"ui/cli/main.cpp", "#include \"core/session/log.h\"", ""},
      {"ui/cli/main.cpp", "#include \"links/keep_distance.cpp\"", "may not include"},
      {"ui/cli/main.cpp", "#include <core/session/log.h>", "take quotes"},
      {"core/base/a.cpp", "#include \"text.h\"", "no path from the root"},
      {"core/base/a.cpp", "#include \"../base/text.h\"", "no path from the root"},
      {"core/mystery/a.cpp", "#include <vector>", "no row"},
      {"core/base/a.cpp", "// #include \"core/graph/scene.h\"", ""},
      {"core/base/a.cpp", "/* \n#include \"core/graph/scene.h\"\n*/", ""},
      {"core/geometry/a.cpp", "#include <CGAL/Point_3.h>", ""},
      {"core/geometry/a.h", "#include <CGAL/Point_3.h>", ".cpp files only"},
      {"core/import/a.cpp", "#include <CGAL/Point_3.h>", "core/geometry/ only"},
      {"core/base/mathematics.cpp", "#include <sleef.h>", ""},
      {"core/sun/a.cpp", "#include <sleef.h>", "core/base/ only"},
      {"core/journal/a.cpp", "#include <sqlite3.h>", ""},
      {"core/room/a.cpp", "#include <boost/beast/core.hpp>", "core/serve/ only"},
      {"core/serve/a.h", "#include <boost/asio.hpp>", ""},
      {"tests/core/journal/a.cpp", "#include <sqlite3.h>", ""},
      {"ui/cli/main.cpp", "#include <sqlite3.h>", "core/journal/ only"},
      {"core/define/a.cpp", "#include <nlohmann/json.hpp>", ""},
      {"core/define/a.h", "#include <nlohmann/json.hpp>", ".cpp files only"},
      {"core/define/a.h", "#include <nlohmann/json_fwd.hpp>", ""},
      {"ui/desktop/shell/window.cpp", "#include <GLFW/glfw3.h>", ""},
      {"ui/cli/main.cpp", "#include <imgui.h>", "ui/desktop/ only"},
  };
  for (const Sample& sample : samples) {
    SCOPED_TRACE(std::string(sample.path) + " | " + sample.line);
    const auto found = sentences(check_includes(sample.path, std::string("// A sample.\n") + sample.line + "\n"));
    if (*sample.expected == '\0') {
      EXPECT_TRUE(found.empty()) << found.front();
    } else {
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NE(found[0].find(sample.expected), std::string::npos) << found[0];
    }
  }
}

TEST(HouseRules, WordsOfSamples) {
  const Sample samples[] = {
      {"core/graph/a.cpp", "auto h = std::hash<int>{}(1);", "std::hash"},
      {"core/graph/a.cpp", "auto h = std::hash_like(1);", ""},
      {"core/graph/a.cpp", "std::uniform_real_distribution<double> d;", "distribution"},
      {"core/graph/a.cpp", "std::normal_distribution<double> d;", "distribution"},
      {"core/graph/a.cpp", "our_distribution d;", ""},
      {"core/graph/a.cpp", "int i = rand ();", "rand"},
      {"core/graph/a.cpp", "int i = std::rand();", "rand"},
      {"core/graph/a.cpp", "int i = operand(1) + strand(2) + box.rand();", ""},
      {"core/graph/a.cpp", "std::unordered_map<int, int> m;", "hash table"},
      {"nodes/a.cpp", "#include <unordered_set>", "hash table"},
      {"core/live/commands/a.cpp", "#include <unordered_set>", "hash table"},
      {"core/geometry/a.cpp", "std::unordered_map<int, int> m;", ""},
      {"core/session/a.cpp", "#include <chrono>", "wall clock"},
      {"links/a.cpp", "auto now = std::chrono::steady_clock::now();", "wall clock"},
      {"ui/cli/a.cpp", "#include <chrono>", ""},
      {"core/base/a.cpp", "#include <chrono>", ""},
      {"core/sun/a.cpp", "double up = std::sin(turn);", "`sin`"},
      {"core/sun/a.cpp", "double up = ::sin(turn);", "`sin`"},
      {"core/sun/a.cpp", "double up = 2 * cosf (turn);", "`cosf`"},
      {"links/a.cpp", "std::transform(a, b, c, std::exp2l);", "`exp2l`"},
      {"nodes/a.cpp", "return __builtin_pow(2, x);", "pow"},
      {"nodes/a.cpp", "return std::hypot(x, y, z);", "`hypot`"},
      {"nodes/a.cpp", "using std::log;", "`log`"},
      {"nodes/a.cpp", "return mathematics::sine(x) + std::sqrt(x) + std::fma(x, x, x) + std::fmod(x, 2) + std::floor(x);", ""},
      {"nodes/a.cpp", "session.log(); const auto& log() const; log.size(); Log log{}; entry->log(1); own::exp(2); explog(3);",
       ""},
      {"ui/desktop/a.cpp", "double up = std::sin(turn);", ""},
      {"core/making/new_scene.cpp", "double side = std::cbrt(volume);", "`cbrt`"},
      {"core/drawing/a.cpp", "double up = std::sin(turn);", ""},
      {"ui/cli/a.cpp", "std::ofstream file(path);", "one place"},
      {"core/import/a.cpp", "int f = open(path, O_WRONLY | O_CREAT, 0666);", "one place"},
      {"core/import/a.cpp", "std::ifstream file(path);", ""},
      {"core/file/a.cpp", "FILE* f = fopen(path, \"w\");", ""},
      {"core/graph/a.cpp", "// neither rand() nor std::hash", ""},
      {"core/graph/a.cpp", "auto text = \"rand() \\\" std::hash\";", ""},
      {"core/graph/a.cpp", "auto text = R\"x(\" rand() )x\"; int i = rand();", "rand"},
      {"core/graph/a.cpp", "char q = '\"'; int million = 1'000'000; rand();", "rand"},
  };
  for (const Sample& sample : samples) {
    SCOPED_TRACE(std::string(sample.path) + " | " + sample.line);
    const auto found = sentences(check_words(sample.path, sample.line));
    if (*sample.expected == '\0') {
      EXPECT_TRUE(found.empty()) << found.front();
    } else {
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NE(found[0].find(sample.expected), std::string::npos) << found[0];
    }
  }
}

TEST(HouseRules, NamespacesOfSamples) {
  const auto found = [](const char* path, const char* text) { return sentences(check_names(path, text)).size(); };
  EXPECT_EQ(found("core/graph/a.h", "namespace bl {\n}\n"), 0u);
  EXPECT_EQ(found("core/base/a.h", "namespace bl::mathematics {\n}\n"), 0u) << "a namespace of its own within the room's";
  EXPECT_EQ(found("core/geometry/inside/a.h", "namespace bl::geometry {\nnamespace {\n}\n}\n"), 0u);
  EXPECT_EQ(found("core/geometry/a.h", "namespace bl {\n}\n"), 1u);
  EXPECT_EQ(found("core/graph/a.h", "namespace bl::geometry {\n}\n"), 1u);
  EXPECT_EQ(found("ui/desktop/panels/canvas/a.h", "namespace bl::desktop::canvas {\n}\n"), 0u);
}

TEST(HouseRules, FormOfSamples) {
  EXPECT_TRUE(check_form("core/base/a.h", "// Says what it is for.\n#pragma once\n").empty());
  EXPECT_EQ(check_form("core/base/a.h", "// Says what it is for.\n").size(), 1u);
  EXPECT_EQ(check_form("core/base/a.h", "// Says what it is for.\n// #pragma once\n").size(), 1u);
  EXPECT_EQ(check_form("core/base/a.cpp", "#include <vector>\n").size(), 1u);
  EXPECT_EQ(check_form("core/base/a.cpp", "// a.cpp\n").size(), 1u);
  EXPECT_EQ(check_form("core/base/a.h", "").size(), 2u);
}

TEST(HouseRules, FunctionsOfSamples) {
  const std::string body = "  a();\n  b();\n";
  const auto lines_over = [](const std::string& text, int most) { return sentences(check_functions("core/a.cpp", text, most)); };
  EXPECT_TRUE(lines_over("void f() {\n" + body + "}\n", 4).empty());
  EXPECT_EQ(lines_over("int x;\nvoid f() {\n" + body + "}\n", 3),
            std::vector<std::string>{"core/a.cpp:2: a function of 4 lines, more than 3: split it"});
  EXPECT_EQ(
      lines_over("namespace n {\nstruct S {\n  int x;\n  void f(\n      int y) const {\n" + body + "  }\n};\n}\n", 4).size(), 1u);
  EXPECT_TRUE(lines_over("namespace n {\nstruct S {\n" + body + body + "};\n}\n", 3).empty()) << "a struct is no function";
  EXPECT_TRUE(lines_over("constexpr std::array kRows = {\n 1,\n 2,\n 3,\n};\n", 3).empty()) << "a table is no function";
}

TEST(HouseRules, LayersOfSamples) {
  const Layers table =
      read_layers("# why\n\nroom a: 10\nroom a/b: 5 a\nfile a/long.cpp: 20 It is long.\nroom c: a\nfile a/x.cpp: 3\nd\n");
  EXPECT_EQ(table.faults.size(), 3u);
  EXPECT_EQ(table.line_limit("a/b/x.cpp"), 5);
  EXPECT_EQ(table.line_limit("a/bc/x.cpp"), 10);
  EXPECT_EQ(table.line_limit("a/long.cpp"), 20);
  EXPECT_EQ(table.room_of("ab/x.cpp"), nullptr);
  EXPECT_EQ(list_of(table), "a\na/b -> a\n");
  EXPECT_EQ(picture_of(table), "flowchart BT\n  a/b --> a\n");
}

TEST(HouseRules, FindingsNameTheirLine) {
  const auto found = check_includes("core/base/a.cpp", "// A sample.\n\n/* two\nlines */\n#include \"core/graph/scene.h\"");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].place, "core/base/a.cpp:5");
}

TEST(HouseRules, CodeOnlyKeepsLinesAndSurvivesOddEnds) {
  EXPECT_EQ(code_only("a // b\nc"), "a     \nc");
  EXPECT_EQ(code_only("a /* b\nc */ d"), "a     \n     d");
  for (const char* odd : {"", "\"", "\"\\", "'", "/*", "/", "//", "R\"", "R\"(", "R\"x(", "R\"x", "a'", "'\\"})
    EXPECT_EQ(code_only(odd).size(), std::string(odd).size()) << odd;
}

}  // namespace
}  // namespace bl::house
