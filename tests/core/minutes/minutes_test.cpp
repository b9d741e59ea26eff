// Minutes against the room that they tell of: nothing is missing, nothing is added, and what is secret or erased stays so.
#include "core/minutes/minutes.h"

#include <algorithm>
#include <filesystem>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/csv/csv_table.h"
#include "core/file/file_io.h"
#include "core/minutes/page.h"
#include "core/minutes/tables.h"
#include "tests/core/journal/room_file.h"
#include "tests/core/minutes/told_session.h"

namespace bl::minutes {
namespace {

using journal::test::Folder;

Account account_in(const std::string& path) {
  const auto journal = journal::Journal::open_to_read(path, full_registry());
  EXPECT_TRUE(journal);
  const auto loaded = (*journal)->load();
  auto account = account_of((*journal)->room(), *loaded, full_registry());
  EXPECT_TRUE(account) << account.error().text();
  return account ? std::move(*account) : Account{};
}

// Rows of a table as its readers find them.
class Rows {
 public:
  explicit Rows(const std::string& text) : records_(csv::read_csv(text)->records) {}
  std::size_t count() const { return records_.size() - 1; }
  std::string at(std::size_t row, const std::string& column) const {
    const auto& header = records_[0].fields;
    const auto found = std::find(header.begin(), header.end(), column);
    EXPECT_NE(found, header.end()) << column;
    const auto& fields = records_[row + 1].fields;
    const auto k = static_cast<std::size_t>(found - header.begin());
    EXPECT_EQ(fields.size(), header.size()) << row;
    return k < fields.size() ? fields[k] : "";
  }
  double sum(const std::string& column, const std::string& key = "", const std::string& value = "") const {
    double sum = 0;
    for (std::size_t row = 0; row < count(); ++row)
      if (key.empty() || at(row, key) == value) sum += parse_number(at(row, column)).value_or(0);
    return sum;
  }

 private:
  std::vector<csv::CsvRecord> records_;
};

class Minutes : public testing::Test {
 protected:
  Minutes() {
    session.store(folder.path("s.blsession"));
    account = account_in(folder.path("s.blsession"));
  }
  const room::RoomState& state() { return session.world.room().state(); }

