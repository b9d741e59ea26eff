// Rows into a session file, in transactions, and out of it for good.
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/journal/journal.h"
#include "core/journal/reading.h"

namespace bl::journal {

namespace {

// A page that has been away for long sends again what it has not heard of: no more than this waits there for an answer.
constexpr std::int64_t kKeptRefusals = 256;
constexpr const char* kErased = "[erased]";

std::string without_line_feed(std::string line) {
  if (line.ends_with('\n')) line.pop_back();
  return line;
}

// The text between the quotes of a JSON text.
std::string inside_json(const std::string& text) {
  const std::string quoted = write_json_line(Json(text));
  return quoted.substr(1, quoted.size() - 2);
}

}  // namespace

Result<void> Journal::change(const std::function<Result<void>()>& changes) {
  const std::int64_t last_seq = last_seq_;
  const std::string last_chain = last_chain_;
  loaded_.reset();
  if (auto done = database_.in_one_transaction(changes); !done) {
    last_seq_ = last_seq;
    last_chain_ = last_chain;
    return told(done.error());
  }
  if (changed_)
    if (const auto noted = database_.take_changes(); !noted || !noted->empty()) changed_(noted);
  // A failure leaves the work to the next change: this one is on the disk already.
  if (is_cleaning_due_ && database_.checkpoint()) is_cleaning_due_ = false;
  return {};
}

Result<void> Journal::commit(std::span<const room::Record> records) {
  return change([&]() -> Result<void> {
    for (const room::Record& record : records)
      if (auto done = store(record); !done) return done;
    return {};
  });
}

Result<void> Journal::store(const room::Record& record) {
  auto done = store_entries(record.entries);
  if (done) done = store_answers(record);
  if (done) done = store_people(record);
  if (done) done = store_drafts(record);
  if (done) done = store_ballots(record);
  return done;
}

Result<void> Journal::store_entries(const std::vector<room::EntryRecord>& entries) {
  const std::int64_t last_before = last_seq_;
  for (const room::EntryRecord& record : entries) {
    const std::int64_t seq = record.entry.seq;
    const std::string place = "entry/" + std::to_string(seq);
    if (seq > last_seq_ + 1 || seq <= room_.base)
      return Error{ErrorCode::conflict, place, "does not follow entry " + std::to_string(last_seq_)};
    if (seq <= last_seq_) {
      // A rewind that could not take place moves what was said since to another tick: all of it comes again.
      if (last_seq_ != last_before || !record.entry.is_called_off) return Error{ErrorCode::duplicate, place, "is stored already"};
      last_chain_.clear();
      auto done = database_.read("SELECT chain FROM entry WHERE seq = ?", {seq - 1}, [&](const Row& row) {
        last_chain_ = row.text(0);
        return Result<void>();
      });
      if (!done) return done;
    }
    const std::string line = without_line_feed(log_line(record.entry, *registry_));
    last_chain_ = chain_after(last_chain_, record, line);
    last_seq_ = seq;
    auto done =
        database_.change("INSERT OR REPLACE INTO entry VALUES (?, ?, ?, ?, ?, ?, ?)",
                         {seq, record.at, record.draft, record.by, std::int64_t{record.entry.is_called_off}, line, last_chain_});
    if (!done) return done;
  }
  if (last_seq_ < last_before)
    return Error{ErrorCode::conflict, "entry/" + std::to_string(last_seq_), "the entries after it are not there again"};
  return {};
}

Result<void> Journal::store_answers(const room::Record& record) {
  for (const room::RunRecord& run : record.runs)
    if (auto done = database_.change("INSERT OR REPLACE INTO run VALUES (?, ?, ?)", {run.run, run.seat, run.last_operation});
        !done)
      return done;
  for (const room::RefusalRecord& row : record.refusals) {
    auto done = database_.change(
        "INSERT OR REPLACE INTO refusal VALUES (?, ?, ?, ?, ?, ?)",
        {row.run, row.operation, room::name_of(row.refusal.why), row.refusal.place, row.refusal.text, row.refusal.args.text()});
    if (done)
      done = database_.change(
          "DELETE FROM refusal WHERE run = ?1 AND operation <= "
          "(SELECT operation FROM refusal WHERE run = ?1 ORDER BY operation DESC LIMIT 1 OFFSET ?2)",
          {row.run, kKeptRefusals});
    if (!done) return done;
  }
  return {};
}

Result<void> Journal::store_people(const room::Record& record) {
  for (const room::TokenRecord& token : record.tokens)
    if (auto done = database_.change("INSERT OR REPLACE INTO token VALUES (?, ?)", {token.seat, token.hash}); !done) return done;
  for (const room::PersonRecord& person : record.persons) {
    const bool is_empty = person.name.empty() && person.contact.empty() && person.language.empty() && person.consent_at == 0;
    is_cleaning_due_ = is_cleaning_due_ || is_empty;
    auto done = is_empty ? database_.change("DELETE FROM person WHERE seat = ?", {person.seat})
                         : database_.change("INSERT OR REPLACE INTO person VALUES (?, ?, ?, ?, ?)",
                                            {person.seat, person.name, person.contact, person.language, person.consent_at});
    if (!done) return done;
  }
  for (const room::TextRecord& text : record.texts) {
    is_cleaning_due_ = is_cleaning_due_ || text.is_erased;
    auto done = database_.change("INSERT OR REPLACE INTO text VALUES (?, ?, ?, ?, ?)",
                                 {text.id, text.seat, text.kind, text.body, std::int64_t{text.is_erased}});
    if (!done) return done;
  }
  return {};
}

Result<void> Journal::store_drafts(const room::Record& record) {
  for (const room::DraftRecord& draft : record.drafts) {
    is_cleaning_due_ = is_cleaning_due_ || draft.title == kErased;
    auto done = database_.change("INSERT OR REPLACE INTO draft VALUES (?, ?, ?, ?, ?)",
                                 {draft.id, draft.seat, draft.base, draft.title, draft.state});
    if (!done) return done;
  }
  for (const room::DraftStepRecord& step : record.draft_steps) {
    const bool is_undone = step.command.id.empty();
    const std::string command = is_undone ? std::string() : write_json_line(command_to_json(*registry_, step.command));
    auto done = database_.change("INSERT OR REPLACE INTO draft_step VALUES (?, ?, ?)",
                                 {step.draft, step.number, is_undone ? Cell() : Cell(std::string_view(command))});
    if (!done) return done;
  }
  return {};
}

Result<void> Journal::store_ballots(const room::Record& record) {
  for (const room::BallotKeyRecord& key : record.ballot_keys) {
    is_cleaning_due_ = is_cleaning_due_ || key.key.empty();
    if (auto done = database_.change("INSERT OR REPLACE INTO ballot_key VALUES (?, ?)", {key.vote, key.key}); !done) return done;
  }
  // Those of the record itself were given after the others had come into the log.
  for (const std::string& vote : record.ballots_in_log) {
    is_cleaning_due_ = true;
    if (auto done = database_.change("DELETE FROM secret_ballot WHERE vote = ?", {vote}); !done) return done;
  }
  for (const room::SecretBallotRecord& ballot : record.secret_ballots) {
    auto done = ballot.ballot.is_null()
                    ? database_.change("DELETE FROM secret_ballot WHERE vote = ? AND id = ?", {ballot.vote, ballot.id})
                    : database_.change("INSERT OR REPLACE INTO secret_ballot VALUES (?, ?, ?)",
                                       {ballot.vote, ballot.id, ballot.ballot.text()});
    if (!done) return done;
  }
  return {};
}

Result<void> Journal::add_snapshot(const Snapshot& snapshot) {
  return change([&]() -> Result<void> {
    auto done = database_.change("INSERT OR REPLACE INTO snapshot VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                                 {snapshot.seq, snapshot.tick, snapshot.epoch, snapshot.hash, snapshot.name,
                                  Blob{snapshot.scene.bytes}, snapshot.scene.size, snapshot.scene.digest});
    if (done && !snapshot.hash.empty())
      done = database_.change("INSERT OR REPLACE INTO hash VALUES (?, ?, ?)", {snapshot.seq, snapshot.tick, snapshot.hash});
    if (!done) return done;
    return database_.change(
        "DELETE FROM snapshot WHERE name = '' AND rowid NOT IN "
        "(SELECT rowid FROM snapshot WHERE name = '' ORDER BY seq DESC, tick DESC LIMIT 2)");
  });
}

