// Where reference values are: our own in tests/data, and larger ones beside the checkout.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/place/source_folder.h"

namespace bl::test {

/// Reference files beside the checkout; empty where they are not there.
inline std::filesystem::path shared_file(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(test::source_folder()) / ".." / "shared" / name;
  return std::filesystem::exists(path) ? path : std::filesystem::path{};
}

/// Files of reference values, "cells" or "fits": our own, which is always there, and a larger one where the shared folder is.
inline std::vector<std::filesystem::path> reference_files(const std::string& name) {
  std::vector<std::filesystem::path> files{std::filesystem::path(test::source_folder()) / "tests/data" /
                                           ("reference_" + name + ".json")};
  if (const auto shared = shared_file("oracle/" + name + ".json"); !shared.empty()) files.push_back(shared);
  return files;
}

/// Texts of a file of tests/data, which is always there, and of one of the shared folder where that is.
inline std::vector<std::string> texts_of(const std::string& own, const std::string& shared) {
  std::vector<std::string> texts;
  for (const std::filesystem::path& path :
       {std::filesystem::path(test::source_folder()) / "tests/data" / own, shared_file(shared)}) {
    if (path.empty()) continue;
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << path;
    texts.push_back(text.str());
  }
  return texts;
}

}  // namespace bl::test
