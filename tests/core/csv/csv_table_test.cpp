// CSV texts, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/random.h"
#include "core/csv/csv_reader.h"
#include "core/csv/csv_table.h"

namespace bl::csv {
namespace {

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

TEST(CsvTable, NoTextIsAFormulaAndNumbersStayNumbers) {
  const std::vector<std::string> header = {"=evil()", "b"};
  const std::vector<std::vector<CsvCell>> rows = {{"=cmd|'/c calc'!A0", -12.5},
                                                  {"+1", -3},
                                                  {"-1+1", 1e-7},
                                                  {"@SUM(A1)", 0.0},
                                                  {"\t=1", ""},
                                                  {"\r=1", ""},
                                                  {"\xEF\xBC\x9D"
                                                   "1",
                                                   ""},
                                                  {"'=1", "a-b"},
                                                  {"a\x01\x1B[2J\xC2\x9B"
                                                   "b\x7F",
                                                   "'plain"}};
  EXPECT_EQ(write_csv(header, rows),
            "'=evil(),b\r\n'=cmd|'/c calc'!A0,-12.5\r\n'+1,-3\r\n'-1+1,1e-07\r\n'@SUM(A1),0\r\n' =1,\r\n' =1,\r\n"
            "'\xEF\xBC\x9D"
            "1,\r\n''=1,a-b\r\n\"a  [2J b \",'plain\r\n");
}

TEST(CsvTable, NoTextIsAFormulaBehindASemicolon) {
  const std::vector<std::vector<CsvCell>> rows = {
      {"a;=1+1", "b"}, {"a; +1;-2;c", "a;b"}, {"two\n=lines", "-"}, {"a;'=1", "a;'b"}};
  EXPECT_EQ(write_csv(std::vector<std::string>{"n;=1", "b"}, rows),
            "\"n;'=1\",b\r\n\"a;'=1+1\",b\r\n\"a;' +1;'-2;c\",\"a;b\"\r\n\"two\n'=lines\",'-\r\n\"a;''=1\",\"a;'b\"\r\n");
  for (const char* text : {"a;=1+1", "a; +1;-2;c", "two\n=lines", "a;'=1", ";=1", "=;=", "';'=1", "\n=1"})
    EXPECT_EQ(text_of_harmless(harmless_text(text)), text);
  EXPECT_EQ(text_of_harmless("'\n=1"), "\n=1") << "as tables were written before";
}

// The law: whatever people write, no text cell begins with a sign of a formula or holds a control character but a line end, and
// the text comes back.
TEST(CsvTable, EveryTextIsHarmlessAndComesBack) {
  Random random(14);
  const std::string letters = "=+-@' \"\t\r\n,;a1|\x01\x7F";
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text;
    for (std::uint64_t k = 0; k < 1 + random.below(6); ++k) text += letters[random.below(letters.size())];
    const auto read =
        read_csv(write_csv(std::vector<std::string>{"name", "count"}, std::vector<std::vector<CsvCell>>{{text, 1}}), ',');
    ASSERT_TRUE(read) << read.error().text();
    ASSERT_EQ(read->records.size(), 2u);
    const std::string& cell = read->records[1].fields[0];
    // Where lists are separated by semicolons, a spreadsheet begins a cell behind each of them, and a row behind a line end.
    for (std::size_t begin = 0; begin <= cell.size(); ++begin) {
      if (begin > 0 && cell[begin - 1] != ';' && cell[begin - 1] != '\n') continue;
      const std::size_t first = cell.find_first_not_of(" \n", begin);
      EXPECT_TRUE(first == std::string::npos || std::string("=+-@").find(cell[first]) == std::string::npos) << cell;
    }
    EXPECT_TRUE(std::none_of(cell.begin(), cell.end(), [](char c) {
      return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F;
    })) << cell;
    EXPECT_EQ(harmless_text(text_of_harmless(cell)), cell);
    const bool is_plain =
        std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    if (is_plain && trimmed(text) == text) { EXPECT_EQ(text_of_harmless(cell), text); }
  }
}

}  // namespace
}  // namespace bl::csv
