// Table by table; of a damaged row its table and its key are told.
#include "core/journal/reading.h"

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/define/codec.h"

namespace bl::journal {

namespace {

class Reading {
 public:
  Reading(Database& database, const Registry& registry, Loaded& loaded)
      : database_(&database), registry_(&registry), loaded_(&loaded), record_(&loaded.room.stored) {}

  Result<void> entries(std::int64_t base) {
    std::int64_t last = base;
    bool is_whole = true;
    return rows("SELECT seq, at, draft, accepted_by, is_called_off, line, chain FROM entry ORDER BY seq", [&](const Row& row) {
      if (!is_whole) return;
      auto entry = entry_of(row, last);
      if (entry) {
        last = entry->entry.seq;
        record_->entries.push_back(std::move(*entry));
        return;
      }
      is_whole = false;
      damaged(entry.error());
    });
  }

  Result<void> answers() {
    auto done = rows("SELECT run, seat, last_operation FROM run ORDER BY run", [&](const Row& row) {
      record_->runs.push_back({row.text(0), row.number(1), row.number(2)});
    });
    if (!done) return done;
    return rows("SELECT run, operation, why, place, text, args FROM refusal ORDER BY run, operation", [&](const Row& row) {
      const auto reason = room::reason_named(row.text(2));
      const JsonValue args(row.text(5));
      const std::string place = "refusal/" + row.text(0) + "/" + std::to_string(row.number(1));
      if (!reason) return damaged({ErrorCode::parse, place, "there is no reason `" + row.text(2) + "`"});
      if (const auto read = args.read(); !read) return damaged(read.error().within(place));
      record_->refusals.push_back({row.text(0), row.number(1), {*reason, row.text(3), row.text(4), args}});
    });
  }

  Result<void> people() {
    auto done = rows("SELECT seat, hash FROM token ORDER BY seat", [&](const Row& row) {
      record_->tokens.push_back({row.number(0), row.text(1)});
    });
    if (done)
      done = rows("SELECT seat, name, contact, language, consent_at FROM person ORDER BY seat", [&](const Row& row) {
        record_->persons.push_back({row.number(0), row.text(1), row.text(2), row.text(3), row.number(4)});
      });
    if (!done) return done;
    return rows("SELECT id, seat, kind, body, is_erased FROM text ORDER BY id", [&](const Row& row) {
      record_->texts.push_back({row.text(0), row.number(1), row.text(2), row.text(3), row.number(4) != 0});
    });
  }

  Result<void> drafts() {
    auto done = rows("SELECT id, seat, base, title, state FROM draft ORDER BY id", [&](const Row& row) {
      record_->drafts.push_back({row.text(0), row.number(1), row.number(2), row.text(3), row.text(4)});
    });
    if (!done) return done;
    return rows("SELECT draft, number, command FROM draft_step ORDER BY draft, number", [&](const Row& row) {
      room::DraftStepRecord step{row.text(0), row.number(1), {}};
      const std::string place = "draft_step/" + step.draft + "/" + std::to_string(step.number);
      if (!row.is_null(2)) {
        const auto json = parse_json(row.text(2));
        auto command = json ? command_from_json(*registry_, *json, place) : Result<Command>(json.error().within(place));
        if (!command) return damaged(command.error());
        step.command = std::move(*command);
      }
      record_->draft_steps.push_back(std::move(step));
    });
  }

  Result<void> ballots() {
    auto done = rows("SELECT vote, key FROM ballot_key ORDER BY vote", [&](const Row& row) {
      record_->ballot_keys.push_back({row.text(0), row.text(1)});
    });
    if (!done) return done;
    return rows("SELECT vote, id, ballot FROM secret_ballot ORDER BY vote, id", [&](const Row& row) {
      room::SecretBallotRecord ballot{row.text(0), row.text(1), JsonValue(row.text(2))};
      if (const auto read = ballot.ballot.read(); !read)
        return damaged(read.error().within("secret_ballot/" + ballot.vote + "/" + ballot.id));
      record_->secret_ballots.push_back(std::move(ballot));
    });
  }

  // The snapshots from the newest on, until one is whole.
  Result<void> snapshot() {
    return rows(
        "SELECT seq, tick, epoch, hash, name, scene, scene_size, scene_digest FROM snapshot ORDER BY seq DESC, tick DESC, name",
        [&](const Row& row) {
          Snapshot found{row.number(0), row.number(1), row.number(2),
                         row.text(3),   row.text(4),   {row.text(5), row.number(6), row.text(7)}};
          if (!found.name.empty()) loaded_->scenarios.emplace(found.name, found);
          if (loaded_->snapshot) return;
          const std::string place = "snapshot/" + std::to_string(found.seq);
          const std::int64_t last = record_->entries.empty() ? loaded_->room.base : record_->entries.back().entry.seq;
          if (const auto text = unpack(found.scene); !text) loaded_->unusable_snapshots.push_back(text.error().within(place));
          else if (found.seq > last)
            loaded_->unusable_snapshots.push_back({ErrorCode::missing, place, "the entries up to this snapshot are not there"});
          else loaded_->snapshot = std::move(found);
        });
  }

