// Media: sizes by hand, and what is said of pictures that may not be shown.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World media(const std::string& ports) {
  World world = World::from_text(one_node("media", R"("file": "a.jpg", "pixel_width": 400, "pixel_height": 200)" + ports));
  world.tick();
  EXPECT_EQ(world.node_error("it", "media"), "");
  return world;
}

TEST(Media, HeightFollowsThePixels) {
  World flat = media(R"(, "size": 30, "consent": "given")"), turned = media(R"(, "size": 30, "orientation": 6, "consent": "given")");
  EXPECT_EQ(flat.number("it", "media.height"), 15);
  EXPECT_EQ(turned.number("it", "media.height"), 60) << "lying on its side it stands upright for people";
  EXPECT_EQ(flat.text("it", "media.message"), "");
}

TEST(Media, ACameraSeesItsAngleAcrossItsPlane) {
  World world = media(R"(, "placement": "camera", "distance": 10, "field_of_view": 90, "consent": "not_needed")");
  EXPECT_NEAR(world.number("it", "media.width"), 20, 1e-12);
  EXPECT_NEAR(world.number("it", "media.height"), 10, 1e-12);
}

TEST(Media, WithoutConsentItIsVeiledAndSaysSo) {
  World unknown = media(""), refused = media(R"(, "consent": "refused")"), given = media(R"(, "consent": "given")");
  EXPECT_EQ(unknown.number("it", "media.is_free"), 0);
  EXPECT_NE(unknown.text("it", "media.message").find("set `consent`"), std::string::npos);
  EXPECT_EQ(refused.number("it", "media.is_free"), 0);
  EXPECT_EQ(given.number("it", "media.is_free"), 1);
}

TEST(Media, WithoutAFileItSaysSo) {
  World world = World::from_text(one_node("media", ""));
  world.tick();
  EXPECT_NE(world.text("it", "media.message").find("no file"), std::string::npos);
}

TEST(Media, SceneSettles) {
  World world = World::from_file("scenes/nodes/media.json");
  EXPECT_TRUE(world.settle());
  EXPECT_EQ(world.number("board", "media.height"), 10);
  EXPECT_EQ(world.number("veiled", "media.is_free"), 0);
}

}  // namespace
}  // namespace bl