Result<void> Journal::add_hashes(std::span<const HashRow> hashes) {
  return change([&]() -> Result<void> {
    for (const HashRow& row : hashes)
      if (auto done = database_.change("INSERT OR REPLACE INTO hash VALUES (?, ?, ?)", {row.seq, row.tick, row.hash}); !done)
        return done;
    return {};
  });
}

Result<void> Journal::change_room(const RoomRow& room) {
  auto done = change([&] {
    return database_.change(
        "UPDATE room SET code = ?, title = ?, epoch = ?, build = ?, registry = ?, created = ?, closes = ?, erase_on = ?",
        {room.code, room.title, room.epoch, room.build, room.registry, room.created, room.closes, room.erase_on});
  });
  if (!done) return done;
  RoomRow changed = room;
  changed.scene = std::move(room_.scene);
  changed.base = room_.base;
  changed.hash_scheme = room_.hash_scheme;
  room_ = std::move(changed);
  return {};
}

Result<Erased> Journal::erase(std::int64_t seat) {
  Erased erased;
  const auto counted = [&](std::size_t& count, const char* statement, std::initializer_list<Cell> cells) {
    auto done = database_.change(statement, cells);
    if (done) count += static_cast<std::size_t>(database_.changed_rows());
    return done;
  };
  auto done = change([&]() -> Result<void> {
    std::vector<std::string> names;
    auto read = database_.read("SELECT name, contact FROM person WHERE seat = ?", {seat}, [&](const Row& row) {
      names = {row.text(0), row.text(1)};
      return Result<void>();
    });
    // A refusal may have said whose area it was. Its reason stays.
    for (const std::string& name : names) {
      if (!read || name.empty()) continue;
      read = counted(erased.refusals, "UPDATE refusal SET text = ?3, args = '{}' WHERE instr(text, ?1) OR instr(args, ?2)",
                     {name, inside_json(name), kErased});
    }
    if (read) read = counted(erased.persons, "DELETE FROM person WHERE seat = ?", {seat});
    if (read)
      read = counted(erased.texts, "UPDATE text SET body = ?, is_erased = 1 WHERE seat = ? AND NOT is_erased", {kErased, seat});
    if (read)
      read =
          counted(erased.texts, "UPDATE draft SET title = ?1 WHERE seat = ?2 AND title <> '' AND title <> ?1", {kErased, seat});
    if (read) read = counted(erased.tokens, "UPDATE token SET hash = '' WHERE seat = ? AND hash <> ''", {seat});
    return read;
  });
  // SQLite zeroes what is freed. Built anew from what is left, the file is clean whether it did so everywhere or not.
  if (done) done = database_.run("VACUUM");
  if (done) done = database_.checkpoint();
  if (!done) return told(done.error());
  return erased;
}

}  // namespace bl::journal
