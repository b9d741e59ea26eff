// Writes the log of a run line by line, so that a crash loses none of the written lines.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

class LogWriter {
 public:
  LogWriter() = default;
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Empties an existing file, or refuses it as `duplicate` where the file must be new.
  Result<void> open(const std::string& path, bool must_be_new = false);
  bool is_open() const { return file_ != nullptr; }
  /// Writes a line and passes it to the system at once. The first failure is kept; nothing is written after it.
  void write(std::string_view lines);
  /// Why lines are missing; empty where none are.
  const std::string& failure() const { return failure_; }
  Result<void> close();

 private:
  void fail();
  std::FILE* file_ = nullptr;
  std::string path_, failure_;
};

}  // namespace bl
