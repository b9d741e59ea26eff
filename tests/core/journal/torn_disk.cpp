// The disk, and the table of functions by which SQLite calls it.
#include "tests/core/journal/torn_disk.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace bl::journal::test {

namespace {

constexpr std::size_t kSector = 512;  // [bytes]

// What SQLite lays out for an open file: its own part, then ours.
struct OpenFile {
  sqlite3_file base;
  TornDisk* disk;
  std::string* path;
};

OpenFile& open_file(sqlite3_file* file) { return *reinterpret_cast<OpenFile*>(file); }

int close_file(sqlite3_file* file) {
  delete open_file(file).path;
  return SQLITE_OK;
}
int read_file(sqlite3_file* file, void* bytes, int count, sqlite3_int64 offset) {
  auto& own = open_file(file);
  return own.disk->read(*own.path, static_cast<char*>(bytes), static_cast<std::size_t>(count), static_cast<std::size_t>(offset));
}
int write_file(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset) {
  auto& own = open_file(file);
  return own.disk->write(*own.path, static_cast<const char*>(bytes), static_cast<std::size_t>(count),
                         static_cast<std::size_t>(offset));
}
int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  auto& own = open_file(file);
  return own.disk->truncate(*own.path, static_cast<std::size_t>(size));
}
int sync_file(sqlite3_file* file, int) {
  auto& own = open_file(file);
  return own.disk->sync(*own.path);
}
int size_of_file(sqlite3_file* file, sqlite3_int64* size) {
  auto& own = open_file(file);
  std::int64_t found = 0;
  const int code = own.disk->size(*own.path, found);
  *size = found;
  return code;
}
// One process at a time: locks are always free.
int lock(sqlite3_file*, int) { return SQLITE_OK; }
int check_lock(sqlite3_file*, int* is_reserved) {
  *is_reserved = 0;
  return SQLITE_OK;
}
int control(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int sector_size(sqlite3_file*) { return kSector; }
// As SQLite takes it for granted of disks: a write changes no byte beside it.
int characteristics(sqlite3_file*) { return SQLITE_IOCAP_POWERSAFE_OVERWRITE; }

const sqlite3_io_methods kMethods = {1,       close_file, read_file,  write_file, truncate_file, sync_file,       size_of_file,
                                     lock,    lock,       check_lock, control,    sector_size,   characteristics, nullptr,
                                     nullptr, nullptr,    nullptr,    nullptr,    nullptr};

TornDisk& disk_of(sqlite3_vfs* vfs) { return *static_cast<TornDisk*>(vfs->pAppData); }

int open_by_name(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* flags_out) {
  auto& own = open_file(file);
  own.base.pMethods = nullptr;
  // Files without a name hold what is rebuilt; ours is rebuilt in memory.
  if (name == nullptr) return SQLITE_CANTOPEN;
  const int code = disk_of(vfs).open(name, (flags & SQLITE_OPEN_CREATE) != 0, (flags & SQLITE_OPEN_MAIN_DB) == 0);
  if (code != SQLITE_OK) return code;
  own.disk = &disk_of(vfs);
  own.path = new std::string(name);
  own.base.pMethods = &kMethods;
  if (flags_out != nullptr) *flags_out = flags;
  return SQLITE_OK;
}
int remove_by_name(sqlite3_vfs* vfs, const char* name, int is_durable) { return disk_of(vfs).remove(name, is_durable != 0); }
int access_by_name(sqlite3_vfs* vfs, const char* name, int, int* is_allowed) {
  *is_allowed = disk_of(vfs).is_there(name) ? 1 : 0;
  return SQLITE_OK;
}
int full_name(sqlite3_vfs*, const char* name, int count, char* full) {
  sqlite3_snprintf(count, full, "%s", name);
  return SQLITE_OK;
}
int randomness(sqlite3_vfs*, int count, char* bytes) {
  // The salts of a log behind each other have to differ, and need no more.
  static Random random(20);
  for (int k = 0; k < count; ++k) bytes[k] = static_cast<char>(random.bits());
  return count;
}
int pause(sqlite3_vfs*, int microseconds) { return microseconds; }
int moment(sqlite3_vfs*, double* days) {
  *days = 2460000.5;
  return SQLITE_OK;
}

}  // namespace

