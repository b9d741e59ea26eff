// A map from names that costs next to nothing to copy: copies share what they have in common, and a change copies only what it
// touches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/heap_bytes.h"

namespace bl {

/// A map in ascending names, read as a std::map. Copies share leaves of up to 64 records. Whoever writes gets a record of their
/// own, which takes the place of the one before: references to that one hold as long as a copy of the map does, and read what it
/// was. Iterators go on over the map as it was when they were made. Adding or removing a record costs a pass over the leaves.
template <class T>
class SharedMap {
  using Leaf = std::vector<std::shared_ptr<std::pair<const std::string, T>>>;  // never empty
  using Leaves = std::vector<std::shared_ptr<const Leaf>>;

 public:
  using value_type = std::pair<const std::string, T>;

  SharedMap() : leaves_(std::make_shared<const Leaves>()) {}
  SharedMap(std::initializer_list<value_type> records) : SharedMap() {
    for (const value_type& record : records) emplace(record.first, record.second);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  class Iterator {
   public:
    using iterator_category = std::bidirectional_iterator_tag;
    using value_type = SharedMap::value_type;
    using difference_type = std::ptrdiff_t;
    using pointer = const value_type*;
    using reference = const value_type&;

    Iterator() = default;
    reference operator*() const { return *(*(*leaves_)[leaf_])[at_]; }
    pointer operator->() const { return &**this; }
    Iterator& operator++() {
      if (++at_ == (*leaves_)[leaf_]->size()) ++leaf_, at_ = 0;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    Iterator& operator--() {
      if (at_ == 0) at_ = (*leaves_)[--leaf_]->size();
      --at_;
      return *this;
    }
    Iterator operator--(int) {
      Iterator before = *this;
      --*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return leaf_ == other.leaf_ && at_ == other.at_; }

   private:
    friend class SharedMap;
    Iterator(const SharedMap& map, std::size_t leaf, std::size_t at) : leaves_(map.leaves_), leaf_(leaf), at_(at) {}
    std::shared_ptr<const Leaves> leaves_;  // held: the map may change meanwhile
    std::size_t leaf_ = 0, at_ = 0;
  };
  using const_iterator = Iterator;
  using iterator = Iterator;

  Iterator begin() const { return {*this, 0, 0}; }
  Iterator end() const { return {*this, leaves_->size(), 0}; }
  auto rbegin() const { return std::reverse_iterator(end()); }
  auto rend() const { return std::reverse_iterator(begin()); }

  Iterator find(const std::string& name) const {
    const auto [leaf, at, is_there] = place_of(name);
    return is_there ? Iterator(*this, leaf, at) : end();
  }
  /// The first record that does not come before the name.
  Iterator lower_bound(const std::string& name) const {
    const auto [leaf, at, is_there] = place_of(name);
    const bool is_behind_leaf = leaf < leaves_->size() && at == (*leaves_)[leaf]->size();
    return is_behind_leaf ? Iterator(*this, leaf + 1, 0) : Iterator(*this, leaf, at);
  }
  bool contains(const std::string& name) const { return place_of(name).is_there; }
  const T& at(const std::string& name) const {
    const auto [leaf, at, is_there] = place_of(name);
    if (!is_there) throw std::out_of_range("there is no `" + name + "`");
    return (*(*leaves_)[leaf])[at]->second;
  }

  /// The record to write to, which must exist; only until the map is copied.
  T& edit(const std::string& name) {
    const auto [leaf, at, is_there] = place_of(name);
    if (!is_there) throw std::out_of_range("there is no `" + name + "`");
    return own(leaf, at);
  }
  /// The record to write to; a fresh one where there is none yet.
  T& operator[](const std::string& name) {
    emplace(name, T());
    return edit(name);
  }
  /// Whether it was added: a record of that name stays as it is.
  bool emplace(const std::string& name, T record) {
    const auto [leaf, at, is_there] = place_of(name);
    if (is_there) return false;
    auto fresh = std::make_shared<value_type>(name, std::move(record));
    Leaves leaves = *leaves_;
    if (leaf == leaves.size()) {
      leaves.push_back(std::make_shared<const Leaf>(Leaf{std::move(fresh)}));
    } else {
      Leaf with = *leaves[leaf];
      with.insert(with.begin() + static_cast<std::ptrdiff_t>(at), std::move(fresh));
      if (with.size() > kMostInLeaf) {
        const auto half = with.begin() + static_cast<std::ptrdiff_t>(with.size() / 2);
        leaves.insert(leaves.begin() + static_cast<std::ptrdiff_t>(leaf) + 1, std::make_shared<const Leaf>(half, with.end()));
        with.erase(half, with.end());
      }
      leaves[leaf] = std::make_shared<const Leaf>(std::move(with));
    }
    leaves_ = std::make_shared<const Leaves>(std::move(leaves));
    ++size_;
    return true;
  }
  /// How many were removed: one or none.
  std::size_t erase(const std::string& name) {
    const auto [leaf, at, is_there] = place_of(name);
    if (!is_there) return 0;
    Leaves leaves = *leaves_;
    Leaf without = *leaves[leaf];
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(at));
    if (without.empty()) leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(leaf));
    else leaves[leaf] = std::make_shared<const Leaf>(std::move(without));
    leaves_ = std::make_shared<const Leaves>(std::move(leaves));
    --size_;
    return 1;
  }
  void clear() { *this = SharedMap(); }

