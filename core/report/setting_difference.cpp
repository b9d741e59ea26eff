// Rows are found again by the name that their table gives them, where no two have one; else by their place, from both ends.
#include "core/report/setting_difference.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/plural.h"
#include "core/define/codec.h"
#include "core/define/json_text.h"
#include "core/define/list_json.h"

namespace bl::report {

namespace {

constexpr std::size_t kMostTold = 3;  // rows of one table, entries of one list
constexpr std::size_t kMostLetters = 60;
constexpr std::size_t kLettersBefore = 16;  // of what is the same in both, where that is left out

bool is_inside_letter(const std::string& text, std::size_t at) {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

std::string shortened(const std::string& text) {
  if (text.size() <= kMostLetters) return text;
  std::size_t end = kMostLetters;
  while (end > 0 && is_inside_letter(text, end)) --end;
  return text.substr(0, end) + " ...";
}

std::string from_place(const std::string& text, std::size_t place) {
  const std::string quote = text.front() == '"' ? "\"" : "";
  return quote + "... " + shortened(text.substr(place));
}

// Which rows of both are the same row, by index; who has no partner is in one of both only.
struct RowPair {
  std::optional<std::size_t> before, after;
};

// By place: what both begin and end with is the same, and what lies between is told in order.
template <class Same>
std::vector<RowPair> pairs_by_place(std::size_t before, std::size_t after, const Same& is_same) {
  const std::size_t both = std::min(before, after);
  std::size_t head = 0, tail = 0;
  while (head < both && is_same(head, head)) ++head;
  while (tail < both - head && is_same(before - 1 - tail, after - 1 - tail)) ++tail;
  std::vector<RowPair> pairs;
  for (std::size_t k = head; k < std::max(before, after) - tail; ++k)
    pairs.push_back({k < before - tail ? std::optional(k) : std::nullopt, k < after - tail ? std::optional(k) : std::nullopt});
  return pairs;
}

// The column that names a row: its key, else its first text. The number of columns where there is none.
std::size_t naming_column(const PortDefinition& port) {
  const auto& columns = port.columns;
  auto found = std::find_if(columns.begin(), columns.end(), [](const ColumnDefinition& c) { return c.is_key; });
  if (found == columns.end())
    found = std::find_if(columns.begin(), columns.end(), [](const ColumnDefinition& c) { return c.is_text; });
  return static_cast<std::size_t>(found - columns.begin());
}

class Rows {
 public:
  Rows(const Table& before, const Table& after, const PortDefinition& port)
      : before_(before), after_(after), port_(port), naming_(naming_column(port)) {}

  std::string told() const {
    const auto by_name = pairs_by_name();
    const auto is_same = [&](std::size_t a, std::size_t b) { return columns_told(a, b).empty(); };
    std::vector<std::pair<std::string, std::size_t>> told;  // with the number of rows of which it tells
    const auto pairs = by_name ? *by_name : pairs_by_place(before_.rows.size(), after_.rows.size(), is_same);
    for (std::size_t k = 0; k < pairs.size();) {
      const auto& [a, b] = pairs[k];
      if (a && b) {
        if (const std::string columns = columns_told(*a, *b); !columns.empty())
          told.emplace_back("row " + std::to_string(*a + 1) + named(before_, *a) +
                                (*a == *b ? "" : ", now row " + std::to_string(*b + 1)) + ": " + columns,
                            1);
        ++k;
        continue;
      }
      const std::size_t count = alike_from(pairs, k), first = (a ? *a : *b) + 1;
      told.emplace_back((count == 1 ? "row " + std::to_string(first)
                                    : "rows " + std::to_string(first) + " to " + std::to_string(first + count - 1)) +
                            named(a ? before_ : after_, first - 1) + (a ? " in the first only" : " in the second only"),
                        count);
      k += count;
    }
    if (told.empty()) return before_.rows == after_.rows ? "" : "the same rows in another order";
    std::string text;
    std::size_t more = 0;
    for (std::size_t k = 0; k < told.size(); ++k)
      if (k < kMostTold) text += (k == 0 ? "" : "; ") + told[k].first;
      else more += told[k].second;
    return more == 0 ? text : text + "; and " + how_many(more, "more row");
  }

 private:
  std::string name_in(const Table& table, std::size_t row) const {
    const TableRow& fields = table.rows[row];
    if (naming_ >= fields.size()) return "";
    const auto* name = std::get_if<std::string>(&fields[naming_]);
    return name == nullptr ? "" : *name;
  }
  std::string named(const Table& table, std::size_t row) const {
    const std::string name = name_in(table, row);
    return name.empty() ? "" : " `" + shortened(name) + "`";
  }

  // The rows of a table by their names; nothing where a row has none, or two have one.
  std::optional<std::map<std::string, std::size_t>> rows_by_name(const Table& table) const {
    std::map<std::string, std::size_t> rows;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      if (const std::string name = name_in(table, row); name.empty() || !rows.emplace(name, row).second) return std::nullopt;
    return rows;
  }

  // In the order of the first, then those of the second only in theirs.
  std::optional<std::vector<RowPair>> pairs_by_name() const {
    const auto first = rows_by_name(before_), second = rows_by_name(after_);
    if (!first || !second) return std::nullopt;
    std::vector<RowPair> pairs;
    for (std::size_t row = 0; row < before_.rows.size(); ++row) {
      const auto other = second->find(name_in(before_, row));
      pairs.push_back({row, other == second->end() ? std::nullopt : std::optional(other->second)});
    }
    for (std::size_t row = 0; row < after_.rows.size(); ++row)
      if (!first->contains(name_in(after_, row))) pairs.push_back({std::nullopt, row});
    return pairs;
  }

  // How many rows of one name, one after the other, are in the same one only.
  std::size_t alike_from(const std::vector<RowPair>& pairs, std::size_t begin) const {
    const auto row_of = [](const RowPair& pair) { return pair.before ? *pair.before : *pair.after; };
    const Table& table = pairs[begin].before ? before_ : after_;
    const std::size_t first = row_of(pairs[begin]);
    std::size_t count = 1;
    for (; begin + count < pairs.size(); ++count) {
      const RowPair& next = pairs[begin + count];
      if (next.before.has_value() != pairs[begin].before.has_value() || (next.before && next.after) ||
          row_of(next) != first + count || name_in(table, first + count) != name_in(table, first))
        break;
    }
    return count;
  }

  const Scalar& field(const Table& table, std::size_t row, std::size_t column) const {
    const TableRow& fields = table.rows[row];
    return column < fields.size() ? fields[column] : port_.columns[column].default_value;
  }

  // "floor_area 300 -> 350, count 1 -> 2".
  std::string columns_told(std::size_t a, std::size_t b) const {
    std::string text;
    for (std::size_t column = 0; column < port_.columns.size(); ++column) {
      const Scalar &first = field(before_, a, column), &second = field(after_, b, column);
      if (first == second) continue;
      text += (text.empty() ? "" : ", ") + port_.columns[column].id + " " +
              text_difference(write_json_line(field_to_json(first)), write_json_line(field_to_json(second)));
    }
    return text;
  }

  const Table &before_, &after_;
  const PortDefinition& port_;
  std::size_t naming_;
};

std::string entries_told(const Json& before, const Json& after) {
  const auto pairs =
      pairs_by_place(before.size(), after.size(), [&](std::size_t a, std::size_t b) { return before[a] == after[b]; });
  std::string text;
  std::size_t told = 0, more = 0;
  for (const auto& [a, b] : pairs) {
    if (a && b && before[*a] == after[*b]) continue;
    if (told == kMostTold) {
      ++more;
      continue;
    }
    text += (told++ == 0 ? "entry " : "; entry ") + std::to_string((a ? *a : *b) + 1) + ": ";
    if (a && b) text += text_difference(write_json_line(before[*a]), write_json_line(after[*b]));
    else text += shortened(write_json_line(a ? before[*a] : after[*b])) + (a ? " in the first only" : " in the second only");
  }
  return more == 0 ? text : text + "; and " + std::to_string(more) + " more";
}

}  // namespace

std::string text_difference(const std::string& before, const std::string& after) {
  if (before == after) return "";
  const std::string first = shortened(before), second = shortened(after);
  if (first != second) return first + " -> " + second;
  const std::size_t common =
      static_cast<std::size_t>(std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first - before.begin());
  std::size_t place = common - std::min(common, kLettersBefore);
  while (place > 0 && is_inside_letter(before, place)) --place;
  return from_place(before, place) + " -> " + from_place(after, place);
}

std::string setting_difference(const Value& before, const Value& after, const PortDefinition& port) {
  if (before == after) return "";
  const auto *first = std::get_if<Shared<Table>>(&before), *second = std::get_if<Shared<Table>>(&after);
  if (first != nullptr && second != nullptr) return Rows(**first, **second, port).told();
  const Json a = value_to_json(before, port), b = value_to_json(after, port);
  const bool is_list = port.kind == ValueKind::points || port.kind == ValueKind::texts || port.kind == ValueKind::numbers;
  const std::string one = write_json_line(a), other = write_json_line(b);
  // Short lists are read at a glance.
  const bool is_long = one.size() > kMostLetters || other.size() > kMostLetters;
  return is_list && is_long && a.is_array() && b.is_array() ? entries_told(a, b) : text_difference(one, other);
}

}  // namespace bl::report
