// Batches: one step whatever they hold, taken back as one, and no dearer for each command the longer they are.
#include <gtest/gtest.h>

#include <ctime>

#include "core/base/stop.h"
#include "core/session/ledger.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string batch_of(std::size_t count, const std::string& last = "") {
  std::string list = "[";
  for (std::size_t i = 0; i < count; ++i)
    list += std::string(i > 0 ? "," : "") + R"({"command": "add_node", "arguments": {"id": "n)" + std::to_string(i) +
            R"(", "node": {"types": {"junction": {}}}}})";
  return list + (last.empty() ? "" : "," + last) + "]";
}

double seconds_for(std::size_t count) {
  Scene scene;
  SceneEdit edit(scene, full_registry());
  const Command batch = batch_of_text(batch_of(count));
  const std::clock_t start = std::clock();
  const Inverse inverse = apply(edit, batch);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_TRUE(inverse.ok());
  EXPECT_EQ(scene.nodes.size(), count);
  EXPECT_EQ(inverse.ok() ? inverse->size() : 0, count);
  return seconds;
}

// Quadratic work shows as four times as much for twice as many; the processor's own time is measured, so that others do not
// count.
TEST(Batch, TwiceAsManyCommandsTakeAboutTwiceAsLong) {
  (void)seconds_for(1000);
  const double some = seconds_for(5000), many = seconds_for(20000);
  EXPECT_LT(many, 12 * some + 0.5) << some << " s for 5 000, " << many << " s for 20 000";
}

// Each node that goes has to leave all links and sets that name it, without a look at all others.
TEST(Batch, UndoingTwiceAsManyTakesAboutTwiceAsLong) {
  const auto undo_of = [](std::size_t count) {
    Ledger ledger(full_registry(), Scene());
    EXPECT_TRUE(ledger.submit(batch_of_text(batch_of(count)), "test", 0).ok());
    const std::clock_t start = std::clock();
    EXPECT_TRUE(ledger.undo("test", 0).ok());
    const double undone = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_TRUE(ledger.scene().nodes.empty());
    EXPECT_TRUE(ledger.redo("test", 0).ok());
    EXPECT_EQ(ledger.scene().nodes.size(), count);
    return undone;
  };
  (void)undo_of(500);
  const double some = undo_of(5000), many = undo_of(20000);
  EXPECT_LT(many, 9 * some + 0.5) << some << " s for 5 000, " << many << " s for 20 000";
}

// Who names whom is kept while nodes come and go: the same steps, each with an edit of its own that looks at the whole scene, say
// the same and lead to the same.
TEST(Batch, StepsThatShareWhatIsKnownDoWhatStepsAloneDo) {
  std::uint64_t seed = 7;
  const auto choose = [&seed](std::uint64_t end) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (seed >> 33) % end;
  };
  const auto name = [](std::uint64_t number) { return "n" + std::to_string(number); };
  Scene together, alone;
  std::optional<Namers> kept;
  std::size_t done = 0, dropped = 0;
  for (int step = 0; step < 4000; ++step) {
    const std::string one = name(choose(12)), other = name(choose(12)), third = name(choose(12)), link = "l" + one + other;
    const JsonValue of_two{R"({"kind": "attract", "from": [")" + one + "\", \"" + third + R"("], "to": ")" + other + "\"}"};
    const JsonValue street{R"({"types": {"street": {"start": ")" + other + R"(", "end": ")" + third + "\"}}}"};
    const Command commands[] = {command<AddNode>({one, {R"({"types": {"junction": {}}})"}}),
                                command<AddNode>({one, street}),
                                command<RemoveNode>({one}),
                                command<RemoveNode>({other}),
                                command<AddLink>({link, of_two}),
                                command<AddLink>({link, of_two}),
                                command<RemoveLink>({link}),
                                command<SetLinkEnds>({link, Selection{{one}, "", ""}, Selection{{other, third}, "", ""}}),
                                command<SetPort>({one, {"street.start"}, {"\"" + other + "\""}})};
    const Command& next = commands[choose(std::size(commands))];
    SceneEdit shared(together, full_registry(), &kept), own(alone, full_registry());
    const Inverse a = apply(shared, next), b = apply(own, next);
    ASSERT_EQ(a.ok(), b.ok()) << step;
    ASSERT_EQ(together, alone) << step;
    if (!a) continue;
    ASSERT_EQ(*a, *b) << step;
    ++done;
    dropped += a->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(done, 500u);
  EXPECT_GT(dropped, 50u) << "nodes that others named";
}

TEST(Batch, ItsInversesUndoFromTheLastToTheFirst) {
  World world = World::from_file("scenes/links/ratio.json");
  const Scene before = world.session().scene();
  const std::string list =
      R"([{"command": "add_node", "arguments": {"id": "a", "node": {"types": {"smart_volume": {}}}}},
          {"command": "set_port", "arguments": {"node": "a", "port": "smart_volume.demand", "value": 5}},
          {"command": "set_port", "arguments": {"node": "a", "port": "smart_volume.demand", "value": 7}},
          {"command": "rename_node", "arguments": {"id": "a", "name": "A"}},
          {"command": "remove_node", "arguments": {"id": "parking"}}])";
  ASSERT_EQ(world.submit(batch_of_text(list)), "");
  const Scene after = world.session().scene();
  EXPECT_FALSE(after.nodes.contains("parking"));
  ASSERT_TRUE(world.session().undo("test").ok());
  EXPECT_EQ(world.session().scene(), before);
  ASSERT_TRUE(world.session().redo("test").ok());
  EXPECT_EQ(world.session().scene(), after);
}

TEST(Batch, AFaultAtItsEndLeavesTheSceneAsItWas) {
  World world = World::from_file("scenes/links/ratio.json");
  const Scene before = world.session().scene();
  const std::string twice = R"({"command": "add_node", "arguments": {"id": "n3", "node": {"types": {"junction": {}}}}})";
  EXPECT_NE(world.submit(batch_of_text(batch_of(500, twice))).find("taken"), std::string::npos);
  EXPECT_EQ(world.session().scene(), before);
}

// Whoever waits for a long one can stop it: all of it is taken back.
TEST(Batch, OneThatNobodyWantsAnyMoreChangesNothing) {
  Scene scene;
  SceneEdit edit(scene, full_registry());
  int asked = 0;
  const StopScope scope([&asked] { return ++asked > 3; });
  const Inverse stopped = apply(edit, batch_of_text(batch_of(5000)));
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(scene.nodes.empty());
}

}  // namespace
}  // namespace bl
