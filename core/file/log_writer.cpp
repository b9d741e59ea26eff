// The log as a growing file.
#include "core/file/log_writer.h"

#include <cerrno>
#include <cstring>

#include "core/file/file_io.h"

namespace bl {

LogWriter::~LogWriter() {
  if (file_ != nullptr) std::fclose(file_);
}

Result<void> LogWriter::open(const std::string& path, bool must_be_new) {
  path_ = path;
  const auto opened = open_growing_file(path, must_be_new);
  if (!opened) return opened.error();
  file_ = *opened;
  return {};
}

void LogWriter::fail() { failure_ = std::string("the log cannot be written any further: ") + std::strerror(errno); }

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
