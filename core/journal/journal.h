// The session file of a room: what has been said is on the disk before anybody is told of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/journal/database.h"
#include "core/journal/rows.h"

namespace bl::journal {

/// What an erasure has taken out of a file.
struct Erased {
  std::size_t persons = 0, texts = 0, tokens = 0;
  std::size_t refusals = 0;  ///< of anybody, that quoted the name
};

/// One thread at a time may use it.
class Journal {
 public:
  struct Options {
    std::int64_t opened_at = 0;        ///< by the host's clock [ms since 1970]; others that try to open the file are told
    std::string vfs = {};              ///< by which SQLite reaches the disk; empty: its own
    const char* synchronous = "FULL";  ///< less loses commits in a power cut: for the proof that such a loss is noticed
  };
  /// Makes a new file, with nothing in it but the room. Never touches a file that has something in it.
  static Result<std::unique_ptr<Journal>> create(const std::string& path, const RoomRow& room, const Registry& registry,
                                                 const Options& options);
  /// Opens a file for more. Damage is an error; such a file can still be opened for reading.
  static Result<std::unique_ptr<Journal>> open(const std::string& path, const Registry& registry, const Options& options);
  /// Opens a file without changing it. What of it is damaged is among what `load` gives.
  static Result<std::unique_ptr<Journal>> open_to_read(const std::string& path, const Registry& registry);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Stores a record, or several as one. It is on the disk when this returns. After an error nothing of it is stored, and the
  /// next commit may succeed. The numbers of entries have no gaps; an entry that is stored already can only be called off.
  Result<void> commit(const room::Record& record) { return commit(std::span(&record, 1)); }
  Result<void> commit(std::span<const room::Record> records);
  /// Older snapshots without a name are given up: the newest two stay.
  Result<void> add_snapshot(const Snapshot& snapshot);
  Result<void> add_hashes(std::span<const HashRow> hashes);
  /// Replaces all of the room but its beginning: the scene, `base` and `hash_scheme` stay.
  Result<void> change_room(const RoomRow& room);
  /// Everything that is stored.
  Result<Loaded> load();

  /// Takes the person of a seat out of the file: the name, the words, and the token. The entries stay, because they hold neither;
  /// so the log leads to the same hashes. The bytes are gone from the file when this returns. It may be repeated.
  Result<Erased> erase(std::int64_t seat);

  /// The whole file as bytes, for a Copy elsewhere. From now on each change is handed out as well, once it is stored; an error
  /// where it could not be, after which copies begin anew.
  using Changed = std::function<void(const Result<std::string>&)>;
  Result<std::string> copied(Changed changed);
  void stop_copying();

  const RoomRow& room() const { return room_; }
  const Registry& registry() const { return *registry_; }
  std::int64_t last_seq() const { return last_seq_; }
  /// Commits are written behind each other, and brought into the file from time to time: by this, while nobody waits. It takes
  /// tens of milliseconds.
  Result<void> checkpoint() { return database_.checkpoint(); }
  /// What waits for that [bytes].
  std::int64_t unfinished_bytes() const { return database_.unfinished_bytes(); }
  /// Ends the work with the file; otherwise that happens with the object, and failures are not told.
  Result<void> close();

 private:
  Journal(const std::string& path, Database database, const Registry& registry)
      : path_(path), registry_(&registry), database_(std::move(database)) {}
  static std::unique_ptr<Journal> over(const std::string& path, Database database, const Registry& registry);
  Result<void> check_kind();
  /// Prepares the file for writing; it must be known by now that it is ours.
  Result<void> prepare(const Options& options);
  Result<void> make_tables(const RoomRow& room);
  Result<void> check_pages(bool is_thorough);
  /// Reads all, and fails at the first damage.
  Result<void> take_in();
  /// The error with the file as its place; a locked file is told with its holder.
  Error told(const Error& error) const;
  /// One transaction; afterwards `last_seq` and the like are those of the file.
  Result<void> change(const std::function<Result<void>()>& changes);

  // Writing (journal_writing.cpp).
  Result<void> store(const room::Record& record);
  Result<void> store_entries(const std::vector<room::EntryRecord>& entries);
  Result<void> store_answers(const room::Record& record);
  Result<void> store_people(const room::Record& record);
  Result<void> store_drafts(const room::Record& record);
  Result<void> store_ballots(const room::Record& record);

  std::string path_;
  const Registry* registry_;
  bool is_held_ = false;
  Database database_;
  RoomRow room_;
  std::int64_t last_seq_ = 0;
  std::string last_chain_;
  /// Something was taken out that must not stay in what is not yet brought into the file.
  bool is_cleaning_due_ = false;
  Changed changed_;
  std::optional<Loaded> loaded_;    ///< as it was found when the file was opened; only until the first change
  std::vector<Error> page_damage_;  ///< of a file that is open for reading only
};

}  // namespace bl::journal
