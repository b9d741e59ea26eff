// OBJ and CSV texts, byte by byte.
#include <gtest/gtest.h>

#include "core/exchange/csv_reader.h"
#include "core/exchange/csv_table.h"
#include "core/exchange/wavefront_obj.h"

namespace bl {
namespace {

TEST(WavefrontObj, ObjectsShareOneCount) {
  const auto triangle = std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 1e-20}}, {{0, 1, 2}}});
  const std::vector<NamedMesh> meshes = {
      {"shop", triangle}, {"starved", nullptr}, {"shop", triangle}, {"two words\no evil", triangle}};
  EXPECT_EQ(write_obj(meshes),
            "# BehaviourLinks: lengths in metres, z up\n"
            "o shop\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 1 2 3\n"
            "# starved: no shape\n"
            "# shop\no shop_2\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 4 5 6\n"
            "# two words o evil\no two_words_o_evil\nv 0 0 0\nv 1 0 0\nv 0 0.1 1e-20\nf 7 8 9\n");
}

TEST(CsvTable, QuotesWhereNeeded) {
  const std::vector<std::string> header = {"name", "floor_area [m2]", "count"};
  const std::vector<std::vector<CsvCell>> rows = {{"a, \"b\"", 0.1, 3}, {" padded", 1e6, std::size_t{2}}, {"two\nlines"}};
  EXPECT_EQ(write_csv(header, rows),
            "name,floor_area [m2],count\r\n\"a, \"\"b\"\"\",0.1,3\r\n\" padded\",1e+06,2\r\n\"two\nlines\",,\r\n");
}

TEST(CsvTable, ReadsBack) {
  const std::vector<std::string> header = {"a", "b"};
  const std::vector<std::vector<CsvCell>> rows = {{"x;\"y\"", "1\n2"}, {"", 5}};
  const auto csv = read_csv(write_csv(header, rows));
  ASSERT_TRUE(csv);
  ASSERT_EQ(csv->records.size(), 3u);
  EXPECT_EQ(csv->records[1].fields, (std::vector<std::string>{"x;\"y\"", "1\n2"}));
  EXPECT_EQ(csv->records[2].line, 4u);
  EXPECT_EQ(write_csv(std::vector<std::string>{"only"}, std::vector<std::vector<CsvCell>>{{""}}), "only\r\n\"\"\r\n");
}

}  // namespace
}  // namespace bl
