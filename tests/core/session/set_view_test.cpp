// The view's merge patch: however many keys a patch has, it comes to the same as its keys one by one, and is taken back exactly.
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/session/commands.h"
#include "core/session/ledger.h"
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

TEST(SetViewMerge, ThousandsOfKeysAreMergedInOneWalk) {
  Ledger ledger(full_registry(), Scene());
  Json patch = Json::object();
  for (int k = 0; k < 3000; ++k) patch["boxes"]["node-" + std::to_string(k)] = Json::array({k, -k});
  view_after(ledger, patch);
  const Json view = Json::parse(ledger.scene().view);
  ASSERT_EQ(view["boxes"].size(), 3000u);
  std::string last;
  for (const auto& [key, place] : view["boxes"].items()) {
    EXPECT_LT(last, key) << "ascending, whatever the order of the patch";
    last = key;
  }
}

}  // namespace
}  // namespace bl
