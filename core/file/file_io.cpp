// Files through the POSIX calls, whose errors can be told apart.
#include "core/file/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

namespace bl {

namespace {

constexpr off_t kMostBytes = off_t{1} << 30;

Error io_error(const std::string& path, const std::string& what) {
  return {ErrorCode::io, path, what + ": " + std::strerror(errno)};
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  int release_and_close() {
    const int n = number_;
    number_ = -1;
    return ::close(n);
  }

 private:
  int number_;
};

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

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

Result<void> write_file(const std::string& path, std::string_view content) {
  // A link is followed, so that saving through it keeps it a link.
  std::string target = path;
  if (char* real = ::realpath(path.c_str(), nullptr)) {
    target = real;
    ::free(real);
  }
  struct stat status {};
  const bool is_there = ::stat(target.c_str(), &status) == 0;
  if (is_there && !S_ISREG(status.st_mode)) {
    // Devices and pipes cannot be renamed over: written as they are.
    const Descriptor device(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
    if (!device.is_open() || !write_all(device.number(), content)) return io_error(path, "cannot be written");
    return {};
  }
  const std::string temporary = target + ".saving-" + std::to_string(::getpid());
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, is_there ? (status.st_mode & 0777) : 0666));
  if (!file.is_open()) return io_error(path, "cannot be written");
  const bool is_written = write_all(file.number(), content) && ::fsync(file.number()) == 0 && file.release_and_close() == 0 &&
                          ::rename(temporary.c_str(), target.c_str()) == 0;
  if (is_written) return {};
  const Error error = io_error(path, is_there ? "could not be saved, the old file is unchanged" : "could not be saved");
  ::unlink(temporary.c_str());
  return error;
}

}  // namespace bl
