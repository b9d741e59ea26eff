// The kinds of value that ports hold, and the one variant type that carries them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/hash.h"
#include "core/base/made.h"
#include "core/base/mesh.h"
#include "core/base/vector.h"
#include "core/define/payload.h"
#include "core/define/table_row.h"

namespace bl {

/// An immutable T that snapshots share; compares by content.
template <class T>
class Shared {
 public:
  Shared() : content_(empty()) {}
  Shared(T content) : content_(std::make_shared<const T>(std::move(content))) {}  // NOLINT: implicit on purpose
  const T& operator*() const { return *content_; }
  const T* operator->() const { return content_.get(); }
  bool operator==(const Shared& other) const { return content_ == other.content_ || *content_ == *other.content_; }

 private:
  static const std::shared_ptr<const T>& empty() {
    static const std::shared_ptr<const T> nothing = std::make_shared<const T>();
    return nothing;
  }
  std::shared_ptr<const T> content_;
};

/// A set of nodes: named ones, or all that carry a typification and/or a tag. It is always used in ascending node id.
struct Selection {
  std::vector<std::string> ids;
  std::string typification;
  std::string tag;
  bool operator==(const Selection&) const = default;
  bool is_empty() const { return ids.empty() && typification.empty() && tag.empty(); }
  bool is_query() const { return !typification.empty() || !tag.empty(); }
};

/// Rows under named columns; the columns are those that the port declares, in that order.
struct Table {
  std::vector<std::string> columns;
  std::vector<TableRow> rows;
  bool operator==(const Table&) const = default;

  /// Index of a column, or the number of columns where it is missing.
  std::size_t column(std::string_view name) const;
  /// The first row with that text in a column, or the number of rows where it is missing.
  std::size_t row_of(std::string_view column, std::string_view text) const;
  /// Nothing (0, an empty text) where row or column do not exist.
  double number(std::size_t row, std::string_view name) const;
  const std::string& text(std::size_t row, std::string_view name) const;
  const Numbers& numbers(std::size_t row, std::string_view name) const;
  const Indices& indices(std::size_t row, std::string_view name) const;

 private:
  template <class T>
  const T& field(std::size_t row, std::string_view name) const;
};

/// `port` is a text of the form `typification.port`; `json` one JSON value as it stood in a file; `made` an object for code;
/// `commands` what a batch holds.
enum class ValueKind {
  boolean,
  integer,
  number,
  text,
  choice,
  port,
  json,
  point,
  points,
  texts,
  selection,
  table,
  mesh,
  numbers,
  made,
  commands
};

/// Text, choice and port share std::string; the declared kind distinguishes them. Add new kinds at the end: the index of a kind
/// is part of the hash.
using Value =
    std::variant<bool, std::int64_t, double, std::string, Vector3, Shared<std::vector<Point3>>, Shared<std::vector<std::string>>,
                 Shared<Selection>, Shared<Table>, MeshPointer, Numbers, Made, JsonValue, CommandList>;

/// As variants compare. Nearly all ports hold one of the kinds named here, which cost no call: variants of so many kinds look up
/// a function for each comparison.
bool is_same_content(const Value& a, const Value& b);
inline bool operator==(const Value& a, const Value& b) {
  if (a.index() != b.index()) return false;
  if (const auto* number = std::get_if<double>(&a)) return *number == *std::get_if<double>(&b);
  if (const auto* text = std::get_if<std::string>(&a)) return *text == *std::get_if<std::string>(&b);
  if (const auto* flag = std::get_if<bool>(&a)) return *flag == *std::get_if<bool>(&b);
  if (const auto* integer = std::get_if<std::int64_t>(&a)) return *integer == *std::get_if<std::int64_t>(&b);
  if (const auto* point = std::get_if<Vector3>(&a)) return *point == *std::get_if<Vector3>(&b);
  return is_same_content(a, b);
}
/// Copies of all of them, for the same reason without a call for most.
std::vector<Value> copied(const std::vector<Value>& values);

std::string_view name_of(ValueKind kind);
/// Are values of this kind computed from others, so that no file holds them?
bool is_derived(ValueKind kind);
/// Can a link propose values of this kind?
bool is_proposable(ValueKind kind);
/// Are all numbers in it finite?
bool is_finite(const Value& value);
/// Normalises every stored value, whether read, set or computed: -0 becomes 0, because a file gives 0 back, while -0 divides and
/// prints differently. False where a number is not finite.
[[nodiscard]] bool make_storable(Value& value);
/// Adds a value to a hash. Meshes and made objects do not count, because they follow from the rest.
void add_to(Hash& hash, const Value& value);
/// The number in a number, integer or boolean; 0 for other kinds.
double as_number(const Value& value);

}  // namespace bl
