// Session files: what was stored is read again, the export leads to the same hashes, and whatever is wrong with a file has its
// sentence.
#include "core/journal/journal.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "core/journal/export.h"
#include "core/session/session.h"
#include "tests/core/journal/room_file.h"
#include "tests/support/random_commands.h"
#include "tests/support/random_records.h"

namespace bl::journal::test {
namespace {

void write_bytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

// Changes a file as no journal would.
void tamper(const std::string& path, const std::string& statement) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
}

std::unique_ptr<Journal> fresh(const std::string& path) {
  auto journal = Journal::create(path, a_room(), full_registry(), {});
  EXPECT_TRUE(journal) << why(journal);
  return journal ? std::move(*journal) : nullptr;
}

std::unique_ptr<Journal> again(const std::string& path) {
  auto journal = Journal::open(path, full_registry(), {});
  EXPECT_TRUE(journal) << why(journal);
  return journal ? std::move(*journal) : nullptr;
}

room::Record of_entries(std::vector<room::EntryRecord> entries) {
  room::Record record;
  record.entries = std::move(entries);
  return record;
}

std::string rows_of(const Loaded& all) {
  StoredRows rows;
  rows.add(all.room.stored);
  return rows.text();
}

// Law: a file holds all entries in order, and of the other rows the last of each key, whatever was opened and closed between.
TEST(Journal, HoldsWhatWasCommitted) {
  const Folder folder;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const std::string path = folder.path(std::to_string(seed) + ".blsession");
    RandomRecords records(its_scene(), seed);
    StoredRows expected;
    auto journal = fresh(path);
    for (int round = 0; round < 60; ++round) {
      ASSERT_NE(journal, nullptr);
      const room::Record record = records.next();
      ASSERT_EQ(why(journal->commit(record)), "");
      expected.add(record);
      if (round % 20 == 7) {
        journal.reset();
        journal = again(path);
      }
      if (round % 20 == 13) { ASSERT_EQ(why(journal->checkpoint()), ""); }
    }
    const auto all = journal->load();
    ASSERT_TRUE(all) << why(all);
    EXPECT_EQ(first_difference(rows_of(*all), expected.text()), "");
    EXPECT_TRUE(all->damage.empty());
    EXPECT_EQ(all->room.code, "BRKT");
    EXPECT_EQ(all->room.scene, a_room().scene);
  }
}

TEST(Journal, KeepsTheLast256RefusalsOfARun) {
  const Folder folder;
  auto journal = fresh(folder.path("a.blsession"));
  room::Record record;
  for (std::int64_t operation = 1; operation <= 300; ++operation)
    record.refusals.push_back({"run", operation, {room::Reason::area, "nodes/a", "Bea holds the pen", R"({"holder": "Bea"})"}});
  record.refusals.push_back({"other", 7, {room::Reason::gap, "", "", {}}});
  ASSERT_EQ(why(journal->commit(record)), "");
  const auto all = journal->load();
  ASSERT_TRUE(all);
  ASSERT_EQ(all->room.stored.refusals.size(), 257u);
  EXPECT_EQ(all->room.stored.refusals[0].run, "other");
  EXPECT_EQ(all->room.stored.refusals[1].operation, 45);
  EXPECT_EQ(all->room.stored.refusals[256].refusal, record.refusals[299].refusal);
}

TEST(Journal, AnEntryIsStoredOnceAndInOrder) {
  const Folder folder;
  auto journal = fresh(folder.path("a.blsession"));
  RandomRecords records(its_scene(), 3);
  const room::Record first = records.next_of(3), second = records.next_of(2);
  EXPECT_EQ(why(journal->commit(second)), folder.path("a.blsession") + "/entry/4: does not follow entry 0");
  ASSERT_EQ(why(journal->commit(first)), "");
  EXPECT_EQ(why(journal->commit(first)), folder.path("a.blsession") + "/entry/1: is stored already");
  EXPECT_EQ(journal->last_seq(), 3);
  ASSERT_EQ(why(journal->commit(second)), "");
  EXPECT_EQ(journal->load()->room.stored.entries.size(), 5u);
}

