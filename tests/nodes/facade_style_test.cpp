// Styles: which rule holds where, who dresses what, and the law that all surface of a volume is counted once.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string house_with(const std::string& facade, const std::string& styles) {
  return scene_text(
      R"({"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [20, 0, 0], [20, 20, 0], [0, 20, 0]], "height": 20}}},
         {"id": "house", "position": [10, 10, 6], "types": {"smart_volume": {"use": "shop", "demand": 2000}, "facade": {)" +
      facade + R"(}}}, {"id": "solver", "types": {"smart_volumes_solver": {}}}, )" + styles);
}

TEST(FacadeStyle, TheFirstRowThatFitsHolds) {
  World world = World::from_text(house_with(R"("style": ["s"])", R"({"id": "s", "types": {"facade_style": {"name": "s", "rows": [
      {"use": "office", "glazing": 0.9}, {"use": "shop", "orientation": "south", "glazing": 0.5, "band": 0, "sill": 0},
      {"orientation": "north", "glazing": 0.1}]}}})"));
  world.tick(30);
  EXPECT_EQ(world.node_error("s", "facade_style"), "");
  const Table& sides = world.table("house", "facade.by_orientation");
  const auto share = [&](const char* side) {
    const std::size_t row = sides.row_of("orientation", side);
    return sides.number(row, "glazed") / sides.number(row, "area");
  };
  EXPECT_NEAR(share("south"), 0.5, 1e-9);
  EXPECT_NEAR(share("north"), 0.1, 0.03);
  EXPECT_EQ(share("east"), 0);
  EXPECT_NE(world.text("house", "facade.message").find("no row of the style fits north_east, east"), std::string::npos);
}

TEST(FacadeStyle, AllSurfaceIsCountedAndTheTotalsAgree) {
  World world = World::from_file("scenes/nodes/facade_style.json");
  ASSERT_TRUE(world.settle());
  double area = 0, cost = 0, shared = 0;
  for (const char* id : {"flats_1", "flats_2", "corner", "offices"}) {
    const auto number = [&](const char* port) { return world.number(id, std::string("facade.") + port); };
    area += number("facade_area");
    cost += number("cost");
    shared += number("shared_area");
    EXPECT_GT(number("glazed_area"), 0) << id;
    EXPECT_NEAR(number("glazed_area") + number("opaque_area"), number("facade_area"), 1e-9 * number("facade_area")) << id;
    EXPECT_LT(number("facade_area") + number("roof_area") + number("shared_area"), world.number(id, "smart_volume.surface_area"));
    double neighbours = 0;
    const Table& table = world.table(id, "smart_volume.neighbours");
    for (std::size_t row = 0; row < table.rows.size(); ++row) neighbours += table.number(row, "area");
    EXPECT_NEAR(number("shared_area"), neighbours, 1e-6 * neighbours) << id << ": what neighbours cover is no façade";
  }
  EXPECT_GT(shared, 100);
  EXPECT_NEAR(world.number("brick", "facade_style.facade_area") + world.number("glass", "facade_style.facade_area"), area, 1e-9 * area);
  EXPECT_NEAR(world.number("brick", "facade_style.cost") + world.number("glass", "facade_style.cost"), cost, 1e-9 * cost);
}

TEST(FacadeStyle, OfTwoClaimsTheFirstHoldsAndTheOtherIsNamed) {
  World world = World::from_file("scenes/nodes/facade_style.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("corner", "facade.style_in_force"), "brick");
  EXPECT_EQ(world.text("corner", "facade.message"), "claimed by `glass` as well; `brick` holds, because it comes first by name");
  EXPECT_EQ(world.number("brick", "facade_style.count"), 3);
}

TEST(FacadeStyle, MoreGlassThanFitsIsMissingAndSaid) {
  World world = World::from_text(house_with(R"("style": ["s"], "glazing": 5)", R"({"id": "s", "types": {"facade_style": {"name": "s"}}})"));
  world.tick(30);
  EXPECT_NE(world.text("house", "facade.message").find("no room between sills and bands"), std::string::npos);
  EXPECT_LT(world.number("house", "facade.glazing_ratio"), 0.7);
}

TEST(FacadeStyle, TellsWhatIsNoOrientation) {
  World world = World::from_text(one_node("facade_style", R"("rows": [{"orientation": "nort"}])"));
  world.tick();
  EXPECT_NE(world.node_error("it", "facade_style").find("rows/0/orientation: `nort` is no orientation, did you mean `north`?"),
            std::string::npos)
      << world.node_error("it", "facade_style");
}

TEST(FacadeStyle, OfTwoStylesWithOneNameBothComplain) {
  World world = World::from_text(house_with(
      R"("style": ["s"])", R"({"id": "s1", "types": {"facade_style": {"name": "s"}}}, {"id": "s2", "types": {"facade_style": {"name": "s"}}})"));
  world.tick(10);
  for (const char* id : {"s1", "s2"})
    EXPECT_EQ(world.node_error(id, "facade_style"), "nodes/" + std::string(id) +
                                                        "/facade_style/name: `s1` and `s2` are both called `s`: give one of them "
                                                        "another name");
}

// A façade that names a style which may not dress it stands bare, whatever dressed it before, and says why.
TEST(FacadeStyle, AStyleThatMayNotDressAFacadeClearsIt) {
  const auto set = [](World& world, const char* node, const char* port, const char* value) {
    EXPECT_EQ(world.submit(command<SetPort>({.node = node, .port = {port}, .value = {value}})), "");
  };
  World world = World::from_file("scenes/nodes/facade_style.json");
  ASSERT_TRUE(world.settle());
  for (const char* only : {R"(["flats_1"])", R"(["corner"])"}) {
    set(world, "glass", "facade_style.volumes", R"(["flats_1"])");
    set(world, "brick", "facade_style.volumes", only);
    set(world, "offices", "facade.style", R"(["glass"])");
    world.tick(3);
    EXPECT_EQ(world.node_error("glass", "facade_style"), "");
    EXPECT_EQ(world.text("offices", "facade.style_in_force"), "");
    EXPECT_EQ(world.number("offices", "facade.facade_area"), 0);
    EXPECT_EQ(world.number("offices", "facade.cost"), 0);
    EXPECT_EQ(world.text("offices", "facade.message"),
              "`glass` is not allowed to dress it: add it to the `volumes` of that style");
  }
  set(world, "glass", "facade_style.volumes", R"({"typification": "facade"})");
  world.tick(1);
  EXPECT_EQ(world.node_error("glass", "facade_style"), "");
  EXPECT_EQ(world.text("offices", "facade.style_in_force"), "glass");
  EXPECT_GT(world.number("offices", "facade.facade_area"), 0);
}

}  // namespace
}  // namespace bl
