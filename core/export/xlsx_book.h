// A workbook of plain tables (Office Open XML): texts, numbers, and formulas that bring their values along.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace bl::exporting {

/// How a number is shown.
enum class XlsxStyle { plain, bold, two_decimals, percent };

struct XlsxCell {
  enum class Kind { empty, text, number } kind = Kind::empty;
  std::string text;     ///< of a text
  double number = 0;    ///< of a number, or the value of the formula
  std::string formula;  ///< without its `=`; none where empty
  XlsxStyle style = XlsxStyle::plain;

  XlsxCell() = default;
  static XlsxCell words(std::string text, XlsxStyle style = XlsxStyle::plain) {
    XlsxCell cell;
    cell.kind = Kind::text, cell.text = std::move(text), cell.style = style;
    return cell;
  }
  static XlsxCell value(double number, XlsxStyle style = XlsxStyle::two_decimals) {
    XlsxCell cell;
    cell.kind = Kind::number, cell.number = number, cell.style = style;
    return cell;
  }
  static XlsxCell sum(std::string formula, double number, XlsxStyle style = XlsxStyle::two_decimals) {
    XlsxCell cell = value(number, style);
    cell.formula = std::move(formula);
    return cell;
  }
};

struct XlsxSheet {
  std::string name;  ///< of letters, at most 31
  std::vector<double> widths;
  std::vector<std::vector<XlsxCell>> rows;  ///< the first one is the header, and stays in sight
};

/// The last bytes of each workbook: the comment of its archive.
inline constexpr const char* kXlsxEnd = "BehaviourLinks xlsx";
/// "A", "B", ..., "AA": of the column counted from 0.
std::string column_name(std::size_t column);
/// The bytes of the workbook. `title`, `about`: of its properties.
Result<std::string> xlsx_book(const std::vector<XlsxSheet>& sheets, const std::string& title, const std::string& about);

}  // namespace bl::exporting
