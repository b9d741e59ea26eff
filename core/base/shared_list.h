// A list that costs next to nothing to copy: copies share what they have in common, and a change copies only what it touches.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/heap_bytes.h"

namespace bl {

/// An immutable list of T in leaves of 16 items; each leaf also holds a Digest of its items, such as their sum or their hash.
/// Copies share leaves and items, and nobody can write to what is shared: new lists come out of a Draft.
template <class T, class Digest>
class SharedList {
 public:
  // Fewer items make more leaves to list, more of them more items to share anew where few have changed.
  static constexpr std::size_t kLeaf = 16;

  SharedList() : leaves_(std::make_shared<const Leaves>()) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return *item(i); }
  /// The item itself, by which two lists can be compared: the same pointer means the same content.
  const std::shared_ptr<const T>& item(std::size_t i) const { return (*leaves_)[i / kLeaf]->items[i % kLeaf]; }

  /// One for each leaf of items, in their order.
  std::size_t leaf_count() const { return leaves_->size(); }
  const Digest& digest(std::size_t leaf) const { return (*leaves_)[leaf]->digest; }
  /// Are all items of this leaf shared with the other list?
  bool shares_leaf(const SharedList& other, std::size_t leaf) const {
    return leaves_ == other.leaves_ || (leaf < other.leaves_->size() && (*leaves_)[leaf] == (*other.leaves_)[leaf]);
  }

  class Iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    Iterator() = default;
    Iterator(const SharedList* list, std::size_t at) : list_(list), at_(at) {}
    const T& operator*() const { return (*list_)[at_]; }
    const T* operator->() const { return &(*list_)[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) { return {list_, at_++}; }
    Iterator& operator--() {
      --at_;
      return *this;
    }
    Iterator operator--(int) { return {list_, at_--}; }
    Iterator& operator+=(difference_type by) {
      at_ += static_cast<std::size_t>(by);
      return *this;
    }
    Iterator& operator-=(difference_type by) { return *this += -by; }
    Iterator operator+(difference_type by) const { return Iterator(*this) += by; }
    Iterator operator-(difference_type by) const { return Iterator(*this) -= by; }
    friend Iterator operator+(difference_type by, const Iterator& it) { return it + by; }
    difference_type operator-(const Iterator& other) const { return static_cast<difference_type>(at_ - other.at_); }
    const T& operator[](difference_type by) const { return *(*this + by); }
    bool operator==(const Iterator& other) const { return at_ == other.at_; }
    auto operator<=>(const Iterator& other) const { return at_ <=> other.at_; }

   private:
    const SharedList* list_ = nullptr;
    std::size_t at_ = 0;
  };
  using const_iterator = Iterator;
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size_}; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }

  /// About how much memory it takes that `before` does not: of each item of its own, `bytes_of(item)` beside the item itself.
  template <class BytesOf>
  std::size_t unshared_bytes(const SharedList& before, const BytesOf& bytes_of) const {
    if (leaves_ == before.leaves_) return 0;
    // Items may stand elsewhere in the other list. The addresses decide who is met, and nobody learns in which order.
    std::vector<const T*> others;
    for (std::size_t l = 0; l < before.leaf_count(); ++l)
      for (std::size_t k = 0; !before.shares_leaf(*this, l) && k < kLeaf; ++k)
        others.push_back((*before.leaves_)[l]->items[k].get());
    std::sort(others.begin(), others.end(), std::less<>());
    std::size_t bytes = kBytesOfBlock + leaf_count() * sizeof(std::shared_ptr<const Leaf>);
    for (std::size_t i = 0; i < size_; ++i) {
      if (i % kLeaf == 0) {
        if (shares_leaf(before, i / kLeaf)) {
          i += kLeaf - 1;
          continue;
        }
        bytes += kBytesOfBlock + sizeof(Leaf);
      }
      const T& own = (*this)[i];
      if (!std::binary_search(others.begin(), others.end(), &own, std::less<>()))
        bytes += kBytesOfBlock + sizeof(T) + bytes_of(own);
    }
    return bytes;
  }

  class Draft;

 private:
  struct Leaf {
    std::array<std::shared_ptr<const T>, kLeaf> items;
    Digest digest{};
  };
  using Leaves = std::vector<std::shared_ptr<const Leaf>>;

  std::shared_ptr<const Leaves> leaves_;
  std::size_t size_ = 0;
};

