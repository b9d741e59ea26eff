// SQLite behind the class: statements are prepared once, and codes become sentences.
#include "core/journal/database.h"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>

namespace bl::journal {

namespace {

// How long a statement waits for somebody who reads the file [ms].
constexpr int kPatience = 2000;

std::string percent_encoded(const std::string& path) {
  std::string text;
  for (const char c : path) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%' || c == '?' || c == '#') text.append({'%', kDigits[byte >> 4], kDigits[byte & 15]});
    else text += c;
  }
  return text;
}

// What the system said, where SQLite knows it.
std::string because(sqlite3* database) {
  const int number = database == nullptr ? 0 : sqlite3_system_errno(database);
  return number == 0 ? std::string() : std::string(": ") + std::strerror(number);
}

Error sentence_of(int code, sqlite3* database, const std::string& path) {
  const std::string detail = database == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(database);
  const auto error = [&](ErrorCode kind, const std::string& sentence) { return Error{kind, path, sentence}; };
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED: return error(ErrorCode::conflict, "another program has this file open");
    case SQLITE_NOTADB: return error(ErrorCode::parse, "this is not a session file: it does not begin like one");
    case SQLITE_CORRUPT: return error(ErrorCode::parse, "the file is damaged (" + detail + ")");
    case SQLITE_FULL: return error(ErrorCode::io, "the disk is full: free some space. Nothing of this step was stored");
    case SQLITE_READONLY: return error(ErrorCode::io, "the file may not be changed" + because(database));
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH: return error(ErrorCode::io, "the file cannot be opened" + because(database));
    case SQLITE_IOERR: return error(ErrorCode::io, "the disk does not read or write (" + detail + because(database) + ")");
    case SQLITE_NOMEM: return error(ErrorCode::io, "there is too little memory");
    default: return error(ErrorCode::internal, "the storage failed (" + detail + ")");
  }
}

bool exists_by(sqlite3_vfs* vfs, const std::string& path) {
  int is_there = 0;
  return vfs->xAccess(vfs, path.c_str(), SQLITE_ACCESS_EXISTS, &is_there) == SQLITE_OK && is_there != 0;
}

sqlite3_vfs* vfs_named(const std::string& name) { return sqlite3_vfs_find(name.empty() ? nullptr : name.c_str()); }

void bind(sqlite3_stmt* statement, int place, const Cell& cell) {
  // The texts outlive the statement: it is run at once.
  if (const auto* number = std::get_if<std::int64_t>(&cell)) sqlite3_bind_int64(statement, place, *number);
  else if (const auto* text = std::get_if<std::string_view>(&cell))
    sqlite3_bind_text64(statement, place, text->data() == nullptr ? "" : text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
  else if (const auto* blob = std::get_if<Blob>(&cell))
    sqlite3_bind_blob64(statement, place, blob->bytes.data() == nullptr ? "" : blob->bytes.data(), blob->bytes.size(),
                        SQLITE_STATIC);
  else sqlite3_bind_null(statement, place);
}

}  // namespace

