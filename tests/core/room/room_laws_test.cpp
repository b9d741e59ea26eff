// Laws of a room under faults: messages that are lost, doubled and late, and a program that dies with what it has not stored.
#include <deque>
#include <map>

#include "core/base/random.h"
#include "tests/core/room/room_world.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"

namespace bl::room {
namespace {

// A page: it sends its operations again until each has its answer, and folds what it is told.
struct Bot {
  std::int64_t seat = 0, next = 1;
  std::deque<Operation> waiting;
  std::map<std::int64_t, Operation> said;
  std::map<std::int64_t, Answer> answers;
  std::unique_ptr<Ledger> fold;
  std::size_t heard = 0;  // entries of the log
};

// A server that stores several operations at once, and tells nobody before.
class Server {
 public:
  explicit Server(std::uint64_t seed) : random(seed) {}

  void take(Bot& bot, const Operation& operation) {
    held_.push_back({&bot, operation.id, world.room().submit(bot.seat, operation, world.now())});
    if (held_.size() >= 4) commit();
  }
  // On the disk first, then to the pages; a third of the messages is lost on the way.
  void commit() {
    world.store();
    for (const Held& held : held_)
      if (random.below(10) >= 3) tell(held);
    held_.clear();
  }
  void crash() {
    held_.clear();
    (void)world.room().take_record();
    world.crash();
    ++crashes;
  }

  RoomWorld world;
  Random random;
  int crashes = 0;

 private:
  struct Held {
    Bot* bot;
    std::int64_t operation;
    Answer answer;
  };
  void tell(const Held& held) {
    // A gap is no answer: what is missing comes again.
    if (why(held.answer) == "gap") return;
    const auto before = held.bot->answers.find(held.operation);
    // Whatever was lost in between: the same operation never gets another answer, but for refusals that a crash has forgotten.
    if (before != held.bot->answers.end()) { ASSERT_EQ(before->second.index(), held.answer.index()); }
    held.bot->answers[held.operation] = held.answer;
    while (!held.bot->waiting.empty() && held.bot->answers.contains(held.bot->waiting.front().id)) held.bot->waiting.pop_front();
  }
  std::vector<Held> held_;
};

Operation random_operation(const Scene& scene, Bot& bot, Random& random, int number) {
  Operation operation{.run = "run " + std::to_string(bot.seat), .id = bot.next++};
  const auto event = [&](const std::string& id, const std::string& arguments) {
    operation.kind = OperationKind::event;
    operation.content = R"({"event": ")" + id + R"(", "arguments": )" + arguments + "}";
  };
  const std::string name = std::to_string(number);
  const std::string draft = "draft_" + std::to_string(bot.seat) + "_" + std::to_string(random.below(3));
  switch (random.below(14)) {
    case 0: operation.kind = OperationKind::undo; break;
    case 1: operation.kind = OperationKind::redo; break;
    case 2: event("comment", R"({"id": "c)" + name + R"(", "text": "words )" + name + R"("})"); break;
    case 3: event("ask_pen", R"({"area": "north"})"); break;
    case 4:
      event(random.below(2) == 0 ? "open_vote" : "close_vote",
            random.below(2) == 0 ? R"({"vote": "poll"})" : R"({"vote": "secret_poll"})");
      break;
    case 5:
      operation.content = JsonValue::of({{"command", "cast_vote"},
                                         {"arguments",
                                          {{"node", random.below(2) == 0 ? "poll" : "secret_poll"},
                                           {"voter", RoomState::author_of_seat(bot.seat)},
                                           {"ballot", random.below(2) == 0 ? "yes" : "no"}}}});
      break;
    case 6:
      operation.kind = OperationKind::draft_begin;
      operation.content = R"({"draft": ")" + draft + R"("})";
      break;
    case 7: event("propose", R"({"draft": ")" + draft + R"("})"); break;
    case 8:
      event("decide_proposal", R"({"draft": "draft_)" + std::to_string(random.below(6)) + "_" + std::to_string(random.below(3)) +
                                   R"(", "is_accepted": )" + (random.below(3) > 0 ? "true" : "false") + "}");
      break;
    case 9:
      operation.kind = OperationKind::rewind;
      operation.content = R"({"to": )" + std::to_string(random.below(60)) + "}";
      break;
    case 10: operation.draft = draft; [[fallthrough]];
    default:
      operation.content = JsonValue::of(command_to_json(full_registry(), random_command(scene, random, number)));
      if (random.below(4) == 0) operation.gesture = 1 + static_cast<std::int64_t>(random.below(3));
  }
  return operation;
}

// Steps of drafts and secret ballots have rows of their own.
bool is_of_log(const Operation& operation) {
  const std::string content = operation.content.text();
  const bool is_of_draft = !operation.draft.empty() || operation.kind == OperationKind::draft_begin;
  const bool is_secret = content.find("cast_vote") != std::string::npos && content.find("secret_poll") != std::string::npos;
  return !is_of_draft && !is_secret;
}

