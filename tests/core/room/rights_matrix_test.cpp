// The matrix of rights: every command and event, every role, in and out of an area, made by oneself or not, live, in a batch, in
// a draft and as an undo, in phases that allow it and that do not. The table here was written from the specification, not from
// the declarations.
#include <map>
#include <optional>

#include "core/live/commands.h"
#include "tests/core/room/room_world.h"
#include "tests/support/sanitized.h"

namespace bl::room {
namespace {

// `+` always, `a` in an own area, `o` of one's own making, `O` both, `c` on the role card, `d` in a draft, `D` in a draft and of
// one's own making, `f` by a visitor's form, `s` where scripts are allowed, `v` the layout of an own area.
struct Row {
  const char *facilitator, *designer, *stakeholder, *participant, *viewer, *recorder, *device;
  const char* of(Role role) const {
    const char* all[] = {facilitator, designer, stakeholder, participant, viewer, recorder, device};
    return all[static_cast<std::size_t>(role)];
  }
};
const std::map<std::string, Row> kCommands = {
    {"add_node", {"+", "ad", "d", "fd", "", "", "o"}},
    {"remove_node", {"+", "Od", "D", "D", "", "", "o"}},
    {"rename_node", {"+", "ad", "o", "", "", "", ""}},
    {"typify", {"+", "ad", "d", "", "", "", ""}},
    {"untypify", {"+", "ad", "d", "", "", "", ""}},
    {"set_port", {"+", "ad", "cd", "c", "", "", "o"}},
    {"set_cell", {"+", "ad", "co", "o", "", "", ""}},
    {"add_row", {"+", "ad", "o", "o", "", "", ""}},
    {"remove_row", {"+", "ad", "o", "o", "", "", ""}},
    {"lock_port", {"+", "ad", "", "", "", "", ""}},
    {"unlock_port", {"+", "ad", "", "", "", "", ""}},
    {"add_link", {"+", "ad", "d", "", "", "", ""}},
    {"remove_link", {"+", "ad", "d", "", "", "", ""}},
    {"set_link_ends", {"+", "ad", "d", "", "", "", ""}},
    {"enable_link", {"+", "ad", "d", "", "", "", ""}},
    {"mute_link", {"+", "ad", "d", "", "", "", ""}},
    {"set_link_parameter", {"+", "ad", "cd", "c", "", "", ""}},
    {"set_link_strength", {"+", "ad", "cd", "c", "", "", ""}},
    {"set_setting", {"+", "d", "", "", "", "", ""}},
    {"set_script", {"s", "s", "", "", "", "", ""}},
    {"remove_script", {"s", "s", "", "", "", "", ""}},
    {"set_view", {"+", "v", "", "", "", "", ""}},
    {"receive", {"+", "", "", "", "", "", "o"}},
    {"note_connection", {"+", "", "", "", "", "", "o"}},
    {"cast_vote", {"o", "o", "o", "o", "", "", ""}},
    {"batch", {"", "", "", "", "", "", ""}},  // as its parts
};

// Every element is there three times: in the area of who asks (`mine`), in somebody else's (`theirs`), and in none (`free`).
constexpr const char* kThree = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "mine", "position": [0, 0, 0], "tags": ["mine"], "types": {"smart_volume": {}, "programme": {"rows": [{"use": "shop", "floor_area": 9}]}, "sensor": {}}, "locked": ["smart_volume.demand"]},
  {"id": "mine_2", "tags": ["mine"], "types": {"smart_volume": {}}},
  {"id": "theirs", "tags": ["theirs"], "types": {"smart_volume": {}, "programme": {"rows": [{"use": "shop", "floor_area": 9}]}, "sensor": {}}, "locked": ["smart_volume.demand"]},
  {"id": "theirs_2", "tags": ["theirs"], "types": {"smart_volume": {}}},
  {"id": "free", "types": {"smart_volume": {}, "programme": {"rows": [{"use": "shop", "floor_area": 9}]}, "sensor": {}}, "locked": ["smart_volume.demand"]},
  {"id": "free_2", "types": {"smart_volume": {}}},
  {"id": "card", "types": {"stakeholder_group": {"controls": [
    {"node": "mine", "port": "smart_volume.demand", "minimum": 0, "maximum": 900},
    {"node": "mine_link", "port": "strength", "minimum": 0, "maximum": 1},
    {"node": "mine_link", "port": "minimum", "minimum": 0, "maximum": 900}]}}},
  {"id": "poll", "types": {"vote": {"kind": "yes_no"}}}],
  "links": [{"id": "mine_link", "kind": "keep_distance", "from": "mine", "to": "mine_2"},
            {"id": "theirs_link", "kind": "keep_distance", "from": "theirs", "to": "theirs_2"},
            {"id": "free_link", "kind": "keep_distance", "from": "free", "to": "free_2"}],
  "scripts": []})";

