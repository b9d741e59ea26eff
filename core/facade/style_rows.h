// A style as rows of a table: which rule holds for a use and an orientation. Works with any table that hands out numbers and
// texts by row and column, so that the algorithms need not know the declarative layer.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/text.h"
#include "core/facade/dressing.h"

namespace bl::facade {

/// The rules of a use: for each orientation the first row that fits. Empty fields of `use` and `orientation` fit all. Without any
/// rows a plain façade; where rows exist and none fits, a closed wall, and a sentence about it is added to `message`.
template <class Table>
FacadeRules rules_of(const Table& table, const std::string& use, std::string& message) {
  struct Fit {
    std::size_t row = 0;
    const std::string* side = nullptr;
    std::optional<FacadeRule> rule;  // once it is asked for: a table finds its columns by their names
  };
  std::vector<Fit> fitting;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    if (const std::string& wanted = table.text(row, "use"); wanted.empty() || wanted == use)
      fitting.push_back({row, &table.text(row, "orientation"), {}});
  FacadeRules rules;
  std::string unmatched;
  for (std::size_t k = 0; k < kOrientations && !table.rows.empty(); ++k) {
    const std::string_view name = name_of(static_cast<Orientation>(k));
    const auto fit =
        std::find_if(fitting.begin(), fitting.end(), [&](const Fit& one) { return one.side->empty() || *one.side == name; });
    if (fit == fitting.end()) {
      rules[k].glazing = 0;
      unmatched += (unmatched.empty() ? "" : ", ") + std::string(name);
      continue;
    }
    const auto number = [&](const char* column) { return table.number(fit->row, column); };
    if (!fit->rule)
      fit->rule = FacadeRule{number("glazing"), number("module"),      number("sill"),
                             number("band"),    number("cost_glazed"), number("cost_opaque")};
    rules[k] = *fit->rule;
  }
  if (!unmatched.empty())
    message += (message.empty() ? "" : "; ") + std::string("no row of the style fits ") + unmatched + ": closed walls there";
  return rules;
}

/// An error at the first row whose orientation is none.
template <class Table>
Result<void> check_style_rows(const Table& table) {
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& side = table.text(row, "orientation");
    if (side.empty() || orientation_named(side)) continue;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < kOrientations; ++k) names.emplace_back(name_of(static_cast<Orientation>(k)));
    return Error{ErrorCode::out_of_range, "rows/" + std::to_string(row) + "/orientation",
                 "`" + side + "` is no orientation" + did_you_mean(side, names) +
                     "; it is north, north_east and so on around to north_west, or empty for all"};
  }
  return {};
}

}  // namespace bl::facade
