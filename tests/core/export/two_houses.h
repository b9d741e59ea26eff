// A small proposal to export, and the files that a format makes of it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/export/format.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "tests/support/world.h"

namespace bl::exporting {

// Two volumes, one of them shaped by its neighbour, on a place in Delft.
inline World settled_world() {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1,
    "settings": {"title": "Two houses", "coordinate_system": "EPSG:28992", "origin_x": 85000, "origin_y": 446000,
                 "latitude": 51.99, "longitude": 4.37},
    "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-30, -20, 0], [30, -20, 0], [30, 20, 0], [-30, 20, 0]], "height": 30}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}},
      {"id": "east", "position": [9, 0, 8], "types": {"smart_volume": {"demand": 3000, "use": "housing"}}},
      {"id": "west", "position": [-6, 0, 8], "types": {"smart_volume": {"demand": 2000, "use": "shops"}}}]})");
  EXPECT_TRUE(world.settle());
  return world;
}

inline Proposal proposal_of(const World& world) {
  auto proposal = read_proposal(world.state(), "two.json");
  EXPECT_TRUE(proposal) << proposal.error().text();
  return std::move(*proposal);
}

// As the page's build leaves it, without its script.
inline constexpr const char* kShell =
    "<!doctype html>\n<!-- BehaviourLinks proposal -->\n<meta name=\"data-version\" content=\"2\">\n<title>PAGE_TITLE</title>\n"
    "<script id=\"data\" type=\"application/json\">PAGE_DATA</script>\n";

/// All files of a format with these options.
inline ExportFiles files_of(const Proposal& proposal, const char* id, const std::vector<std::string>& options = {},
                            bool is_folder = false) {
  const FormatDefinition* format = find_format(id);
  EXPECT_NE(format, nullptr) << id;
  const auto values = option_values(*format, options);
  EXPECT_TRUE(values) << id << ": " << values.error().text();
  auto files = format->write(proposal, *values, is_folder);
  EXPECT_TRUE(files) << id << ": " << files.error().text();
  return files ? std::move(*files) : ExportFiles{{{}}, {}};
}
/// The content of the only one.
inline std::string file_of(const Proposal& proposal, const char* id, const std::vector<std::string>& options = {}) {
  return files_of(proposal, id, options).files.front().content;
}

}  // namespace bl::exporting