bool Row::is_null(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
std::int64_t Row::number(int column) const { return sqlite3_column_int64(statement_, column); }
std::string Row::text(int column) const {
  const void* bytes = sqlite3_column_blob(statement_, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

void Database::CloseDatabase::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void Database::EndStatement::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Result<Database> Database::open(const std::string& path, Access access, const std::string& vfs) {
  const auto attempt = [&](const std::string& name, int flags) -> Result<Database> {
    Database opened;
    opened.path_ = path;
    sqlite3* raw = nullptr;
    const int code = sqlite3_open_v2(name.c_str(), &raw, flags | SQLITE_OPEN_EXRESCODE, vfs.empty() ? nullptr : vfs.c_str());
    opened.database_.reset(raw);
    if (code != SQLITE_OK) return sentence_of(code, raw, path);
    sqlite3_busy_timeout(raw, kPatience);
    return opened;
  };
  if (access == Access::create) return attempt(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (access == Access::write) return attempt(path, SQLITE_OPEN_READWRITE);
  auto opened = attempt(path, SQLITE_OPEN_READONLY);
  if (!opened || has_unfinished_part(path, vfs)) return opened;
  // To read what is in such a file, SQLite makes small files beside it. Where the folder allows none, and nothing waits to be
  // brought into the file, it can be read as one that nobody changes.
  if (auto first = opened->number("SELECT count(*) FROM sqlite_schema"); first || first.error().code != ErrorCode::io)
    return opened;
  return attempt("file:" + percent_encoded(path) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
}

bool Database::exists(const std::string& path, const std::string& vfs) {
  sqlite3_vfs* found = vfs_named(vfs);
  return found != nullptr && exists_by(found, path);
}

bool Database::has_unfinished_part(const std::string& path, const std::string& vfs) {
  // SQLite removes this file, or empties it, when the work with the main file ends well; an empty one does not "exist" to it.
  return exists(path + "-wal", vfs);
}

Error Database::failure() const { return sentence_of(sqlite3_extended_errcode(database_.get()), database_.get(), path_); }

Result<void> Database::run(const std::string& statements) {
  if (sqlite3_exec(database_.get(), statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) return failure();
  return {};
}

Result<sqlite3_stmt*> Database::prepared(const char* statement, std::initializer_list<Cell> cells) {
  auto found = statements_.find(std::string_view(statement));
  if (found == statements_.end()) {
    sqlite3_stmt* raw = nullptr;
    if (sqlite3_prepare_v3(database_.get(), statement, -1, SQLITE_PREPARE_PERSISTENT, &raw, nullptr) != SQLITE_OK)
      return failure();
    found = statements_.emplace(statement, std::unique_ptr<sqlite3_stmt, EndStatement>(raw)).first;
  }
  int place = 0;
  for (const Cell& cell : cells) bind(found->second.get(), ++place, cell);
  return found->second.get();
}

Result<void> Database::read(const char* statement, std::initializer_list<Cell> cells, const Reader& reader) {
  const auto ready = prepared(statement, cells);
  if (!ready) return ready.error();
  Result<void> done;
  int code = SQLITE_ROW;
  while (done && (code = sqlite3_step(*ready)) == SQLITE_ROW) done = reader(Row(*ready));
  if (done && code != SQLITE_DONE) done = failure();
  sqlite3_reset(*ready);
  sqlite3_clear_bindings(*ready);
  return done;
}

Result<void> Database::change(const char* statement, std::initializer_list<Cell> cells) {
  return read(statement, cells, [](const Row&) { return Result<void>(); });
}

Result<std::int64_t> Database::number(const char* statement, std::initializer_list<Cell> cells) {
  std::int64_t number = 0;
  bool is_first = true;
  const auto done = read(statement, cells, [&](const Row& row) {
    if (is_first) number = row.number(0);
    is_first = false;
    return Result<void>();
  });
  if (!done) return done.error();
  return number;
}

Result<void> Database::in_one_transaction(const std::function<Result<void>()>& changes) {
  if (auto begun = change("BEGIN IMMEDIATE"); !begun) return begun;
  Result<void> done = changes();
  if (done) done = change("COMMIT");
  // SQLite has rolled back already after some failures, and says so.
  if (!done && sqlite3_get_autocommit(database_.get()) == 0) (void)change("ROLLBACK");
  return done;
}

std::int64_t Database::changed_rows() const { return sqlite3_changes64(database_.get()); }

bool Database::is_read_only() const { return sqlite3_db_readonly(database_.get(), "main") == 1; }

std::int64_t Database::unfinished_bytes() const {
  sqlite3_file* file = nullptr;
  sqlite3_int64 size = 0;
  if (sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_JOURNAL_POINTER, &file) != SQLITE_OK || file == nullptr ||
      file->pMethods == nullptr || file->pMethods->xFileSize(file, &size) != SQLITE_OK)
    return 0;
  return size;
}

Result<void> Database::checkpoint() {
  if (sqlite3_wal_checkpoint_v2(database_.get(), "main", SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr) != SQLITE_OK)
    return failure();
  return {};
}

Result<void> Database::close() {
  session_.reset();
  statements_.clear();
  if (sqlite3* raw = database_.release(); sqlite3_close(raw) != SQLITE_OK) {
    database_.reset(raw);
    return failure();
  }
  return {};
}

}  // namespace bl::journal