// A rewind that could not take place: what was said since belongs to another tick.
TEST(Journal, ARewindIsCalledOff) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  auto journal = fresh(path);
  const auto rename = [](std::int64_t seq, std::int64_t tick) {
    return room::EntryRecord{{.seq = seq,
                              .tick = tick,
                              .gesture = seq,
                              .author = "1",
                              .command = command<RenameNode>({"site", "Site " + std::to_string(seq)})}};
  };
  room::EntryRecord back{{.seq = 2, .tick = 9, .gesture = 2, .author = "1", .rewinds_to = 4}};
  ASSERT_EQ(why(journal->commit(of_entries({rename(1, 3), back, rename(3, 4)}))), "");
  back.entry.is_called_off = true;
  EXPECT_EQ(why(journal->commit(of_entries({back}))), path + "/entry/2: the entries after it are not there again");
  ASSERT_EQ(why(journal->commit(of_entries({back, rename(3, 9)}))), "");
  journal.reset();
  journal = again(path);
  const auto all = journal->load();
  ASSERT_EQ(all->room.stored.entries.size(), 3u);
  EXPECT_TRUE(all->room.stored.entries[1].entry.is_called_off);
  EXPECT_EQ(all->room.stored.entries[2].entry.tick, 9);
  const auto log = read_log(log_text(journal->room(), *all, full_registry()), full_registry());
  ASSERT_TRUE(log) << why(log);
  EXPECT_EQ(log->entries.size(), 2u);
}

TEST(Journal, TheNewestWholeSnapshotIsTaken) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  auto journal = fresh(path);
  RandomRecords records(its_scene(), 4);
  for (std::int64_t seq = 1; seq <= 4; ++seq) {
    ASSERT_EQ(why(journal->commit(records.next_of(1))), "");
    const std::string scene = "scene at " + std::to_string(seq);
    ASSERT_EQ(why(journal->add_snapshot({seq, seq * 10, 1, "0123456789abcdef", seq == 1 ? "variant A" : "", pack(scene)})), "");
  }
  auto all = journal->load();
  ASSERT_TRUE(all && all->snapshot);
  EXPECT_EQ(all->snapshot->tick, 40);
  EXPECT_EQ(*unpack(all->snapshot->scene), "scene at 4");
  EXPECT_TRUE(all->unusable_snapshots.empty());
  journal.reset();
  // Of those without a name the newest two are there.
  tamper(path, "UPDATE snapshot SET scene = x'00' WHERE seq = 4");
  journal = again(path);
  all = journal->load();
  ASSERT_TRUE(all && all->snapshot);
  EXPECT_EQ(*unpack(all->snapshot->scene), "scene at 3");
  ASSERT_EQ(all->unusable_snapshots.size(), 1u);
  EXPECT_EQ(all->unusable_snapshots[0].text(), "snapshot/4: the packed text is damaged");
  journal.reset();
  tamper(path, "DELETE FROM snapshot WHERE seq >= 3");
  all = again(path)->load();
  ASSERT_TRUE(all && all->snapshot);
  EXPECT_EQ(all->snapshot->name, "variant A");
}

TEST(Packed, IsTheSameTextOrNone) {
  for (const std::string& text : {std::string(), std::string("a"), std::string(100000, 'x'), a_room().scene}) {
    const Packed packed = pack(text);
    ASSERT_TRUE(unpack(packed));
    EXPECT_EQ(*unpack(packed), text);
    Packed other = packed;
    other.size += 1;
    EXPECT_FALSE(unpack(other));
    other = packed;
    other.digest = pack("other").digest;
    EXPECT_FALSE(unpack(other));
    other = packed;
    other.bytes.pop_back();
    EXPECT_FALSE(unpack(other));
  }
  EXPECT_FALSE(unpack({.bytes = "x", .size = std::int64_t{1} << 29, .digest = ""}));
}

