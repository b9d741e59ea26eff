// The window in a room of a real server, without a screen: two people, what one does and what the other sees.
#include <nlohmann/json.hpp>

#include "tests/ui/desktop/room/room_window.h"

namespace bl::desktop {
namespace {

TEST(RoomWindows, TwoPeopleSeeEachOther) {
  const Deadline deadline(300, "two windows in a room");
  serve::RunningServer server;
  RoomWindow lead(address_of(server, "facilitator")), other(address_of(server, "viewer"));
  ASSERT_TRUE(
      frames_until({&lead, &other}, [&] { return lead.room().standing().has_scene && other.room().standing().has_scene; }));
  EXPECT_NE(lead->desktop().title().find("room BKRT"), std::string::npos) << lead->desktop().title();
  EXPECT_TRUE(lead.room().standing().takes_ticks);

  // What one has chosen is outlined at the other's.
  lead.editor().picks.only_node("cafe");
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return other.editor().holder_of("cafe") != nullptr; }));
  EXPECT_EQ(other.editor().holder_of("cafe")->name, other.room().people().seats.at(lead.room().seat()).name);
  EXPECT_NE(other.editor().holder_of("cafe")->colour, 0u);

  // A change comes to both, and the history says whose it is.
  ASSERT_TRUE(lead.editor().submit(command<RenameNode>({"cafe", "Corner"})));
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return other.editor().name_of("cafe") == "Corner"; }));
  ASSERT_EQ(other.editor().document->history().size(), 1u);
  EXPECT_EQ(other.room().people().name_of(other.editor().document->history()[0].author.id),
            other.room().people().seats.at(lead.room().seat()).name);

  // A refused change goes back, and is explained.
  ASSERT_TRUE(other.editor().submit(command<RenameNode>({"cafe", "Mine"})));
  EXPECT_EQ(other.editor().name_of("cafe"), "Mine");
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return has_notice(other.editor(), "was refused"); }));
  EXPECT_EQ(other.editor().name_of("cafe"), "Corner");

  // The clock is the facilitator's.
  EXPECT_FALSE(other.editor().document->running().why_no_clock().empty());
  lead.editor().document->running().play(false);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return !other.editor().moment->is_playing; }));

  // To follow somebody is to look as they do.
  lead.editor().document->running().play(true);
  other.editor().followed = lead.room().seat();
  Camera camera = lead.editor().view->camera();
  camera.azimuth += 0.5;
  lead.editor().view->set_camera(camera);
  ASSERT_TRUE(
      frames_until({&lead, &other}, [&] { return std::abs(other.editor().view->camera().azimuth - camera.azimuth) < 1e-6; }));
  camera.azimuth += 0.5;
  other.editor().view->set_camera(camera);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return other.editor().followed == 0; })) << "until they look elsewhere";
}

TEST(RoomWindows, ADragOfOneGivesBothTheSameTicks) {
  const Deadline deadline(300, "a drag in a room");
  serve::RunningServer server;
  RoomWindow lead(address_of(server, "facilitator")), other(address_of(server, "viewer"));
  ASSERT_TRUE(
      frames_until({&lead, &other}, [&] { return lead.room().standing().has_scene && other.room().standing().has_scene; }));
  const std::int64_t gesture = lead.editor().new_gesture();
  int k = 0;
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    ++k;
    EXPECT_TRUE(lead.editor().show(
        {command<SetPort>({"cafe", {"node.position"}, JsonValue::of({60 + 20 * std::sin(0.05 * k), 36, 6})})}, gesture));
    return lead.room().agreed() >= 3 && other.room().agreed() >= 3;
  }));
  lead.editor().end_gesture(gesture);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return lead.room().standing().waiting == 0; }));
  EXPECT_EQ(lead.room().differed(), 0);
  EXPECT_EQ(other.room().differed(), 0);
}

TEST(RoomWindows, AnAddressIsTypedAndALostServerIsSaidWithoutStoppingAnybody) {
  const Deadline deadline(300, "a window whose server ends");
  serve::RunningServer server;
  RoomWindow window(address_of(server, "designer"));
  ASSERT_TRUE(frames_until({&window}, [&] { return window.room().standing().has_scene; }));
  window->frames(2);
  EXPECT_TRUE(memory_of(window.editor()).places.contains("room"));
  server.stop();
  ASSERT_TRUE(frames_until({&window}, [&] { return !window.room().standing().is_connected; }));
  ASSERT_TRUE(window.editor().submit(command<RenameNode>({"cafe", "Meanwhile"})));
  EXPECT_EQ(window.editor().name_of("cafe"), "Meanwhile");
  EXPECT_EQ(window.room().standing().waiting, 1u);
  EXPECT_TRUE(window.editor().document->is_unsaved());
  EXPECT_FALSE(window.editor().open("room://nobody/"));
  EXPECT_TRUE(has_notice(window.editor(), "cannot be joined"));
}

// --- The tab Room ---------------------------------------------------------------------------------------------------

