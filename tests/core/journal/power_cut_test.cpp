// The proof that no acknowledged commit is lost: the power is cut at random moments, the disk fails and is full, and each time
// all is there.
#include <gtest/gtest.h>

#include "tests/core/journal/room_file.h"
#include "tests/core/journal/torn_disk.h"
#include "tests/support/random_records.h"
#include "tests/support/sanitized.h"

namespace bl::journal::test {
namespace {

// A room on a disk that forgets. It knows what was acknowledged, and what was under way when the power went.
class RoomOnTornDisk {
 public:
  RoomOnTornDisk(std::uint64_t seed, const char* synchronous)
      : disk_(seed), random_(seed, 1), records_(its_scene(), seed), path_(folder_.path("a.blsession")) {
    options_.vfs = disk_.name();
    options_.synchronous = synchronous;
    // Small, because it is written for each of thousands of rooms.
    room_.scene = "{}";
  }

  std::string create() {
    auto made = Journal::create(path_, room_, full_registry(), options_);
    if (made) journal_ = std::move(*made);
    return why(made);
  }

  // Works until the power goes. What is wrong otherwise, or "".
  std::string work_until_cut() {
    disk_.cut_after(static_cast<std::int64_t>(random_.below(90)));
    while (!disk_.is_cut()) {
      const std::string failed = step();
      if (!failed.empty() && !disk_.is_cut()) return failed;
    }
    journal_.reset();
    return "";
  }

  // One step of a room's life.
  std::string step() {
    const std::uint64_t kind = random_.below(24);
    if (kind == 0) return why(journal_->checkpoint());
    if (kind == 1) {
      journal_.reset();
      return open();
    }
    if (kind == 2) {
      const std::int64_t seq = journal_->last_seq();
      return why(journal_->add_snapshot({seq, seq, 1, "", "", pack(std::string(random_.below(20000), 's'))}));
    }
    // Nobody sits there: the file is built anew, and nothing else changes.
    if (kind == 3) return why(journal_->erase(99));
    return commit();
  }

  std::string commit() {
    const room::Record record = records_.next();
    const auto done = journal_->commit(record);
    if (done) acknowledged_.add(record);
    else if (disk_.is_cut()) under_way_ = record;
    else records_.take_back();
    return why(done);
  }

  std::string open() {
    auto opened = Journal::open(path_, full_registry(), options_);
    if (opened) journal_ = std::move(*opened);
    return why(opened);
  }

  // Power on; what is wrong with what is there, or "".
  std::string come_back() {
    disk_.power_on();
    if (auto failed = open(); !failed.empty()) return failed;
    return compare();
  }

  std::string compare() {
    const auto all = journal_->load();
    if (!all) return why(all);
    if (!all->unusable_snapshots.empty()) return all->unusable_snapshots[0].text();
    StoredRows found;
    found.add(all->room.stored);
    if (found.text() == acknowledged_.text()) {
      if (under_way_) records_.take_back();
    } else if (under_way_) {
      // It was not acknowledged, but it had come so far that it is there as a whole.
      StoredRows more = acknowledged_;
      more.add(*under_way_);
      if (auto difference = first_difference(found.text(), more.text()); !difference.empty())
        return first_difference(found.text(), acknowledged_.text());
      acknowledged_ = more;
      ++finished_;
    } else {
      return first_difference(found.text(), acknowledged_.text());
    }
    under_way_.reset();
    return "";
  }

  TornDisk& disk() { return disk_; }
  Random& random() { return random_; }
  int finished() const { return finished_; }
  std::int64_t entries() const { return journal_->last_seq(); }

 private:
  const Folder folder_;
  TornDisk disk_;
  Random random_;
  RandomRecords records_;
  std::string path_;
  Journal::Options options_;
  RoomRow room_ = a_room();
  std::unique_ptr<Journal> journal_;
  StoredRows acknowledged_;
  std::optional<room::Record> under_way_;
  int finished_ = 0;
};

struct Tally {
  int cuts = 0, losses = 0, finished = 0;
  std::int64_t entries = 0;
  std::string first;
};

// Rooms of up to 20 cuts each, until there are so many; a room that has lost something ends.
Tally cut_many(int cuts, std::uint64_t seed, const char* synchronous) {
  Tally tally;
  while (tally.cuts < cuts) {
    RoomOnTornDisk room(++seed, synchronous);
    std::string wrong = room.create();
    for (int k = 0; k < 20 && tally.cuts < cuts && wrong.empty(); ++k) {
      wrong = room.work_until_cut();
      ++tally.cuts;
      if (wrong.empty()) wrong = room.come_back();
    }
    tally.finished += room.finished();
    if (wrong.empty()) {
      tally.entries += room.entries();
      continue;
    }
    ++tally.losses;
    if (tally.first.empty()) tally.first = "seed " + std::to_string(seed) + ": " + wrong;
  }
  std::printf("%s: %d cuts of the power, %d losses; %lld entries are there, %d commits without an answer were there as a whole\n",
              synchronous, tally.cuts, tally.losses, static_cast<long long>(tally.entries), tally.finished);
  return tally;
}

constexpr int kCuts = bl::test::kIsSanitized ? 200 : 2400;

TEST(PowerCut, LosesNoAcknowledgedCommit) {
  const Tally tally = cut_many(kCuts, 1000, "FULL");
  EXPECT_EQ(tally.losses, 0) << tally.first;
  EXPECT_GT(tally.entries, kCuts);
  EXPECT_GT(tally.finished, 0);
}

// With less than is promised the same test finds the losses: it can fail.
TEST(PowerCut, LossesAreFound) {
  for (const char* synchronous : {"NORMAL", "OFF"}) {
    const Tally tally = cut_many(200, 5000, synchronous);
    EXPECT_GT(tally.losses, 0) << synchronous;
    std::printf("  such as %.300s\n", tally.first.c_str());
  }
}

// The disk fails or is full for some calls: the journal says so, nothing of that commit is there, and it goes on afterwards. Then
// the power is cut, and all that was acknowledged is there.
TEST(PowerCut, ADiskThatFailsOrIsFullLosesNothing) {
  int failures = 0, full = 0;
  for (std::uint64_t seed = 1; seed <= (bl::test::kIsSanitized ? 30u : 400u); ++seed) {
    SCOPED_TRACE(seed);
    RoomOnTornDisk room(seed + 9000, "FULL");
    ASSERT_EQ(room.create(), "");
    for (int round = 0; round < 6; ++round) {
      for (int k = 0; k < 3; ++k) ASSERT_EQ(room.commit(), "");
      const bool is_full = room.random().below(2) == 0;
      room.disk().fail_after(static_cast<std::int64_t>(room.random().below(12)),
                             static_cast<std::int64_t>(1 + room.random().below(6)),
                             is_full ? TornDisk::Fault::full : TornDisk::Fault::error);
      for (int k = 0; k < 8; ++k) {
        const std::string said = room.commit();
        if (said.empty()) continue;
        ++failures;
        full += is_full ? 1 : 0;
        EXPECT_TRUE(said.find(is_full ? "the disk is full: free some space" : "the disk does not read or write") !=
                    std::string::npos)
            << said;
      }
      room.disk().heal();
      ASSERT_EQ(room.commit(), "");
      ASSERT_EQ(room.compare(), "");
      ASSERT_EQ(room.work_until_cut(), "");
      ASSERT_EQ(room.come_back(), "");
    }
  }
  std::printf("%d commits failed, %d of them because the disk was full\n", failures, full);
  EXPECT_GT(full, 50);
  EXPECT_GT(failures - full, 50);
}

}  // namespace
}  // namespace bl::journal::test
