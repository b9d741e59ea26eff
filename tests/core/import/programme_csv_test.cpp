// Programmes from CSV: the ways people write tables, real room lists, and broken tables with their messages.
#include "core/import/programme_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/csv/csv_reader.h"
#include "core/import/number_column.h"
#include "core/import/programme_columns.h"
#include "tests/support/reference_files.h"

namespace bl::importing {
namespace {

// Our own file, and a published one where the shared folder is.
std::vector<std::string> brief_texts_of(const std::string& own, const std::string& published) {
  return test::texts_of(own, "data/programme/" + published);
}

// What a whole table comes to.
struct TableSums {
  std::size_t rows, items;
  double floor_area;
  std::size_t row;  // one of them, and its use
  std::string use;
};
void expect_sums(const ProgrammeImport& import, const TableSums& sums) {
  EXPECT_EQ(import.rows.size(), sums.rows);
  EXPECT_EQ(import.items, sums.items);
  EXPECT_DOUBLE_EQ(import.floor_area, sums.floor_area);
  EXPECT_EQ(import.rows.at(sums.row).use, sums.use);
}

bool brief_has_note(const ProgrammeImport& import, const std::string& part) {
  for (const std::string& note : import.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

bool brief_has_whole_note(const std::vector<std::string>& notes, const std::string& whole) {
  return std::find(notes.begin(), notes.end(), whole) != notes.end();
}

std::string error_of(const std::string& text, const ProgrammeOptions& options = {}) {
  const auto import = read_programme_csv(text, options);
  return import ? "no error" : import.error().text();
}

double first_area(const std::string& text) {
  const auto import = read_programme_csv(text);
  return import ? import->rows.at(0).floor_area : -1;
}

TEST(ProgrammeCsv, SaysWhatMayStandOnWhat) {
  const auto import =
      read_programme_csv("use,area,standing\ngarage,900,Ground\nflats,400,\nfoot bridge,60,bridge\nshop,200,stack\n");
  ASSERT_TRUE(import) << import.error().text();
  EXPECT_EQ(import->rows[0].standing, "ground");
  EXPECT_EQ(import->rows[1].standing, "stack");
  EXPECT_EQ(import->rows[2].standing, "bridge");
  EXPECT_EQ(import->rows[3].standing, "stack");
  EXPECT_EQ(read_programme_csv("use,area\nshop,200\n")->rows[0].standing, "stack");
  const std::string wrong = error_of("use,area,standing\ngarage,900,grond\n");
  EXPECT_TRUE(wrong.starts_with("line 2, column 3 `standing`: `grond` is not understood, did you mean `ground`?")) << wrong;
}

TEST(ProgrammeCsv, FullTable) {
  const auto import = read_programme_csv(
      "use,floor_area_m2,floor_area_min_m2,floor_area_max_m2,count,storey_height_m,adjacent_to,tags\n"
      "hall,120,100,150,1,6,shop|Office,\"public, loud\"\n"
      "shop,40,,,3,,shop,\n"
      "\n"
      "office,0.5 ha,,,,350 cm,,quiet\n");
  ASSERT_TRUE(import) << import.error().text();
  ASSERT_EQ(import->rows.size(), 3u);
  const ProgrammeRow& hall = import->rows[0];
  EXPECT_EQ(hall.use, "hall");
  EXPECT_EQ(hall.floor_area, 120);
  EXPECT_EQ(hall.floor_area_min, 100);
  EXPECT_EQ(hall.floor_area_max, 150);
  EXPECT_EQ(hall.storey_height, 6);
  EXPECT_EQ(hall.adjacent_to, (std::vector<std::string>{"shop", "office"}));
  EXPECT_EQ(hall.tags, (std::vector<std::string>{"public", "loud"}));
  EXPECT_EQ(import->rows[1].count, 3);
  EXPECT_EQ(import->rows[1].storey_height, 3.2);
  EXPECT_EQ(import->rows[1].adjacent_to, (std::vector<std::string>{"shop"}));
  EXPECT_FALSE(import->rows[1].floor_area_min.has_value());
  EXPECT_EQ(import->rows[2].floor_area, 5000);
  EXPECT_DOUBLE_EQ(import->rows[2].storey_height, 3.5);
  EXPECT_EQ(import->rows[2].line, 5u);
  EXPECT_EQ(import->items, 5u);
  EXPECT_EQ(import->floor_area, 120 + 3 * 40 + 5000);
  // A height that nobody gave decides on storeys: it is told.
  ASSERT_EQ(import->notes.size(), 1u);
  EXPECT_TRUE(import->notes[0].starts_with("Rows without a storey height: 1 (`")) << import->notes[0];
}

TEST(ProgrammeCsv, HeadersAreTolerant) {
  for (const std::string header : {"Use,Floor area (m²)", "FUNCTION,Area [m2]", " use , floor-area_m2", "Programme,Area in sqm",
                                   "use,AREA", "Use,\"Floor\narea\""})
    EXPECT_EQ(first_area(header + "\nhall,120\n"), 120) << header;
  EXPECT_EQ(first_area("use,area [ha]\nhall,0.5\n"), 5000);
  EXPECT_EQ(first_area("use,area_ha\nhall,200 m2\n"), 200);
  const auto named = read_programme_csv("Room,Area\nA,5\n");
  ASSERT_TRUE(named);
  EXPECT_TRUE(brief_has_note(*named, "There is no column `use`; the column `Room` was taken for it."));
  const auto both = read_programme_csv("use,name,area\nflat,Flat A,50\nflat,Flat B,50\n");
  ASSERT_TRUE(both);
  EXPECT_EQ(both->rows[1].use, "flat 2");
  EXPECT_EQ(both->rows[1].name, "Flat B");
}

TEST(ProgrammeCsv, SeparatorsLineEndsAndEncodings) {
  EXPECT_EQ(first_area("use;area\r\nhall;120,5\r\n"), 120.5);
  EXPECT_EQ(first_area("use\tarea\rhall\t120\r"), 120);
  EXPECT_EQ(first_area("\xEF\xBB\xBFuse,area\nhall,\"120,5\""), 120.5);
  EXPECT_EQ(first_area("sep=;\nuse;area\nhall;7\n"), 7);
  EXPECT_EQ(first_area("\"use, of the room\",area\nx,1\n"), -1);
  const auto quoted = read_programme_csv("use,area\n\"hall \"\"A\"\",\nlarge\",5\n,\nlast,6\n");
  ASSERT_TRUE(quoted) << quoted.error().text();
  EXPECT_EQ(quoted->rows[0].use, "hall \"A\",\nlarge");
  EXPECT_EQ(quoted->rows[1].line, 5u);
  EXPECT_TRUE(brief_has_note(*quoted, "1 row without any text was skipped."));
  const auto latin = read_programme_csv("use,area\ncaf\xE9,5\n");
  ASSERT_TRUE(latin);
  EXPECT_EQ(latin->rows[0].use, "café");
  EXPECT_TRUE(
      brief_has_note(*latin, "The text is not UTF-8; it was read as Windows-1252 (Latin-1). Check letters with accents."));
}

TEST(ProgrammeCsv, NumbersAsPeopleWriteThem) {
  EXPECT_EQ(first_area("use,area\na,1 200\n"), 1200);
  EXPECT_EQ(first_area("use,area\na,1\xC2\xA0"
                       "200.5 m²\n"),
            1200.5);
  EXPECT_EQ(first_area("use;area\na;1.200,50\n"), 1200.5);
  EXPECT_EQ(first_area("use;area\na;1,200.50\n"), 1200.5);
  EXPECT_EQ(first_area("use;area\na;1.200\nb;12,5\n"), 1200);
  EXPECT_EQ(first_area("use;area\na;1.200\nb;12.5\n"), 1.2);
  EXPECT_EQ(first_area("use;area;height\na;1.200;3,2\n"), 1200);
  EXPECT_EQ(first_area("use;area\na;1.200.000\n"), 1200000);
  EXPECT_EQ(first_area("use;area\na;0,125\n"), 0.125);
  EXPECT_EQ(first_area("use;area\na;1'200\n"), 1200);
  EXPECT_EQ(first_area("use;area\na;1e3 m2\n"), 1000);
  ProgrammeOptions comma;
  comma.decimal = ',';
  EXPECT_EQ(read_programme_csv("use;area\na;1.200\n", comma)->rows[0].floor_area, 1200);
  EXPECT_EQ(decimal_evidence("1.200"), DecimalEvidence::ambiguous);
  EXPECT_EQ(decimal_evidence("1 200,5"), DecimalEvidence::comma);
  EXPECT_FALSE(parse_table_number("1,20,000", '.', Unit::count, ""));
}

TEST(ProgrammeCsv, NumberErrors) {
  EXPECT_EQ(error_of("use;area\na;1.200\n"),
            "line 2, column 2 `area`: `1.200` may be a fraction or thousands, and nothing else in the file tells which. Write it "
            "without thousands mark, or give "
            "the option `decimal`: . or ,");
  EXPECT_EQ(error_of("use;area\na;1,5\nb;2.25\n"),
            "column 2 `area`: The decimal mark changes: `2.25` in line 3 has a point, `1,5` in line 2 a comma. Write all numbers "
            "of the column alike.");
  EXPECT_EQ(error_of("use,area\na,\n"), "line 2, column 2 `area`: The floor area is empty. Give one, or remove the row.");
  EXPECT_EQ(error_of("use,area\na,-5\n"),
            "line 2, column 2 `area`: The floor area is -5 m². It must be greater than zero and at most 1e9 m².");
  EXPECT_EQ(error_of("use,area\na,0\n"),
            "line 2, column 2 `area`: The floor area is 0 m². It must be greater than zero and at most 1e9 m².");
  EXPECT_EQ(error_of("use,area\na,nan\n"),
            "line 2, column 2 `area`: `nan` is not understood. Write an area such as 120, 120 m2 or 0.4 ha.");
  EXPECT_EQ(error_of("use,area\na,12 persons\n"),
            "line 2, column 2 `area`: `12 persons` is not understood. Write an area such as 120, 120 m2 or 0.4 ha.");
  EXPECT_EQ(error_of("use,area,count\na,5,1.5\n"),
            "line 2, column 3 `count`: The count is 1.5. It must be a whole number from 1 to 100000.");
  EXPECT_EQ(error_of("use,area,count\na,5,0\n"),
            "line 2, column 3 `count`: The count is 0. It must be a whole number from 1 to 100000.");
  EXPECT_EQ(error_of("use,area,count\na,5,1000000\n"),
            "line 2, column 3 `count`: The count is 1000000. It must be a whole number from 1 to 100000.");
  EXPECT_EQ(error_of("use,area\na,2000000000\n"),
            "line 2, column 2 `area`: The floor area is 2000000000 m². It must be greater than zero and at most 1e9 m².");
  EXPECT_EQ(error_of("use,area,height\na,5,-3\n"),
            "line 2, column 3 `height`: The storey height is -3 m. It must be greater than zero and at most 1000 m.");
  EXPECT_EQ(error_of("use,area,min area\na,5,6\n"),
            "line 2, column 3 `min area`: The floor area 5 m² lies outside its own bounds (6 to none). Correct one of them.");
}

TEST(ProgrammeCsv, HeaderErrors) {
  EXPECT_EQ(error_of("use,surface\nhall,5\n"),
            "line 1: There is no column floor_area_m2. The header has: `use`, `surface`. Accepted are: `floor_area`, `area`, "
            "`floorarea`, `target_area`, "
            "`area_target`, `floor_area_target`, `floor_space`, `size`, or name the column by --column floor_area_m2=HEADER");
  EXPECT_EQ(error_of("what,area\nhall,5\n"),
            "line 1: There is no column use. The header has: `what`, `area`. Accepted are: `use`, `function`, `usage`, "
            "`program`, `programme`, `activity`, "
            "`name`, `room`, `room_name`, `space`, `space_name`, `title`, or name the column by --column use=HEADER");
  EXPECT_EQ(error_of("use,floor_aria_m2\nhall,5\n"),
            "line 1: There is no column floor_area_m2. If `floor_aria_m2` is meant, correct it, or give --column "
            "floor_area_m2=floor_aria_m2. The header has: `use`, `floor_aria_m2`.");
  EXPECT_EQ(error_of("use,flor area\nhall,5\n"),
            "line 1: There is no column floor_area_m2. If `flor area` is meant, correct it, or give --column "
            "\"floor_area_m2=flor area\". The header has: `use`, `flor area`.");
  EXPECT_EQ(
      error_of("use,area,floor area\nhall,5,6\n"),
      "line 1, column 3: The columns `area` and `floor area` both read as floor_area_m2. Rename one, or say which by --column "
      "\"floor_area_m2=floor area\".");
  EXPECT_EQ(error_of("use,area (sq ft)\nhall,5\n"),
            "line 1, column 2: The unit `sq ft` in the header `area (sq ft)` is not read for floor_area_m2. Use m2, ha or km2.");
  EXPECT_EQ(error_of("use,area\n"), "line 1: The table has a header but no rows. Add one row per use.");
  EXPECT_EQ(error_of(""), "line 1: The table is empty. It needs a header with `use` and `floor_area_m2`, and rows.");
  ProgrammeOptions options;
  options.columns = {{"use", "Rom Name"}};
  EXPECT_EQ(error_of("Room Name,Area\nhall,5\n", options),
            "line 1: There is no column `Rom Name` for use, did you mean `Room Name`? The header has: `Room Name`, `Area`.");
  options.columns = {{"usr", "Room Name"}};
  EXPECT_EQ(error_of("Room Name,Area\nhall,5\n", options).substr(0, 71),
            "columns: `usr` is no column of a programme, did you mean `use`? There a");
}

TEST(ProgrammeCsv, RowErrors) {
  EXPECT_EQ(error_of("use,area\n,5\n"), "line 2, column 1 `use`: The use is empty. Name it, or remove the row.");
  EXPECT_EQ(
      error_of("use,area\nshop,1,5\n"),
      "line 2: The row has 3 fields, the header 2. Put fields with a comma inside them into double quotes (decimal commas too).");
  EXPECT_EQ(error_of("use,area,adjacent_to\nshop,5,\nhall,6,shp\n"),
            "line 3, column 3 `adjacent_to`: `shp` is no use of this table, did you mean `shop`?");
  EXPECT_EQ(error_of("use,area\n\"shop,5\nhall,6\n"),
            "line 2: A double quote opens a field in this record and is never closed. Close or remove it.");
  EXPECT_EQ(error_of("use,area\nsh\"op,5\n"),
            "line 2: A double quote stands in the wrong place. Quote the whole field and double the quotes inside it: \"a "
            "\"\"b\"\" c\".");
  EXPECT_EQ(error_of("use,area\nshop\x81,5\n"),
            "line 2: The text is neither UTF-8 nor Windows-1252 (Latin-1). Save the file as CSV in UTF-8.");
  EXPECT_EQ(error_of(std::string("\xFF\xFEu\0s\0", 6)),
            "byte 0: This is no CSV table but text in UTF-16: save it as CSV in UTF-8.");
}

TEST(ProgrammeCsv, DuplicatesUnknownColumnsAndBounds) {
  const auto import = read_programme_csv(
      "use,area,min area,max area,colour,cuont,adjacent to\nshop,5,,,red,1,\nShop,6,,,,1,\nshop "
      "2,7,,,,1,\nhall,,10,20,,1,shop\nbar,5,,,,1,bar\n");
  ASSERT_TRUE(import) << import.error().text();
  EXPECT_EQ(import->rows[1].use, "Shop 3");
  EXPECT_EQ(import->rows[3].floor_area, 15);
  EXPECT_EQ(import->rows[3].adjacent_to, (std::vector<std::string>{"shop", "Shop 3"}));
  for (const char* note : {"Line 3: the use `Shop` exists already; this one became `Shop 3`.", "Column 5 `colour` was left out.",
                           "Line 5 has no floor area; the middle of its bounds was taken, 15 m².",
                           "Line 6: `bar` cannot be adjacent to itself alone; this was left out."})
    EXPECT_TRUE(brief_has_whole_note(import->notes, note)) << note;
  EXPECT_EQ(import->notes.size(), 5u) << "and the rows without a storey height";
  // What was probably meant as one of ours is lost, and that may be much.
  EXPECT_EQ(import->warnings, (std::vector<std::string>{"Column 6 `cuont` was left out, did you mean `count`?"}));
  const auto standing = read_programme_csv("use,area,standng\nshop,5,ground\n");
  ASSERT_TRUE(standing);
  EXPECT_EQ(standing->warnings, (std::vector<std::string>{"Column 3 `standng` was left out, did you mean `standing`?"}));
}

TEST(ProgrammeCsvData, RoomLists) {
  const std::array<TableSums, 2> sums{{{3, 5, 237.5, 0, "Wood Shop"}, {77, 160, 4714, 0, "Event Space"}}};
  ProgrammeOptions options;
  options.columns = {
      {"use", "Room Name"}, {"floor_area_m2", "Area"}, {"count", "Room Quantity"}, {"storey_height_m", "Room Height"}};
  std::size_t k = 0;
  for (const std::string& text : brief_texts_of("rooms.csv", "college_school_rooms.csv")) {
    const auto import = read_programme_csv(text, options);
    ASSERT_TRUE(import) << import.error().text();
    expect_sums(*import, sums[k]);
    EXPECT_EQ(import->rows[0].storey_height, k == 0 ? 5 : 4);
    EXPECT_TRUE(brief_has_note(*import, "Column 1 `Suite Name` was left out"));
    ++k;
  }
}

TEST(ProgrammeCsvData, ListsOfFunctions) {
  const std::array<TableSums, 2> sums{{{3, 3, 203.5, 2, "Entrance"}, {19, 19, 18776, 5, "Entrance hall"}}};
  std::size_t k = 0;
  for (const std::string& text : brief_texts_of("functions.csv", "zoho_apidae_programme.csv")) {
    const auto import = read_programme_csv(text);
    ASSERT_TRUE(import) << import.error().text();
    expect_sums(*import, sums[k++]);
  }
}

}  // namespace
}  // namespace bl::importing
