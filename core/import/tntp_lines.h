// Splits a TNTP text into metadata and rows of fields, with the number of each line.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace bl::importing {

struct TntpLine {
  int number = 0;
  std::vector<std::string_view> fields;  ///< without separators: blanks, tabs, commas, `:` and `;`
  std::string_view text;                 ///< the whole line without its comment
};

/// Metadata by upper-case name; lines that hold data; names of columns where a comment line or the first row gives some.
struct TntpText {
  bool is_cut_off = false;  ///< every row but the last one ends with `;`: that one was longer once
  std::map<std::string, std::string> metadata;
  std::vector<TntpLine> lines;
  std::vector<std::string> columns;  ///< lower case, without blanks and underscores
};

Result<TntpText> split_tntp(std::string_view text);

/// The number in a metadata entry; `missing` where there is none, an error where it is no number.
Result<double> tntp_metadata_number(const TntpText& text, const std::string& name, double missing);
std::string tntp_line_place(int number);

}  // namespace bl::importing
