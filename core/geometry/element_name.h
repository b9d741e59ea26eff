// The lasting name of an element of the cell complex: the sorted set of the sites and boundary sides that meet in it.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace bl::geometry {

/// A site, by the number that its owner gave it, or a boundary side `#k`. Sites come before sides.
struct ElementLabel {
  std::uint64_t code = 0;

  static constexpr ElementLabel site(std::uint32_t number) { return {number}; }
  static constexpr ElementLabel side(std::uint32_t number) { return {(std::uint64_t{1} << 32) | number}; }
  constexpr bool is_side() const { return (code >> 32) != 0; }
  constexpr std::uint32_t number() const { return static_cast<std::uint32_t>(code); }
  constexpr auto operator<=>(const ElementLabel&) const = default;
};

/// Written `{3,7,#2}`: two labels name a facet, three (or more, where cells meet as in a lattice) an edge, four or more a vertex.
/// Which of them is meant is not in the name but beside it (ElementKind). Ordered by the first label that differs, a beginning
/// before its continuation.
class ElementName {
 public:
  ElementName() = default;
  /// In any order, with repeats.
  explicit ElementName(std::span<const ElementLabel> labels);
  ElementName(std::initializer_list<ElementLabel> labels);
  /// What text() wrote; spaces and any order are fine, a label twice is not.
  static Result<ElementName> parse(std::string_view text);

  std::size_t size() const { return size_; }
  ElementLabel operator[](std::size_t i) const { return i < kInside ? first_[i] : rest_[i - kInside]; }
  bool contains(ElementLabel label) const;
  /// The numbers of the sites among the labels, ascending.
  std::vector<std::uint32_t> sites() const;
  std::string text() const;

  bool operator==(const ElementName& other) const {
    return size_ == other.size_ && first_ == other.first_ && rest_ == other.rest_;
  }
  std::strong_ordering operator<=>(const ElementName& other) const {
    // The places behind a short name hold zeros, and so may a label: then the size decides.
    for (std::size_t i = 0; i < kInside; ++i) {
      if (first_[i].code == other.first_[i].code) continue;
      if (i >= size_ || i >= other.size_) break;
      return first_[i].code <=> other.first_[i].code;
    }
    return size_ <= kInside || other.size_ <= kInside ? size_ <=> other.size_ : compare_rest(other);
  }

 private:
  // Four labels are what general position asks for; more only where cells are lined up.
  static constexpr std::size_t kInside = 4;
  void assign(std::vector<ElementLabel>& labels);
  std::strong_ordering compare_rest(const ElementName& other) const;
  std::uint32_t size_ = 0;
  std::array<ElementLabel, kInside> first_{};
  std::vector<ElementLabel> rest_;
};

}  // namespace bl::geometry
