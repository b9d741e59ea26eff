// A window's own picture of its draft: whatever answers are late, lost or out of order, it becomes that of the room.
#include "core/guest/draft_work.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/file/scene_file.h"
#include "core/session/ledger.h"
#include "tests/support/world.h"

namespace bl::guest {
namespace {

using View = std::map<std::string, JsonValue>;

Scene two_nodes() {
  return read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a"}, {"id": "b"}]})", full_registry()).scene;
}

// Few names, so that many steps say the same.
Command rename(Random& random) {
  return command<RenameNode>({random.below(2) == 0 ? "a" : "b", random.below(2) == 0 ? "X" : "Y"});
}

JsonValue told(const Command& command) { return JsonValue::of(command_to_json(full_registry(), command)); }

// The draft as a room keeps it: numbers of steps never change, and each operation is taken once.
struct Kept {
  struct Said {
    std::int64_t id;
    enum { step, undo, redo } what;
    Command command;
    bool is_refused = false;
  };
  std::vector<std::optional<Command>> steps;
  std::vector<std::size_t> taken_back;
  std::int64_t last = 0;

  bool take(const Said& said) {
    last = said.id;
    if (said.is_refused) return false;
    if (said.what == Said::step) {
      steps.emplace_back(said.command);
      taken_back.clear();
      return true;
    }
    if (said.what == Said::redo) {
      if (taken_back.empty()) return false;
      steps[taken_back.back()] = kept_;
      taken_back.pop_back();
      return true;
    }
    for (std::size_t k = steps.size(); k-- > 0;)
      if (steps[k]) {
        kept_ = *std::exchange(steps[k], std::nullopt);
        taken_back = {k};  // the last one alone comes back here
        return true;
      }
    return false;
  }
  View view() const {
    View view;
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (steps[k]) view.emplace("d/" + std::to_string(k), told(*steps[k]));
    view.emplace("/run", JsonValue::of(last));
    return view;
  }
  std::size_t step_count() const {
    return static_cast<std::size_t>(std::count_if(steps.begin(), steps.end(), [](const auto& s) { return s.has_value(); }));
  }
  Scene on(Scene scene) const {
    SceneEdit edit(scene, full_registry());
    for (const auto& step : steps)
      if (step) (void)apply(edit, *step);
    return scene;
  }

 private:
  Command kept_;
};

TEST(DraftWork, OfTwoStepsThatSayTheSameTheOneThatWasTakenBackIsGone) {
  DraftWork work(full_registry(), "run", "d", "");
  work.follow(two_nodes(), 1, nullptr);
  const Command same = command<RenameNode>({"a", "X"});
  ASSERT_TRUE(work.say(1, same).ok());
  work.took_back(2);  // its answer comes before that of the step
  EXPECT_EQ(work.step_count(), 0u);
  ASSERT_TRUE(work.say(3, same).ok());
  const View view = {{"d/1", told(same)}, {"/run", JsonValue::of(3)}};
  work.follow(two_nodes(), 1, &view);
  EXPECT_FALSE(work.answered(1, true)) << "the view has told what became of it";
  EXPECT_FALSE(work.answered(3, true));
  EXPECT_EQ(work.step_count(), 1u);
}

TEST(DraftWork, AServerThatHasLostTheEndOfItsRecordIsToldAgain) {
  DraftWork work(full_registry(), "run", "d", "");
  work.follow(two_nodes(), 1, nullptr);
  const Command first = command<RenameNode>({"a", "X"}), second = command<RenameNode>({"b", "Y"});
  ASSERT_TRUE(work.say(1, first).ok() && work.say(2, second).ok());
  const View whole = {{"d/0", told(first)}, {"d/1", told(second)}, {"/run", JsonValue::of(2)}};
  work.follow(two_nodes(), 1, &whole);
  EXPECT_TRUE(work.has(2));
  const View lost = {{"d/0", told(first)}, {"/run", JsonValue::of(1)}};
  work.follow(two_nodes(), 1, &lost);
  EXPECT_TRUE(work.has(1));
  EXPECT_FALSE(work.has(2)) << "who still has it says and shows it again";
  ASSERT_TRUE(work.say(2, second).ok());
  EXPECT_EQ(work.step_count(), 2u);
}

TEST(DraftWork, AServerThatCountsNoRunsHasToldWhatIsStored) {
  DraftWork work(full_registry(), "run", "d", "");
  work.follow(two_nodes(), 1, nullptr);
  ASSERT_TRUE(work.say(1, command<RenameNode>({"a", "X"})).ok());
  EXPECT_TRUE(work.answered(1, true));
  const View view = {{"d/0", told(command<RenameNode>({"a", "X"}))}};
  work.follow(two_nodes(), 1, &view);
  EXPECT_EQ(work.step_count(), 1u);
}

TEST(DraftWork, LawOfAnswersInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    const Scene head = two_nodes();
    Kept room;
    DraftWork work(full_registry(), "run", "d", "");
    work.follow(head, 1, nullptr);
    std::deque<Kept::Said> to_room;
    std::vector<std::pair<Kept::Said, bool>> answers;  // in any order
    std::deque<View> views;
    View seen;
    const auto hear = [&](std::size_t at) {
      const auto [said, is_done] = answers[at];
      answers.erase(answers.begin() + static_cast<std::ptrdiff_t>(at));
      if (said.what == Kept::Said::undo && is_done) work.took_back(said.id);
      (void)work.answered(said.id, is_done);
    };
    const auto follow = [&] {
      work.follow(head, 1, &views.front());
      views.pop_front();
    };
    std::int64_t id = 0;
    for (int k = 0; k < 200; ++k) {
      const std::uint64_t what = random.below(10);
      if (what < 3) {
        Kept::Said said{id + 1, Kept::Said::step, rename(random), random.below(5) == 0};
        if (work.say(said.id, said.command).ok()) ++id, to_room.push_back(said);
      } else if (what == 3) {
        if (work.step_count() > 0) to_room.push_back({++id, Kept::Said::undo, {}, random.below(8) == 0});
      } else if (what == 4) {
        to_room.push_back({++id, Kept::Said::redo, {}});
      } else if (what < 7) {
        if (!to_room.empty()) answers.emplace_back(to_room.front(), room.take(to_room.front())), to_room.pop_front();
      } else if (what == 7) {
        if (!answers.empty()) hear(random.below(answers.size()));
      } else if (what == 8) {
        // Only what has changed is told, and what came and went in between is not.
        if (const View now = room.view(); now != seen) views.push_back(now), seen = now;
      } else if (!views.empty()) {
        follow();
      }
    }
    for (; !to_room.empty(); to_room.pop_front()) answers.emplace_back(to_room.front(), room.take(to_room.front()));
    views.push_back(room.view());
    // Whichever comes last.
    while (!answers.empty() || !views.empty()) {
      if (views.empty() || (!answers.empty() && random.below(4) != 0)) hear(random.below(answers.size()));
      else follow();
    }
    EXPECT_EQ(work.step_count(), room.step_count()) << seed;
    EXPECT_EQ(write_scene(work.fold().shown(), full_registry()), write_scene(room.on(head), full_registry())) << seed;
    EXPECT_FALSE(work.fold().has_own()) << seed;
  }
}

}  // namespace
}  // namespace bl::guest
