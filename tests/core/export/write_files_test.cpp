// What exports may replace on the disk, and that a refusal changes nothing there.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/export/write_files.h"
#include "tests/core/export/two_houses.h"
#include "tests/ui/cli/program.h"

namespace bl::exporting {
namespace {

Order order_of(const char* id, const std::string& out, const std::vector<std::string>& options = {}) {
  const FormatDefinition* format = find_format(id);
  EXPECT_NE(format, nullptr) << id;
  return {format, out, means_folder(out), *option_values(*format, options)};
}

// They begin as files of the format do.
TEST(WriteFiles, WhatOthersMadeIsNotReplaced) {
  const test::Workplace place;
  const std::string packed("PK\x03\x04\x14\0\0\0 [Content_types].xml", 28);
  const std::vector<std::pair<const char*, std::string>> others = {
      {"xlsx", packed},
      {"xlsx", packed + std::string(100000, ' ') + "BehaviourLinks 3mf"},
      {"3mf", packed},
      {"pdf", "%PDF-1.4\n1 0 obj\n<</Creator (Writer)>>"},
      {"glb", std::string("glTF\2\0\0\0", 8) + "{\"asset\":{\"generator\":\"Blender\"}}"},
      {"stl", "solid part\nfacet normal 0 0 1\n"},
      {"stl", "solid BehaviourLinks\nfacet normal 0 0 1\n"},
      {"csv", "my,own\n"}};
  for (const auto& [id, content] : others) {
    place.write("mine", content);
    const auto may = may_write_order(order_of(id, place.path("mine").string()));
    ASSERT_FALSE(may) << id << ": " << content.substr(0, 40);
    EXPECT_NE(may.error().message.find("was not exported as"), std::string::npos) << may.error().message;
  }
}

TEST(WriteFiles, WhatWasExportedIsReplaced) {
  const test::Workplace place;
  Proposal proposal = proposal_of(settled_world());
  place.write("proposal.html", kShell);
  for (const FormatDefinition& format : all_formats())
    for (const char* option : {"", "layout=text"}) {
      if (*option != 0 && format.id != "stl") continue;
      const std::string out = place.path("out" + format.ending).string();
      const Order order =
          order_of(format.id.c_str(), out, *option == 0 ? std::vector<std::string>{} : std::vector<std::string>{option});
      for (int time = 0; time < 2; ++time) {
        const auto may = may_write_order(order);
        ASSERT_TRUE(may) << format.id << ": " << may.error().text();
        const auto products = make_products(std::span(&order, 1), proposal, place.path(".").string());
        ASSERT_TRUE(products) << format.id << ": " << products.error().text();
        std::vector<std::string> written;
        ASSERT_TRUE(write_products(*products, written));
        EXPECT_EQ(written, std::vector<std::string>{out});
      }
    }
}

Result<Products> products_of(const Order& order) {
  static const Proposal proposal = proposal_of(settled_world());
  return make_products(std::span(&order, 1), proposal, "");
}

// All files of a folder are looked at, not only those with the ending of the format.
TEST(WriteFiles, AFolderKeepsWhatOthersPutThere) {
  const test::Workplace place;
  std::filesystem::create_directory(place.path("models"));
  place.write("models/proposal.mtl", "newmtl mine\n");
  const auto refused = products_of(order_of("obj", place.path("models").string()));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("was not exported as obj"), std::string::npos) << refused.error().message;
  place.write("models/proposal.mtl", "# BehaviourLinks: of last week\n");
  EXPECT_TRUE(products_of(order_of("obj", place.path("models").string())));
}

TEST(WriteFiles, WhereOneFileOfAFolderCannotBeWrittenNoneIsMade) {
  const test::Workplace place;
  std::filesystem::create_directories(place.path("plans/level_01.svg"));
  const auto refused = products_of(order_of("svg", place.path("plans").string()));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().place.find("level_01.svg"), std::string::npos) << refused.error().text();
}

TEST(WriteFiles, FilesOfALargerExportBeforeAreTold) {
  const test::Workplace place;
  std::filesystem::create_directory(place.path("plans"));
  const Order order = order_of("svg", place.path("plans").string());
  const auto first = products_of(order);
  ASSERT_TRUE(first);
  std::vector<std::string> written;
  ASSERT_TRUE(write_products(*first, written));
  EXPECT_TRUE(products_of(order)->notes.empty());
  place.write("plans/level_77.svg", place.text("plans/level_00.svg"));
  place.write("plans/level_78.svg", "<svg>mine</svg>");
  const auto again = products_of(order);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->notes.size(), 1u);
  EXPECT_NE(again->notes.front().find("also holds level_77.svg of an earlier export"), std::string::npos) << again->notes.front();
}

// A file of the system that is there, and of which no byte can be read.
TEST(WriteFiles, WhatCannotBeReadIsNotReplaced) {
  const std::string locked = "/proc/self/mem";
  ASSERT_TRUE(std::filesystem::is_regular_file(locked));
  const auto may = may_write_order(order_of("csv", locked));
  ASSERT_FALSE(may);
  EXPECT_NE(may.error().message.find("cannot be read"), std::string::npos) << may.error().message;
}

}  // namespace
}  // namespace bl::exporting