  Folder folder;
  ToldSession session;
  Account account;
};

TEST_F(Minutes, TheFoldIsThatOfTheRoom) {
  EXPECT_EQ(account.state, state());
  EXPECT_EQ(account.last_scene, write_scene(session.world.scene(), full_registry()));
  EXPECT_EQ(account.entries, session.world.disk.entries.size());
  EXPECT_EQ(account.chain.size(), 16u);
}

TEST_F(Minutes, AScenarioIsTheFoldUpToItsEntry) {
  ASSERT_EQ(account.scenarios.size(), 1u);
  const std::int64_t seq = state().scenarios.at("end").seq;
  Ledger plain(full_registry(), read_scene(room::kTable, full_registry()).scene);
  for (const room::EntryRecord& record : session.world.disk.entries)
    if (record.entry.seq <= seq) { ASSERT_TRUE(plain.replay(record.entry)); }
  EXPECT_EQ(account.scenarios[0].scene, write_scene(plain.scene(), full_registry()));
  EXPECT_EQ(account.scenarios[0].scene, write_scene(session.at_scenario, full_registry()));
  EXPECT_NE(account.scenarios[0].scene, account.last_scene);
  EXPECT_EQ(account.scenarios[0].file(), "scenes/_end.json") << "the end of the session has that name";
}

TEST_F(Minutes, TablesAddUpToTheRoom) {
  const Rows decisions(decisions_csv(account)), comments(comments_csv(account)), votes(votes_csv(account));
  ASSERT_EQ(decisions.count(), state().marks.size());
  for (std::size_t k = 0; k < decisions.count(); ++k) EXPECT_EQ(decisions.at(k, "entry"), std::to_string(state().marks[k].seq));
  EXPECT_EQ(decisions.at(0, "text"), "The park stays");
  EXPECT_EQ(decisions.at(0, "time"), "2026-03-01 09:31 UTC");
  EXPECT_EQ(csv::text_of_harmless(decisions.at(1, "text")), "=Ask the owner\nof the yard");

  ASSERT_EQ(comments.count(), state().comments.size());
  double agree = 0, disagree = 0;
  for (const auto& [id, comment] : state().comments)
    for (const auto& [seat, rating] : comment.ratings) (rating > 0 ? agree : disagree) += 1;
  EXPECT_EQ(comments.sum("agree"), agree);
  EXPECT_EQ(comments.sum("disagree"), disagree);
  EXPECT_EQ(agree, 2);
  EXPECT_EQ(comments.at(0, "id") + comments.at(1, "id") + comments.at(2, "id"), "c1a2b3") << "in the order in which they came";
  EXPECT_EQ(comments.at(2, "answer"), "We follow it");
  EXPECT_EQ(comments.at(2, "about_y [m]"), "2.5");
  EXPECT_EQ(comments.at(1, "answers_comment"), "c1");
  EXPECT_EQ(comments.at(0, "text"), "[erased]");

  ASSERT_EQ(account.rounds.size(), 3u);
  for (const char* vote : {"poll", "secret_poll"}) {
    const auto& table = *std::get<Shared<Table>>(session.world.scene().nodes.at(vote).types.at("vote").at("ballots"));
    const double cast = vote == std::string("poll") ? 2 : static_cast<double>(table.rows.size());
    EXPECT_EQ(votes.sum("points", "vote", vote), cast) << vote;
  }
}

TEST_F(Minutes, EachRoundHasItsOwnResult) {
  const Round &first = account.rounds[0], &secret = account.rounds[1], &again = account.rounds[2];
  EXPECT_EQ(first.outcome.tallies.at(1).points, 2) << "anna changed her mind";
  EXPECT_EQ(first.ballots.size(), 2u);
  EXPECT_EQ(first.closed->at - first.opened.at, 4 * 60000);
  EXPECT_EQ(secret.outcome.counted, 3) << "with those that came into the log at the close";
  EXPECT_EQ(secret.outcome.tallies.at(1).points, 2);
  EXPECT_EQ(secret.seats, 4);
  EXPECT_EQ(again.number, 2);
  EXPECT_FALSE(again.closed);
  EXPECT_EQ(again.outcome.counted, 3);
  EXPECT_TRUE(again.outcome.tallies.empty()) << "it is open, and shows its result when it is closed";
  EXPECT_TRUE(again.ballots.empty());
}

TEST_F(Minutes, ASecretVoteHasNoSeats) {
  const Rows votes(votes_csv(account));
  int ballots = 0;
  for (std::size_t row = 0; row < votes.count(); ++row) {
    if (votes.at(row, "row") == "ballot") ++ballots;
    if (votes.at(row, "vote") != "secret_poll") continue;
    EXPECT_NE(votes.at(row, "row"), "ballot");
    EXPECT_EQ(votes.at(row, "seat") + votes.at(row, "pseudonym") + votes.at(row, "answer"), "");
  }
  EXPECT_EQ(ballots, 2);
  EXPECT_TRUE(account.rounds[1].ballots.empty());
}

// One that was held openly and then in secret: the ballots of before are not told either.
TEST(MinutesOfVotes, AVoteThatBecameSecretHasNoSeatsBefore) {
  ToldSession session;
  ASSERT_EQ(room::sentence(session.world.event(session.lead, "close_vote", R"({"vote": "poll"})")), "");
  ASSERT_EQ(room::sentence(session.world.command(session.lead, command<SetPort>({"poll", {"vote.is_secret"}, {"true"}}))), "");
  ASSERT_EQ(room::sentence(session.world.event(session.lead, "open_vote", R"({"vote": "poll"})")), "");
  const Folder folder;
  session.store(folder.path("s.blsession"));
  const Account account = account_in(folder.path("s.blsession"));
  ASSERT_EQ(account.rounds.size(), 4u);
  for (const Round& round : account.rounds) EXPECT_TRUE(round.ballots.empty()) << round.vote << round.number;
}

TEST_F(Minutes, PhasesAndProposalsAreToldInOrder) {
  ASSERT_EQ(account.phases.size(), 2u) << "another timer is no other phase";
  EXPECT_EQ(account.title_words(account.phases[0].phase.name), "Look around");
  EXPECT_EQ(account.phases[0].end->seq, account.phases[1].begin.seq);
  EXPECT_EQ(account.phases[1].phase, state().phase);
  EXPECT_FALSE(account.phases[1].end);
  ASSERT_EQ(account.proposals.size(), 3u);
  EXPECT_EQ(account.proposals[0].proposal.kept, 1);
  EXPECT_EQ(account.proposals[0].proposal.steps, 2);
  EXPECT_EQ(account.title_words(account.proposals[1].proposal.title), "Lower south");
  EXPECT_EQ(account.proposals[1].proposal.state, room::ProposalState::rejected);
  EXPECT_EQ(account.words(account.proposals[1].proposal.answer), "Too low");
  EXPECT_EQ(account.proposals[2].proposal, state().proposals.at("e"));
  EXPECT_EQ(account.refusals, (std::map<room::Reason, int>{{room::Reason::gone, 1}, {room::Reason::right, 2}}));
}

TEST_F(Minutes, ThePageSaysAllOfIt) {
  const std::string page = write_page(account);
  for (const room::Mark& mark : state().marks)
    EXPECT_NE(page.find("<td>" + drawing::escape_xml(account.words(mark.text)) + "</td>"), std::string::npos) << mark.seq;
  for (const char* text :
       {"Quarter &lt;north&gt;", "Look around", "Decide", "In part", "1 of 2", "Too low", "Lower south again", "1 proposed",
        "Much light", "scenes/_end.json", "[erased]", "We follow it", "Heron (seat 1)", "facilitator", "2026-03-01 09:30 UTC",
        "the photo", "3 ballots; 4 people had a seat", "The result is shown when the vote is closed.", "comment 1"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("More light"), std::string::npos) << "the title of somebody who was erased";
  EXPECT_NE(page.find("<dd>" + account.chain), std::string::npos);
  EXPECT_NE(page.find("<dd>" + std::to_string(account.entries) + "</dd>"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("@media print"), std::string::npos);
  EXPECT_TRUE(page.starts_with(page_beginning(account)));
  EXPECT_TRUE(page.starts_with(page_beginning()));
}

// Who reads minutes looks for what came of it; the list of people is long.
TEST_F(Minutes, WhatWasDecidedComesBeforeWhoWasThere) {
  const std::string page = write_page(account);
  std::size_t last = 0;
  for (const char* heading : {"Decisions and other marks", "Votes", "Proposals", "Who took part", "Phases"}) {
    const std::size_t at = page.find("<h2>" + std::string(heading) + "</h2>");
    ASSERT_NE(at, std::string::npos) << heading;
    EXPECT_GT(at, last) << heading;
    last = at;
  }
}

TEST_F(Minutes, TimesAreThoseOfTheZone) {
  const std::string in_utc = write_page(account);
  account.zone = 60;
  EXPECT_EQ(Rows(decisions_csv(account)).at(0, "time"), "2026-03-01 10:31 +01:00");
  const std::string ahead = write_page(account);
  EXPECT_NE(ahead.find("2026-03-01 10:30 +01:00"), std::string::npos);
  EXPECT_EQ(ahead.find("2026-03-01 09:30 UTC"), std::string::npos) << "all of them";
  EXPECT_TRUE(ahead.starts_with(page_beginning(account))) << "minutes in another zone replace these";
  account.zone = 0;
  EXPECT_EQ(write_page(account), in_utc);
}

TEST_F(Minutes, AnEmptySessionHasMinutesToo) {
  const auto created =
      journal::Journal::create(folder.path("e.blsession"), {.code = "EMTY", .scene = room::kTable}, full_registry(), {});
  ASSERT_TRUE(created);
  ASSERT_TRUE((*created)->close());
  const Account empty = account_in(folder.path("e.blsession"));
  EXPECT_EQ(empty.entries, 0u);
  for (const char* text : {"Nobody took part.", "Nothing was refused.", "No vote was opened.", "Room EMTY"})
    EXPECT_NE(write_page(empty).find(text), std::string::npos) << text;
  EXPECT_EQ(Rows(votes_csv(empty)).count(), 0u);
}

TEST_F(Minutes, FilesOfOthersAreSafe) {
  const std::string out = folder.path("out");
  const auto written = write_minutes(out, account);
  ASSERT_TRUE(written) << written.error().text();
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, *written);
  EXPECT_TRUE(write_minutes(out, account)) << "its own files are replaced";
  EXPECT_TRUE(may_fill_with_minutes(out));
  Account other = account;
  other.code = "XXXX";
  EXPECT_EQ(journal::test::why(write_minutes(out, other)),
            out +
                "/minutes.html: is there already and holds the minutes of another session; choose another folder, or remove it "
                "first");
  for (const char* name : {"minutes.html", "decisions.csv", "comments.csv", "votes.csv", "log.jsonl", "scenes/end.json"}) {
    const std::filesystem::path mine = std::filesystem::path(folder.path("mine")) / name;
    std::filesystem::create_directories(mine.parent_path());
    ASSERT_TRUE(write_file(mine.string(), "{\"format\": \"behaviourlinks\"}"));
    EXPECT_FALSE(write_minutes(folder.path("mine"), account)) << name;
    EXPECT_EQ(*read_file(mine.string()), "{\"format\": \"behaviourlinks\"}");
    std::filesystem::remove_all(folder.path("mine"));
  }
}

}  // namespace
}  // namespace bl::minutes
