// How the nodes or links of one plan follow from those of the plan before.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/base/shared_list.h"

namespace bl {

/// A node or link that was added, removed or changed, by its index in both plans.
struct ItemEdit {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t before = kNone, now = kNone;

  bool is_added() const { return before == kNone; }
  bool is_removed() const { return now == kNone; }
};

/// By index before: the index now, or ItemEdit::kNone. `edits` ascend.
inline std::vector<std::uint32_t> places_after(std::size_t count, std::span<const ItemEdit> edits) {
  std::vector<std::uint32_t> places(count);
  std::uint32_t before = 0, now = 0;
  const auto pass = [&](std::uint32_t stretch) {
    std::iota(places.begin() + before, places.begin() + before + stretch, now);
    before += stretch, now += stretch;
  };
  for (const ItemEdit& edit : edits) {
    pass(edit.is_added() ? edit.now - now : edit.before - before);
    if (!edit.is_added()) places[before++] = edit.now;
    if (!edit.is_removed()) ++now;
  }
  pass(static_cast<std::uint32_t>(count) - before);
  return places;
}

/// Where items were added or removed: edits by their place in the list before. What is said of them in ascending order keeps
/// count of the others.
class EditCount {
 public:
  ItemEdit next(std::uint32_t place, bool was_there, bool is_there) {
    ItemEdit edit;
    if (was_there) edit.before = place;
    if (is_there) edit.now = place + added_ - removed_;
    if (!was_there) ++added_;
    if (!is_there) ++removed_;
    return edit;
  }

 private:
  std::uint32_t added_ = 0, removed_ = 0;
};

// Origins are handed to drafts of shared lists, which read in them what is still to be put.
static_assert(SharedItems<char>::Draft::kNone == ItemEdit::kNone);

/// By index now: the index before, or ItemEdit::kNone. `count`: how many there are now.
inline std::vector<std::uint32_t> origins_of(std::size_t count, std::span<const ItemEdit> edits) {
  std::vector<ItemEdit> back;
  for (const ItemEdit& edit : edits) back.push_back({edit.now, edit.before});
  return places_after(count, back);
}

}  // namespace bl
