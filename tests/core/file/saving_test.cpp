// Saving where others are at work: names that were guessed, links that were laid, rights, and what an interrupted save has left.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/file/log_writer.h"

namespace bl {
namespace {

namespace fs = std::filesystem;

class Saving : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& text) const {
    const int file = ::open(at(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ASSERT_GE(file, 0);
    ASSERT_EQ(::write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(file);
  }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  struct stat status(const std::string& name) const {
    struct stat status {};
    EXPECT_EQ(::lstat(at(name).c_str(), &status), 0) << name;
    return status;
  }

  fs::path folder_ = fs::temp_directory_path() / ("bl_saving_test_" + std::to_string(::getpid()));
};

TEST_F(Saving, NeverWritesThroughALinkUnderAGuessedName) {
  put("victim", "precious");
  // The name that older programs used can be guessed.
  fs::create_symlink(at("victim"), at("a.json.saving-" + std::to_string(::getpid())));
  ASSERT_TRUE(write_file(at("a.json"), "new").ok());
  EXPECT_EQ(*read_file(at("victim")), "precious");
  EXPECT_EQ(*read_file(at("a.json")), "new");
  EXPECT_FALSE(fs::is_symlink(at("a.json")));
}

TEST_F(Saving, KeepsModeAndGroupWhateverTheUsualRights) {
  const mode_t usual = ::umask(077);
  put("a.json", "old");
  ASSERT_EQ(::chmod(at("a.json").c_str(), 0664), 0);
  // As root any group will do; others have but their own.
  const gid_t group = ::geteuid() == 0 ? 4321 : ::getegid();
  ASSERT_EQ(::chown(at("a.json").c_str(), ::geteuid(), group), 0);
  const auto saved = write_file(at("a.json"), "new");
  const auto fresh = write_file(at("b.json"), "new");
  ::umask(usual);
  ASSERT_TRUE(saved.ok() && fresh.ok());
  EXPECT_EQ(status("a.json").st_mode & 07777, 0664u);
  EXPECT_EQ(status("a.json").st_gid, group);
  EXPECT_EQ(status("b.json").st_mode & 07777, 0600u) << "a new file has the usual rights";
}

// An access list as the kernel keeps it (version 2): what the owner, one other person, the group and everybody may do.
std::string access_list(std::uint16_t person, std::uint16_t group, std::uint16_t mask) {
  std::string list("\x02\0\0\0", 4);
  const auto add = [&list](std::uint16_t tag, std::uint16_t rights, std::uint32_t id) {
    for (const std::uint32_t half : {static_cast<std::uint32_t>(tag), static_cast<std::uint32_t>(rights), id, id >> 16})
      list += static_cast<char>(half & 0xff), list += static_cast<char>(half >> 8 & 0xff);
  };
  constexpr std::uint32_t kNobody = 0xffffffff;
  add(0x01, 6, kNobody);
  add(0x02, person, 4321);
  add(0x04, group, kNobody);
  add(0x10, mask, kNobody);
  add(0x20, 0, kNobody);
  return list;
}

std::string attribute(const std::string& path, const char* name) {
  std::string value(4096, '\0');
  const ssize_t size = ::getxattr(path.c_str(), name, value.data(), value.size());
  value.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return value;
}

// Whether the file could be given it; a file system without them has nothing to test.
bool give(const std::string& path, const char* name, const std::string& value) {
  return ::setxattr(path.c_str(), name, value.data(), value.size(), 0) == 0;
}

constexpr const char* kList = "system.posix_acl_access";

TEST_F(Saving, KeepsTheAccessList) {
  put("a.json", "old");
  const std::string list = access_list(6, 0, 6);
  if (!give(at("a.json"), kList, list)) GTEST_SKIP() << "no access lists here: " << std::strerror(errno);
  ASSERT_EQ(status("a.json").st_mode & 07777, 0660u) << "the group's bits are the mask";
  ASSERT_TRUE(write_file(at("a.json"), "new").ok());
  EXPECT_EQ(*read_file(at("a.json")), "new");
  EXPECT_EQ(attribute(at("a.json"), kList), list) << "the group of the file may do nothing still";
  EXPECT_EQ(status("a.json").st_mode & 07777, 0660u);
}

// A folder gives what is made in it a list: a file that had none gets none by being saved.
TEST_F(Saving, AListOfTheFolderIsForNewFilesAlone) {
  put("a.json", "old");
  if (!give(folder_.string(), "system.posix_acl_default", access_list(6, 6, 6)))
    GTEST_SKIP() << "no access lists here: " << std::strerror(errno);
  ASSERT_EQ(::chmod(at("a.json").c_str(), 0664), 0);
  ASSERT_TRUE(write_file(at("a.json"), "new").ok());
  ASSERT_TRUE(write_file(at("b.json"), "first").ok());
  EXPECT_EQ(attribute(at("a.json"), kList), "");
  EXPECT_EQ(status("a.json").st_mode & 07777, 0664u);
  EXPECT_NE(attribute(at("b.json"), kList), "");
}

TEST_F(Saving, KeepsWhatPeopleHaveNotedAtAFile) {
  put("a.json", "old");
  const std::string bytes("with\0zero", 9), large(2000, 'l');
  if (!give(at("a.json"), "user.origin", bytes)) GTEST_SKIP() << "no attributes here: " << std::strerror(errno);
  ASSERT_TRUE(give(at("a.json"), "user.large", large));
  ASSERT_TRUE(give(at("a.json"), "user.empty", ""));
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(write_file(at("a.json"), "new").ok());
    EXPECT_EQ(attribute(at("a.json"), "user.origin"), bytes);
    EXPECT_EQ(attribute(at("a.json"), "user.large"), large);
    EXPECT_EQ(::getxattr(at("a.json").c_str(), "user.empty", nullptr, 0), 0);
  }
}

TEST_F(Saving, FollowsLinksToTheirFileAlsoWhereItIsNotThereYet) {
  fs::create_directories(folder_ / "deep" / "er");
  put("deep/er/real.json", "old");
  fs::create_symlink("er/real.json", at("deep/link.json"));
  fs::create_symlink("deep/link.json", at("link.json"));
  fs::create_symlink("deep/er/later.json", at("dangling.json"));
  ASSERT_TRUE(write_file(at("link.json"), "new").ok());
  ASSERT_TRUE(write_file(at("dangling.json"), "first").ok());
  EXPECT_TRUE(fs::is_symlink(at("link.json")) && fs::is_symlink(at("deep/link.json")) && fs::is_symlink(at("dangling.json")));
  EXPECT_EQ(*read_file(at("deep/er/real.json")), "new");
  EXPECT_EQ(*read_file(at("deep/er/later.json")), "first");
  fs::create_symlink("round.json", at("round.json"));
  EXPECT_EQ(write_file(at("round.json"), "x").error().message, "cannot be written: Too many levels of symbolic links");
}

TEST_F(Saving, FollowsNoLinkThatSomebodyElseHasLaidInAFolderOfEverybodys) {
  put("victim", "precious");
  fs::create_directories(folder_ / "common");
  ASSERT_EQ(::chmod(at("common").c_str(), 01777), 0);
  fs::create_symlink(at("victim"), at("common/mine"));
  ASSERT_TRUE(write_file(at("common/mine"), "changed").ok()) << "one of our own is followed";
  EXPECT_EQ(*read_file(at("victim")), "changed");
  if (::geteuid() != 0) return;  // only root can lay a link for somebody else
  ASSERT_EQ(::chown(at("common").c_str(), 1234, 1234), 0);
  fs::create_symlink(at("victim"), at("common/theirs"));
  ASSERT_EQ(::lchown(at("common/theirs").c_str(), 4321, 4321), 0);
  const auto saved = write_file(at("common/theirs"), "stolen");
  ASSERT_FALSE(saved.ok());
  EXPECT_NE(saved.error().message.find("is a symbolic link of another user"), std::string::npos) << saved.error().message;
  LogWriter log;
  EXPECT_FALSE(log.open(at("common/theirs")).ok());
  EXPECT_EQ(*read_file(at("victim")), "changed");
}

TEST_F(Saving, ClearsWhatAnInterruptedSaveHasLeftAndNothingElse) {
  const std::string gone = "a.json.saving-abcdefghij0123456789", busy = "a.json.saving-zzzzzzzzzz0123456789";
  const std::vector<std::string> kept = {busy, "a.json.saving-notes",
                                         "a.json.saving-" + std::to_string(::getppid()),  // of an older program that runs
                                         "b.json.saving-abcdefghij0123456789"};
  for (const std::string& name : kept) put(name, "kept");
  for (const char* name : {"a.json.saving-999999999", "a.json"}) put(name, "old");
  put(gone, "half");
  fs::create_symlink("a.json", at("a.json.saving-llllllllll0123456789"));
  const int writing = ::open(at(busy).c_str(), O_WRONLY);
  ASSERT_EQ(::flock(writing, LOCK_EX), 0);
  ASSERT_TRUE(write_file(at("a.json"), "new").ok());
  ::close(writing);
  EXPECT_FALSE(fs::exists(at(gone)));
  EXPECT_FALSE(fs::exists(at("a.json.saving-999999999")));
  for (const std::string& name : kept) EXPECT_EQ(*read_file(at(name)), "kept") << name;
  EXPECT_TRUE(fs::is_symlink(at("a.json.saving-llllllllll0123456789")));
  EXPECT_EQ(*read_file(at("a.json")), "new");
}

TEST_F(Saving, TwoWhoSaveAtOnceLeaveOneWholeFile) {
  const std::string mine(40000, 'm'), yours(40000, 'y');
  const auto save = [&](const std::string& text) {
    for (int k = 0; k < 60; ++k) EXPECT_TRUE(write_file(at("a.json"), text).ok());
  };
  std::thread other([&] { save(yours); });
  save(mine);
  other.join();
  const std::string found = *read_file(at("a.json"));
  EXPECT_TRUE(found == mine || found == yours);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Saving, LongNamesHaveRoomForTheTemporaryOne) {
  const std::string name(250, 'n');
  ASSERT_TRUE(write_file(at(name), "one").ok());
  ASSERT_TRUE(write_file(at(name), "two").ok());
  EXPECT_EQ(*read_file(at(name)), "two");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Saving, AGrowingFileThatHasToBeNewIsNeverOneThatIsThere) {
  put("a.log", "precious");
  fs::create_symlink("a.log", at("link.log"));
  fs::create_symlink("nowhere", at("dangling.log"));
  for (const char* name : {"a.log", "link.log"}) {
    LogWriter log;
    const auto opened = log.open(at(name), true);
    ASSERT_FALSE(opened.ok()) << name;
    EXPECT_EQ(opened.error().code, ErrorCode::duplicate) << name;
  }
  EXPECT_EQ(*read_file(at("a.log")), "precious");
  LogWriter log;
  ASSERT_TRUE(log.open(at("fresh.log"), true).ok());
  log.write("line\n");
  ASSERT_TRUE(log.close().ok());
  EXPECT_EQ(*read_file(at("fresh.log")), "line\n");
  EXPECT_EQ(write_file(at(""), "x").error().message, "is a folder, not a file");
}

}  // namespace
}  // namespace bl
