// Proposals in the tab Room: figures, conflicts, acceptance of the whole and of a part, refusal, and one undo.
#include <nlohmann/json.hpp>

#include "tests/core/serve/talk.h"
#include "tests/ui/desktop/room/room_window.h"

namespace bl::desktop {
namespace {

// A designer who makes drafts, as the page does.
struct Proposer {
  explicit Proposer(const serve::RunningServer& server) : talk(serve::address_of(server)) {
    talk.client.send(serve::hello(server.invite("designer"), "a designer"));
    EXPECT_TRUE(talk.wait_for("welcome"));
    seat = (*talk.last("welcome"))["you"]["seat"].get<std::int64_t>();
  }
  void say(Json message) {
    message["id"] = ++id;
    talk.client.send(message.dump());
    EXPECT_TRUE(talk.wait([&] {
      return std::any_of(talk.frames.begin(), talk.frames.end(),
                         [&](const Json& frame) { return frame["t"] == "ack" && frame["id"].get<std::int64_t>() >= id; });
    })) << message.dump()
        << (talk.last("nack") == nullptr ? "" : talk.last("nack")->dump());
  }
  void draft(const std::string& name, const std::vector<Command>& steps) {
    say({{"t", "draft"}, {"do", "begin"}, {"draft", name}, {"title", name}});
    for (const Command& step : steps) say({{"t", "op"}, {"c", command_to_json(full_registry(), step)}, {"draft", name}});
  }
  void propose(const std::string& name) {
    say({{"t", "room"},
         {"e", {{"event", "propose"}, {"arguments", {{"draft", name}, {"title", name}, {"why", "It is better"}}}}}});
  }
  serve::Talk talk;
  std::int64_t seat = 0, id = 0;
};

Command value_of(const std::string& node, double value) {
  return command<SetPort>({node, {"indicator.value"}, JsonValue::of(value)});
}

double number_at(RoomWindow& window, const std::string& node) {
  return std::get<double>(window.room().fold().confirmed().nodes.find(node)->second.types.at("indicator").at("value"));
}

const AgendaProposal* proposal_in(const Agenda& agenda, const std::string& draft) {
  for (const AgendaProposal& proposal : agenda.proposals)
    if (proposal.draft == draft) return &proposal;
  return nullptr;
}

TEST(RoomProposals, APartIsAcceptedAsItsAuthorsAndOneUndoTakesItBack) {
  const Deadline deadline(300, "a proposal in the tab Room");
  serve::RunningServer server({}, "/scenes/nodes/indicator.json");
  RoomWindow lead(address_of(server, "facilitator"), {2000, 1600});
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().has_scene && agenda_of(lead.room()).is_known; }));
  lead.room().say_event("set_phase", JsonValue::of({{"name", "Work"}, {"activities", {"change", "draft", "comment", "vote"}}}));
  ASSERT_TRUE(frames_until({&lead}, [&] { return agenda_of(lead.room()).may.contains("draft"); }));
  lead.editor().person.bottom_height = 800;
  open_tab(lead);
  Proposer proposer(server);
  proposer.draft("cheap", {value_of("cost", 2.5e7), value_of("walk", 500), command<RenameNode>({"walk", "Shorter way"})});
  // Somebody else changes the same meanwhile.
  ASSERT_TRUE(lead.editor().submit(value_of("walk", 700)));
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().waiting == 0; }));
  proposer.propose("cheap");
  ASSERT_TRUE(frames_until({&lead}, [&] {
    const Agenda agenda = agenda_of(lead.room());
    const AgendaProposal* proposal = proposal_in(agenda, "cheap");
    return proposal != nullptr && !proposal->figures.empty() && !proposal->is_decided;
  })) << "the server tries what the window looks at";
  const Agenda agenda = agenda_of(lead.room());
  const AgendaProposal& proposal = *proposal_in(agenda, "cheap");
  EXPECT_EQ(proposal.seat, proposer.seat);
  ASSERT_EQ(proposal.steps.size(), 3u);
  ASSERT_FALSE(proposal.conflicts.empty());
  EXPECT_EQ(proposal.conflicts.front().live, "700");
  EXPECT_EQ(proposal.conflicts.front().drafted, "500");
  EXPECT_EQ(proposal.conflicts.front().by, lead.room().people().seats.at(lead.room().seat()).name);
  const auto cost =
      std::find_if(proposal.figures.begin(), proposal.figures.end(), [](const auto& f) { return f.name == "Cost"; });
  ASSERT_NE(cost, proposal.figures.end());
  EXPECT_EQ(cost->before, 3.6e7);
  EXPECT_EQ(cost->after, 2.5e7);

  // The second step is left out.
  const std::string key = "roompanel/proposal/cheap";
  press(lead, key + "/step/1");
  press(lead, key + "/accept");
  ASSERT_TRUE(frames_until({&lead}, [&] { return number_at(lead, "cost") == 2.5e7; })) << notices_of(lead.editor());
  EXPECT_EQ(number_at(lead, "walk"), 700);
  EXPECT_EQ(lead.editor().name_of("walk"), "Shorter way");
  ASSERT_TRUE(frames_until({&lead}, [&] {
    const Agenda now = agenda_of(lead.room());
    return proposal_in(now, "cheap")->is_accepted && proposal_in(now, "cheap")->kept == 2;
  }));
  const host::HistoryStep step = lead.room().history().back();
  EXPECT_EQ(step.author.id, "seat " + std::to_string(proposer.seat)) << "it stays the proposer's";
  EXPECT_EQ(step.entries, 1u);
  press(lead, key + "/undo");
  ASSERT_TRUE(frames_until({&lead}, [&] { return number_at(lead, "cost") == 3.6e7; })) << notices_of(lead.editor());
  EXPECT_EQ(lead.editor().name_of("walk"), "Way to the school");
  EXPECT_EQ(number_at(lead, "walk"), 700);
  lead->frames(3);
  EXPECT_FALSE(has_place(lead, key + "/undo")) << "it is taken back already";
}

