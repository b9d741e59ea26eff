// A session file that repeats what is stored in another one, on another computer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/journal/database.h"

namespace bl::journal {

class Copy {
 public:
  /// A new file, or a copy of that room from before. Until it is closed, it is locked as a journal is.
  static Result<std::unique_ptr<Copy>> open(const std::string& path, std::int64_t opened_at);
  ~Copy();
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  /// All of the other file. Refused where this file has another room. On the disk when this returns, as is each change.
  Result<void> take(const std::string& bytes);
  /// A change of the other file, after all before it.
  Result<void> repeat(const std::string& changes);
  /// There is a room in it.
  bool is_of_use() const { return !room_.empty(); }
  Result<void> close();

 private:
  Copy(std::string path, Database database) : path_(std::move(path)), database_(std::move(database)) {}
  Result<void> prepare(std::int64_t opened_at);

  std::string path_;
  Database database_;
  std::string room_;  // its code, and when it was made
  bool is_held_ = false;
};

}  // namespace bl::journal
