// The words for where a scene lies are the same in its settings and in what reads them.
#include "core/import/local_frame.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace bl::importing