TEST(RoomPanel, AFacilitatorLeadsFromItAndOthersAreOfferedNoneOfThat) {
  const Deadline deadline(300, "the tab Room");
  serve::RunningServer server({}, "/scenes/nodes/vote.json");
  RoomWindow lead(address_of(server, "facilitator")), other(address_of(server, "participant"));
  lead.editor().person.bottom_height = other.editor().person.bottom_height = 800;
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    return lead.room().standing().has_scene && other.room().standing().has_scene && agenda_of(lead.room()).seats.size() == 2 &&
           !agenda_of(other.room()).votes.empty();
  }));
  open_tab(lead);
  open_tab(other);
  EXPECT_TRUE(has_place(lead, "roompanel/code"));
  EXPECT_TRUE(has_place(other, "roompanel/code"));
  for (const char* key : {"roompanel/pause", "roompanel/begin", "roompanel/end", "roompanel/door/shut"}) {
    EXPECT_TRUE(has_place(lead, key)) << key;
    EXPECT_FALSE(has_place(other, key)) << key;
  }

  press(lead, "roompanel/pause");
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return other.room().people().is_paused; }));
  press(lead, "roompanel/door/shut");
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return agenda_of(other.room()).door == "shut"; }));
  press(lead, "roompanel/show/code");
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return agenda_of(other.room()).layout == "code"; }));

  // A phase without a title is not begun; with one it is, and says what may be done.
  press(lead, "roompanel/begin");
  EXPECT_EQ(agenda_of(lead.room()).phase, "");
  memory_of(lead.editor()).room_texts["phase"] = "Talk";
  memory_of(lead.editor()).room_texts["minutes"] = "10";
  press(lead, "roompanel/may/change");
  press(lead, "roompanel/begin");
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return agenda_of(other.room()).phase == "Talk"; }));
  EXPECT_FALSE(agenda_of(other.room()).may.contains("change"));
  EXPECT_TRUE(agenda_of(other.room()).may.contains("vote"));
  EXPECT_GT(agenda_of(other.room()).ends_at, 0);

  // What is refused is explained as elsewhere.
  lead.room().say_event("close_vote", JsonValue::of({{"vote", "nowhere"}}));
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return has_notice(lead.editor(), "is not open"); }));

  // A comment waits in the queue until it is answered.
  other.room().say_event("comment", JsonValue::of({{"id", "one"}, {"text", "More trees"}}));
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return agenda_of(lead.room()).comments.size() == 1; }));
  press(lead, "roompanel/comment/one/follow");
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return agenda_of(lead.room()).comments.empty(); }));
}

TEST(RoomPanel, AVoteIsOpenedVotedOnAndClosed) {
  const Deadline deadline(300, "a vote in the tab Room");
  serve::RunningServer server({}, "/scenes/nodes/vote.json");
  const ImVec2 tall{1440, 1800};
  RoomWindow lead(address_of(server, "facilitator"), tall), other(address_of(server, "participant"), tall);
  lead.editor().person.bottom_height = other.editor().person.bottom_height = 1400;
  const auto vote_at = [](RoomWindow& window, const std::string& id) {
    const Agenda agenda = agenda_of(window.room());
    const auto found = std::find_if(agenda.votes.begin(), agenda.votes.end(), [&](const AgendaVote& v) { return v.id == id; });
    return found == agenda.votes.end() ? AgendaVote{} : *found;
  };
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    return lead.room().standing().has_scene && other.room().standing().has_scene && !agenda_of(lead.room()).votes.empty();
  }));
  const std::string id = "height";  // a slider
  // Ballots are counted by a tick, and the scene has two of them.
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return vote_at(lead, id).count == 2; }));
  open_tab(lead);
  open_tab(other);
  EXPECT_FALSE(has_place(other, "roompanel/cast/" + id));
  EXPECT_FALSE(has_place(other, "roompanel/open/" + id));
  press(lead, "roompanel/open/" + id);
  ASSERT_TRUE(frames_until({&lead, &other}, [&] { return vote_at(other, id).is_open; }));
  // The room sets in the scene that the vote is open; until that is here, the window cannot take a ballot.
  ASSERT_TRUE(frames_until({&lead, &other}, [&] {
    const PortValues& vote = other.editor().scene().nodes.at(id).types.at("vote");
    return lead.room().standing().waiting == 0 && vote.contains("is_open") && std::get<bool>(vote.at("is_open"));
  }));
  (*other).frames(20);
  // What is no number of the range is not offered.
  memory_of(other.editor()).room_texts["ballot/height"] = "5";
  press(other, "roompanel/cast/" + id);
  EXPECT_EQ(other.room().standing().waiting, 0u);
  memory_of(other.editor()).room_texts["ballot/height"] = "20";
  press(other, "roompanel/cast/" + id);
  EXPECT_FALSE(has_notice(other.editor(), "vote")) << notices_of(other.editor());
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return vote_at(lead, id).count == 3; })) << notices_of(other.editor());
  press(lead, "roompanel/close/" + id);
  EXPECT_TRUE(frames_until({&lead, &other}, [&] { return !vote_at(other, id).is_open; }));
}

}  // namespace
}  // namespace bl::desktop
