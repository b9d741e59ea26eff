// Laws of people who change the same scene: what a command says that it touches is what it changes, and an undo changes nothing
// that somebody else has written.
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"
#include "tests/support/scene_differences.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kShared = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "position": [1, 2, 3], "types": {"smart_volume": {"demand": 900}}, "locked": ["node.position"]},
  {"id": "b", "types": {"smart_volume": {}}},
  {"id": "c", "types": {"statistics": {"nodes": ["a", "b"]}}},
  {"id": "brief", "types": {"programme": {"rows": [{"use": "housing", "floor_area": 90, "count": 4},
    {"use": "office", "floor_area": 400}, {"use": "shop", "floor_area": 60}]}}},
  {"id": "poll", "types": {"vote": {"is_open": true}}},
  {"id": "d", "types": {"sensor": {"reading": 5, "reading_tick": 3}}}],
  "links": [{"id": "l", "kind": "keep_distance", "from": "a", "to": "b"},
            {"id": "m", "kind": "keep_distance", "from": "b", "to": ["a", "c"], "strength": 0.5}]})";

std::string text_of(const std::set<Touch>& places) {
  std::string text;
  for (const Touch& place : places) text += bl::text_of(place) + "\n";
  return text;
}

TEST(TouchLaws, WhatACommandTouchesIsWhatItChanges) {
  std::map<std::string, int> changed;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Scene scene = read_scene(kShared, full_registry()).scene;
    std::optional<Namers> namers;
    Random random(seed);
    for (int k = 0; k < 600; ++k) {
      const Command command = random_command(scene, random, k);
      const Scene before = scene;
      SceneEdit edit(scene, full_registry(), &namers);
      const auto inverse = apply(edit, command);
      const std::set<Touch> told(edit.touches().begin(), edit.touches().end()), found = differences(before, scene);
      if (!inverse) {
        ASSERT_TRUE(found.empty()) << command.id << " was refused and changed\n" << text_of(found);
        continue;
      }
      changed[command.id] += found.empty() ? 0 : 1;
      // A batch may change a place and bring it back; all others say just what they change.
      if (command.id == "batch") {
        for (const Touch& place : found) ASSERT_TRUE(told.contains(place)) << bl::text_of(place);
      } else {
        ASSERT_EQ(text_of(told), text_of(found)) << command.id << ", seed " << seed << ", step " << k;
      }
      ASSERT_EQ(edit.is_logic_touched(), hash_of(before) != hash_of(scene) || !edit.placed().empty()) << command.id;
      if (scene.nodes.size() < 3 || scene.links.size() < 2) {
        scene = read_scene(kShared, full_registry()).scene;
        namers.reset();
      }
    }
  }
  for (const auto& [id, command] : full_registry().commands()) EXPECT_GT(changed[id], 0) << id << " never changed anything";
}

// A plain model of who wrote what stands in a scene, made of all scenes that there were. It knows nothing of the program's marks:
// what an undo brings back is whose it was when it stood there last.
class Past {
 public:
  explicit Past(const Scene& scene) : moments_{{scene, {}}} {}
  const Scene& scene() const { return moments_.back().scene; }
  /// The writer of the place, or of the nearest place around it; nobody where it is as it was opened.
  std::string owner(const Touch& place) const { return owner_in(moments_.back().owners, place); }

  void written(const Scene& scene, const std::string& author) {
    Owners owners = moments_.back().owners;
    for (const Touch& place : differences(this->scene(), scene)) write(owners, place, author);
    moments_.push_back({scene, std::move(owners)});
  }
  void brought_back(const Scene& scene, const std::string& author) {
    Owners owners = moments_.back().owners;
    std::set<Touch> open = differences(this->scene(), scene);
    for (const Touch& place : open) write(owners, place, author);
    for (auto moment = moments_.rbegin(); moment != moments_.rend() && !open.empty(); ++moment) {
      const std::set<Touch> other = differences(moment->scene, scene);
      std::erase_if(open, [&](const Touch& place) {
        Touch around = place;
        bool is_same = true;
        do is_same = is_same && !other.contains(around);
        while (widen(around));
        for (const Touch& inner : other) is_same = is_same && !lies_inside(inner, place);
        if (is_same) take_over(owners, moment->owners, place);
        return is_same;
      });
    }
    moments_.push_back({scene, std::move(owners)});
  }

