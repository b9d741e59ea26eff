// Opening, checking and closing of a session file.
#include "core/journal/journal.h"

#include "core/journal/holder.h"
#include "core/journal/reading.h"
#include "core/journal/tables.h"

namespace bl::journal {

namespace {

// Alone: before the file is read for the first time, so that nobody comes between. In memory: what is rebuilt shall not lie in a
// folder of everybody's.
constexpr const char* kAlone = "PRAGMA locking_mode=EXCLUSIVE; PRAGMA temp_store=MEMORY; PRAGMA trusted_schema=OFF";

}  // namespace

std::unique_ptr<Journal> Journal::over(const std::string& path, Database database, const Registry& registry) {
  return std::unique_ptr<Journal>(new Journal(path, std::move(database), registry));
}

Journal::~Journal() { (void)close(); }

Result<void> Journal::close() {
  if (!database_.is_open()) return {};
  Result<void> done;
  if (is_held_) done = database_.checkpoint();
  if (auto closed = database_.close(); done) done = std::move(closed);
  if (is_held_ && !database_.is_open()) {
    forget_holder(path_);
    is_held_ = false;
  }
  return done;
}

Error Journal::told(const Error& error) const {
  if (error.place == path_ && error.code == ErrorCode::conflict) return {error.code, path_, sentence_of_holder(path_)};
  return error.place == path_ ? error : error.within(path_);
}

Result<std::unique_ptr<Journal>> Journal::create(const std::string& path, const RoomRow& room, const Registry& registry,
                                                 const Options& options) {
  if (Database::exists(path, options.vfs)) return Error{ErrorCode::duplicate, path, "exists already: choose another name"};
  auto database = Database::open(path, Database::Access::create, options.vfs);
  if (!database) return database.error();
  auto journal = over(path, std::move(*database), registry);
  auto done = journal->database_.run(kAlone);
  if (done) done = journal->prepare(options);
  if (done) done = journal->make_tables(room);
  // The file shall say by itself what it is.
  if (done) done = journal->database_.checkpoint();
  if (!done) return journal->told(done.error());
  journal->room_ = room;
  journal->last_seq_ = room.base;
  return journal;
}

Result<std::unique_ptr<Journal>> Journal::open(const std::string& path, const Registry& registry, const Options& options) {
  const bool was_cut_off = Database::has_unfinished_part(path, options.vfs);
  auto database = Database::open(path, Database::Access::write, options.vfs);
  if (!database) return database.error();
  auto journal = over(path, std::move(*database), registry);
  // SQLite opens for reading only what it may not write, and fails at the first lock.
  if (journal->database_.is_read_only())
    return Error{ErrorCode::io, path, "the file may not be changed: you lack the right to write it, or its disk is read-only"};
  auto done = journal->database_.run(kAlone);
  if (done) done = journal->check_kind();
  if (done) done = journal->prepare(options);
  if (done) done = journal->check_pages(was_cut_off);
  if (done) done = journal->take_in();
  if (!done) return journal->told(done.error());
  return journal;
}

Result<std::unique_ptr<Journal>> Journal::open_to_read(const std::string& path, const Registry& registry) {
  auto database = Database::open(path, Database::Access::read, "");
  if (!database) return database.error();
  auto journal = over(path, std::move(*database), registry);
  auto done = journal->check_kind();
  if (done) {
    if (auto sound = journal->check_pages(false); !sound && sound.error().code == ErrorCode::parse)
      journal->page_damage_.push_back(sound.error());
    else done = sound;
  }
  if (done) {
    auto room = read_room_row(journal->database_);
    if (room) journal->room_ = std::move(*room);
    else done = room.error();
  }
  if (!done) return journal->told(done.error());
  return journal;
}

Result<void> Journal::check_kind() {
  const auto id = database_.number("PRAGMA application_id");
  if (!id) return id.error();
  const auto version = database_.number("PRAGMA user_version");
  if (!version) return version.error();
  const auto tables = database_.number("SELECT count(*) FROM sqlite_schema");
  if (!tables) return tables.error();
  if (*id == 0 && *tables == 0) return Error{ErrorCode::parse, path_, "the file is empty: no session was stored in it"};
  if (*id != kApplicationId) return Error{ErrorCode::parse, path_, "this is not a session file: another program made it"};
  if (*version < 1 || *version > kVersion)
    return Error{ErrorCode::version, path_,
                 "the file is of version " + std::to_string(*version) + ", and this program reads version " +
                     std::to_string(kVersion) + ": take a newer program"};
  return {};
}

Result<void> Journal::prepare(const Options& options) {
  std::string mode;
  auto done = database_.read("PRAGMA journal_mode=WAL", {}, [&](const Row& row) {
    mode = row.text(0);
    return Result<void>();
  });
  if (!done) return done;
  if (mode != "wal") return Error{ErrorCode::io, path_, "the file system does not allow what a session file needs"};
  done = database_.run(std::string("PRAGMA synchronous=") + options.synchronous +
                       "; PRAGMA secure_delete=ON; PRAGMA wal_autocheckpoint=0");
  if (!done) return done;
  is_held_ = true;
  note_holder(path_, options.opened_at);
  return {};
}

Result<void> Journal::make_tables(const RoomRow& room) {
  const Packed scene = pack(room.scene);
  return database_.in_one_transaction([&]() -> Result<void> {
    auto done = database_.run("PRAGMA application_id=" + std::to_string(kApplicationId) +
                              "; PRAGMA user_version=" + std::to_string(kVersion) + ";" + kTables);
    if (!done) return done;
    return database_.change("INSERT INTO room VALUES (1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                            {room.code, room.title, room.epoch, room.build, room.registry, std::int64_t{room.hash_scheme},
                             room.base, Blob{scene.bytes}, scene.size, scene.digest, room.created, room.closes, room.erase_on});
  });
}

Result<void> Journal::check_pages(bool is_thorough) {
  std::string found;
  const auto done = database_.read(is_thorough ? "PRAGMA integrity_check(1)" : "PRAGMA quick_check(1)", {}, [&](const Row& row) {
    if (found.empty()) found = row.text(0);
    return Result<void>();
  });
  if (!done) return done;
  if (found != "ok") return Error{ErrorCode::parse, path_, "the file is damaged (" + found + ")"};
  return {};
}

Result<void> Journal::take_in() {
  auto room = read_room_row(database_);
  if (!room) return room.error();
  auto all = read_all(database_, *room, *registry_);
  if (!all) return all.error();
  if (!all->damage.empty()) return all->damage.front();
  room_ = std::move(*room);
  last_seq_ = all->room.stored.entries.empty() ? room_.base : all->room.stored.entries.back().entry.seq;
  last_chain_ = all->chain;
  loaded_ = std::move(*all);
  return {};
}

Result<Loaded> Journal::load() {
  if (loaded_) {
    Loaded all = std::move(*loaded_);
    loaded_.reset();
    return all;
  }
  auto all = read_all(database_, room_, *registry_);
  if (!all) return told(all.error());
  all->damage.insert(all->damage.begin(), page_damage_.begin(), page_damage_.end());
  for (Error& error : all->damage) error = told(error);
  return all;
}

}  // namespace bl::journal
