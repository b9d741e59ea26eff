// `export`: pairs of formats and files, what is refused and why, and that a refusal leaves nothing behind.
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

TEST(Export, TwoPairsInOneCall) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome =
      place.run({"export", "a.json", "--settle", "--format", "csv", "--out", "a.csv", "--format", "obj", "--out", "a.obj"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(place.text("a.csv").starts_with("row,building,"));
  EXPECT_TRUE(place.text("a.obj").starts_with("# BehaviourLinks:"));
}

TEST(Export, AFolderGetsOneFileForEachLevel) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome = place.run({"export", "a.json", "--settle", "--format", "svg", "--out", "plans/"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(place.path("plans/level_00.svg")));
  EXPECT_TRUE(std::filesystem::exists(place.path("plans/level_01.svg")));
  const Outcome again = place.run({"export", "a.json", "--settle", "--format", "svg", "--out", "plans"});
  EXPECT_EQ(again.code, 0) << again.err;
}

// What was saved is exported without a tick more.
TEST(Export, WithoutSettleASceneIsExportedAsItIs) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome fresh = place.run({"export", "a.json", "--format", "csv", "--out", "a.csv"});
  EXPECT_EQ(fresh.code, 2);
  EXPECT_NE(fresh.err.find("--settle"), std::string::npos) << fresh.err;
  EXPECT_FALSE(std::filesystem::exists(place.path("a.csv")));
  ASSERT_EQ(place.run({"run", "a.json", "--ticks", "3", "--save", "b.json"}).code, 0);
  EXPECT_EQ(place.run({"export", "b.json", "--format", "csv", "--out", "b.csv"}).code, 0);
  EXPECT_NE(place.text("b.csv").find(",3,"), std::string::npos);
}

TEST(Export, WhatDoesNotSettleIsWrittenAndSaid) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome = place.run({"export", "a.json", "--settle", "--max-ticks", "1", "--format", "csv", "--out", "a.csv"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("not settled"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(place.path("a.csv")));
}

TEST(Export, MistakesAreNamedAndWriteNothing) {
  const Workplace place;
  place.write("a.json", moving_scene());
  place.write("mine.csv", "my,own\n1,2\n");
  std::filesystem::create_directory(place.path("folder"));
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--format", "dfx", "--out", "x"}, "did you mean `dxf`?"},
      {{"--format", "csv", "--out", "x", "--format", "obj"}, "--format is given 2 times, --out 1 time:"},
      {{"--format", "csv", "--out", "x", "--format", "obj", "--out", "x"}, "written by --out already"},
      {{"--format", "csv", "--out", "a.json"}, "is read as SCENE"},
      {{"--format", "csv", "--out", "mine.csv"}, "was not exported as csv"},
      {{"--format", "csv", "--out", "folder"}, "is a folder, but csv makes one file"},
      {{"--format", "svg", "--out", "mine.csv/"}, "is a file, not a folder"},
      {{"--format", "csv", "--out", "mine.csv/x.csv"}, "mine.csv is a file, not a folder"},
      {{"--format", "pdf", "--out", "x.dxf"}, "ends like files of the format dxf, and pdf is wanted"},
      {{"--format", "pdf", "--out", "x", "--option", "section=5000"}, "a level cut at +5000.00 m meets no volume"},
      {{"--format", "dxf", "--out", "x", "--option", "section=5000"}, "they lie between "},
      {{"--format", "stl", "--out", "x", "--option", "scael=3"}, "did you mean `scale`?"},
      {{"--format", "stl", "--out", "x", "--option", "scale=0"}, "scale"},
      {{"--format", "geojson", "--out", "x"}, "where it lies on Earth"},
      {{"--format", "svg", "--out", "x", "--option", "level=99"}, "there is no level 99"},
      {{"--format", "svg", "--out", "x", "--option", "scale=1"}, "does not fit on the paper at 1:1"},
  };
  for (const auto& [arguments, words] : cases) {
    std::vector<std::string> all = {"export", "a.json", "--settle"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = place.run(all);
    EXPECT_EQ(outcome.code, 2) << words << outcome.out;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(place.path("x"))) << words;
  }
  EXPECT_EQ(place.text("mine.csv"), "my,own\n1,2\n");
}

// What one format cannot hold keeps no other from being written.
TEST(Export, AFormatThatCannotHoldTheProposalKeepsNoOtherFromBeingWritten) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome =
      place.run({"export", "a.json", "--settle", "--format", "geojson", "--out", "earth/a.geojson", "--format", "csv", "--out",
                 "a.csv", "--format", "dxf", "--out", "plans/a.dxf", "--option", "section=5000"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("geojson: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("they lie between "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("2 formats of 3 cannot hold this proposal"), std::string::npos) << outcome.out;
  EXPECT_TRUE(place.text("a.csv").starts_with("row,building,"));
  for (const char* folder : {"earth", "plans"}) EXPECT_FALSE(std::filesystem::exists(place.path(folder))) << "it has no file";
}

// As formats of several files do it; what ends in a way that no format has is told.
TEST(Export, MissingFoldersAreMadeForSingleFiles) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome = place.run({"export", "a.json", "--settle", "--format", "csv", "--out", "new/deep/a.csv", "--format",
                                     "svg", "--out", "new/plans/", "--format", "pdf", "--out", "new/a.docx"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(place.text("new/deep/a.csv").starts_with("row,building,"));
  EXPECT_TRUE(std::filesystem::exists(place.path("new/plans/level_00.svg")));
  EXPECT_NE(outcome.out.find("pdf: new/a.docx does not end with .pdf"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("csv: "), std::string::npos) << outcome.out;
}

// Whoever means a folder and forgets its stroke reads what became of it.
TEST(Export, AFileWithoutAnEndingIsTold) {
  const Workplace place;
  place.write("a.json", moving_scene());
  const Outcome outcome =
      place.run({"export", "a.json", "--settle", "--format", "svg", "--out", "plans", "--format", "csv", "--out", "/dev/null"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_regular_file(place.path("plans")));
  EXPECT_NE(outcome.out.find("svg: plans does not end with .svg, by which programs know such files; a folder is named with a "
                             "stroke at its end: plans/"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find("csv: "), std::string::npos) << "a device has no ending: " << outcome.out;
}

// A disk that is full is played by the largest size that a file may have.
TEST(Export, AFullDiskLeavesTheOldFileWhole) {
  const Workplace place;
  place.write("a.json", moving_scene());
  ASSERT_EQ(place.run({"export", "a.json", "--settle", "--format", "obj", "--out", "a.obj"}).code, 0);
  const std::string before = place.text("a.obj");
  const std::string command = "cd " + place.path(".").string() + " && ulimit -f 1 && " + program_path().string() +
                              " export a.json --settle --format obj --out a.obj > out.txt 2> err.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(place.text("a.obj"), before);
  EXPECT_NE(place.text("err.txt").find("a.obj"), std::string::npos) << place.text("err.txt");
}

TEST(Export, HelpListsTheFormatsWithTheirOptions) {
  const Workplace place;
  const Outcome outcome = place.run({"export", "--help"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* words : {"dxf ", "text_height=1", "from 1 to 100000", "one of a4, a3, a2, a1, a0"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << outcome.out;
  EXPECT_NE(place.run({"docs", "geojson"}).out.find("RFC 7946"), std::string::npos);
}

}  // namespace

}  // namespace bl::test
