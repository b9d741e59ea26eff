// A person who is taken out of a session file is in no byte of it, and the log leads to the same hashes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/journal/export.h"
#include "core/session/session.h"
#include "tests/core/journal/room_file.h"
#include "tests/support/random_records.h"

namespace bl::journal::test {
namespace {

// The bytes of the file and of all beside it, while it is open: read by another process, because this one would lose its locks
// with the first file that it closes.
std::string all_bytes(const Folder& folder) {
  EXPECT_EQ(std::system(("cat " + folder.path("") + "a.blsession* > " + folder.path("all")).c_str()), 0);
  std::ifstream file(folder.path("all"), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

const std::vector<std::string> kSecrets = {"Beatrix Quillfeather", "bea.q@example.org", "My aunt lives in the third house",
                                           "the crooked willow must stay", "a3f1a3f1a3f1a3f1"};

room::Record of_a_person() {
  room::Record record;
  record.persons.push_back({3, kSecrets[0], kSecrets[1], "en", 1700000000000});
  record.persons.push_back({4, "Ben", "", "en", 1700000000000});
  record.texts.push_back({"t3", 3, "comment", kSecrets[2], false});
  record.texts.push_back({"t5", 3, "proposal", kSecrets[3] + std::string(9000, '.') + kSecrets[3], false});
  record.texts.push_back({"t4", 4, "comment", "Ben's own words", false});
  record.tokens.push_back({3, kSecrets[4]});
  record.tokens.push_back({4, "b4b4b4b4b4b4b4b4"});
  record.refusals.push_back({"run9",
                             2,
                             {room::Reason::area, "nodes/school", kSecrets[0] + " holds the pen of the north",
                              R"({"holder": "Beatrix Quillfeather", "area": "north"})"}});
  return record;
}

int secrets_in(const std::string& bytes) {
  int count = 0;
  for (const std::string& secret : kSecrets) count += bytes.find(secret) != std::string::npos ? 1 : 0;
  return count;
}

TEST(Erasing, LeavesNoByteOfAPersonAndTheSameLog) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  auto journal = std::move(*Journal::create(path, a_room(), full_registry(), {}));
  const auto session = std::move(*Session::start(full_registry(), its_scene(), nullptr, 1));
  RandomRecords others(its_scene(), 12);
  std::vector<HashRow> hashes;
  // Rows come and go around those of the person, so that pages are divided and filled again.
  for (int k = 0; k < 40; ++k) {
    room::Record record;
    if (session->submit(command<RenameNode>({"site", "Site " + std::to_string(k)}), "3"))
      record.entries.push_back({session->log().back(), 1700000000000});
    record.texts.push_back(
        {"o" + std::to_string(k % 13), 4, "comment", std::string(static_cast<std::size_t>(37 * k), 'o'), false});
    ASSERT_EQ(why(journal->commit(record)), "");
    if (k == 10 || k == 25) { ASSERT_EQ(why(journal->commit(of_a_person())), ""); }
    if (k == 20) { ASSERT_EQ(why(journal->checkpoint()), ""); }
    session->tick();
    if (k % 8 == 7) hashes.push_back({journal->last_seq(), session->state()->tick, hex_digits(session->state()->hash)});
  }
  ASSERT_EQ(why(journal->add_hashes(hashes)), "");
  EXPECT_EQ(secrets_in(all_bytes(folder)), 5);
  const std::string log = log_text(journal->room(), *journal->load(), full_registry());

  const auto erased = journal->erase(3);
  ASSERT_TRUE(erased) << why(erased);
  EXPECT_EQ(erased->persons, 1u);
  EXPECT_EQ(erased->texts, 2u);
  EXPECT_EQ(erased->tokens, 1u);
  EXPECT_EQ(erased->refusals, 1u);
  EXPECT_EQ(secrets_in(all_bytes(folder)), 0);
  EXPECT_EQ(std::filesystem::file_size(path + "-wal"), 0u);
  EXPECT_NE(all_bytes(folder).find("Ben's own words"), std::string::npos);

  const auto all = journal->load();
  ASSERT_TRUE(all) << why(all);
  EXPECT_EQ(log_text(journal->room(), *all, full_registry()), log);
  const auto report = replay(*read_log(log, full_registry()), full_registry(), 1);
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->first_mismatch);
  EXPECT_EQ(report->checks, hashes.size());
  ASSERT_EQ(all->room.stored.persons.size(), 1u);
  EXPECT_EQ(all->room.stored.persons[0].name, "Ben");
  for (const auto& text : all->room.stored.texts) {
    EXPECT_EQ(text.is_erased, text.seat == 3) << text.id;
    EXPECT_EQ(text.body == "[erased]", text.seat == 3) << text.id;
  }
  EXPECT_EQ(all->room.stored.tokens[0].hash, "");
  EXPECT_EQ(all->room.stored.tokens[1].hash, "b4b4b4b4b4b4b4b4");
  // The reason stays, so that the same operation is refused again.
  ASSERT_EQ(all->room.stored.refusals.size(), 1u);
  EXPECT_EQ(all->room.stored.refusals[0].refusal.why, room::Reason::area);

  // Once more there is nothing to take out; and the file goes on, and opens.
  EXPECT_EQ(journal->erase(3)->persons + journal->erase(3)->texts + journal->erase(3)->tokens, 0u);
  ASSERT_EQ(why(journal->commit(others.next_of(0))), "");
  journal.reset();
  EXPECT_EQ(why(Journal::open(path, full_registry(), {})), "");
  EXPECT_EQ(secrets_in(all_bytes(folder)), 0);
}

// The ballots of a secret vote and its key are gone from the disk once the log has the ballots, not only from the tables.
TEST(Erasing, ADestroyedKeyIsInNoByte) {
  const Folder folder;
  auto journal = std::move(*Journal::create(folder.path("a.blsession"), a_room(), full_registry(), {}));
  room::Record open;
  open.ballot_keys.push_back({"tower", "kkkk1111kkkk2222"});
  open.secret_ballots.push_back({"tower", "ba11ba11ba11", R"({"choice": "very high"})"});
  ASSERT_EQ(why(journal->commit(open)), "");
  ASSERT_EQ(why(journal->checkpoint()), "");
  ASSERT_EQ(why(journal->commit(open)), "");
  EXPECT_NE(all_bytes(folder).find("kkkk1111kkkk2222"), std::string::npos);
  room::Record closed;
  closed.ballot_keys.push_back({"tower", ""});
  closed.ballots_in_log.push_back("tower");
  ASSERT_EQ(why(journal->commit(closed)), "");
  for (const char* secret : {"kkkk1111kkkk2222", "ba11ba11ba11", "very high"})
    EXPECT_EQ(all_bytes(folder).find(secret), std::string::npos) << secret;
  EXPECT_EQ(journal->load()->room.stored.ballot_keys.at(0).key, "");
}

}  // namespace
}  // namespace bl::journal::test