 private:
  using Owners = std::map<Touch, std::string>;
  struct Moment {
    Scene scene;
    Owners owners;
  };
  static std::string owner_in(const Owners& owners, Touch place) {
    do {
      if (const auto owner = owners.find(place); owner != owners.end()) return owner->second;
    } while (widen(place));
    return "";
  }
  static void write(Owners& owners, const Touch& place, const std::string& author) {
    std::erase_if(owners, [&](const auto& owner) { return lies_inside(owner.first, place); });
    owners[place] = author;
  }
  static void take_over(Owners& owners, const Owners& from, const Touch& place) {
    write(owners, place, owner_in(from, place));
    for (const auto& [inner, author] : from)
      if (lies_inside(inner, place)) owners[inner] = author;
  }
  std::vector<Moment> moments_;
};

class ThreePeople : public ::testing::TestWithParam<int> {};

// Whatever three people do to the same few things, an undo or redo changes only what its author wrote.
TEST_P(ThreePeople, NobodysUndoChangesWhatSomebodyElseWrote) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  Ledger ledger(full_registry(), read_scene(kShared, full_registry()).scene);
  Past past(ledger.scene());
  for (int k = 0; k < 120 && !HasFailure(); ++k) {
    const std::string person = std::array{"anna", "ben", "cleo"}[random.below(3)];
    const std::uint64_t what = random.below(10);
    if (what < 6) {
      if (ledger.submit(random_command(ledger.scene(), random, k), person, 0).ok()) past.written(ledger.scene(), person);
      continue;
    }
    const bool is_undo = what < 8;
    const auto done = is_undo ? ledger.undo(person, 0) : ledger.redo(person, 0);
    if (!done) {
      EXPECT_TRUE(past.scene() == ledger.scene()) << "a refused undo has changed something";
      continue;
    }
    // A redo writes over what the undo brought back, whosever that was.
    if (is_undo)
      for (const Touch& place : differences(past.scene(), ledger.scene())) {
        EXPECT_EQ(past.owner(place), person) << "undo of " << bl::text_of(place) << ", step " << k;
      }
    for (const Mark& left : done->left) { EXPECT_EQ(left.writer.author.id, past.owner(left.place)) << bl::text_of(left.place); }
    past.brought_back(ledger.scene(), person);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, ThreePeople, ::testing::Range(0, test::kIsSanitized ? 8 : 40));

// Who takes back all that is to be taken back, and brings it back, has the same scene; and so has a replay of the log.
TEST_P(ThreePeople, UndoingAndRedoingAllOfMineLeavesTheScene) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 500);
  const Scene start = read_scene(kShared, full_registry()).scene;
  Ledger ledger(full_registry(), start);
  for (int k = 0; k < 150; ++k)
    (void)ledger.submit(random_command(ledger.scene(), random, k), std::array{"anna", "ben", "cleo"}[random.below(3)], 0);
  for (const char* author : {"anna", "ben", "cleo"}) {
    const std::string before = write_scene(ledger.scene(), full_registry());
    int undone = 0, redone = 0;
    while (ledger.undo(author, 0).ok()) ++undone;
    EXPECT_GT(undone, 0);
    while (ledger.redo(author, 0).ok()) ++redone;
    EXPECT_EQ(redone, undone) << author;
    EXPECT_EQ(write_scene(ledger.scene(), full_registry()), before) << author;
  }
  Ledger again(full_registry(), start);
  for (const LogEntry& entry : ledger.log()) {
    const auto done = again.replay(entry);
    ASSERT_TRUE(done.ok()) << "entry " << entry.seq << ", " << entry.command.id << ": " << done.error().text();
  }
  EXPECT_EQ(write_scene(again.scene(), full_registry()), write_scene(ledger.scene(), full_registry()));
}

// The first complaint of all: one key, two people.
TEST(TouchLaws, AnUndoLeavesTheNameThatSomebodyElseGaveSince) {
  World world = World::from_text(kShared);
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "by Anna"}), "anna"), "");
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "by Ben"}), "ben"), "");
  const auto undone = world.session().undo("anna");
  ASSERT_FALSE(undone.ok());
  EXPECT_EQ(undone.error().message, "cannot be undone: ben has changed nodes/a/name since");
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "by Ben");
  ASSERT_TRUE(world.session().undo("ben").ok());
  ASSERT_TRUE(world.session().undo("anna").ok()) << "what Ben took back is Anna's again";
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "");
}

TEST(TouchLaws, WhatSomebodyElseWroteBetweenOnesOwnStepsStays) {
  World world = World::from_text(kShared);
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "first"}), "anna"), "");
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "by Ben"}), "ben"), "");
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "third"}), "anna"), "");
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "by Ben");
  EXPECT_FALSE(world.session().undo("anna").ok()) << "the name is Ben's";
  ASSERT_TRUE(world.session().redo("anna").ok());
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "third");
}

