// Copies of a session file: as a whole, and change by change, by SQLite's sessions.
// They are in Debian's library; its header shows them to whoever says this.
#define SQLITE_ENABLE_SESSION
#define SQLITE_ENABLE_PREUPDATE_HOOK
#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "core/journal/database.h"

namespace bl::journal {

namespace {

using Bytes = std::unique_ptr<unsigned char, decltype(&sqlite3_free)>;

std::string text_of(const void* bytes, sqlite3_int64 size) {
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(size)};
}

// Any difference means that the copy is no longer one.
int stop_at_conflicts(void*, int, sqlite3_changeset_iter*) { return SQLITE_CHANGESET_ABORT; }

}  // namespace

void Database::EndSession::operator()(sqlite3_session* session) const { sqlite3session_delete(session); }

Result<std::string> Database::bytes() {
  sqlite3_int64 size = 0;
  const Bytes all(sqlite3_serialize(database_.get(), "main", &size, 0), sqlite3_free);
  if (!all) return failure();
  return text_of(all.get(), size);
}

Result<void> Database::become(const std::string& bytes) {
  static constexpr std::size_t kHeader = 100, kWriteVersion = 18, kReadVersion = 19;
  if (bytes.size() < kHeader) return Error{ErrorCode::parse, path_, "the copy is not whole"};
  auto memory = open(":memory:", Access::create, "");
  if (!memory) return memory.error();
  auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
  if (copy == nullptr) return Error{ErrorCode::io, path_, "there is too little memory"};
  std::memcpy(copy, bytes.data(), bytes.size());
  // Memory has no write-ahead log; the file that it becomes has one all the same, as it had before.
  copy[kWriteVersion] = copy[kReadVersion] = 1;
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  // It frees the bytes in any case.
  if (sqlite3_deserialize(memory->database_.get(), "main", copy, size, size,
                          SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_READONLY) != SQLITE_OK)
    return memory->failure();
  sqlite3_backup* backup = sqlite3_backup_init(database_.get(), "main", memory->database_.get(), "main");
  if (backup == nullptr) return failure();
  const int code = sqlite3_backup_step(backup, -1);
  (void)sqlite3_backup_finish(backup);
  return code == SQLITE_DONE ? Result<void>() : Result<void>(failure());
}

Result<void> Database::note_changes() {
  sqlite3_session* raw = nullptr;
  if (sqlite3session_create(database_.get(), "main", &raw) != SQLITE_OK) return failure();
  session_.reset(raw);
  if (sqlite3session_attach(raw, nullptr) != SQLITE_OK) return failure();
  return {};
}

// Without the values before: they are there, and what was erased shall not travel once more.
Result<std::string> Database::take_changes() {
  if (!session_) return std::string();
  int size = 0;
  void* raw = nullptr;
  const int code = sqlite3session_patchset(session_.get(), &size, &raw);
  const Bytes changes(static_cast<unsigned char*>(raw), sqlite3_free);
  if (code != SQLITE_OK) return failure();
  if (auto noted = note_changes(); !noted) return noted.error();
  return size == 0 ? std::string() : text_of(changes.get(), size);
}

Result<void> Database::repeat(const std::string& changes) {
  const int size = static_cast<int>(changes.size());
  void* bytes = const_cast<char*>(changes.data());  // SQLite only reads them
  return in_one_transaction([&]() -> Result<void> {
    const int code = sqlite3changeset_apply(database_.get(), size, bytes, nullptr, stop_at_conflicts, nullptr);
    if (code == SQLITE_OK) return {};
    if (code == SQLITE_ABORT || code == SQLITE_CORRUPT)
      return Error{ErrorCode::conflict, path_, "the change does not fit what is stored"};
    return failure();
  });
}

Result<bool> erases_words(const std::string& changes) {
  static constexpr std::string_view kPersonal[] = {"person", "token", "text", "refusal", "ballot_key", "secret_ballot"};
  sqlite3_changeset_iter* changed = nullptr;
  if (sqlite3changeset_start(&changed, static_cast<int>(changes.size()), const_cast<char*>(changes.data())) != SQLITE_OK)
    return Error{ErrorCode::parse, "", "the change is not whole"};
  bool is_erasing = false;
  while (!is_erasing && sqlite3changeset_next(changed) == SQLITE_ROW) {
    const char* table = nullptr;
    int columns = 0, kind = 0, is_indirect = 0;
    sqlite3changeset_op(changed, &table, &columns, &kind, &is_indirect);
    is_erasing = kind != SQLITE_INSERT &&
                 std::find(std::begin(kPersonal), std::end(kPersonal), std::string_view(table)) != std::end(kPersonal);
  }
  return sqlite3changeset_finalize(changed) == SQLITE_OK ? Result<bool>(is_erasing)
                                                         : Error{ErrorCode::parse, "", "the change is not whole"};
}

}  // namespace bl::journal
