// A copy of a session file that repeats each change holds the same rows, whatever the changes are.
#include "core/journal/copy.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "core/journal/journal.h"
#include "tests/core/journal/room_file.h"
#include "tests/support/random_records.h"

namespace bl::journal::test {
namespace {

std::string rows_in(const std::string& path) {
  const auto journal = Journal::open(path, full_registry(), {});
  EXPECT_TRUE(journal) << why(journal);
  if (!journal) return "";
  const auto all = (*journal)->load();
  EXPECT_TRUE(all) << why(all);
  StoredRows rows;
  rows.add(all->room.stored);
  return rows.text() + all->chain + std::to_string(all->hashes.size()) + (all->snapshot ? all->snapshot->scene.digest : "");
}

// Law: whole file, then each change: the copy is the file, also after it was closed and begun again in between.
TEST(Copy, HoldsWhatTheOriginalHolds) {
  const Folder folder;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const std::string path = folder.path(std::to_string(seed) + ".blsession"), there = path + ".copy";
    RandomRecords records(its_scene(), seed);
    auto journal = Journal::create(path, a_room(), full_registry(), {});
    ASSERT_TRUE(journal) << why(journal);
    std::vector<std::string> changes;
    std::string whole;
    const auto begin = [&] {
      auto bytes = (*journal)->copied([&](const Result<std::string>& change) {
        ASSERT_TRUE(change) << why(change);
        changes.push_back(*change);
      });
      ASSERT_TRUE(bytes) << why(bytes);
      whole = *bytes;
    };
    auto copy = Copy::open(there, 1);
    ASSERT_TRUE(copy) << why(copy);
    EXPECT_FALSE((*copy)->is_of_use());
    for (int round = 0; round < 60; ++round) {
      if (round % 25 == 5) {
        begin();
        ASSERT_EQ(why((*copy)->take(whole)), "");
        changes.clear();
      }
      ASSERT_EQ(why((*journal)->commit(records.next())), "");
      if (round % 9 == 0) {
        const HashRow row{(*journal)->last_seq(), round, "0123456789abcdef"};
        ASSERT_EQ(why((*journal)->add_hashes(std::span(&row, 1))), "");
        const Snapshot snapshot{
            .seq = (*journal)->last_seq(), .tick = round, .hash = "", .scene = pack("a scene " + std::to_string(round))};
        ASSERT_EQ(why((*journal)->add_snapshot(snapshot)), "");
      }
      if (round == 44) {
        copy->reset();
        copy = Copy::open(there, 1);
        ASSERT_TRUE(copy) << why(copy);
      }
      for (const std::string& change : changes)
        if (round >= 5) {
          ASSERT_EQ(why((*copy)->repeat(change)), "");
        }
      changes.clear();
    }
    EXPECT_TRUE((*copy)->is_of_use());
    ASSERT_EQ(why((*copy)->close()), "");
    journal->reset();
    EXPECT_EQ(first_difference(rows_in(there), rows_in(path)), "");
  }
}

TEST(Copy, WhatIsErasedIsInNoByteOfIt) {
  const Folder folder;
  auto journal = Journal::create(folder.path("a.blsession"), a_room(), full_registry(), {});
  ASSERT_TRUE(journal) << why(journal);
  const std::string there = folder.path("b.blsession");
  auto copy = Copy::open(there, 1);
  ASSERT_TRUE(copy) << why(copy);
  std::vector<std::string> changes;
  const auto whole = (*journal)->copied([&](const Result<std::string>& change) { changes.push_back(*change); });
  ASSERT_TRUE(whole) << why(whole);
  ASSERT_EQ(why((*copy)->take(*whole)), "");
  const auto pass_on = [&] {
    for (const std::string& change : std::exchange(changes, {})) ASSERT_EQ(why((*copy)->repeat(change)), "");
  };
  const auto holds = [&](const std::string& word) {
    return bytes_of(there).find(word) != std::string::npos || bytes_of(there + "-wal").find(word) != std::string::npos;
  };
  room::Record record;
  record.persons.push_back({1, "Quirinius", "", "", 0});
  record.texts.push_back({"text1", 1, "comment.text", "xylophone", false});
  record.ballot_keys.push_back({"poll", "keykeykey"});
  ASSERT_EQ(why((*journal)->commit(record)), "");
  pass_on();
  EXPECT_TRUE(holds("Quirinius") && holds("xylophone") && holds("keykeykey"));
  room::Record away;
  away.persons.push_back({1, "", "", "", 0});
  away.texts.push_back({"text1", 1, "comment.text", "", true});
  away.ballot_keys.push_back({"poll", ""});
  ASSERT_EQ(why((*journal)->commit(away)), "");
  pass_on();
  EXPECT_FALSE(holds("Quirinius") || holds("xylophone") || holds("keykeykey"));
}

TEST(Copy, RefusesWhatDoesNotBelongToIt) {
  const Folder folder;
  const std::string path = folder.path("copy.blsession");
  auto copy = Copy::open(path, 1);
  ASSERT_TRUE(copy) << why(copy);
  EXPECT_FALSE((*copy)->take("not a session file"));
  EXPECT_FALSE((*copy)->take(std::string(4096, '\1')));
  EXPECT_FALSE((*copy)->repeat("nothing of the kind"));
  EXPECT_FALSE((*copy)->is_of_use());
  const auto room = [&](const char* name, const char* code) {
    RoomRow row = a_room();
    row.code = code;
    auto journal = Journal::create(folder.path(name), row, full_registry(), {});
    EXPECT_TRUE(journal) << why(journal);
    return *(*journal)->copied([](const Result<std::string>&) {});
  };
  ASSERT_EQ(why((*copy)->take(room("a", "AAAA"))), "");
  const auto other = (*copy)->take(room("b", "BBBB"));
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("another room"), std::string::npos);
  EXPECT_EQ(why((*copy)->take(room("c", "AAAA"))), "");
  const auto second = Copy::open(path, 1);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::conflict);
  std::ofstream(folder.path("letter")) << "Dear all, this is a letter and no database.";
  EXPECT_FALSE(Copy::open(folder.path("letter"), 1));
}

}  // namespace
}  // namespace bl::journal::test
