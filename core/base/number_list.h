// Contiguous numbers that are shared and never change. What a hash takes of them is worked out once.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/long_text.h"

namespace bl {

/// An immutable list; compares by content. T is double or std::uint32_t. Zeros have no sign; indices are below 2^24.
/// Files once held such lists as digits of base 64 (RFC 4648), the lowest six bits first: eleven digits for the 64 bits of a
/// number, four for an index. A list is hashed as these digits, so that the hashes of older logs and scenes still hold.
template <class T>
class NumberList {
 public:
  NumberList();
  NumberList(std::vector<T> numbers);  // NOLINT: implicit on purpose

  const std::vector<T>& operator*() const { return content_->numbers; }
  const std::vector<T>* operator->() const { return &content_->numbers; }
  bool operator==(const NumberList& other) const;
  /// Are all of them finite?
  bool is_finite() const { return content_->is_finite; }
  void add_to(Hash& hash) const;

 private:
  struct Content {
    std::vector<T> numbers;
    bool is_finite = true;
    TextLanes lanes;  // of long lists only
  };
  std::shared_ptr<const Content> content_;
};

using Numbers = NumberList<double>;
using Indices = NumberList<std::uint32_t>;

/// No index of a list is larger.
inline constexpr std::uint32_t kLargestIndex = (1u << 24) - 1;

/// The list as digits.
std::string digits_of(std::span<const double> numbers);
std::string digits_of(std::span<const std::uint32_t> indices);
/// The list that digits stand for; nothing where the text is no such digits.
std::optional<std::vector<double>> numbers_of_digits(std::string_view text);
std::optional<std::vector<std::uint32_t>> indices_of_digits(std::string_view text);

}  // namespace bl
