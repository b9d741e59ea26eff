// The copy is as durable as the original: each change is one transaction.
#include "core/journal/copy.h"

#include "core/journal/holder.h"
#include "core/journal/journal.h"
#include "core/journal/tables.h"

namespace bl::journal {

namespace {

constexpr std::int64_t kTidyFrom = 4 << 20;  // [bytes]

// Which room a file has; empty: none yet.
Result<std::string> room_in(Database& database, const std::string& path) {
  const auto tables = database.number("SELECT count(*) FROM sqlite_schema");
  if (!tables) return tables.error();
  if (*tables == 0) return std::string();
  const auto id = database.number("PRAGMA application_id"), version = database.number("PRAGMA user_version");
  if (!id || *id != kApplicationId) return Error{ErrorCode::parse, path, "this is not a session file: another program made it"};
  if (!version || *version != kVersion)
    return Error{ErrorCode::version, path, "the session file is of another version of the program"};
  std::string room;
  auto done = database.read("SELECT code, created FROM room", {}, [&](const Row& row) {
    room = row.text(0) + " " + std::to_string(row.number(1));
    return Result<void>();
  });
  if (!done) return done.error();
  return room;
}

}  // namespace

Result<std::string> Journal::copied(Changed changed) {
  if (auto noted = database_.note_changes(); !noted) return told(noted.error());
  auto bytes = database_.bytes();
  if (!bytes) return told(bytes.error());
  changed_ = std::move(changed);
  return bytes;
}

void Journal::stop_copying() {
  changed_ = nullptr;
  database_.stop_noting();
}

Result<std::unique_ptr<Copy>> Copy::open(const std::string& path, std::int64_t opened_at) {
  const auto access = Database::exists(path, "") ? Database::Access::write : Database::Access::create;
  auto database = Database::open(path, access, "");
  if (!database) return database.error();
  std::unique_ptr<Copy> copy(new Copy(path, std::move(*database)));
  if (auto ready = copy->prepare(opened_at); !ready) {
    const Error& error = ready.error();
    return error.code == ErrorCode::conflict ? Error{error.code, path, sentence_of_holder(path)} : error;
  }
  return copy;
}

Result<void> Copy::prepare(std::int64_t opened_at) {
  auto done = database_.run("PRAGMA locking_mode=EXCLUSIVE; PRAGMA temp_store=MEMORY; PRAGMA trusted_schema=OFF");
  if (!done) return done;
  auto room = room_in(database_, path_);
  if (!room) return room.error();
  room_ = std::move(*room);
  done = database_.run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA secure_delete=ON; PRAGMA wal_autocheckpoint=0");
  if (!done) return done;
  is_held_ = true;
  note_holder(path_, opened_at);
  return {};
}

Result<void> Copy::take(const std::string& bytes) {
  auto trial = Database::open(":memory:", Database::Access::create, "");
  if (!trial) return trial.error();
  if (auto read = trial->become(bytes); !read) return read;
  auto room = room_in(*trial, path_);
  if (!room) return room.error();
  if (room->empty()) return Error{ErrorCode::parse, path_, "what came is no session file"};
  if (!room_.empty() && room_ != *room)
    return Error{ErrorCode::conflict, path_,
                 "holds another room (" + room_.substr(0, room_.find(' ')) + "): choose another file"};
  if (auto done = database_.become(bytes); !done) return done;
  room_ = std::move(*room);
  return database_.checkpoint();
}

// What was erased there, or ties a secret ballot to a seat, leaves this file at once, too.
Result<void> Copy::repeat(const std::string& changes) {
  if (auto done = database_.repeat(changes); !done) return done;
  const auto erases = erases_words(changes);
  if (!erases) return erases.error();
  return *erases || database_.unfinished_bytes() >= kTidyFrom ? database_.checkpoint() : Result<void>();
}

Result<void> Copy::close() {
  if (!database_.is_open()) return {};
  Result<void> done;
  if (is_held_) done = database_.checkpoint();
  if (auto closed = database_.close(); done) done = std::move(closed);
  if (is_held_ && !database_.is_open()) forget_holder(path_);
  is_held_ = false;
  return done;
}

Copy::~Copy() { (void)close(); }

}  // namespace bl::journal
