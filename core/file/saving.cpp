// Writes a file beside the old one under a random name, flushes it to the disk, then renames it.
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <memory>
#include <string>

#include "core/file/descriptor.h"
#include "core/file/file_io.h"
#include "core/file/private_file.h"

namespace bl {

namespace {

constexpr int kMostLinks = 40, kMostTries = 100;
constexpr std::string_view kSavingMark = ".saving-";
constexpr std::string_view kMarkDigits = "abcdefghijklmnopqrstuvwxyz0123456789";
constexpr std::size_t kMarkLength = 20;    // 36^20 names
constexpr std::size_t kLongestStem = 200;  // a name has room for 255 bytes
constexpr const char* kAccessList = "system.posix_acl_access";
constexpr std::string_view kOwnAttributes = "user.";

// A place in an open folder, so that nobody can put another folder under the path meanwhile.
struct SavePlace {
  Descriptor folder;
  std::string folder_path, name;
  bool is_there = false;
  struct stat status {};  // of the file, where it is there

  // Of the temporary files for this one.
  std::string mark() const { return name.substr(0, kLongestStem) + std::string(kSavingMark); }
};

// In a folder where everybody may write, a link of somebody else's may lead to any file of ours; the kernel follows none there,
// either.
bool is_laid_by_others(int folder, const struct stat& link) {
  struct stat status {};
  if (::fstat(folder, &status) != 0) return true;
  const bool is_common = (status.st_mode & S_ISVTX) != 0 && (status.st_mode & S_IWOTH) != 0;
  return is_common && link.st_uid != ::geteuid() && link.st_uid != status.st_uid;
}

// Follows links by hand up to the file that they mean, which need not be there.
Result<SavePlace> place_to_save(const std::string& path) {
  std::string now = path;
  for (int links = 0; links < kMostLinks; ++links) {
    const std::size_t slash = now.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : slash == 0 ? "/" : now.substr(0, slash);
    SavePlace place{Descriptor(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)), folder,
                    slash == std::string::npos ? now : now.substr(slash + 1)};
    if (!place.folder.is_open()) return io_error(path, "cannot be written");
    if (place.name.empty()) return Error{ErrorCode::io, path, "is a folder, not a file"};
    place.is_there = ::fstatat(place.folder.number(), place.name.c_str(), &place.status, AT_SYMLINK_NOFOLLOW) == 0;
    if (!place.is_there && errno != ENOENT) return io_error(path, "cannot be written");
    if (!place.is_there || !S_ISLNK(place.status.st_mode)) return place;
    if (is_laid_by_others(place.folder.number(), place.status))
      return Error{ErrorCode::io, path,
                   "is a symbolic link of another user in a folder that everybody can write to, and is not followed; choose "
                   "another place"};
    std::array<char, 4096> text;
    const ssize_t length = ::readlinkat(place.folder.number(), place.name.c_str(), text.data(), text.size());
    if (length <= 0) return io_error(path, "cannot be written");
    const std::string target(text.data(), static_cast<std::size_t>(length));
    now = target.front() == '/' ? target : folder + "/" + target;
  }
  errno = ELOOP;
  return io_error(path, "cannot be written");
}

// The same, where no folder has that name.
Result<SavePlace> place_to_file(const std::string& path) {
  auto place = place_to_save(path);
  if (!place || !place->is_there || !S_ISDIR(place->status.st_mode)) return place;
  errno = EISDIR;
  return io_error(path, "cannot be written");
}

// Devices and pipes cannot be renamed over: they are written as they are. Their links may lead to no path (/dev/stdout).
bool is_device(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Nothing where the system has no chance to give.
std::string unguessable_name() {
  std::string name;
  while (name.size() < kMarkLength) {
    unsigned char byte = 0;
    const ssize_t count = ::getrandom(&byte, 1, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count != 1) return "";
    if (byte < 252) name += kMarkDigits[byte % 36];  // 252 = 7 · 36: every digit is as likely
  }
  return name;
}

struct Temporary {
  Descriptor file;
  std::string name;
};

// A file of our own, locked for as long as we write it: that tells it from what a program that is gone has left. Old rights come
// later, so that nobody reads along before.
Result<Temporary> new_temporary(const SavePlace& place, const std::string& path, bool is_private = false) {
  for (int tries = 0; tries < kMostTries; ++tries) {
    const std::string digits = unguessable_name();
    if (digits.empty()) return io_error(path, "cannot be written");
    Temporary made{
        Descriptor(::openat(place.folder.number(), (place.mark() + digits).c_str(),
                            O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, place.is_there || is_private ? 0600 : 0666)),
        place.mark() + digits};
    if (!made.file.is_open() && errno == EEXIST) continue;
    if (!made.file.is_open()) return io_error(path, "cannot be written");
    // Somebody who clears up may have come in between.
    struct stat status {};
    const bool is_taken = ::flock(made.file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_taken && ::fstat(made.file.number(), &status) == 0 && status.st_nlink > 0) return made;
  }
  errno = EEXIST;
  return io_error(path, "cannot be written");
}

// What `get` gives where it is asked for its size first; empty where there is nothing, or nothing of the kind here.
template <class Get>
std::string attribute_bytes(const Get& get) {
  const ssize_t size = get(nullptr, 0);
  if (size <= 0) return "";
  std::string bytes(static_cast<std::size_t>(size), '\0');
  const ssize_t read = get(bytes.data(), bytes.size());
  bytes.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
  return bytes;
}

std::string attribute_of(int file, const char* name) {
  return attribute_bytes([&](char* room, std::size_t size) { return ::fgetxattr(file, name, room, size); });
}

// Whether the access list of the file that is replaced holds for the new one as well: also where there is none, although the
// folder has given one to the new file.
bool keep_access_list(int file, int old) {
  const std::string list = attribute_of(old, kAccessList);
  if (!list.empty()) return ::fsetxattr(file, kAccessList, list.data(), list.size(), 0) == 0;
  return attribute_of(file, kAccessList).empty() || ::fremovexattr(file, kAccessList) == 0;
}

// What people and their programs have noted at the file. A note that does not come along is no reason not to save.
void keep_attributes(int file, int old) {
  const std::string names = attribute_bytes([old](char* room, std::size_t size) { return ::flistxattr(old, room, size); });
  for (std::size_t at = 0; at < names.size(); at += std::char_traits<char>::length(names.c_str() + at) + 1) {
    const char* name = names.c_str() + at;
    if (!std::string_view(name).starts_with(kOwnAttributes)) continue;
    const std::string value = attribute_of(old, name);
    (void)::fsetxattr(file, name, value.data(), value.size(), 0);
  }
}

// Mode, group, access list and attributes of the file that is replaced, its owner where we may. With a list, the group's bits of
// the mode are the most that anybody named in it may do: where list or group cannot be kept, the group that has the file now gets
// no more than everybody. File systems without rights have nothing to keep.
void keep_rights(int file, const SavePlace& place) {
  const struct stat& old = place.status;
  struct stat now {};
  if (::fstat(file, &now) != 0) return;
  mode_t mode = old.st_mode & 07777;
  const uid_t owner = ::geteuid() == 0 ? old.st_uid : now.st_uid;
  const bool is_other = now.st_gid != old.st_gid || now.st_uid != owner;
  bool is_group_kept = !is_other || ::fchown(file, owner, old.st_gid) == 0;
  const Descriptor before(
      ::openat(place.folder.number(), place.name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (before.is_open()) {
    if (is_group_kept) is_group_kept = keep_access_list(file, before.number());
    keep_attributes(file, before.number());
  }
  if (!is_group_kept) mode = (mode & 0707) | ((mode & 07) << 3);
  (void)::fchmod(file, mode);
}

bool is_running(std::string_view digits) {
  long process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);
  return process > 0 && (::kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM);
}

// Of this file, by a save that came to no end: our own, and nobody writes it any more. Older programs put their process number
// at the end, and took no lock.
void clear_leftover(int folder, const std::string& name, std::string_view digits) {
  const bool is_older =
      !digits.empty() && digits.size() <= 10 && digits.find_first_not_of("0123456789") == std::string_view::npos;
  const bool is_ours = digits.size() == kMarkLength && digits.find_first_not_of(kMarkDigits) == std::string_view::npos;
  if (!is_older && !is_ours) return;
  struct stat status {};
  if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return;
  if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid() || (is_older && is_running(digits))) return;
  const Descriptor file(::openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.is_open() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0) ::unlinkat(folder, name.c_str(), 0);
}

void clear_leftovers(const SavePlace& place) {
  const int folder = ::openat(place.folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // it may be written but not looked into
  DIR* list = ::fdopendir(folder);
  if (list == nullptr) {
    ::close(folder);
    return;
  }
  const std::string mark = place.mark();
  while (const dirent* item = ::readdir(list)) {
    const std::string name = item->d_name;
    if (name.starts_with(mark)) clear_leftover(folder, name, std::string_view(name).substr(mark.size()));
  }
  ::closedir(list);
}

// A new name is on the disk only once its folder is.
Result<void> sync_folder(const SavePlace& place, const std::string& path) {
  const Descriptor folder(::openat(place.folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const bool is_failing =
      folder.is_open() && ::fsync(folder.number()) != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT);
  if (is_failing) return io_error(path, "is written, but the disk did not confirm it");
  return {};
}

Result<void> write_whole_file(const std::string& path, std::string_view content, bool is_private) {
  if (is_device(path)) {
    const Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (!device.is_open() || !write_all(device.number(), content)) return io_error(path, "cannot be written");
    return {};
  }
  const auto place = place_to_file(path);
  if (!place) return place.error();
  clear_leftovers(*place);
  const auto made = new_temporary(*place, path, is_private);
  if (!made) return made.error();
  const int folder = place->folder.number(), file = made->file.number();
  if (place->is_there && !is_private) keep_rights(file, *place);
  const bool is_written =
      write_all(file, content) && ::fsync(file) == 0 && ::renameat(folder, made->name.c_str(), folder, place->name.c_str()) == 0;
  if (is_written) return sync_folder(*place, path);
  const Error error = io_error(path, place->is_there ? "could not be saved, the old file is unchanged" : "could not be saved");
  ::unlinkat(folder, made->name.c_str(), 0);
  return error;
}

}  // namespace

Result<void> may_write_file(const std::string& path) {
  // What takes it as it comes is not opened for nothing: a pipe would tell its reader that all is over.
  if (is_device(path)) return {};
  const auto place = place_to_file(path);
  if (!place) return place.error();
  const auto made = new_temporary(*place, path);
  if (!made) return made.error();
  ::unlinkat(place->folder.number(), made->name.c_str(), 0);
  return {};
}

Result<void> write_file(const std::string& path, std::string_view content) { return write_whole_file(path, content, false); }

Result<void> write_private_file(const std::string& path, std::string_view content) {
  return write_whole_file(path, content, true);
}

Result<std::FILE*> open_growing_file(const std::string& path, bool must_be_new) {
  int number = -1;
  constexpr int kFlags = O_WRONLY | O_CLOEXEC | O_NOCTTY;
  if (is_device(path) && !must_be_new) {
    number = ::open(path.c_str(), kFlags);
  } else {
    const auto place = place_to_save(path);
    if (!place) return place.error();
    number = ::openat(place->folder.number(), place->name.c_str(),
                      kFlags | O_CREAT | O_NOFOLLOW | (must_be_new ? O_EXCL : O_TRUNC), 0666);
  }
  Descriptor file(number);
  if (!file.is_open() && errno == EEXIST) return Error{ErrorCode::duplicate, path, "exists already"};
  std::FILE* stream = file.is_open() ? ::fdopen(file.number(), "w") : nullptr;
  if (stream == nullptr) return io_error(path, "cannot be written");
  (void)file.release();
  return stream;
}

Result<std::FILE*> open_private_log(const std::string& path) {
  const auto place = place_to_save(path);
  if (!place) return place.error();
  Descriptor file(::openat(place->folder.number(), place->name.c_str(),
                           O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NOCTTY, 0600));
  if (!file.is_open()) return io_error(path, "cannot be written");
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return Error{ErrorCode::duplicate, path, "is in use"};
  (void)::fchmod(file.number(), 0600);  // file systems without rights have none to set
  std::FILE* stream = ::fdopen(file.number(), "a+");
  if (stream == nullptr) return io_error(path, "cannot be written");
  (void)file.release();
  return stream;
}

}  // namespace bl
