// The log as a growing file.
#include "core/file/log_writer.h"

#include <cerrno>
#include <cstring>

namespace bl {

LogWriter::~LogWriter() {
  if (file_ != nullptr) std::fclose(file_);
}

Result<void> LogWriter::open(const std::string& path) {
  path_ = path;
  file_ = std::fopen(path.c_str(), "we");
  if (file_ == nullptr) return Error{ErrorCode::io, path, std::string("cannot be written: ") + std::strerror(errno)};
  return {};
}

void LogWriter::fail() { failure_ = std::string("the log ends early, it cannot be written: ") + std::strerror(errno); }

void LogWriter::write(std::string_view lines) {
  if (file_ == nullptr || !failure_.empty()) return;
  if (std::fwrite(lines.data(), 1, lines.size(), file_) != lines.size() || std::fflush(file_) != 0) fail();
}

Result<void> LogWriter::close() {
  if (file_ == nullptr) return {};
  if (std::fclose(file_) != 0 && failure_.empty()) fail();
  file_ = nullptr;
  if (!failure_.empty()) return Error{ErrorCode::io, path_, failure_};
  return {};
}

}  // namespace bl