TEST(TouchLaws, OfABatchOfBoxesOnlyTheOwnGoBack) {
  World world = World::from_text(kShared);
  ASSERT_EQ(world.submit(command<SetView>({{R"({"boxes": {"a": [1, 1], "b": [2, 2]}})"}, false}), "anna"), "");
  ASSERT_EQ(world.submit(command<SetView>({{R"({"boxes": {"b": [3, 3]}})"}, false}), "ben"), "");
  const auto undone = world.session().undo("anna");
  ASSERT_TRUE(undone.ok()) << undone.error().text();
  ASSERT_EQ(undone->left.size(), 1u);
  EXPECT_EQ(text_of(undone->left.front()), "ben has changed view/boxes/b since");
  EXPECT_EQ(world.session().scene().view, R"({"boxes": {"b": [3, 3]}})");
}

TEST(TouchLaws, ANodeThatOthersHaveLinkedToStays) {
  World world = World::from_text(kShared);
  ASSERT_EQ(world.submit(command<AddNode>({"e", {R"({"types": {"smart_volume": {}}})"}}), "anna"), "");
  ASSERT_EQ(world.submit(command<AddLink>({"n", {R"({"kind": "attract", "from": "e", "to": "a"})"}}), "ben"), "");
  const auto undone = world.session().undo("anna");
  ASSERT_FALSE(undone.ok());
  EXPECT_EQ(undone.error().message, "cannot be undone: ben has changed links/n since");
}

TEST(TouchLaws, WhatComesAndGoesWithinAGestureIsUndoneStepByStep) {
  World world = World::from_text(kShared);
  const Scene before = world.session().scene();
  const std::int64_t gesture = world.session().new_gesture();
  const Command steps[] = {command<UnlockPort>({"a", {"node.position"}}), command<LockPort>({"a", {"node.position"}}),
                           command<UnlockPort>({"a", {"node.position"}}),
                           command<RemoveRow>({"brief", {"programme.rows"}, "shop"}),
                           command<AddRow>({"brief", {"programme.rows"}, {R"({"use": "shop", "floor_area": 7})"}})};
  for (const Command& step : steps) ASSERT_TRUE(world.session().submit(step, "anna", gesture).ok()) << step.id;
  const auto undone = world.session().undo("anna");
  ASSERT_TRUE(undone.ok()) << undone.error().text();
  EXPECT_TRUE(world.session().scene() == before);
}

TEST(TouchLaws, AStepThatDoesNotFitAnyMoreIsPassedOverAndTold) {
  World world = World::from_text(kShared);
  ASSERT_EQ(world.submit(command<RenameNode>({"b", "by Anna"}), "anna"), "");
  ASSERT_EQ(world.submit(command<AddNode>({"e", {R"({"types": {"smart_volume": {}}})"}}), "ben"), "");
  ASSERT_EQ(world.submit(command<AddLink>({"n", {R"({"kind": "attract", "from": "a", "to": "e"})"}}), "anna"), "");
  ASSERT_EQ(world.submit(command<RemoveLink>({"n"}), "anna"), "");
  ASSERT_EQ(world.submit(command<RemoveNode>({"e"}), "ben"), "");
  const auto undone = world.session().undo("anna");
  ASSERT_TRUE(undone.ok()) << undone.error().text();
  ASSERT_TRUE(undone->misfit.has_value());
  EXPECT_NE(undone->misfit->message.find("cannot be undone because the scene has changed since: there is no node `e`"),
            std::string::npos)
      << undone->misfit->message;
}

// However many steps a gesture has, each place is brought back once.
TEST(TouchLaws, ADragIsUndoneInOneEntryForEachPlace) {
  World world = World::from_text(kShared);
  const std::int64_t drag = world.session().new_gesture();
  for (int i = 1; i <= 600; ++i)
    for (const char* node : {"a", "b"}) {
      const std::string place = "[" + std::to_string(i) + ", 0, 0]";
      ASSERT_TRUE(world.session().submit(command<SetPort>({node, {"node.position"}, {place}}), "anna", drag).ok());
    }
  const std::size_t before = world.session().log().size();
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_EQ(world.session().log().size(), before + 2);
  EXPECT_EQ(std::get<Vector3>(world.session().scene().nodes.at("a").types.at("node").at("position")).x, 1);
  ASSERT_TRUE(world.session().redo("anna").ok());
  EXPECT_EQ(std::get<Vector3>(world.session().scene().nodes.at("b").types.at("node").at("position")).x, 600);
}

}  // namespace
}  // namespace bl
