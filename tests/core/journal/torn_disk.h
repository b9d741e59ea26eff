// A disk for SQLite, in memory, that keeps apart what was written and what was synced, and on which things go wrong.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/random.h"

struct sqlite3_vfs;

namespace bl::journal::test {

/// Files are known by their names. A sync makes one file durable, with its name. What was not synced when the power is cut may be
/// there, or not, sector by sector; the last of it is torn.
class TornDisk {
 public:
  explicit TornDisk(std::uint64_t seed);
  ~TornDisk();
  TornDisk(const TornDisk&) = delete;
  TornDisk& operator=(const TornDisk&) = delete;
  /// By which SQLite finds it.
  const std::string& name() const { return name_; }

  /// The power fails in the change (a write, a sync, a removal) after so many others: nothing can be read or written any more.
  void cut_after(std::int64_t changes);
  bool is_cut() const { return is_cut_; }
  /// What the disk holds after the cut becomes what is read.
  void power_on();

  enum class Fault : std::uint8_t { none, error, full };
  /// Of the calls after so many others, `count` fail: by an error of the disk, or because it is full. A sync that fails loses
  /// some of what it should have made durable, for ever, as on Linux.
  void fail_after(std::int64_t calls, std::int64_t count, Fault fault);
  void heal() { fault_ = Fault::none; }
  bool has_failed() const { return has_failed_; }
  /// Changes so far.
  std::int64_t changes() const { return changes_; }

  // For the functions that SQLite calls. A result is a code of SQLite.
  /// `is_with_folder`: as SQLite does it on Linux, the first sync of a new log also makes durable which files there are.
  int open(const std::string& path, bool may_create, bool is_with_folder);
  int remove(const std::string& path, bool is_durable);
  bool is_there(const std::string& path) const;
  int read(const std::string& path, char* bytes, std::size_t count, std::size_t offset);
  int write(const std::string& path, const char* bytes, std::size_t count, std::size_t offset);
  int truncate(const std::string& path, std::size_t size);
  int sync(const std::string& path);
  int size(const std::string& path, std::int64_t& size);

 private:
  struct Step {
    enum class Kind : std::uint8_t { write, resize, remove } kind = Kind::write;
    std::size_t offset = 0;  ///< or the new size
    std::string bytes;
  };
  struct File {
    bool is_there = false, is_there_durably = false, is_with_folder = false;
    std::string content, durable;
    std::vector<Step> steps;  ///< since the last sync
  };
  bool fails();
  bool is_dead();
  void sync_folder();
  void lay_down(File& file, bool is_torn);
  static void apply(File& file, const Step& step, std::size_t count);

  std::string name_;
  std::unique_ptr<sqlite3_vfs> vfs_;
  Random random_;
  std::map<std::string, File> files_;
  std::int64_t changes_ = 0, cut_at_ = -1;
  bool is_cut_ = false, has_failed_ = false;
  Fault fault_ = Fault::none;
  std::int64_t calls_until_fault_ = 0, faults_left_ = 0;
};

}  // namespace bl::journal::test