TEST(RoomProposals, ARefusedOneChangesNothingAndCarriesTheWord) {
  const Deadline deadline(300, "a refused proposal");
  serve::RunningServer server({}, "/scenes/nodes/indicator.json");
  RoomWindow lead(address_of(server, "facilitator"), {2000, 1600});
  ASSERT_TRUE(frames_until({&lead}, [&] { return lead.room().standing().has_scene && agenda_of(lead.room()).is_known; }));
  lead.room().say_event("set_phase", JsonValue::of({{"name", "Work"}, {"activities", {"draft"}}}));
  ASSERT_TRUE(frames_until({&lead}, [&] { return agenda_of(lead.room()).may.contains("draft"); }));
  lead.editor().person.bottom_height = 800;
  open_tab(lead);
  Proposer proposer(server);
  proposer.draft("small", {value_of("cost", 1), command<RenameNode>({"walk", "Mine"})});
  proposer.propose("small");
  ASSERT_TRUE(frames_until({&lead}, [&] {
    lead->frames(2);
    return has_place(lead, "roompanel/proposal/small/refuse");
  }));
  // Without a step there is nothing to accept.
  press(lead, "roompanel/proposal/small/step/0");
  press(lead, "roompanel/proposal/small/step/1");
  press(lead, "roompanel/proposal/small/accept");
  EXPECT_EQ(lead.room().standing().waiting, 0u);
  memory_of(lead.editor()).room_texts["roompanel/proposal/small"] = "It costs too much.";
  press(lead, "roompanel/proposal/small/refuse");
  ASSERT_TRUE(frames_until({&lead}, [&] {
    const Agenda now = agenda_of(lead.room());
    return proposal_in(now, "small")->is_decided;
  }));
  const Agenda now = agenda_of(lead.room());
  EXPECT_FALSE(proposal_in(now, "small")->is_accepted);
  const auto told = lead.room().view("proposals").at("small").read();
  EXPECT_EQ((**told)["answer"], "It costs too much.");
  EXPECT_EQ(number_at(lead, "cost"), 3.6e7);
}

}  // namespace
}  // namespace bl::desktop