// A session of three people with undo, rewinds and events: the log that comes out of the file runs to the hashes that were
// stored.
TEST(Journal, TheExportReplaysToTheSameHashes) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  auto journal = fresh(path);
  const auto started = Session::start(full_registry(), its_scene(), nullptr, 1);
  Session& session = **started;
  session.keep_states({6});
  Random random(11);
  std::vector<HashRow> hashes;
  std::size_t stored = 0;
  for (int tick = 0; tick < 24; ++tick) {
    for (int k = 0; k < 3; ++k) {
      const Author author = std::to_string(1 + random.below(3));
      if (random.below(4) == 0) (void)session.undo(author);
      else (void)session.submit(random_command(session.scene(), random, tick * 10 + k), author);
    }
    (void)session.ledger().note_event(R"({"event": "mark", "arguments": {"text": "t1"}})", "1", session.state()->tick);
    if (tick == 12) { ASSERT_EQ(why(session.rewind(6, "1")), ""); }
    room::Record record;
    for (; stored < session.log().size(); ++stored) record.entries.push_back({session.log()[stored], 1700000000000});
    ASSERT_EQ(why(journal->commit(record)), "");
    session.tick();
    if (tick % 4 == 3) hashes.push_back({journal->last_seq(), session.state()->tick, hex_digits(session.state()->hash)});
  }
  ASSERT_EQ(why(journal->add_hashes(hashes)), "");
  journal.reset();
  auto reader = Journal::open_to_read(path, full_registry());
  ASSERT_TRUE(reader) << why(reader);
  const auto all = (*reader)->load();
  ASSERT_TRUE(all) << why(all);
  EXPECT_TRUE(all->damage.empty());
  EXPECT_EQ(all->hashes, hashes);
  const auto log = read_log(log_text((*reader)->room(), *all, full_registry()), full_registry());
  ASSERT_TRUE(log) << why(log);
  EXPECT_TRUE(log->has_end);
  EXPECT_EQ(log->entries.size(), stored);
  for (const int threads : {1, 2}) {
    const auto report = replay(*log, full_registry(), threads);
    ASSERT_TRUE(report) << why(report);
    EXPECT_FALSE(report->first_mismatch);
    EXPECT_EQ(report->checks, hashes.size());
    EXPECT_EQ(report->hash, hashes.back().hash);
  }
}

struct Damage {
  std::string statement, sentence;
};

// Every kind of damage of rows is found, with its place; the file can still be read up to there.
TEST(Journal, DamageHasItsPlace) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  {
    auto journal = fresh(path);
    RandomRecords records(its_scene(), 5);
    for (int k = 0; k < 5; ++k) ASSERT_EQ(why(journal->commit(records.next_of(2))), "");
    room::Record record;
    record.refusals.push_back({"run", 1, {room::Reason::gap, "", "", {}}});
    record.draft_steps.push_back({"d1", 2, command<RemoveNode>({"site"})});
    record.secret_ballots.push_back({"v", "b", "[1]"});
    ASSERT_EQ(why(journal->commit(record)), "");
  }
  const std::string whole = bytes_of(path);
  const Damage cases[] = {
      {"DELETE FROM entry WHERE seq = 4", "/entry/5: follows entry 3: one is missing between"},
      {"DELETE FROM entry WHERE seq IN (1, 2)", "/entry/3: follows entry 0: some are missing between"},
      {"UPDATE entry SET line = replace(line, '\"seq\": 6', '\"seq\": 7') WHERE seq = 6", "/entry/6: its line has the number 7"},
      {"UPDATE entry SET line = substr(line, 1, 20) WHERE seq = 6", "/entry/6/line 1, column 21: "},
      {"UPDATE entry SET line = '[]' WHERE seq = 6", "/entry/6: expects an object"},
      {"UPDATE entry SET at = at + 1 WHERE seq = 2",
       "/entry/2: it is not what was stored: a byte of it, or of an entry before it, has changed"},
      {"UPDATE entry SET draft = 'x' WHERE seq = 10",
       "/entry/10: it is not what was stored: a byte of it, or of an entry before it, has changed"},
      {"UPDATE refusal SET why = 'mood'", "/refusal/run/1: there is no reason `mood`"},
      {"UPDATE refusal SET args = '{'", "/refusal/run/1/"},
      {"UPDATE draft_step SET command = '{\"command\": \"sing\"}'", "/draft_step/d1/2: unknown command `sing`"},
      {"UPDATE secret_ballot SET ballot = ''", "/secret_ballot/v/b: "},
      {"UPDATE room SET scene = x'0102'", "/room/scene: the packed text is damaged"},
      {"DELETE FROM room", "/room: the file has 0 rooms, and should have one"},
  };
  for (const auto& [statement, sentence] : cases) {
    SCOPED_TRACE(statement);
    write_bytes(path, whole);
    tamper(path, statement);
    const auto opened = Journal::open(path, full_registry(), {});
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().text().starts_with(path + sentence)) << opened.error().text();
    const auto reader = Journal::open_to_read(path, full_registry());
    if (statement.find("room") != std::string::npos) {
      EXPECT_FALSE(reader);
      continue;
    }
    ASSERT_TRUE(reader) << why(reader);
    const auto all = (*reader)->load();
    ASSERT_TRUE(all) << why(all);
    ASSERT_EQ(all->damage.size(), 1u);
    EXPECT_EQ(all->damage[0].text(), opened.error().text());
    if (statement.find("seq = 6") != std::string::npos) { EXPECT_EQ(all->room.stored.entries.size(), 5u); }
  }
}

