// The words for where a scene lies are the same in its settings and in what reads them.
#include "core/import/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/graph/scene.h"

namespace bl::importing {
namespace {

// Scenes with metres of their own carry the word, so that whoever reads the docs of the setting has to find it there.
TEST(LocalFrame, TheSettingOfAPlaceNamesItsWordForNone) {
  const PortDefinition* port = settings_type().find_port("coordinate_system");
  ASSERT_NE(port, nullptr);
  EXPECT_NE(port->doc.find("`" + std::string(kLocalCrs) + "`"), std::string::npos) << port->doc;
  EXPECT_EQ(tidy_crs_name("Local"), kLocalCrs);
}

// A scene without a coordinate system lies about its latitude and longitude, turned to its true north.
TEST(LocalFrame, LatitudeAndLongitudeAloneAreAPlace) {
  const GeoReference place{"", 0, 0, 52, 5, 30};
  const auto frame = LocalFrame::into("OGC:CRS84", place);
  ASSERT_TRUE(frame) << frame.error().text();
  EXPECT_EQ(frame->reference(), place);
  const Point3 origin = frame->to_local(5, 52);
  EXPECT_NEAR(origin.x, 0, 1e-6);
  EXPECT_NEAR(origin.y, 0, 1e-6);
  // A hundredth of a degree to the north at that latitude, by the meridional radius of curvature of WGS84.
  const double degree = std::numbers::pi / 180, e2 = 0.00669437999014, sine = std::sin(52.005 * degree);
  const double north = 0.01 * degree * 6378137 * (1 - e2) / std::pow(1 - e2 * sine * sine, 1.5);
  const Point3 there = frame->to_local(5, 52.01);
  EXPECT_NEAR(there.x, north * 0.5, 1e-3);
  EXPECT_NEAR(there.y, north * std::sqrt(0.75), 1e-3);
  const Point3 back = frame->from_local(there.x, there.y);
  EXPECT_NEAR(back.x, 5, 1e-11);
  EXPECT_NEAR(back.y, 52.01, 1e-11);
  // Whatever the coordinates of the file are.
  const auto dutch = LocalFrame::into("EPSG:28992", place);
  ASSERT_TRUE(dutch) << dutch.error().text();
  const Point3 corner = dutch->from_local(120, -40), again = dutch->to_local(corner.x, corner.y);
  EXPECT_NEAR(again.x, 120, 1e-3);
  EXPECT_NEAR(again.y, -40, 1e-3);
  // Metres of a model stay what they are, and scenes without any place take nothing else.
  const auto model = LocalFrame::into(kLocalCrs, place);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->to_local(3, 4), (Point3{3, 4, 0}));
  EXPECT_FALSE(LocalFrame::into("OGC:CRS84", {kLocalCrs, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace bl::importing
