// Files of real places beside the checkout, and sums over what was read from them.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "core/import/context.h"
#include "tests/support/reference_files.h"

namespace bl::test {

/// The bytes of a file of the shared data; empty, with a sentence printed, where it is not there.
inline std::string shared_bytes(const std::string& name) {
  const std::filesystem::path path = shared_file("data/" + name);
  if (path.empty()) {
    std::printf("the shared data are not beside this checkout: %s is not read here\n", name.c_str());
    return {};
  }
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Options with nothing but a CRS.
inline importing::ContextOptions in_crs(const std::string& crs) {
  importing::ContextOptions options;
  options.crs = crs;
  return options;
}

/// Rows of a kind whose reason begins so.
inline std::size_t rows_of(const importing::ImportReport& report, std::string_view kind, std::string_view beginning) {
  std::size_t count = 0;
  for (const importing::ImportRow& row : report.rows())
    if (row.kind == kind && row.reason.starts_with(beginning)) count += row.count;
  return count;
}

inline std::string reason_of(const importing::ImportReport& report, std::string_view id) {
  for (const importing::ImportRow& row : report.rows())
    if (row.id == id) return std::string(name_of(row.outcome)) + ": " + row.reason;
  return "no row";
}

inline double area_of(const importing::ContextBuilding& building) {
  double area = geometry::signed_area(building.outer);
  for (const geometry::Ring& hole : building.holes) area += geometry::signed_area(hole);
  return area;
}

}  // namespace bl::test