TornDisk::TornDisk(std::uint64_t seed) : vfs_(std::make_unique<sqlite3_vfs>()), random_(seed) {
  static int number = 0;
  name_ = "torn-disk-" + std::to_string(++number);
  *vfs_ = {};
  vfs_->iVersion = 1;
  vfs_->szOsFile = sizeof(OpenFile);
  vfs_->mxPathname = 512;
  vfs_->zName = name_.c_str();
  vfs_->pAppData = this;
  vfs_->xOpen = open_by_name;
  vfs_->xDelete = remove_by_name;
  vfs_->xAccess = access_by_name;
  vfs_->xFullPathname = full_name;
  vfs_->xRandomness = randomness;
  vfs_->xSleep = pause;
  vfs_->xCurrentTime = moment;
  sqlite3_vfs_register(vfs_.get(), 0);
}

TornDisk::~TornDisk() { sqlite3_vfs_unregister(vfs_.get()); }

void TornDisk::cut_after(std::int64_t changes) { cut_at_ = changes_ + changes; }

// A change begins: is the power gone, or does it go now?
bool TornDisk::is_dead() {
  if (!is_cut_ && changes_++ == cut_at_) is_cut_ = true;
  return is_cut_;
}

void TornDisk::fail_after(std::int64_t calls, std::int64_t count, Fault fault) {
  calls_until_fault_ = calls;
  faults_left_ = count;
  fault_ = fault;
  has_failed_ = false;
}

bool TornDisk::fails() {
  if (fault_ == Fault::none || --calls_until_fault_ >= 0) return false;
  if (faults_left_-- <= 0) return false;
  has_failed_ = true;
  return true;
}

// On the disk itself: the first `count` bytes of what was written, or all of another step.
void TornDisk::apply(File& file, const Step& step, std::size_t count) {
  if (step.kind == Step::Kind::remove) {
    file.durable.clear();
    file.is_there_durably = false;
  } else if (step.kind == Step::Kind::resize) {
    file.durable.resize(step.offset);
    file.is_there_durably = true;
  } else {
    file.durable.resize(std::max(file.durable.size(), step.offset + count));
    std::copy_n(step.bytes.begin(), count, file.durable.begin() + static_cast<std::ptrdiff_t>(step.offset));
    file.is_there_durably = true;
  }
}

// What of the steps the disk has done by the time that it stops: none; or all of them up to one, or all; or some sectors of each,
// as the disk has sorted them.
void TornDisk::lay_down(File& file, bool is_torn) {
  const std::uint64_t manner = random_.below(5);
  const std::size_t count = file.steps.size(), end = manner == 0 ? 0 : manner == 1 ? random_.below(count + 1) : count;
  const double share = manner < 3 ? 1 : random_.uniform();
  is_torn = is_torn && random_.below(2) == 0;
  for (std::size_t k = 0; k < end; ++k) {
    const Step& step = file.steps[k];
    if (step.kind != Step::Kind::write) {
      // A file that was removed, and was not after all, is not the one that was written then.
      const bool is_done = random_.uniform() < share;
      if (is_done) apply(file, step, 0);
      else if (step.kind == Step::Kind::remove) break;
      continue;
    }
    for (std::size_t at = 0; at < step.bytes.size();) {
      const std::size_t piece = std::min(kSector - (step.offset + at) % kSector, step.bytes.size() - at);
      const bool is_last = k + 1 == end && at + piece == step.bytes.size();
      if (random_.uniform() < share)
        apply(file, {Step::Kind::write, step.offset + at, step.bytes.substr(at, piece)},
              is_torn && is_last ? random_.below(piece) : piece);
      at += piece;
    }
  }
  file.steps.clear();
}

void TornDisk::power_on() {
  for (auto& [path, file] : files_) {
    lay_down(file, true);
    file.content = file.durable;
    file.is_there = file.is_there_durably;
  }
  is_cut_ = false;
  cut_at_ = -1;
}

