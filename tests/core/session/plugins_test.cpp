// What is refused as a plugin before any of its code runs. Building and loading one: tests/links/plugin_test.sh.
#include "core/session/types/plugins.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include "core/file/file_io.h"

namespace bl {
namespace {

class Plugins : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& bytes) {
    const std::string path = (folder_ / name).string();
    EXPECT_TRUE(write_file(path, bytes).ok());
    return path;
  }
  std::string refusal(const std::string& name, const std::string& bytes) {
    Registry registry;
    const PluginReport report = load_plugin(registry, file(name, bytes));
    EXPECT_TRUE(report.types.empty());
    return report.error ? report.error->message : "";
  }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("bl_plugins_" + std::to_string(::getpid()));
};

TEST_F(Plugins, OthersAreRefusedByTheirBytes) {
  EXPECT_NE(refusal("none.so", "").find("no plugin of BehaviourLinks"), std::string::npos);
  EXPECT_NE(refusal("noise.so", std::string("\x7f"
                                            "ELF\x02\x01\x01 and so on",
                                            17))
                .find("no plugin of BehaviourLinks"),
            std::string::npos);
  const std::string mark = std::string("BEHAVIOURLINKS-PLUGIN-") + "ABI:";
  EXPECT_NE(refusal("old.so", "ELF" + mark + "declarations 000, GNU 4.8" + std::string(1, '\0') + "rest")
                .find("built for another program (declarations 000, GNU 4.8), this one is "),
            std::string::npos);
  EXPECT_NE(refusal("cut.so", "ELF" + mark + plugin_abi() + std::string(1, '\0')).find("cannot be opened"), std::string::npos);
}

TEST_F(Plugins, FoldersAreReadInAscendingName) {
  file("b.so", "x"), file("a.so", "x"), file("readme.txt", "x");
  Registry registry;
  const auto reports = load_plugins(registry, folder_.string());
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_TRUE(reports[0].file.ends_with("a.so"));
  EXPECT_NE(load_plugins(registry, (folder_ / "nowhere").string()).front().error->message.find("no folder of plugins"),
            std::string::npos);
}

}  // namespace
}  // namespace bl
