// A row of a table: a short list of fields that needs no block of memory of its own while it is short.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/heap_bytes.h"
#include "core/base/number_list.h"

namespace bl {

/// One field of a table: a number, a text, or a list.
using Scalar = std::variant<double, std::string, Numbers, Indices>;

/// The fields of one row, as a std::vector<Scalar> holds them. Solvers hand out hundreds of tables in a tick whose rows are a
/// name and a number: these two fit into the row itself.
class TableRow {
 public:
  TableRow() = default;
  TableRow(std::initializer_list<Scalar> fields) {
    if (fields.size() > kFew) many_ = fields;
    else
      for (const Scalar& field : fields) push_back(field);
  }

  std::size_t size() const { return many_.empty() ? few_count_ : many_.size(); }
  bool empty() const { return size() == 0; }
  const Scalar* begin() const { return many_.empty() ? few_.data() : many_.data(); }
  const Scalar* end() const { return begin() + size(); }
  Scalar* begin() { return many_.empty() ? few_.data() : many_.data(); }
  Scalar* end() { return begin() + size(); }
  const Scalar& operator[](std::size_t i) const { return begin()[i]; }
  Scalar& operator[](std::size_t i) { return begin()[i]; }

  void push_back(Scalar field) { emplace_back(std::move(field)); }
  template <class Field>
  Scalar& emplace_back(Field&& field) {
    if (many_.empty() && few_count_ < kFew) return few_[few_count_++] = std::forward<Field>(field);
    if (many_.empty()) {
      Scalar made(std::forward<Field>(field));  // it may be one of the fields that move
      many_.reserve(2 * kFew);
      std::move(few_.begin(), few_.end(), std::back_inserter(many_));
      few_ = {};
      return many_.emplace_back(std::move(made));
    }
    return many_.emplace_back(std::forward<Field>(field));
  }

  bool operator==(const TableRow& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }
  /// What the row takes outside of itself, besides what its fields do.
  std::size_t bytes() const { return heap_bytes(many_); }

 private:
  static constexpr std::size_t kFew = 2;

  std::array<Scalar, kFew> few_;
  std::vector<Scalar> many_;   // all fields, where they are more than a few; else empty
  std::size_t few_count_ = 0;  // of them in use, where `many_` is empty
};

}  // namespace bl
