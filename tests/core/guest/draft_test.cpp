// Work in a draft: seen at once, stored as steps, apart from the scene of the room, on any network.
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/guest/room_guest.h"
#include "core/reading/report_model.h"
#include "tests/core/guest/memory_room.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"

namespace bl::guest {
namespace {

constexpr const char* kDrafted = "scenes/start/quarter.json";

std::string scene_text(const Scene& scene) { return write_scene(scene, full_registry()); }

std::string name_in(const Scene& scene, const std::string& node) { return scene.nodes.find(node)->second.name; }

std::string state_of(MemoryRoom& room, const RoomGuest& guest, const std::string& draft) {
  const wire::View drafts = room.host->view("drafts", guest.seat());
  const auto found = drafts.find(draft);
  return found == drafts.end() ? "none" : text_in(*parse_json(found->second), "state");
}

// The steps as the room has them, by number.
std::map<int, Command> steps_of(MemoryRoom& room, const RoomGuest& guest, const std::string& draft) {
  std::map<int, Command> steps;
  for (const auto& [key, text] : room.host->view("draft_steps", guest.seat())) {
    if (!key.starts_with(draft + "/")) continue;
    const auto command = command_from_json(full_registry(), *parse_json(text), "c");
    EXPECT_TRUE(command.ok());
    if (command) steps[std::stoi(key.substr(draft.size() + 1))] = *command;
  }
  return steps;
}

// Folded without any code of guests.
Scene scene_with(const Scene& head, const std::map<int, Command>& steps) {
  Scene scene = head;
  for (const auto& [number, step] : steps) {
    SceneEdit edit(scene, full_registry());
    (void)apply(edit, step);
  }
  return scene;
}

struct DraftRoom {
  DraftRoom() : room(kDrafted), lead(room.join("facilitator")), anna(room.join("designer")) {
    EXPECT_TRUE(room.turn_until([&] { return lead.standing().has_scene && anna.standing().has_scene; }));
    begin_phase({"change", "draft", "comment", "vote"});
  }
  void begin_phase(const std::vector<std::string>& activities) {
    lead.say_event("set_phase", JsonValue::of({{"name", "Work"}, {"activities", activities}}));
    EXPECT_TRUE(room.turn_until([&] { return lead.standing().waiting == 0; }));
  }
  bool is_answered() {
    return room.turn_until([&] { return anna.standing().waiting == 0 && lead.standing().waiting == 0; });
  }
  // Everything is answered, and everybody has the views that the room would show them now.
  void rest() {
    ASSERT_TRUE(is_answered());
    ASSERT_TRUE(room.turn_until([&] {
      return std::all_of(room.guests.begin(), room.guests.end(), [&](const auto& guest) {
        return guest->standing().waiting == 0 && guest->fold().seq() == room.host->health().seq && has_views(*guest);
      });
    }));
  }
  bool has_views(const RoomGuest& guest) {
    for (const char* name : {"drafts", "draft_steps", "proposals"}) {
      const wire::View now = room.host->view(name, guest.seat());
      const auto& seen = guest.view(name);
      // Trials go on by themselves; what people have done stands beside them.
      const auto is_same = [](const std::string& text, const JsonValue& known) {
        Json one = *parse_json(text), other = **known.read();
        if (one.is_object()) one.erase("trial"), other.erase("trial");
        return one == other;
      };
      if (now.size() != seen.size()) return false;
      for (const auto& [key, text] : now)
        if (!seen.contains(key) || !is_same(text, seen.at(key))) return false;
    }
    return true;
  }
  MemoryRoom room;
  RoomGuest &lead, &anna;
};

TEST(Drafts, WhatIsDoneInOneIsSeenThereAndNowhereElse) {
  DraftRoom at;
  const std::string before = scene_text(at.lead.scene());
  ASSERT_TRUE(at.anna.begin_draft("Larger").ok());
  ASSERT_NE(at.anna.draft(), nullptr);
  const std::string draft = at.anna.draft()->id();
  ASSERT_TRUE(at.anna.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's") << "at once";
  EXPECT_EQ(at.anna.draft()->step_count(), 1u);
  at.rest();
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's");
  EXPECT_EQ(at.anna.draft()->step_count(), 1u) << "an answered step is counted once";
  EXPECT_EQ(scene_text(at.lead.scene()), before);
  EXPECT_EQ(steps_of(at.room, at.anna, draft).size(), 1u);
  // What others do is seen in it.
  ASSERT_TRUE(at.lead.submit({command<RenameNode>({"school", "High school"})}).ok());
  at.rest();
  EXPECT_EQ(name_in(at.anna.scene(), "school"), "High school");
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's");
  // Out of it and back into it.
  at.anna.leave_draft();
  EXPECT_EQ(at.anna.draft(), nullptr);
  EXPECT_EQ(scene_text(at.anna.scene()), scene_text(at.lead.scene()));
  EXPECT_FALSE(at.anna.enter_draft("nothing").ok());
  ASSERT_TRUE(at.anna.enter_draft(draft).ok());
  EXPECT_EQ(at.anna.draft()->title(), "Larger");
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's");
  // The last step back; there is no other.
  ASSERT_TRUE(at.anna.undo().ok());
  at.rest();
  EXPECT_NE(name_in(at.anna.scene(), "cafe"), "Anna's");
  EXPECT_EQ(at.anna.draft()->step_count(), 0u);
  EXPECT_FALSE(at.anna.undo().ok());
  // And once more.
  ASSERT_TRUE(at.anna.redo().ok());
  at.rest();
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's");
  EXPECT_EQ(at.anna.draft()->step_count(), 1u);
  ASSERT_TRUE(at.anna.undo().ok());
  at.rest();
  EXPECT_TRUE(at.anna.take_refusals().empty());
  at.anna.drop_draft(draft);
  EXPECT_EQ(at.anna.draft(), nullptr);
  at.rest();
  EXPECT_EQ(state_of(at.room, at.anna, draft), "none");
}

TEST(Drafts, NoStepIsToldBeforeItIsStored) {
  DraftRoom at;
  ASSERT_TRUE(at.anna.begin_draft("").ok());
  const std::string begin = at.anna.draft()->id() + "/";
  at.rest();
  at.room.slowness = 40;  // turns; views are made every ten
  ASSERT_TRUE(at.anna.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
  const auto is_told = [&] {
    const auto& steps = at.anna.view("draft_steps");
    const auto first = steps.lower_bound(begin);
    return first != steps.end() && first->first.starts_with(begin);
  };
  int early = 0;
  ASSERT_TRUE(at.room.turn_until([&] {
    if (at.anna.standing().waiting > 0 && is_told()) ++early;
    return at.anna.standing().waiting == 0;
  }));
  EXPECT_EQ(early, 0);
  EXPECT_TRUE(at.room.turn_until(is_told));
  EXPECT_EQ(at.anna.draft()->step_count(), 1u);
}

TEST(Drafts, AGestureIsOneStepAndAnAbandonedOneIsNone) {
  DraftRoom at;
  ASSERT_TRUE(at.anna.begin_draft("").ok());
  const std::string draft = at.anna.draft()->id();
  const auto drag = [&](std::int64_t gesture) {
    for (int k = 1; k <= 30; ++k) {
      ASSERT_TRUE(at.anna.show({command<SetPort>({"cafe", {"node.position"}, JsonValue::of({10.0 + k, 0, 0})})}, gesture).ok());
      at.room.turn();
    }
  };
  const std::int64_t first = at.anna.new_gesture();
  drag(first);
  ASSERT_TRUE(at.anna.end_gesture(first).ok());
  const std::int64_t second = at.anna.new_gesture();
  drag(second);
  at.anna.abandon(second);
  at.rest();
  EXPECT_EQ(steps_of(at.room, at.anna, draft).size(), 1u);
  EXPECT_EQ(std::get<Vector3>(at.anna.scene().nodes.find("cafe")->second.types.at("node").at("position")).x, 40);
}

// The law: on any network the window has the scene of the room with the steps that the room has stored, each once.
TEST(Drafts, TheWindowHasTheStepsOfTheRoomOnAnyNetwork) {
  const int seeds = test::kIsSanitized ? 1 : 3;
  for (int seed = 1; seed <= seeds; ++seed) {
    DraftRoom at;
    Random random(static_cast<std::uint64_t>(seed));
    ASSERT_TRUE(at.anna.begin_draft("Much").ok());
    const std::string draft = at.anna.draft()->id();
    at.room.weather = {.lost = 0.05, .doubled = 0.05, .cut = 0.003, .most_delay = 8, .keeps_views = true};
    std::size_t said = 0, undone = 0, redone = 0;
    for (int k = 0; k < 120; ++k) {
      if (at.anna.submit({random_command(at.anna.scene(), random, k)}).ok()) ++said;
      if (k % 7 == 3) (void)at.lead.submit({random_command(at.lead.scene(), random, 1000 + k)});
      if (k % 11 == 5 && at.anna.undo().ok()) ++undone;
      if (k % 22 == 5 && at.anna.redo().ok()) ++redone;
      if (k % 25 == 20) {
        at.anna.leave_draft();
        for (int turns = 0; turns < k / 10; ++turns) at.room.turn();
        ASSERT_TRUE(at.anna.enter_draft(draft).ok());
      }
      for (int turns = 0; turns < 5; ++turns) at.room.turn();
    }
    at.room.weather = {};
    ASSERT_TRUE(at.room.turn_until([&] { return at.anna.standing().is_connected && at.lead.standing().is_connected; }));
    at.rest();
    ASSERT_NE(at.anna.draft(), nullptr);
    const auto steps = steps_of(at.room, at.anna, draft);
    EXPECT_GT(steps.size(), 20u) << seed;
    for (const Refused& refused : at.anna.take_refusals()) {
      std::size_t& count = refused.what == "Undo in the draft" ? undone : refused.what == "Redo in the draft" ? redone : said;
      --count;
    }
    EXPECT_GT(redone, 2u) << seed;
    EXPECT_EQ(steps.size(), said - undone + redone) << seed;
    EXPECT_EQ(at.anna.draft()->step_count(), steps.size()) << seed;
    EXPECT_EQ(scene_text(at.anna.scene()), scene_text(scene_with(at.anna.fold().confirmed(), steps))) << seed;
    EXPECT_EQ(scene_text(at.anna.fold().confirmed()), scene_text(at.lead.fold().confirmed())) << seed;
  }
}

TEST(Drafts, ItsTicksRunBesideThoseOfTheRoom) {
  DraftRoom at;
  const auto volume_of = [](const State& state) {
    reading::ReportModel model;
    reading::read_model(state, model);
    for (const reading::VolumeRow& volume : model.volumes)
      if (volume.id == "cafe") return volume.volume;
    return 0.0;
  };
  // No tick of the room runs beside what follows: volumes still move.
  ASSERT_TRUE(at.room.turn_until([&] { return at.anna.follower().tick() > 60 && at.anna.follower().behind() == 0; }));
  const double before = volume_of(*at.anna.moment()->ticked);
  ASSERT_GT(before, 0);
  ASSERT_TRUE(at.anna.begin_draft("Larger").ok());
  ASSERT_TRUE(at.anna.draft()->has_ticks());
  EXPECT_NEAR(volume_of(*at.anna.moment()->ticked), before, 1e-6) << "they begin where those of the room are";
  const JsonValue demand = JsonValue::of(1.5 * before);
  ASSERT_TRUE(at.anna.submit({command<SetPort>({"cafe", {"smart_volume.demand"}, demand})}).ok());
  EXPECT_TRUE(at.room.turn_until([&] { return volume_of(*at.anna.moment()->ticked) > 1.2 * before; }))
      << volume_of(*at.anna.moment()->ticked) << " of " << before;
  EXPECT_LT(volume_of(*at.anna.follower().moment()->ticked), 1.1 * before) << "the room does not know of it";
  // A step that is taken back is taken back in the ticks, too.
  ASSERT_TRUE(at.anna.undo().ok());
  EXPECT_TRUE(at.room.turn_until([&] { return volume_of(*at.anna.moment()->ticked) < 1.1 * before; }));
  at.anna.leave_draft();
  EXPECT_EQ(at.anna.moment(), at.anna.follower().moment());
  ASSERT_TRUE(at.room.come_to_rest());
  EXPECT_EQ(hex_digits(at.anna.moment()->ticked->hash), at.room.host->health().hash);
  EXPECT_EQ(at.anna.differed(), 0);
}

TEST(Drafts, WhatOthersMoveMovesInItsTicks) {
  DraftRoom at;
  const auto place_of = [](const State& state) {
    return std::get<Vector3>(state.value(*state.plan->find(state.plan->node_index("cafe"), {"node", "position", ""})));
  };
  ASSERT_TRUE(at.room.turn_until([&] { return at.anna.follower().tick() > 60; }));
  ASSERT_TRUE(at.anna.begin_draft("").ok());
  const Vector3 before = place_of(*at.anna.moment()->ticked);
  const double there = before.x > 30 ? before.x - 8 : before.x + 8;
  ASSERT_TRUE(at.lead.submit({command<SetPort>({"cafe", {"node.position"}, JsonValue::of({there, before.y, before.z})})}).ok());
  EXPECT_TRUE(at.room.turn_until([&] { return std::abs(place_of(*at.anna.moment()->ticked).x - before.x) > 4; }, 1500))
      << place_of(*at.anna.moment()->ticked).x << " from " << before.x << " to " << there;
}

// A seat on two devices.
TEST(Drafts, OneThatIsDiscardedElsewhereIsLeft) {
  MemoryRoom room(kDrafted);
  RoomGuest& lead = room.join("facilitator");
  std::string token;
  room.before_joining = [&](RoomGuestOptions& options) {
    if (!token.empty()) options.invite.clear();
    options.token = token;
    options.keep_token = [&](const std::string& given) { token = given; };
  };
  RoomGuest& laptop = room.join("designer");
  ASSERT_TRUE(room.turn_until([&] { return lead.standing().has_scene && laptop.standing().has_scene; }));
  lead.say_event("set_phase", JsonValue::of({{"name", "Work"}, {"activities", {"change", "draft"}}}));
  RoomGuest& other = room.join("designer");
  ASSERT_TRUE(room.turn_until([&] { return other.standing().has_scene && lead.standing().waiting == 0; }));
  ASSERT_EQ(other.seat(), laptop.seat());
  for (const bool is_cut : {false, true}) {
    ASSERT_TRUE(laptop.begin_draft("Larger").ok());
    const std::string draft = laptop.draft()->id();
    ASSERT_TRUE(laptop.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
    ASSERT_TRUE(room.turn_until([&] { return laptop.standing().waiting == 0 && other.view("drafts").contains(draft); }));
    ASSERT_NE(laptop.draft(), nullptr);
    if (is_cut) room.wires[1]->is_closed = true;
    other.drop_draft(draft);
    EXPECT_TRUE(room.turn_until([&] { return laptop.draft() == nullptr; })) << is_cut;
    EXPECT_NE(name_in(laptop.scene(), "cafe"), "Anna's");
    EXPECT_FALSE(laptop.enter_draft(draft).ok());
    EXPECT_TRUE(laptop.take_refusals().empty());
  }
}

// A window that computes other results than the server shows the steps without ticks of its own.
TEST(Drafts, AWindowOfAnotherBuildShowsTheSteps) {
  DraftRoom at;
  host::SelfTest other = host::self_test();
  other.fingerprint = "0000000000000000";
  RoomGuest& ben = at.room.join("designer", other);
  ASSERT_TRUE(at.room.turn_until([&] { return ben.standing().has_scene; }));
  ASSERT_FALSE(ben.standing().takes_ticks);
  ASSERT_TRUE(ben.begin_draft("").ok());
  EXPECT_FALSE(ben.draft()->has_ticks());
  ASSERT_TRUE(ben.submit({command<RenameNode>({"cafe", "Ben's"})}).ok());
  at.rest();
  EXPECT_EQ(name_in(ben.scene(), "cafe"), "Ben's");
  EXPECT_EQ(name_in(at.lead.scene(), "cafe"), name_in(ben.fold().confirmed(), "cafe"));
  ben.leave_draft();
  EXPECT_NE(name_in(ben.scene(), "cafe"), "Ben's");
}

TEST(Drafts, OneThatMayNotBeBegunIsLeftAndToldWithItsReason) {
  DraftRoom at;
  at.begin_phase({"comment"});
  ASSERT_TRUE(at.anna.begin_draft("Too late").ok());
  ASSERT_TRUE(at.anna.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
  at.rest();
  EXPECT_EQ(at.anna.draft(), nullptr);
  EXPECT_NE(name_in(at.anna.scene(), "cafe"), "Anna's");
  const auto refusals = at.anna.take_refusals();
  ASSERT_EQ(refusals.size(), 2u) << "the draft, and the step in it";
  EXPECT_EQ(refusals.front().why, "phase");
  // The same where it was left before the answer came.
  ASSERT_TRUE(at.anna.begin_draft("Too late").ok());
  const std::string draft = at.anna.draft()->id();
  at.anna.leave_draft();
  at.rest();
  EXPECT_FALSE(at.anna.enter_draft(draft).ok());
}

TEST(Drafts, AProposalIsLeftAndShownToWhoLeads) {
  DraftRoom at;
  ASSERT_TRUE(at.anna.begin_draft("Larger").ok());
  const std::string draft = at.anna.draft()->id();
  ASSERT_TRUE(at.anna.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
  at.rest();
  at.lead.look_at({draft});
  at.anna.propose_draft(draft, "A larger one", "Because");
  EXPECT_EQ(at.anna.draft(), nullptr);
  at.rest();
  EXPECT_EQ(state_of(at.room, at.anna, draft), "proposed");
  ASSERT_TRUE(at.lead.view("proposals").contains(draft));
  EXPECT_TRUE(at.room.turn_until([&] { return at.lead.view("draft_plans").contains(draft + "/n/cafe"); })) << "its plan comes";
  EXPECT_TRUE(at.lead.plan().contains("n/cafe"));
  EXPECT_FALSE(at.anna.enter_draft(draft).ok()) << "it is not open";
  at.lead.say_event("decide_proposal", JsonValue::of({{"draft", draft}, {"is_accepted", true}}));
  at.rest();
  EXPECT_EQ(name_in(at.anna.scene(), "cafe"), "Anna's");
}

}  // namespace
}  // namespace bl::guest