// A byte anywhere in the file that is another one: it is told, or it was a byte that holds nothing.
TEST(Journal, AChangedByteIsFoundOrMeansNothing) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  std::string rows;
  {
    auto journal = fresh(path);
    RandomRecords records(its_scene(), 6);
    for (int k = 0; k < 12; ++k) ASSERT_EQ(why(journal->commit(records.next_of(3))), "");
    rows = rows_of(*journal->load());
  }
  const std::string whole = bytes_of(path);
  Random random(7);
  int found = 0, harmless = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    const std::size_t at = random.below(bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + random.below(255)));
    write_bytes(path, bytes);
    const auto opened = Journal::open(path, full_registry(), {});
    if (!opened) {
      ++found;
      EXPECT_FALSE(opened.error().message.empty());
      continue;
    }
    ++harmless;
    const auto all = (*opened)->load();
    ASSERT_TRUE(all) << why(all);
    // Rows of runs have no check sum: only entries do.
    const auto entries_in = [](const std::string& text) { return text.substr(0, text.find("run run")); };
    EXPECT_EQ(entries_in(rows_of(*all)), entries_in(rows)) << "byte " << at;
  }
  EXPECT_GT(found, 20);
  std::printf("of 300 changed bytes %d were found, %d meant nothing\n", found, harmless);
}

TEST(Journal, WhatIsNoSessionFileIsToldApart) {
  const Folder folder;
  const auto opened = [&](const std::string& name) { return why(Journal::open(folder.path(name), full_registry(), {})); };
  const auto said = [&](const std::string& name, const std::string& sentence) { return folder.path(name) + ": " + sentence; };
  { ASSERT_EQ(why(fresh(folder.path("a"))->commit(RandomRecords(its_scene(), 8).next_of(40))), ""); }
  const std::string whole = bytes_of(folder.path("a"));
  EXPECT_EQ(opened("none"), said("none", "the file cannot be opened: No such file or directory"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("none")));
  std::filesystem::create_directory(folder.path("folder"));
  EXPECT_EQ(opened("folder"), said("folder", "the file cannot be opened: Is a directory"));
  write_bytes(folder.path("empty"), "");
  EXPECT_EQ(opened("empty"), said("empty", "the file is empty: no session was stored in it"));
  write_bytes(folder.path("scene"), a_room().scene);
  EXPECT_EQ(opened("scene"), said("scene", "this is not a session file: it does not begin like one"));
  EXPECT_EQ(bytes_of(folder.path("scene")), a_room().scene);
  tamper(folder.path("foreign"), "CREATE TABLE song (title TEXT)");
  const std::string foreign = bytes_of(folder.path("foreign"));
  EXPECT_EQ(opened("foreign"), said("foreign", "this is not a session file: another program made it"));
  EXPECT_EQ(bytes_of(folder.path("foreign")), foreign);
  write_bytes(folder.path("newer"), whole);
  tamper(folder.path("newer"), "PRAGMA user_version=2");
  EXPECT_EQ(opened("newer"), said("newer", "the file is of version 2, and this program reads version 1: take a newer program"));
  for (const std::size_t size : {std::size_t{10}, std::size_t{100}, std::size_t{4096}, whole.size() / 2, whole.size() - 1}) {
    write_bytes(folder.path("cut"), whole.substr(0, size));
    EXPECT_NE(opened("cut"), "") << size;
  }
  EXPECT_EQ(why(Journal::create(folder.path("a"), a_room(), full_registry(), {})),
            said("a", "exists already: choose another name"));
  EXPECT_EQ(bytes_of(folder.path("a")), whole);
  EXPECT_EQ(why(Journal::create(folder.path("no/such"), a_room(), full_registry(), {})),
            said("no/such", "the file cannot be opened: No such file or directory"));
}