const std::vector<std::string> kPlaces = {"mine", "theirs", "free"};

std::string tags_of(const std::string& where) { return where == "free" ? "[]" : "[\"" + where + "\"]"; }

// A command of that kind at a place; nothing where the test does not know how to make one.
std::optional<Command> sample(const std::string& id, const std::string& where, std::int64_t seat) {
  const std::string link = where + "_link";
  if (id == "add_node")
    return command<AddNode>(
        {"device_" + std::to_string(seat) + "_new", {R"({"tags": )" + tags_of(where) + R"(, "types": {"smart_volume": {}}})"}});
  if (id == "remove_node") return command<RemoveNode>({where == "mine" ? "mine_2" : where == "theirs" ? "theirs_2" : "free_2"});
  if (id == "rename_node") return command<RenameNode>({where, "renamed"});
  if (id == "typify") return command<Typify>({where, "control", {"{}"}});
  if (id == "untypify") return command<Untypify>({where, "sensor"});
  if (id == "set_port") return command<SetPort>({where, {"smart_volume.demand"}, {"50"}});
  if (id == "set_cell") return command<SetCell>({where, {"programme.rows"}, "shop", "floor_area", {"5"}});
  if (id == "add_row") return command<AddRow>({where, {"programme.rows"}, {R"({"use": "office", "floor_area": 1})"}});
  if (id == "remove_row") return command<RemoveRow>({where, {"programme.rows"}, "shop"});
  if (id == "lock_port") return command<LockPort>({where, {"node.position"}});
  if (id == "unlock_port") return command<UnlockPort>({where, {"smart_volume.demand"}});
  if (id == "add_link")
    return command<AddLink>(
        {"new_link", {R"({"kind": "keep_distance", "from": ")" + where + R"(", "to": ")" + where + R"(_2"})"}});
  if (id == "remove_link") return command<RemoveLink>({link});
  if (id == "set_link_ends") return command<SetLinkEnds>({link, {{where + "_2"}, "", ""}, {{where}, "", ""}});
  if (id == "enable_link") return command<EnableLink>({link, false});
  if (id == "mute_link") return command<MuteLink>({link, true});
  if (id == "set_link_parameter") return command<SetLinkParameter>({link, "minimum", {"12"}});
  if (id == "set_link_strength") return command<SetLinkStrength>({link, 0.25});
  if (id == "set_setting") return command<SetSetting>({"title", {"\"t\""}});
  if (id == "set_view") return command<SetView>({{R"({"boxes": {")" + where + R"(": [1, 2]}})"}, false});
  if (id == "set_script") return command<SetScript>({"s", "bl.kind { id = 's' }", true});
  if (id == "remove_script") return std::nullopt;  // as set_script: the test of scripts below
  if (id == "receive") return command<live::Receive>({.node = where, .value = 4, .time = "", .problem = "", .tick = 0});
  if (id == "note_connection") return command<live::NoteConnection>({where, "unplugged"});
  if (id == "cast_vote") return command<CastVote>({"poll", RoomState::author_of_seat(seat), {"\"yes\""}});
  return std::nullopt;
}

struct Situation {
  std::string where;
  bool is_in_draft, is_in_batch;
};

// What the specification says.
bool is_allowed(const std::string& id, Role role, const Situation& at) {
  const bool is_node_of_card = id == "set_port" && at.where == "mine";
  const bool is_link_of_card = (id == "set_link_strength" || id == "set_link_parameter") && at.where == "mine";
  // The node that a device may remove is one that it has added: another than the one on its card.
  const bool is_own = id == "cast_vote" || (role == Role::device && id == "add_node") ||
                      (role == Role::device && at.where == "mine" && id != "remove_node");  // the device's card names `mine`
  for (const char* ground = kCommands.at(id).of(role); *ground != '\0'; ++ground) {
    const bool is_mine = at.where == "mine";
    switch (*ground) {
      case '+': return true;
      case 'a':
        if (!at.is_in_draft && is_mine) return true;
        break;
      case 'o':
        if (!at.is_in_draft && is_own) return true;
        break;
      case 'c':
        if (!at.is_in_draft && (is_node_of_card || is_link_of_card)) return true;
        break;
      case 'd':
        if (at.is_in_draft) return true;
        break;
      case 'v':
        if (!at.is_in_draft && is_mine) return true;
        break;
      default: break;  // own making, forms and scripts have tests of their own
    }
  }
  return false;
}

