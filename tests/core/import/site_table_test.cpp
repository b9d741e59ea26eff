// Sites from CSV: the ways people write such tables, and what is refused.
#include "core/import/site_table.h"

#include <gtest/gtest.h>

namespace bl::importing {
namespace {

std::string site_error_of(const std::string& text) {
  const auto table = read_site_table(text);
  return table ? "no error" : table.error().text();
}

TEST(SiteTable, AllColumnsInAnyOrder) {
  const auto table = read_site_table(
      "group,name,demand_max,demand_min,demand,weight,z,y,x\n"
      "north,tower,30,20,,4,3,2,1\n"
      "\n"
      ",,,,1e3,,-3,-2,0.5\n");
  ASSERT_TRUE(table) << table.error().text();
  ASSERT_EQ(table->rows.size(), 2u);
  const SiteRow &tower = table->rows[0], &other = table->rows[1];
  EXPECT_EQ(tower.position, (Point3{1, 2, 3}));
  EXPECT_EQ(tower.group, "north");
  EXPECT_EQ(tower.name, "tower");
  EXPECT_EQ(tower.weight, 4);
  EXPECT_EQ(tower.demand_min, 20);
  EXPECT_EQ(tower.demand_max, 30);
  EXPECT_FALSE(tower.demand.has_value());
  EXPECT_EQ(other.line, 4u);
  EXPECT_EQ(other.demand, 1000);
  EXPECT_FALSE(other.weight.has_value());
  EXPECT_TRUE(table->has_weights && table->has_demands && table->has_groups);
}

TEST(SiteTable, UnitsOfHeadersAndFields) {
  const auto table = read_site_table("x_cm,Y (m),z,radius [mm],demand [m³],weight_note\n");
  EXPECT_FALSE(table) << "an unknown column";
  const auto sound = read_site_table("x_cm,Y (m),z,radius [mm],demand_m3\n250,1,30 cm,1500,12\n");
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_EQ(sound->rows[0].position, (Point3{2.5, 1, 0.3}));
  EXPECT_EQ(sound->rows[0].weight, 2.25);
  EXPECT_EQ(sound->rows[0].demand, 12);
  EXPECT_NE(site_error_of("x,y,z,demand [ha]\n1,2,3,4\n").find("The unit `ha` is not read for demand"), std::string::npos);
  EXPECT_NE(site_error_of("x [feet],y,z\n1,2,3\n").find("The unit `feet` is not read for x"), std::string::npos);
}

TEST(SiteTable, DecimalMarks) {
  const auto of = [](const std::string& text) {
    const auto table = read_site_table(text);
    return table ? table->rows[0].position.x : -1;
  };
  EXPECT_EQ(of("x,y,z\n1.234,2,3\n"), 1.234) << "between commas a lone point is a decimal point";
  EXPECT_EQ(of("x;y;z\n1,234;2,5;3\n"), 1.234) << "the other column has decimal commas";
  EXPECT_EQ(of("x;y;z\n1.234;2,5;3\n"), 1234) << "where commas are decimal, points are not";
  EXPECT_EQ(of("x\ty\tz\n1.5\t2\t3\n"), 1.5);
  EXPECT_EQ(of("x,y,z\n0.1000000000000000055511151231257827,2,3\n"), 0.1);
  EXPECT_NE(site_error_of("x;y;z\n1.234;2;3\n").find("may be a fraction or thousands"), std::string::npos);
}

}  // namespace
}  // namespace bl::importing