void listen(const RoomWorld& world, Bot& bot) {
  for (; bot.heard < world.disk.entries.size(); ++bot.heard) {
    const auto done = bot.fold->replay(world.disk.entries[bot.heard].entry);
    ASSERT_TRUE(done.ok()) << done.error().text();
  }
}

TEST(RoomLaws, NoOperationIsLostOrDoneTwiceWhateverIsLostOnTheWay) {
  std::size_t operations = 0, entries = 0, refused = 0;
  int crashes = 0;
  // Ten times as slow under sanitizers, which look for other faults than this law does.
  const std::uint64_t seeds = test::kIsSanitized ? 1 : 12;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Server server(seed);
    RoomWorld& world = server.world;
    std::vector<Bot> bots;
    const Role roles[] = {Role::facilitator, Role::designer, Role::designer, Role::stakeholder, Role::participant};
    for (const Role role : roles) {
      bots.emplace_back();
      bots.back().seat = world.seat(role, {"north"}, "card");
      bots.back().fold = std::make_unique<Ledger>(full_registry(), read_scene(kTable, full_registry()).scene);
    }
    ASSERT_EQ(why(world.event(bots[0].seat, "define_area",
                              R"({"area": "north", "outline": [[-99, 0, 0], [99, 0, 0], [99, 99, 0], [-99, 99, 0]]})")),
              "");
    ASSERT_EQ(why(world.event(bots[0].seat, "set_phase", R"({"forms": ["smart_volume"]})")), "");
    bots[0].next = 3;
    world.room().greet(bots[0].seat, "run 1", 2);
    for (int k = 0; k < 500; ++k) {
      Bot& bot = bots[server.random.below(bots.size())];
      if (bot.waiting.size() < 20) {
        bot.waiting.push_back(random_operation(world.scene(), bot, server.random, k));
        bot.said[bot.waiting.back().id] = bot.waiting.back();
        ++operations;
      }
      // All that waits is sent again, in order; what is lost leaves a gap.
      for (const Operation& operation : std::deque<Operation>(bot.waiting)) {
        if (server.random.below(10) < 3) continue;
        server.take(bot, operation);
        if (server.random.below(20) == 0) server.take(bot, operation);
      }
      if (server.random.below(60) == 0) server.crash();
      world.tick += static_cast<std::int64_t>(server.random.below(2));
      world.at += 997;
      if (server.random.below(30) == 0) world.room().pass(world.now());
      listen(world, bot);
    }
    // The network is back: everybody gets their answers.
    for (int round = 0; round < 200; ++round)
      for (Bot& bot : bots) {
        for (const Operation& operation : std::deque<Operation>(bot.waiting)) server.take(bot, operation);
        server.commit();
      }
    for (Bot& bot : bots) {
      ASSERT_TRUE(bot.waiting.empty()) << "seed " << seed << ": the seat " << bot.seat << " waits for " << bot.waiting.front().id;
      listen(world, bot);
    }
    // In the log: each acknowledged operation that says something in it, once; no refused one.
    std::map<std::pair<std::string, std::int64_t>, std::set<std::int64_t>> found;  // gestures by operation
    for (const EntryRecord& record : world.disk.entries)
      if (record.entry.source.operation != 0)
        found[{record.entry.source.origin, record.entry.source.operation}].insert(record.entry.event ? -record.entry.seq
                                                                                                     : record.entry.gesture);
    for (const auto& [operation, gestures] : found) ASSERT_EQ(gestures.size(), 1u) << operation.first << " " << operation.second;
    for (const Bot& bot : bots)
      for (const auto& [id, answer] : bot.answers) {
        const bool is_in_log = found.contains({"run " + std::to_string(bot.seat), id});
        if (std::holds_alternative<Refusal>(answer)) {
          ASSERT_FALSE(is_in_log) << bot.seat << " " << id;
          ++refused;
        } else if (bot.said.contains(id) && is_of_log(bot.said.at(id))) {
          ASSERT_TRUE(is_in_log) << "acknowledged and lost: " << bot.seat << " " << id << " " << bot.said.at(id).content.text();
        }
      }
    for (std::size_t k = 1; k < world.disk.entries.size(); ++k)
      ASSERT_EQ(world.disk.entries[k].entry.seq, world.disk.entries[k - 1].entry.seq + 1);
    // One fold: of the server, of each page, and of the file.
    const auto hash = hash_of(world.room().state());
    const Scene scene = world.scene();
    for (const Bot& bot : bots) ASSERT_TRUE(bot.fold->scene() == scene) << "seed " << seed << ", seat " << bot.seat;
    world.crash();
    ASSERT_TRUE(world.scene() == scene);
    ASSERT_EQ(hash_of(world.room().state()), hash);
    entries += world.disk.entries.size();
    crashes += server.crashes;
  }
  std::printf("%zu operations, %zu entries, %zu refused, %d crashes\n", operations, entries, refused, crashes);
  EXPECT_GT(entries, 90 * seeds);
  EXPECT_GT(crashes, 3 * static_cast<int>(seeds));
}

}  // namespace
}  // namespace bl::room
