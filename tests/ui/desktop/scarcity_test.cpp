// Where memory runs out, the window ends with a sentence and loses nothing; where it can go on, it does.
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/base/scarcity.h"
#include "core/file/file_io.h"
#include "core/host/journal.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/sanitized.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/shell/window.h"

namespace bl::desktop {
namespace {

// No more address space than there is now, and a little.
void allow_only(std::size_t more) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{bytes, bytes};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
}

// As `main` runs the window: nobody catches what a frame throws. The folder is that of the person.
void work_until_memory_ends(const std::string& folder) noexcept {
  prepare_for_scarcity(kComfort);
  NullDesktop desktop;
  setenv("XDG_STATE_HOME", folder.c_str(), 1);
  desktop.editor().open(test::source_folder() + "/scenes/start/quarter.json");
  desktop.editor().submit(command<RenameNode>({"library", "Kept by the journal"}));
  desktop.frames(2);
  allow_only(std::size_t{48} << 20);
  std::vector<std::string> hoard;
  for (;;) hoard.emplace_back(std::size_t{1} << 20, 'x');
}

TEST(WindowScarcity, MemoryThatRunsOutInAFrameEndsInASentenceAndKeepsTheJournal) {
  if (test::kIsSanitized) GTEST_SKIP() << "sanitizers need more address space than any limit leaves";
  const std::string folder = ::testing::TempDir() + "scarce-" + std::to_string(getpid());
  EXPECT_EXIT(work_until_memory_ends(folder), ::testing::ExitedWithCode(1),
              "behaviourlinks: memory ran out: .*Your changes since the last save are kept");
  std::size_t kept = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/behaviourlinks/journals"))
    kept += read_file(entry.path().string()).value().find("Kept by the journal") != std::string::npos ? 1 : 0;
  EXPECT_EQ(kept, 1u);
  std::filesystem::remove_all(folder);
}

// A scene that is too large for the machine is a problem of its file: the scene that is open stays.
void open_more_than_there_is_room_for(const std::string& path) {
  prepare_for_scarcity(kComfort);
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.frames(2);
  allow_only(std::size_t{64} << 20);
  const bool is_open = desktop.editor().open(path);
  const auto& problems = desktop.editor().problems;
  const bool is_told = problems.size() == 1 && problems.front().error.message.find("memory ran out") != std::string::npos;
  const bool is_kept = desktop.editor().scene().nodes.contains("library");
  std::_Exit(is_open ? 3 : !is_told ? 4 : !is_kept ? 5 : 0);
}

TEST(WindowScarcity, AFileThatIsTooLargeLeavesTheOpenSceneAlone) {
  if (test::kIsSanitized) GTEST_SKIP() << "sanitizers need more address space than any limit leaves";
  const std::string path = ::testing::TempDir() + "too_large-" + std::to_string(getpid()) + ".json";
  std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [)";
  for (int k = 0; k < 200000; ++k)
    text += (k > 0 ? "," : "") + std::string(R"({"id": "n)") + std::to_string(k) + R"(", "types": {"smart_volume": {}}})";
  ASSERT_TRUE(write_file(path, text + "]}").ok());
  EXPECT_EXIT(open_more_than_there_is_room_for(path), ::testing::ExitedWithCode(0), "");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace bl::desktop