  bool operator==(const SharedMap& other) const {
    return size_ == other.size_ && each_difference(other, [](const value_type*, const value_type*) { return false; });
  }
  /// Calls see(before, after) for each name whose records differ, in ascending names, as long as it returns true; nullptr stands
  /// for a record that is not there. Costs what the maps do not share.
  template <class See>
  bool each_difference(const SharedMap& after, const See& see) const {
    if (leaves_ == after.leaves_) return true;
    Iterator a = begin(), b = after.begin();
    const Iterator a_end = end(), b_end = after.end();
    while (a != a_end || b != b_end) {
      if (a != a_end && b != b_end && a.at_ == 0 && b.at_ == 0 && (*leaves_)[a.leaf_] == (*after.leaves_)[b.leaf_]) {
        ++a.leaf_, ++b.leaf_;
        continue;
      }
      const bool is_old = b == b_end || (a != a_end && a->first < b->first);
      const bool is_new = a == a_end || (b != b_end && b->first < a->first);
      const value_type *before = is_new ? nullptr : &*a, *now = is_old ? nullptr : &*b;
      const bool is_same = before == now || (!is_old && !is_new && before->second == now->second);
      if (!is_same && !see(before, now)) return false;
      if (!is_new) ++a;
      if (!is_old) ++b;
    }
    return true;
  }

  /// About how much memory it takes that `before` does not: of each record of its own, `bytes_of(record, other)` beside the
  /// record itself, where `other` is the one of that name in `before`, or nullptr.
  template <class BytesOf>
  std::size_t unshared_bytes(const SharedMap& before, const BytesOf& bytes_of) const {
    if (leaves_ == before.leaves_) return 0;
    std::size_t bytes = kBytesOfBlock + leaves_->size() * sizeof(std::shared_ptr<const Leaf>);
    for (const auto& leaf : *leaves_) {
      const Place first = before.place_of(leaf->front()->first);
      if (first.leaf < before.leaves_->size() && (*before.leaves_)[first.leaf] == leaf) continue;
      bytes += kBytesOfBlock + heap_bytes(*leaf);
      for (const auto& record : *leaf) {
        const Place place = before.place_of(record->first);
        const auto* other = place.is_there ? (*(*before.leaves_)[place.leaf])[place.at].get() : nullptr;
        if (other == record.get()) continue;
        bytes += kBytesOfBlock + sizeof(value_type) + heap_bytes(record->first) +
                 bytes_of(record->second, other != nullptr ? &other->second : nullptr);
      }
    }
    return bytes;
  }

 private:
  static constexpr std::size_t kMostInLeaf = 64;
  struct Place {
    std::size_t leaf = 0, at = 0;  // where the record is, or would go
    bool is_there = false;
  };

  Place place_of(const std::string& name) const {
    // The last leaf that begins at or before the name.
    const auto behind = std::upper_bound(leaves_->begin(), leaves_->end(), name,
                                         [](const std::string& key, const auto& leaf) { return key < leaf->front()->first; });
    if (behind == leaves_->begin()) return {0, 0, false};
    const auto leaf = std::prev(behind);
    const auto at = std::lower_bound((*leaf)->begin(), (*leaf)->end(), name,
                                     [](const auto& record, const std::string& key) { return record->first < key; });
    return {static_cast<std::size_t>(leaf - leaves_->begin()), static_cast<std::size_t>(at - (*leaf)->begin()),
            at != (*leaf)->end() && (*at)->first == name};
  }

  // A record that no other map has.
  T& own(std::size_t leaf, std::size_t at) {
    Leaves leaves = *leaves_;
    Leaf with = *leaves[leaf];
    with[at] = std::make_shared<value_type>(*with[at]);
    T& record = with[at]->second;
    leaves[leaf] = std::make_shared<const Leaf>(std::move(with));
    leaves_ = std::make_shared<const Leaves>(std::move(leaves));
    return record;
  }

  std::shared_ptr<const Leaves> leaves_;
  std::size_t size_ = 0;
};

}  // namespace bl