// What a process is told that has not the rights of the administrator, who may do all; "" where nothing.
std::string told_to_others(const std::function<std::string()>& attempt) {
  int answer[2];
  if (pipe(answer) != 0) return "no pipe";
  const pid_t other = fork();
  if (other == 0) {
    const bool is_lowered = geteuid() != 0 || (setgid(65534) == 0 && setuid(65534) == 0);
    const std::string said = is_lowered ? attempt() : "the rights stay";
    (void)!write(answer[1], said.data(), said.size());
    _exit(0);
  }
  close(answer[1]);
  std::string said(1000, '\0');
  const ssize_t count = read(answer[0], said.data(), said.size());
  close(answer[0]);
  waitpid(other, nullptr, 0);
  said.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return said;
}

TEST(Journal, ThePermissionToWriteIsAskedForAtOnce) {
  using std::filesystem::perms;
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  { fresh(path); }
  std::filesystem::permissions(folder.path(""), perms::all);
  std::filesystem::permissions(path, perms::owner_read | perms::group_read | perms::others_read);
  const auto open = [&] { return why(Journal::open(path, full_registry(), {})); };
  const auto open_to_read = [&] { return why(Journal::open_to_read(path, full_registry())); };
  EXPECT_EQ(told_to_others(open),
            path + ": the file may not be changed: you lack the right to write it, or its disk is read-only");
  EXPECT_EQ(told_to_others(open_to_read), "");
  // Not even the folder may be written: SQLite cannot make its small files there.
  std::filesystem::permissions(folder.path(""), perms::owner_all | perms::others_read | perms::others_exec);
  EXPECT_EQ(told_to_others(open_to_read), "");
  std::filesystem::permissions(path, perms::none);
  EXPECT_EQ(told_to_others(open), path + ": the file cannot be opened: Permission denied");
  EXPECT_EQ(told_to_others(open_to_read), path + ": the file cannot be opened: Permission denied");
}

// A process that stores and tells is killed at any moment, again and again: all that it told is there, once and in order.
TEST(Journal, AKilledProcessLosesNothingThatItTold) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  { fresh(path); }
  Random random(13);
  std::int64_t told = 0;
  for (int kill_number = 0; kill_number < 40; ++kill_number) {
    int answer[2];
    ASSERT_EQ(pipe(answer), 0);
    const pid_t other = fork();
    ASSERT_GE(other, 0);
    if (other == 0) {
      auto journal = Journal::open(path, full_registry(), {});
      if (!journal) _exit(1);
      RandomRecords records(its_scene(), static_cast<std::uint64_t>(kill_number), (*journal)->last_seq());
      while ((*journal)->commit(records.next_of(1 + kill_number % 5))) {
        const std::int64_t seq = (*journal)->last_seq();
        (void)!write(answer[1], &seq, sizeof seq);
      }
      _exit(1);
    }
    close(answer[1]);
    // It has begun; then it is ended in the middle of something.
    std::int64_t seq = 0;
    ASSERT_EQ(read(answer[0], &seq, sizeof seq), static_cast<ssize_t>(sizeof seq)) << kill_number;
    usleep(static_cast<useconds_t>(random.below(20000)));
    kill(other, SIGKILL);
    waitpid(other, nullptr, 0);
    do told = seq;
    while (read(answer[0], &seq, sizeof seq) == static_cast<ssize_t>(sizeof seq));
    close(answer[0]);
    const auto journal = again(path);
    ASSERT_NE(journal, nullptr);
    EXPECT_GE(journal->last_seq(), told);
    EXPECT_LE(journal->last_seq(), told + 5);  // the one that was not told
    EXPECT_EQ(journal->load()->room.stored.entries.size(), static_cast<std::size_t>(journal->last_seq()));
  }
  std::printf("40 kills, %lld entries\n", static_cast<long long>(told));
}

