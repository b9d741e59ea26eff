// Rows of tables: what they are called, how they come and go, and that people who change other rows do not meet.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/session/table_rows.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kBrief = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "brief", "types": {"programme": {"rows": [{"use": "housing", "floor_area": 90, "count": 4}, {"use": "office", "floor_area": 400}]}}},
  {"id": "site", "types": {"boundary": {"plan": [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]], "height": 20,
    "holes": [{"name": "court", "x": 5, "y": 5}, {"name": "court", "x": 9, "y": 5}, {"name": "court", "x": 9, "y": 9}]}}}]})";

const Table& rows_of(World& world) {
  return *std::get<Shared<Table>>(world.session().scene().nodes.at("brief").types.at("programme").at("rows"));
}

std::string set(World& world, const std::string& row, const std::string& column, const std::string& value,
                const std::string& author = "test") {
  return world.submit(command<SetCell>({"brief", {"programme.rows"}, row, column, {value}}), author);
}

TEST(TableRows, FieldsAreSetByTheNameOfTheirRow) {
  World world = World::from_text(kBrief);
  ASSERT_EQ(set(world, "office", "floor_area", "500"), "");
  EXPECT_EQ(rows_of(world).number(1, "floor_area"), 500);
  ASSERT_EQ(set(world, "housing", "count", "null"), "");
  EXPECT_EQ(rows_of(world).number(0, "count"), 1);
  EXPECT_EQ(set(world, "ofice", "count", "2"), "nodes/brief/programme/rows: there is no row `ofice`, did you mean `office`?");
  EXPECT_EQ(set(world, "office", "cuont", "2"),
            "nodes/brief/programme/rows/office: the table has no column `cuont`, did you mean `count`?");
  EXPECT_EQ(set(world, "office", "floor_area", "-2"),
            "nodes/brief/programme/rows/office/floor_area: must be between 0 and 1e+08 m², found -2");
  EXPECT_EQ(set(world, "office", "use", "\"housing\""), "nodes/brief/programme/rows/office: there is a row `housing` already");
  EXPECT_EQ(world.submit(command<SetCell>({"brief", {"node.name"}, "0", "x", {"1"}})).empty(), false);
}

TEST(TableRows, RowsWithoutNamesAreCounted) {
  World world = World::from_text(kBrief);
  ASSERT_EQ(world.submit(command<SetCell>({"site", {"boundary.holes"}, "1", "x", {"12"}})), "");
  EXPECT_EQ(world.submit(command<RemoveRow>({"site", {"boundary.holes"}, "3"})),
            "nodes/site/boundary/holes: there is no row `3`; rows count from 0, and there are 3");
}

TEST(TableRows, TwoPeopleWithARowEachKeepTheirs) {
  World world = World::from_text(kBrief);
  ASSERT_EQ(set(world, "housing", "floor_area", "100", "anna"), "");
  ASSERT_EQ(set(world, "office", "floor_area", "500", "ben"), "");
  ASSERT_EQ(world.submit(command<AddRow>({"brief", {"programme.rows"}, {R"({"use": "shop", "floor_area": 60})"}, 0}), "anna"),
            "");
  ASSERT_EQ(set(world, "shop", "count", "3", "ben"), "");
  const auto undone = world.session().undo("anna");
  ASSERT_TRUE(undone.ok()) << undone.error().text();
  ASSERT_EQ(undone->left.size(), 1u);
  EXPECT_EQ(text_of(undone->left.front()), "ben has changed nodes/brief/types/programme/rows/shop/count since");
  EXPECT_EQ(rows_of(world).number(1, "floor_area"), 90) << "the step before is taken back";
  EXPECT_EQ(rows_of(world).number(2, "floor_area"), 500);
}

// Whatever became of a table: the commands that are made of the difference lead to it, and touch no other row.
TEST(TableRows, CommandsOfADifferenceLeadToTheOtherTable) {
  const PortDefinition& port = *full_registry().typification("programme")->find_port("rows");
  Random random(5);
  const auto table = [&] {
    Table made;
    for (const ColumnDefinition& column : port.columns) made.columns.push_back(column.id);
    std::set<std::string> taken;
    for (std::uint64_t r = random.below(5); r > 0; --r) {
      const std::string use = "use" + std::to_string(random.below(6));
      if (!taken.insert(use).second) continue;
      TableRow& row = made.rows.emplace_back();
      for (const ColumnDefinition& column : port.columns) row.push_back(column.default_value);
      row[0] = use;
      row[1] = static_cast<double>(random.below(3));
    }
    return made;
  };
  int whole = 0;
  for (int round = 0; round < 400; ++round) {
    const Table before = table(), after = table();
    World world = World::from_text(kBrief);
    for (const std::string use : {"housing", "office"})
      ASSERT_EQ(world.submit(command<RemoveRow>({"brief", {"programme.rows"}, use})), "");
    for (const auto& step : table_commands("brief", "programme.rows", port, Table(), before)) ASSERT_EQ(world.submit(step), "");
    const auto steps = table_commands("brief", "programme.rows", port, before, after);
    for (const Command& step : steps) {
      ASSERT_EQ(world.submit(step), "");
      whole += step.id == "set_port" ? 1 : 0;
    }
    const auto& values = world.session().scene().nodes.at("brief").types.at("programme");
    const Table now = values.contains("rows") ? rows_of(world) : Table();
    ASSERT_EQ(now.rows, after.rows) << round;
  }
  EXPECT_GT(whole, 10) << "rows that have changed places";
}

}  // namespace
}  // namespace bl
