// How the links of one plan follow from those of the plan before.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace bl {

/// A link that was added, removed or changed, by its index in both plans.
struct LinkEdit {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::uint32_t before = kNone, now = kNone;

  bool is_added() const { return before == kNone; }
  bool is_removed() const { return now == kNone; }
};

/// By index before: the index now, or LinkEdit::kNone. `edits` ascend.
inline std::vector<std::uint32_t> places_after(std::size_t count, std::span<const LinkEdit> edits) {
  std::vector<std::uint32_t> places(count);
  std::uint32_t before = 0, now = 0;
  const auto pass = [&](std::uint32_t stretch) {
    std::iota(places.begin() + before, places.begin() + before + stretch, now);
    before += stretch, now += stretch;
  };
  for (const LinkEdit& edit : edits) {
    pass(edit.is_added() ? edit.now - now : edit.before - before);
    if (!edit.is_added()) places[before++] = edit.now;
    if (!edit.is_removed()) ++now;
  }
  pass(static_cast<std::uint32_t>(count) - before);
  return places;
}

/// A SharedList of links with those that stay in their new places. Those that were added are still to be put.
template <class List>
typename List::Draft moved_links(const List& before, std::size_t size, std::span<const LinkEdit> edits) {
  typename List::Draft draft(before, size);
  const std::vector<std::uint32_t> places = places_after(before.size(), edits);
  for (std::size_t l = 0; l < places.size(); ++l)
    if (places[l] != LinkEdit::kNone && places[l] != l) draft.share(places[l], before.item(l));
  return draft;
}

}  // namespace bl
