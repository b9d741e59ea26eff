// Published tables of sun positions and sun events, where they lie beside the checkout.
#pragma once

#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/sun/sun_place.h"
#include "tests/support/reference_files.h"

namespace bl::sun {

using SunRow = std::map<std::string, std::string>;

/// The rows of a table by the names of its columns; empty, with a sentence, where the file is not there.
inline std::vector<SunRow> sun_table(const std::string& name) {
  const auto path = test::shared_file("data/solar/" + name);
  if (path.empty()) {
    std::printf("%s does not lie beside the checkout: what it says is not compared\n", name.c_str());
    return {};
  }
  std::ifstream file(path);
  std::string line;
  std::vector<std::string> header;
  std::vector<SunRow> rows;
  while (std::getline(file, line)) {
    std::stringstream fields(line);
    std::string field;
    std::vector<std::string> cells;
    while (std::getline(fields, field, ',')) cells.push_back(field);
    if (header.empty()) {
      header = cells;
      continue;
    }
    SunRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = i < cells.size() ? cells[i] : "";
  }
  EXPECT_FALSE(rows.empty()) << path;
  return rows;
}

inline double number_in(const SunRow& row, const std::string& column) { return parse_number(row.at(column)).value(); }

/// "07:21" or "07:21:55" as seconds after midnight.
inline double clock_in(const std::string& text) {
  return std::stod(text.substr(0, 2)) * 3600 + std::stod(text.substr(3, 2)) * 60 +
         (text.size() > 6 ? std::stod(text.substr(6)) : 0);
}

}  // namespace bl::sun
