// Ballots in the tab Room: whatever is pressed there is counted as core/vote counts it.
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/vote/ballot_json.h"
#include "core/vote/count.h"
#include "tests/ui/desktop/room/room_window.h"

namespace bl::desktop {
namespace {

const ImVec2 kTall{2000, 2600};  // all of the tab is in sight

AgendaVote vote_at(RoomWindow& window, const std::string& id) {
  for (const AgendaVote& vote : agenda_of(window.room()).votes)
    if (vote.id == id) return vote;
  return {};
}

void open_tall_tab(RoomWindow& window) {
  window.editor().person.bottom_height = 1800;
  open_tab(window);
}

// A window fills in a ballot of any kind as people do: by the buttons, by dragging lines, by clicks in the 3D view.
void fill_in(RoomWindow& window, const AgendaVote& vote, Random& random) {
  const std::string id = vote.id;
  const auto& options = vote.asks.options;
  const auto any = [&] { return options[random.below(options.size())].id; };
  PanelMemory& memory = memory_of(window.editor());
  if (vote.asks.kind == vote::Kind::slider) {
    memory.room_texts["ballot/" + id] = std::to_string(vote.asks.least + std::floor(random.uniform(0, 10)));
  } else if (vote.asks.kind == vote::Kind::rank) {
    while (memory.ballots[id].options.size() < options.size()) {
      const std::string option = any(), key = "roompanel/rank/" + id + "/add/" + option;
      const auto& ranked = memory.ballots[id].options;
      if (std::find(ranked.begin(), ranked.end(), option) == ranked.end()) press(window, key);
    }
    const std::vector<std::string> before = memory.ballots[id].options;
    const ImVec4 from = memory.places.at("roompanel/rank/" + id + "/" + before.front());
    const ImVec4 to = memory.places.at("roompanel/rank/" + id + "/" + before.back());
    window->drag({from.x + 20, (from.y + from.w) / 2}, {to.x + 20, (to.y + to.w) / 2}, 0, 12);
    EXPECT_EQ(memory.ballots[id].options.back(), before.front()) << "dragged from the top to the end";
    press(window, "roompanel/rank/" + id + "/" + before.front() + "/up");
    EXPECT_NE(memory.ballots[id].options.back(), before.front());
  } else if (vote.asks.kind == vote::Kind::coins) {
    for (int k = 0; k < 6; ++k) press(window, "roompanel/coins/" + id + "/" + any() + "/more");
    press(window, "roompanel/coins/" + id + "/" + any() + "/less");
  } else {
    const std::string dots = "roompanel/dots/" + id;
    press(window, dots + "/says/" + any());
    press(window, dots + "/place");
    ASSERT_TRUE(memory.placing.has_value());
    const std::size_t before = memory.ballots[id].places.size();
    const Point3 middle = window.editor().view->facts()->centre;
    const double around = 0.3 * window.editor().view->facts()->radius;
    const auto click_at = [&](const Point3& place) {
      const Seen at = window.editor().view->place_in_window(place);
      window->click({static_cast<float>(at.x), static_cast<float>(at.y)});
    };
    const double ground = window.editor().view->facts()->ground;
    click_at({middle.x + random.uniform(-around, around), middle.y + random.uniform(-around, around), ground});
    ASSERT_EQ(memory.ballots[id].places.size(), before + 1);
    // A click on a dot takes it away; another click sets it again.
    click_at(memory.ballots[id].places.back());
    ASSERT_EQ(memory.ballots[id].places.size(), before);
    click_at({middle.x + random.uniform(-around, around), middle.y + random.uniform(-around, around), ground});
    ASSERT_EQ(memory.ballots[id].places.size(), before + 1);
    EXPECT_TRUE(window.editor().picks.nodes.empty()) << "while dots are set, nothing is chosen";
    press(window, dots + "/place");
  }
  window->frames(2);
}

// Opens, votes, changes and closes by pressing; what is shown is what core/vote makes of the ballots that people saw.
void play(const std::string& kind, const std::map<std::string, std::string>& fields, std::uint64_t seed) {
  SCOPED_TRACE(kind);
  const Deadline deadline(300, "a vote of each kind");
  serve::RunningServer server;
  RoomWindow lead(address_of(server, "facilitator"), kTall), other(address_of(server, "participant"), kTall);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    return lead.room().standing().has_scene && other.room().standing().has_scene && agenda_of(lead.room()).seats.size() == 2;
  }));
  open_tall_tab(lead);
  open_tall_tab(other);
  press(lead, "roompanel/new_vote/kind/" + kind);
  press(lead, "roompanel/new_vote/open");
  EXPECT_TRUE(agenda_of(lead.room()).votes.empty()) << "without a question nothing is opened";
  for (const auto& [key, text] : fields) memory_of(lead.editor()).room_texts["new_vote/" + key] = text;
  press(lead, "roompanel/new_vote/open");
  std::string id;
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    const Agenda agenda = agenda_of(other.room());
    id = agenda.votes.empty() ? "" : agenda.votes.front().id;
    return !id.empty() && agenda.votes.front().is_open && agenda.may.contains("vote") && lead.room().standing().waiting == 0;
  })) << notices_of(lead.editor());
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return vote_at(lead, id).is_open; }));  // each window hears of it by itself
  EXPECT_EQ(vote_at(other, id).question, fields.at("question"));
  EXPECT_EQ(vote_at(other, id).electorate, 2);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    const auto node = other.editor().scene().nodes.find(id);
    return node != other.editor().scene().nodes.end() && std::get<bool>(node->second.types.at("vote").at("is_open"));
  }));
  Random random(seed);
  Table ballots;
  for (const ColumnDefinition& column : vote::ballot_columns()) ballots.columns.push_back(column.id);
  std::map<std::string, vote::Ballot> cast;
  for (int round = 0; round < 2; ++round)
    for (RoomWindow* window : {&lead, &other}) {
      (*window)->frames(3);
      const AgendaVote vote = vote_at(*window, id);
      if (kind == "yes_no") {
        const std::string answer = random.below(2) == 0 ? "yes" : "no";
        cast[window->room().author()] = {.options = {answer}, .coins = {}, .places = {}, .value = 0};
        press(*window, "roompanel/" + answer + "/" + id);
      } else {
        fill_in(*window, vote, random);
        const vote::Ballot filled = memory_of(window->editor()).ballots.at(id);
        ASSERT_TRUE(vote::check_ballot(vote.asks, filled).ok()) << vote::check_ballot(vote.asks, filled).error().text();
        cast[window->room().author()] = filled;
        press(*window, "roompanel/cast/" + id);
      }
      ASSERT_TRUE(frames_until({&lead, &other}, [&] {
        return vote_at(*window, id).mine == cast.at(window->room().author()) &&
               vote_at(lead, id).count == static_cast<std::int64_t>(cast.size());
      })) << notices_of(window->editor());
    }
  press(lead, "roompanel/close/" + id);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    return !vote_at(other, id).is_open && !vote_at(other, id).result.empty() && !vote_at(lead, id).result.empty();
  }));
  for (const auto& [voter, ballot] : cast) ballots.rows.push_back(vote::row_of(voter, ballot));
  for (RoomWindow* window : {&lead, &other}) {
    const AgendaVote shown = vote_at(*window, id);
    const vote::Outcome counted = vote::count(shown.asks, ballots);
    EXPECT_TRUE(counted.refusals.empty());
    EXPECT_EQ(shown.count, counted.counted);
    EXPECT_EQ(shown.leading, counted.leading);
    ASSERT_EQ(shown.result.size(), counted.tallies.size());
    for (std::size_t k = 0; k < counted.tallies.size(); ++k) {
      EXPECT_EQ(shown.result[k].option, counted.tallies[k].option);
      EXPECT_EQ(shown.result[k].points, counted.tallies[k].points);
      EXPECT_EQ(shown.result[k].share, counted.tallies[k].share);
    }
    if (kind == "slider") {
      EXPECT_EQ(shown.mean, counted.mean);
      EXPECT_EQ(shown.median, counted.median);
    }
  }
}

