// Reads files through POSIX calls, whose errors say the cause.
#include "core/file/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>

#include "core/file/descriptor.h"

namespace bl {

namespace {

constexpr off_t kMostBytes = off_t{1} << 30;

// `path` names the file in messages.
Result<std::string> read_all(int file, const std::string& path, off_t most, const std::string& too_large) {
  std::string content;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(file, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return io_error(path, "cannot be read");
    if (count == 0) return content;
    content.append(buffer, static_cast<std::size_t>(count));
    if (content.size() > static_cast<std::size_t>(most)) return Error{ErrorCode::io, path, too_large};
  }
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) return io_error(path, "cannot be opened");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return io_error(path, "cannot be read");
  if (S_ISDIR(status.st_mode)) return Error{ErrorCode::io, path, "is a folder, not a file"};
  if (status.st_size > kMostBytes) return Error{ErrorCode::io, path, "is larger than 1 GiB"};
  return read_all(file.number(), path, kMostBytes, "is larger than 1 GiB");
}

Result<std::string> read_plain_file(const std::string& path, std::uintmax_t most) {
  // To open a pipe would wait for somebody who writes into it.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file.is_open()) return io_error(path, "cannot be opened");
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return io_error(path, "cannot be read");
  if (S_ISDIR(status.st_mode)) return Error{ErrorCode::io, path, "is a folder, not a file"};
  if (!S_ISREG(status.st_mode)) return Error{ErrorCode::io, path, "is a device or a pipe, not a file"};
  const std::string too_large = "is larger than the " + std::to_string(most >> 20) + " MiB that are read";
  if (static_cast<std::uintmax_t>(status.st_size) > most) return Error{ErrorCode::io, path, too_large};
  return read_all(file.number(), path, static_cast<off_t>(most), too_large);
}

}  // namespace bl
