// The view's merge patch: however many keys a patch has, it comes to the same as its keys one by one, and is taken back exactly.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/session/commands.h"
#include "core/session/ledger.h"
#include "tests/support/processor_time.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string view_after(Ledger& ledger, const Json& patch) {
  EXPECT_TRUE(ledger.submit(command<SetView>({{patch.dump()}, false}), "test", 0));
  return ledger.scene().view;
}

Json random_patch(std::minstd_rand& random, int depth) {
  Json patch = Json::object();
  const std::size_t count = random() % 6;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string key(1, static_cast<char>('a' + random() % 8));
    switch (random() % 4) {
      case 0: patch[key] = nullptr; break;
      case 1: patch[key] = random() % 100; break;
      default: patch[key] = depth > 0 ? random_patch(random, depth - 1) : Json(random() % 2 == 0); break;
    }
  }
  return patch;
}

TEST(SetViewMerge, APatchComesToTheSameAsItsKeysOneByOne) {
  std::minstd_rand random(5);
  for (int round = 0; round < 300; ++round) {
    const Scene empty;
    Ledger whole(full_registry(), empty), single(full_registry(), empty);
    for (int step = 0; step < 4; ++step) {
      const Json patch = random_patch(random, 2);
      const std::string before = whole.scene().view, after = view_after(whole, patch);
      for (const auto& [key, change] : patch.items()) view_after(single, Json{{key, change}});
      ASSERT_EQ(after, single.scene().view) << before << " with " << patch.dump();
      ASSERT_TRUE(whole.undo("test", 0));
      ASSERT_EQ(whole.scene().view, before) << patch.dump();
      ASSERT_TRUE(whole.redo("test", 0));
      ASSERT_EQ(whole.scene().view, after) << patch.dump();
    }
  }
}

// In descending order, so that none of them goes to the end of what is there.
Json patch_of(int count, int shift) {
  Json boxes = Json::object();
  auto& members = boxes.get_ref<Json::object_t&>();
  for (int k = count; k-- > 0;) members.emplace_back("node-" + std::to_string(k), Json::array({k + shift, -k}));
  Json patch = Json::object();
  patch["boxes"] = std::move(boxes);
  return patch;
}

// Four times as many may take a little more than four times as long; the square would be sixteen times.
TEST(SetViewMerge, ManyBoxesAreMovedInProportionToTheirNumber) {
  const auto seconds = [](int count, bool is_whole) {
    const std::string first = patch_of(count, 0).dump(), second = patch_of(count, 7).dump();
    return test::processor_time([&] {
      Ledger ledger(full_registry(), Scene());
      ASSERT_TRUE(ledger.submit(command<SetView>({{first}, false}), "test", 0));
      ASSERT_TRUE(ledger.submit(command<SetView>({{second}, is_whole}), "test", 0));
      ASSERT_TRUE(ledger.undo("test", 0));
    });
  };
  for (const bool is_whole : {false, true}) {
    const double some = seconds(4000, is_whole), many = seconds(16000, is_whole);
    EXPECT_LT(many, 9 * some + 0.05) << some << " s for 4 000, " << many << " s for 16 000";
  }
}

TEST(SetViewMerge, KeysStandInAscendingOrderWhateverThatOfThePatch) {
  Ledger ledger(full_registry(), Scene());
  view_after(ledger, patch_of(3000, 0));
  const std::string before = ledger.scene().view;
  const Json view = Json::parse(before);
  ASSERT_EQ(view["boxes"].size(), 3000u);
  std::string last;
  for (const auto& [key, place] : view["boxes"].items()) {
    EXPECT_LT(last, key);
    last = key;
  }
  view_after(ledger, patch_of(3000, 7));
  ASSERT_TRUE(ledger.undo("test", 0));
  EXPECT_EQ(ledger.scene().view, before);
}

TEST(SetViewMerge, AWholeViewIsTakenBackWhole) {
  Ledger ledger(full_registry(), Scene());
  view_after(ledger, Json{{"boxes", {{"a", 1}, {"b", 2}}}, {"camera", {{"x", 1}}}});
  const std::string before = ledger.scene().view;
  ASSERT_TRUE(ledger.submit(command<SetView>({{R"({"boxes": {"b": 3, "c": 4}, "notes": {"n": 1}})"}, true}), "test", 0));
  EXPECT_EQ(Json::parse(ledger.scene().view), Json::parse(R"({"boxes": {"b": 3, "c": 4}, "notes": {"n": 1}})"));
  ASSERT_TRUE(ledger.undo("test", 0));
  EXPECT_EQ(ledger.scene().view, before);
}

}  // namespace
}  // namespace bl