/// A list on its way to the next one. It reads as the list that it came from, with what was edited since.
template <class T, class Digest>
class SharedList<T, Digest>::Draft {
 public:
  explicit Draft(SharedList base) : base_(std::move(base)), size_(base_.size()), open_(base_.leaf_count()) {}
  /// Of the items of `base` in other places: item i is the one that stood at `origins[i]`, or is still to be put (kNone).
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  Draft(SharedList base, std::span<const std::uint32_t> origins)
      : base_(std::move(base)), size_(origins.size()), open_((origins.size() + kLeaf - 1) / kLeaf) {
    for (std::size_t l = 0; l < open_.size(); ++l) {
      const std::size_t first = l * kLeaf, count = std::min(kLeaf, size_ - first);
      bool stays = std::min(kLeaf, base_.size() - std::min(first, base_.size())) == count;
      for (std::size_t k = 0; stays && k < count; ++k) stays = origins[first + k] == first + k;
      if (stays) continue;
      open_[l] = std::make_unique<OpenLeaf>();
      for (std::size_t k = 0; k < count; ++k)
        if (origins[first + k] != kNone) open_[l]->items[k] = base_.item(origins[first + k]);
    }
  }
  /// Of items that nobody has seen yet.
  explicit Draft(std::vector<T>&& items) : size_(items.size()), open_((items.size() + kLeaf - 1) / kLeaf) {
    for (std::size_t i = 0; i < size_; ++i) put(i, std::move(items[i]));
  }

  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const {
    const auto& leaf = open_[i / kLeaf];
    return leaf ? *leaf->items[i % kLeaf] : base_[i];
  }
  /// The item itself, as SharedList::item(). It stays the same object while it is edited in this draft.
  const std::shared_ptr<const T>& item(std::size_t i) const {
    return open_[i / kLeaf] ? open_[i / kLeaf]->items[i % kLeaf] : base_.item(i);
  }
  /// Those that were edited or put, ascending.
  std::vector<std::uint32_t> own_items() const {
    std::vector<std::uint32_t> items;
    for (std::size_t l = 0; l < open_.size(); ++l)
      for (std::size_t k = 0; open_[l] && k < kLeaf; ++k)
        if (open_[l]->own[k] != nullptr) items.push_back(static_cast<std::uint32_t>(l * kLeaf + k));
    return items;
  }

  /// The item to write to: a copy of its own where it is shared.
  T& edit(std::size_t i) {
    open(i);
    OpenLeaf& leaf = *open_[i / kLeaf];
    T*& own = leaf.own[i % kLeaf];
    if (own == nullptr) {
      auto copy = std::make_shared<T>(*leaf.items[i % kLeaf]);
      own = copy.get();
      leaf.items[i % kLeaf] = std::move(copy);
    }
    return *own;
  }
  void put(std::size_t i, T item) {
    open(i);
    OpenLeaf& leaf = *open_[i / kLeaf];
    auto fresh = std::make_shared<T>(std::move(item));
    leaf.own[i % kLeaf] = fresh.get();
    leaf.items[i % kLeaf] = std::move(fresh);
  }

  /// The list that came out of it. `finish(item, i)` is called for each item that was edited; then `digest_of(items, first)` for
  /// each leaf with edits, where `items[k]` points to item `first + k`, or nowhere behind the last one.
  template <class Finish, class DigestOf>
  SharedList publish(const Finish& finish, const DigestOf& digest_of) && {
    SharedList list;
    list.size_ = size_;
    bool has_edits = base_.leaf_count() != open_.size();
    for (const auto& leaf : open_) has_edits |= leaf != nullptr;
    if (!has_edits) {
      list.leaves_ = base_.leaves_;
      return list;
    }
    Leaves leaves = *base_.leaves_;
    leaves.resize(open_.size());
    for (std::size_t l = 0; l < open_.size(); ++l) {
      if (!open_[l]) continue;
      for (std::size_t k = 0; k < kLeaf; ++k)
        if (open_[l]->own[k] != nullptr) finish(*open_[l]->own[k], l * kLeaf + k);
      auto leaf = std::make_shared<Leaf>();
      leaf->items = std::move(open_[l]->items);
      leaf->digest = digest_of(leaf->items, l * kLeaf);
      leaves[l] = std::move(leaf);
    }
    list.leaves_ = std::make_shared<const Leaves>(std::move(leaves));
    return list;
  }

 private:
  void open(std::size_t i) {
    auto& leaf = open_[i / kLeaf];
    if (leaf) return;
    leaf = std::make_unique<OpenLeaf>();
    for (std::size_t k = 0, first = i / kLeaf * kLeaf; k < kLeaf && first + k < std::min(size_, base_.size()); ++k)
      leaf->items[k] = base_.item(first + k);
  }

  struct OpenLeaf {
    std::array<std::shared_ptr<const T>, kLeaf> items;
    std::array<T*, kLeaf> own{};  ///< the same items, where they are nobody else's
  };

  SharedList base_;
  std::size_t size_;
  std::vector<std::unique_ptr<OpenLeaf>> open_;  ///< by leaf; nothing where no item was edited
};

/// An immutable vector that copies share as a whole.
template <class T>
class SharedVector {
 public:
  SharedVector() : items_(std::make_shared<const std::vector<T>>()) {}
  explicit SharedVector(std::vector<T> items) : items_(std::make_shared<const std::vector<T>>(std::move(items))) {}
  std::size_t size() const { return items_->size(); }
  bool empty() const { return items_->empty(); }
  const T& operator[](std::size_t i) const { return (*items_)[i]; }
  const T* data() const { return items_->data(); }
  auto begin() const { return items_->begin(); }
  auto end() const { return items_->end(); }
  const T& front() const { return items_->front(); }
  const T& back() const { return items_->back(); }

 private:
  std::shared_ptr<const std::vector<T>> items_;
};

/// A list whose leaves hold nothing else.
template <class T>
using SharedItems = SharedList<T, std::monostate>;
template <class T>
SharedItems<T> published(typename SharedItems<T>::Draft&& draft) {
  return std::move(draft).publish([](T&, std::size_t) {}, [](const auto&, std::size_t) { return std::monostate(); });
}

}  // namespace bl