struct Place {
  RoomWorld world{kThree};
  std::int64_t lead = 0, other = 0, seat = 0;

  explicit Place(Role role) {
    lead = world.seat(Role::facilitator);
    EXPECT_EQ(sentence(world.event(lead, "define_area", R"({"area": "mine", "nodes": {"tag": "mine"}})")), "");
    EXPECT_EQ(sentence(world.event(lead, "define_area", R"({"area": "theirs", "nodes": {"tag": "theirs"}})")), "");
    EXPECT_EQ(sentence(world.event(lead, "open_vote", R"({"vote": "poll"})")), "");
    other = world.seat(Role::designer, {"theirs"});
    seat = world.seat(role, {"mine"}, role == Role::device ? "mine" : "card");
  }
};

const std::vector<Role> kRoles = {Role::facilitator, Role::designer, Role::stakeholder, Role::participant,
                                  Role::viewer,      Role::recorder, Role::device};

TEST(RightsMatrix, EveryCommandHasARowAndASample) {
  for (const auto& [id, definition] : full_registry().commands()) {
    EXPECT_TRUE(kCommands.contains(id)) << id << " has no row in the table of rights";
    if (id != "batch" && id != "remove_script") { EXPECT_TRUE(sample(id, "mine", 1).has_value()) << id; }
  }
}

// Under sanitizers two roles will do: the table is the same.
std::vector<Role> roles_to_try() { return test::kIsSanitized ? std::vector{Role::designer, Role::participant} : kRoles; }

TEST(RightsMatrix, EveryCommandIsDecidedAsTheTableSays) {
  int decided = 0, taken = 0;
  for (const Role role : roles_to_try()) {
    for (const auto& [id, row] : kCommands) {
      for (const std::string& where : kPlaces)
        for (const bool is_in_draft : {false, true})
          for (const bool is_in_batch : {false, true})
            for (const bool is_on : {true, false}) {
              Place place(role);
              auto tried = sample(id, where, place.seat);
              const bool is_by_script = id == "set_script";
              if (!tried || is_by_script) continue;
              const bool is_vote = id == "cast_vote";
              if (is_in_batch) tried = command<Batch>({std::vector{*tried}});
              std::string draft;
              if (is_in_draft) {
                draft = "d";
                (void)place.world.say(place.seat, OperationKind::draft_begin, R"({"draft": "d"})");
              }
              if (!is_on) (void)place.world.event(place.lead, "set_phase", R"({"activities": []})");
              const Scene before = place.world.scene();
              const std::size_t length = place.world.ledger().log().size();
              const Answer answer = place.world.command(place.seat, *tried, draft);
              const bool is_bound = role != Role::facilitator && role != Role::recorder && role != Role::device;
              const bool has_draft = !is_in_draft || place.world.room().drafts().contains("d");
              const bool expected = is_allowed(id, role, {where, is_in_draft, is_in_batch}) && (is_on || !is_bound) &&
                                    has_draft && !(is_vote && is_in_batch) && !(is_vote && is_in_draft);
              ASSERT_EQ(why(answer).empty(), expected)
                  << kRoleNames[static_cast<std::size_t>(role)] << ", " << id << " at " << where
                  << (is_in_draft ? ", in a draft" : "") << (is_in_batch ? ", in a batch" : "")
                  << (is_on ? "" : ", in another phase") << ": " << sentence(answer);
              if (!expected || is_in_draft) {
                ASSERT_TRUE(place.world.scene() == before) << id;
                ASSERT_EQ(place.world.ledger().log().size(), length) << id;
              }
              ++decided;
              taken += expected ? 1 : 0;
            }
    }
  }
  std::printf("%d decisions, %d taken\n", decided, taken);
  EXPECT_GT(taken, test::kIsSanitized ? 50 : 300);
}

