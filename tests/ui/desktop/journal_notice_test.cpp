// People hear of a journal that cannot be written, and hear of it once.
#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/place/source_folder.h"
#include "tests/ui/desktop/null_desktop.h"

namespace bl::desktop {
namespace {

TEST(JournalNotice, PeopleHearOnceThatItCannotBeWritten) {
  NullDesktop desktop;
  setenv("XDG_STATE_HOME", "/dev/null", 1);  // no folder can be made in there
  Editor& editor = desktop.editor();
  ASSERT_TRUE(editor.open(test::source_folder() + "/scenes/start/quarter.json"));
  desktop.frames(2);
  const auto told = [&] {
    return std::count_if(editor.notices.begin(), editor.notices.end(),
                         [](const Notice& n) { return n.text.find("crash would lose your changes") != std::string::npos; });
  };
  EXPECT_EQ(told(), 1);
  editor.notices.clear();
  ASSERT_TRUE(editor.submit(command<RenameNode>({"library", "Reading room"})));
  desktop.frames(2);
  EXPECT_EQ(told(), 0);
  unsetenv("XDG_STATE_HOME");
}

}  // namespace
}  // namespace bl::desktop