int TornDisk::open(const std::string& path, bool may_create, bool is_with_folder) {
  File& file = files_[path];
  if (is_cut_ || (!file.is_there && !may_create)) return SQLITE_CANTOPEN;
  if (!file.is_there) {
    file.is_there = true;
    file.content.clear();
  }
  file.is_with_folder = is_with_folder && may_create;
  return SQLITE_OK;
}

int TornDisk::remove(const std::string& path, bool is_durable) {
  File& file = files_[path];
  if (is_dead()) return SQLITE_IOERR_DELETE;
  if (!file.is_there) return SQLITE_IOERR_DELETE_NOENT;
  if (fails()) return SQLITE_IOERR_DELETE;
  file.is_there = false;
  file.content.clear();
  file.steps.push_back({Step::Kind::remove, 0, {}});
  if (is_durable) {
    apply(file, file.steps.back(), 0);
    file.steps.clear();
  }
  return SQLITE_OK;
}

bool TornDisk::is_there(const std::string& path) const {
  const auto found = files_.find(path);
  return found != files_.end() && found->second.is_there && !found->second.content.empty();
}

int TornDisk::read(const std::string& path, char* bytes, std::size_t count, std::size_t offset) {
  const File& file = files_[path];
  if (is_cut_ || (fault_ == Fault::error && fails())) return SQLITE_IOERR_READ;
  const std::size_t there = offset < file.content.size() ? std::min(count, file.content.size() - offset) : 0;
  std::copy_n(file.content.begin() + static_cast<std::ptrdiff_t>(std::min(offset, file.content.size())), there, bytes);
  std::memset(bytes + there, 0, count - there);
  return there == count ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
}

int TornDisk::write(const std::string& path, const char* bytes, std::size_t count, std::size_t offset) {
  File& file = files_[path];
  const bool was_cut = is_cut_, is_now_dead = is_dead();
  if (was_cut) return SQLITE_IOERR_WRITE;
  const bool is_refused = !is_now_dead && fails();
  // Of a write that fails a part is done.
  const std::size_t done = is_refused ? random_.below(count + 1) : count;
  file.content.resize(std::max(file.content.size(), offset + done));
  std::copy_n(bytes, done, file.content.begin() + static_cast<std::ptrdiff_t>(offset));
  file.steps.push_back({Step::Kind::write, offset, std::string(bytes, done)});
  if (is_now_dead) return SQLITE_IOERR_WRITE;
  if (!is_refused) return SQLITE_OK;
  return fault_ == Fault::full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
}

int TornDisk::truncate(const std::string& path, std::size_t size) {
  if (is_dead()) return SQLITE_IOERR_TRUNCATE;
  if (fault_ == Fault::error && fails()) return SQLITE_IOERR_TRUNCATE;
  File& file = files_[path];
  file.content.resize(size);
  file.steps.push_back({Step::Kind::resize, size, {}});
  return SQLITE_OK;
}

int TornDisk::sync(const std::string& path) {
  if (is_dead()) return SQLITE_IOERR_FSYNC;
  File& file = files_[path];
  if (fault_ == Fault::error && fails()) {
    // The system takes for written what was not, and never writes it again.
    lay_down(file, false);
    return SQLITE_IOERR_FSYNC;
  }
  for (const Step& step : file.steps) apply(file, step, step.bytes.size());
  file.steps.clear();
  file.is_there_durably = file.is_there;
  if (std::exchange(file.is_with_folder, false)) sync_folder();
  return SQLITE_OK;
}

void TornDisk::sync_folder() {
  for (auto& [path, file] : files_) {
    const auto last =
        std::find_if(file.steps.rbegin(), file.steps.rend(), [](const Step& step) { return step.kind == Step::Kind::remove; });
    if (last == file.steps.rend()) continue;
    apply(file, *last, 0);
    file.steps.erase(file.steps.begin(), last.base());
  }
}

int TornDisk::size(const std::string& path, std::int64_t& size) {
  if (is_cut_) return SQLITE_IOERR_FSTAT;
  size = static_cast<std::int64_t>(files_[path].content.size());
  return SQLITE_OK;
}

}  // namespace bl::journal::test