// What somebody could do, they can undo; and nobody undoes what they may not do any more.
TEST(RightsMatrix, AnUndoNeedsTheRightToo) {
  int undone = 0, held = 0;
  for (const Role role : roles_to_try()) {
    for (const auto& [id, row] : kCommands) {
      for (const bool keeps_area : {true, false}) {
        Place place(role);
        const auto tried = sample(id, "mine", place.seat);
        if (!tried || !why(place.world.command(place.seat, *tried)).empty()) continue;
        const Scene done = place.world.scene();
        if (!keeps_area) {
          ASSERT_EQ(why(place.world.event(place.lead, "set_role",
                                          R"({"seat": )" + std::to_string(place.seat) + R"(, "role": "viewer"})")),
                    "");
        }
        const Answer answer = place.world.say(place.seat, OperationKind::undo, "{}");
        const bool is_device = role == Role::device;  // nothing is kept to undo what devices say
        if (keeps_area && !is_device) {
          ASSERT_EQ(sentence(answer), "") << kRoleNames[static_cast<std::size_t>(role)] << " " << id;
          ++undone;
        } else if (!is_device) {
          ASSERT_EQ(why(answer), "right") << id;
          ASSERT_TRUE(place.world.scene() == done);
          ++held;
        }
      }
    }
  }
  std::printf("%d undone, %d held\n", undone, held);
  EXPECT_GT(undone, test::kIsSanitized ? 10 : 30);
  EXPECT_GT(held, test::kIsSanitized ? 10 : 30);
}

// `x` may; who leads is not bound by phases, and the room alone causes `join` and `presence`.
const std::map<std::string, std::string> kEvents = {{"join", "......."},
                                                    {"presence", "......."},
                                                    {"set_role", "x......"},
                                                    {"mute", "x......"},
                                                    {"remove_seat", "x......"},
                                                    {"define_area", "x......"},
                                                    {"drop_area", "x......"},
                                                    {"ask_pen", "xxx...."},
                                                    {"give_pen", "xxx...."},
                                                    {"set_phase", "x......"},
                                                    {"open_vote", "x......"},
                                                    {"close_vote", "x......"},
                                                    {"comment", "xxxx.x."},
                                                    {"rate_comment", "xxxx.x."},
                                                    {"answer_comment", "x....x."},
                                                    {"propose", "xxxx..."},
                                                    {"decide_proposal", "x......"},
                                                    {"save_scenario", "xx...x."},
                                                    {"restart", "x......"},
                                                    {"mark", "x....x."},
                                                    {"show", "x......"},
                                                    {"set_pace", "x......"},
                                                    {"step_clock", "x......"},
                                                    {"set_door", "x......"},
                                                    {"renew_keys", "x......"},
                                                    {"close_room", "x......"},
                                                    {"forget", "x......"}};

TEST(RightsMatrix, EveryEventIsDecidedAsTheTableSays) {
  for (const auto& [id, kind] : event_kinds()) {
    ASSERT_TRUE(kEvents.contains(id)) << id << " has no row in the table of rights";
    for (const Role role : kRoles) {
      Place place(role);
      const RoomState before = place.world.room().state();
      // Arguments come after rights: an empty event says `bad`, `gone` or is taken where the role may.
      const Answer answer = place.world.event(place.seat, id);
      const bool may = kEvents.at(id)[static_cast<std::size_t>(role)] == 'x';
      ASSERT_EQ(why(answer) == "right", !may)
          << id << ", " << kRoleNames[static_cast<std::size_t>(role)] << ": " << sentence(answer);
      if (!may) { ASSERT_TRUE(place.world.room().state() == before); }
    }
  }
}

TEST(RightsMatrix, AMutedOrRemovedSeatDoesNothing) {
  for (const char* what : {"mute", "remove_seat"}) {
    Place place(Role::designer);
    ASSERT_EQ(why(place.world.event(place.lead, what, R"({"seat": )" + std::to_string(place.seat) + "}")), "");
    for (const auto& [id, row] : kCommands) {
      const auto tried = sample(id, "mine", place.seat);
      if (!tried) continue;
      ASSERT_NE(why(place.world.command(place.seat, *tried)), "") << what << " " << id;
    }
    ASSERT_NE(why(place.world.event(place.seat, "comment", R"({"id": "c", "text": "t"})")), "");
  }
}

TEST(RightsMatrix, ScriptsNeedARoomThatAllowsThem) {
  for (const bool are_allowed : {false, true})
    for (const Role role : kRoles) {
      RoomWorld world(kThree, {.scripts = are_allowed, .live = false});
      const auto seat = world.seat(role);
      const Answer answer = world.command(seat, command<SetScript>({"s", "broken(", true}));
      const bool may = are_allowed && (role == Role::facilitator || role == Role::designer);
      EXPECT_EQ(why(answer).empty(), may) << kRoleNames[static_cast<std::size_t>(role)] << " " << sentence(answer);
      if (may) { EXPECT_EQ(sentence(world.command(seat, command<RemoveScript>({"s"}))), ""); }
    }
}

}  // namespace
}  // namespace bl::room