// Another process is told who has the file. It ends by a kill, and then the file is free, with what was stored.
TEST(Journal, ASecondProcessIsToldWhoHasTheFile) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t other = fork();
  ASSERT_GE(other, 0);
  if (other == 0) {
    auto journal = Journal::create(path, a_room(), full_registry(), {.opened_at = 1772357400000});
    const bool is_done = journal && (*journal)->commit(RandomRecords(its_scene(), 9).next_of(3));
    const char mark = is_done ? '+' : '-';
    (void)!write(ready[1], &mark, 1);
    while (true) pause();
  }
  char mark = 0;
  ASSERT_EQ(read(ready[0], &mark, 1), 1);
  EXPECT_EQ(mark, '+');
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  const std::string sentence = path + ": another program has this file open: process " + std::to_string(other) +
                               " on the computer " + host + ", since 2026-03-01 09:30 UTC; end it first";
  EXPECT_EQ(why(Journal::open(path, full_registry(), {})), sentence);
  EXPECT_EQ(why(Journal::open_to_read(path, full_registry())), sentence);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
  {
    const auto journal = again(path);
    ASSERT_NE(journal, nullptr);
    EXPECT_EQ(journal->load()->room.stored.entries.size(), 3u);
    // In this process as well, and the note names the new holder.
    EXPECT_NE(why(Journal::open(path, full_registry(), {})).find("process " + std::to_string(getpid())), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(path + "-holder"));
  EXPECT_FALSE(std::filesystem::exists(path + "-wal"));
}

// A file that a crash has left can be read without being changed, also what was not yet brought into it.
TEST(Journal, WhatACrashHasLeftIsRead) {
  const Folder folder;
  const std::string path = folder.path("a.blsession"), copy = folder.path("b.blsession");
  auto journal = fresh(path);
  ASSERT_EQ(why(journal->commit(RandomRecords(its_scene(), 10).next_of(5))), "");
  // By another process: this one would lose its locks with the first file that it closes.
  ASSERT_EQ(std::system(("cp " + path + " " + copy + " && cp " + path + "-wal " + copy + "-wal").c_str()), 0);
  const std::string before = bytes_of(copy);
  {
    auto reader = Journal::open_to_read(copy, full_registry());
    ASSERT_TRUE(reader) << why(reader);
    EXPECT_EQ((*reader)->load()->room.stored.entries.size(), 5u);
  }
  EXPECT_EQ(bytes_of(copy), before);
  EXPECT_EQ(again(copy)->load()->room.stored.entries.size(), 5u);
  EXPECT_NE(bytes_of(copy), before);
}

TEST(Journal, TheRoomChangesButForItsBeginning) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  auto journal = fresh(path);
  RoomRow room = a_room();
  room.title = "Renamed";
  room.epoch = 2;
  room.scene = "none";
  ASSERT_EQ(why(journal->change_room(room)), "");
  EXPECT_EQ(journal->room().scene, a_room().scene);
  journal.reset();
  journal = again(path);
  EXPECT_EQ(journal->room().title, "Renamed");
  EXPECT_EQ(journal->room().epoch, 2);
  EXPECT_EQ(journal->room().scene, a_room().scene);
  EXPECT_EQ(journal->room().erase_on, 1800000000000);
}

}  // namespace
}  // namespace bl::journal::test