TEST(RoomBallots, LawOfEqualCountsYesOrNo) { play("yes_no", {{"question", "Shall we build?"}}, 1); }
TEST(RoomBallots, LawOfEqualCountsOrder) { play("rank", {{"question", "What first?"}, {"options", "Park, School, Shop"}}, 2); }
TEST(RoomBallots, LawOfEqualCountsCoins) {
  play("coins", {{"question", "For what?"}, {"options", "Trees, Bridge"}, {"points", "20"}}, 3);
}
TEST(RoomBallots, LawOfEqualCountsDots) {
  play("dots", {{"question", "Where is it good?"}, {"options", ""}, {"points", "5"}}, 4);
}
TEST(RoomBallots, LawOfEqualCountsNumber) {
  play("slider", {{"question", "How high?"}, {"least", "10"}, {"most", "30"}, {"unit", "m"}}, 5);
}

TEST(RoomBallots, WhatIsMissingIsSaidAndNothingIsSent) {
  const Deadline deadline(300, "a ballot that is not complete");
  serve::RunningServer server({}, "/scenes/nodes/vote.json");
  RoomWindow lead(address_of(server, "facilitator"), kTall);
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().has_scene && !agenda_of(lead.room()).votes.empty(); }));
  open_tall_tab(lead);
  press(lead, "roompanel/open/court");
  ASSERT_TRUE(frames_until({&lead}, [&] { return vote_at(lead, "court").is_open && lead.room().standing().waiting == 0; }));
  lead->frames(3);
  press(lead, "roompanel/rank/court/add/garden");
  press(lead, "roompanel/cast/court");
  EXPECT_EQ(lead.room().standing().waiting, 0u) << "of three options only one has a place";
  press(lead, "roompanel/rank/court/garden/x");
  EXPECT_TRUE(memory_of(lead.editor()).ballots.at("court").options.empty());
  for (const char* option : {"play", "garden", "parking"}) press(lead, std::string("roompanel/rank/court/add/") + option);
  press(lead, "roompanel/cast/court");
  ASSERT_TRUE(frames_until({&lead}, [&] { return vote_at(lead, "court").mine.has_value(); }));
  EXPECT_EQ(vote_at(lead, "court").mine->options, (std::vector<std::string>{"play", "garden", "parking"}));
  press(lead, "roompanel/withdraw/court");
  ASSERT_TRUE(frames_until({&lead}, [&] { return !vote_at(lead, "court").mine.has_value(); }));
}

TEST(RoomBallots, ASwitchLetsTheResultActOnTheModel) {
  const Deadline deadline(300, "a vote that acts");
  serve::RunningServer server({}, "/scenes/links/vote_to_weight.json");
  RoomWindow lead(address_of(server, "facilitator"), kTall);
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().has_scene && !agenda_of(lead.room()).votes.empty(); }));
  open_tall_tab(lead);
  ASSERT_TRUE(lead.editor().scene().links.find("l1_library")->second.is_enabled);
  press(lead, "roompanel/apply/l1_library");
  ASSERT_TRUE(frames_until({&lead}, [&] { return !lead.room().fold().confirmed().links.find("l1_library")->second.is_enabled; }));
  press(lead, "roompanel/apply/l1_library");
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().fold().confirmed().links.find("l1_library")->second.is_enabled; }));
}

}  // namespace
}  // namespace bl::desktop
