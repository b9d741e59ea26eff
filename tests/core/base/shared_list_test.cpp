// Lists that share: what a draft edits is copied, what it leaves alone is the same object, and the list before stays as it was.
#include "core/base/shared_list.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace bl {
namespace {

struct Item {
  int number = 0;
  int doubled = 0;
};
struct Sum {
  int of_numbers = 0;
};
using Items = SharedList<Item, Sum>;
constexpr std::size_t kLeaf = Items::kLeaf;

Items published(Items::Draft&& draft) {
  return std::move(draft).publish([](Item& item, std::size_t) { item.doubled = 2 * item.number; },
                                  [](const auto& items, std::size_t) {
                                    Sum sum;
                                    for (const auto& item : items)
                                      if (item) sum.of_numbers += item->number;
                                    return sum;
                                  });
}

Items numbers(int count) {
  std::vector<Item> items;
  for (int i = 0; i < count; ++i) items.push_back({i, 0});
  return published(Items::Draft(std::move(items)));
}

TEST(SharedList, HoldsWhatItWasGiven) {
  EXPECT_TRUE(Items().empty());
  EXPECT_EQ(Items().leaf_count(), 0u);
  for (const int count : {1, 31, 32, 33, 100}) {
    const Items items = numbers(count);
    ASSERT_EQ(items.size(), static_cast<std::size_t>(count));
    int at = 0, sum = 0;
    for (const Item& item : items) {
      EXPECT_EQ(item.number, at);
      EXPECT_EQ(item.doubled, 2 * at++);
    }
    for (std::size_t leaf = 0; leaf < items.leaf_count(); ++leaf) sum += items.digest(leaf).of_numbers;
    EXPECT_EQ(sum, count * (count - 1) / 2);
  }
}

TEST(SharedList, ADraftOfItemsInOtherPlacesSharesThem) {
  const Items before = numbers(100);
  for (const std::size_t size : {0u, 31u, 32u, 64u, 70u, 99u, 101u, 128u, 129u}) {
    std::vector<std::uint32_t> origins(size, Items::Draft::kNone);
    std::iota(origins.begin(), origins.begin() + static_cast<std::ptrdiff_t>(std::min(size, before.size())), 0u);
    Items::Draft draft(before, origins);
    for (std::size_t i = before.size(); i < size; ++i) draft.put(i, {static_cast<int>(i), 0});
    const Items after = published(std::move(draft));
    ASSERT_EQ(after.size(), size);
    ASSERT_EQ(after.leaf_count(), (size + kLeaf - 1) / kLeaf);
    int sum = 0;
    for (std::size_t leaf = 0; leaf < after.leaf_count(); ++leaf) sum += after.digest(leaf).of_numbers;
    EXPECT_EQ(sum, static_cast<int>(size) * (static_cast<int>(size) - 1) / 2) << size;
    for (std::size_t i = 0; i < std::min(size, before.size()); ++i) EXPECT_EQ(after.item(i), before.item(i));
    for (std::size_t leaf = 0; leaf < std::min(size, before.size()) / kLeaf; ++leaf) EXPECT_TRUE(after.shares_leaf(before, leaf));
  }
  // One item in the middle is gone: those behind it move by one place.
  std::vector<std::uint32_t> origins(99);
  for (std::uint32_t i = 0; i < 99; ++i) origins[i] = i < 40 ? i : i + 1;
  const Items after = published(Items::Draft(before, origins));
  EXPECT_TRUE(after.shares_leaf(before, 0));
  EXPECT_EQ(after.item(39), before.item(39));
  EXPECT_EQ(after.item(40), before.item(41));
  EXPECT_EQ(after.item(98), before.item(99));
}

TEST(SharedList, AnEditCopiesWhatItTouches) {
  const Items before = numbers(100);
  Items::Draft draft(before);
  draft.edit(40).number = 1000;
  draft.put(41, {2000, 0});
  EXPECT_EQ(draft[40].number, 1000) << "a draft reads as what was edited";
  EXPECT_EQ(draft[42].number, 42);
  EXPECT_EQ(draft.own_items(), (std::vector<std::uint32_t>{40, 41}));
  const Items after = published(std::move(draft));
  EXPECT_EQ(before[40].number, 40) << "what is shared is never written";
  EXPECT_EQ(after[40].number, 1000);
  EXPECT_EQ(after[40].doubled, 2000);
  EXPECT_EQ(after[41].number, 2000);
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after.item(i) == before.item(i), i != 40 && i != 41) << i;
  for (std::size_t leaf = 0; leaf < after.leaf_count(); ++leaf)
    EXPECT_EQ(after.shares_leaf(before, leaf), leaf != 40 / kLeaf) << leaf;
  EXPECT_EQ(after.digest(40 / kLeaf).of_numbers, before.digest(40 / kLeaf).of_numbers - 40 - 41 + 3000);
}

TEST(SharedList, WithoutAnEditItIsTheSameList) {
  const Items before = numbers(70);
  const Items after = published(Items::Draft(before));
  for (std::size_t leaf = 0; leaf < after.leaf_count(); ++leaf) EXPECT_TRUE(after.shares_leaf(before, leaf));
}

}  // namespace
}  // namespace bl