  Result<void> hashes() {
    return rows("SELECT seq, tick, hash FROM hash ORDER BY seq, tick", [&](const Row& row) {
      loaded_->hashes.push_back({row.number(0), row.number(1), row.text(2)});
    });
  }

 private:
  // What a damaged page hides is damage as well; the other tables can still be read.
  Result<void> rows(const char* statement, const std::function<void(const Row&)>& take) {
    auto done = database_->read(statement, {}, [&](const Row& row) {
      take(row);
      return Result<void>();
    });
    if (done || done.error().code != ErrorCode::parse) return done;
    const std::string text = statement, name = text.substr(text.find(" FROM ") + 6);
    damaged({ErrorCode::parse, name.substr(0, name.find(' ')), "the rest of the table cannot be read: " + done.error().message});
    return {};
  }

  void damaged(const Error& error) { loaded_->damage.push_back(error); }

  Result<room::EntryRecord> entry_of(const Row& row, std::int64_t last) {
    const std::int64_t seq = row.number(0);
    const std::string place = "entry/" + std::to_string(seq), line = row.text(5);
    const auto error = [&](const std::string& sentence) { return Error{ErrorCode::parse, place, sentence}; };
    if (seq != last + 1)
      return error("follows entry " + std::to_string(last) + ": " + (seq == last + 2 ? "one is" : "some are") +
                   " missing between");
    auto read = log_entry_of(line, *registry_);
    if (!read) return read.error().within(place);
    if (read->seq != seq) return error("its line has the number " + std::to_string(read->seq));
    room::EntryRecord entry{std::move(*read), row.number(1), row.text(2), row.number(3)};
    const std::string chain = chain_after(loaded_->chain, entry, line);
    if (chain != row.text(6)) return error("it is not what was stored: a byte of it, or of an entry before it, has changed");
    loaded_->chain = chain;
    entry.entry.is_called_off = row.number(4) != 0;
    return entry;
  }

  Database* database_;
  const Registry* registry_;
  Loaded* loaded_;
  room::Record* record_;
};

}  // namespace

Result<RoomRow> read_room_row(Database& database) {
  RoomRow room;
  Packed scene;
  int rows = 0;
  const auto done = database.read(
      "SELECT code, title, epoch, build, registry, hash_scheme, base, scene, scene_size, scene_digest, created, closes, erase_on "
      "FROM room",
      {}, [&](const Row& row) {
        ++rows;
        room.code = row.text(0);
        room.title = row.text(1);
        room.epoch = row.number(2);
        room.build = row.text(3);
        room.registry = row.text(4);
        room.hash_scheme = static_cast<int>(row.number(5));
        room.base = row.number(6);
        scene = {row.text(7), row.number(8), row.text(9)};
        room.created = row.number(10);
        room.closes = row.number(11);
        room.erase_on = row.number(12);
        return Result<void>();
      });
  if (!done) return done.error();
  if (rows != 1) return Error{ErrorCode::parse, "room", "the file has " + std::to_string(rows) + " rooms, and should have one"};
  auto text = unpack(scene);
  if (!text) return text.error().within("room/scene");
  room.scene = std::move(*text);
  return room;
}

Result<Loaded> read_all(Database& database, const RoomRow& room, const Registry& registry) {
  Loaded loaded;
  loaded.room = {room.code, room.title, room.base, room.scene, {}};
  Reading reading(database, registry, loaded);
  auto done = reading.entries(room.base);
  if (done) done = reading.answers();
  if (done) done = reading.people();
  if (done) done = reading.drafts();
  if (done) done = reading.ballots();
  if (done) done = reading.snapshot();
  if (done) done = reading.hashes();
  if (!done) return done.error();
  return loaded;
}

std::string chain_after(const std::string& before, const room::EntryRecord& entry, const std::string& line) {
  Hash hash;
  hash.add(std::string_view(before));
  hash.add(std::string_view(line));
  hash.add(static_cast<std::uint64_t>(entry.at));
  hash.add(std::string_view(entry.draft));
  hash.add(static_cast<std::uint64_t>(entry.by));
  return hash.hex();
}

}  // namespace bl::journal
