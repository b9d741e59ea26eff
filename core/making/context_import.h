// Imports files of surroundings into a scene, for the command line and the window.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene.h"
#include "core/import/context.h"
#include "core/making/site_buildings.h"
#include "core/making/site_grounds.h"

namespace bl::making {

/// What people can say that a file holds, where it does not say so itself.
struct ImportKind {
  const char* id;
  const char* label;    ///< as people read it
  bool is_of_features;  ///< of single polygons and lines, not of the whole file
};
inline constexpr std::array kImportKinds = {
    ImportKind{"building", "buildings", true}, ImportKind{"street", "streets", true},
    ImportKind{"plot", "plots", true},         ImportKind{"area", "areas of ground", true},
    ImportKind{"terrain", "a terrain", false}, ImportKind{"layer", "a layer of data", false}};
/// Of such files, as a list within a sentence.
inline constexpr std::string_view kContextFormats = "OSM, CityJSON, GeoJSON, ASCII grid, GeoTIFF and CSV";

struct ImportOptions {
  std::vector<std::string> files;
  std::string into, out, report;
  std::string kind;    ///< id of an ImportKind; empty: what the file says
  std::string origin;  ///< "X,Y"; empty: the middle of the first file
  std::vector<std::string> properties;
  std::string value, unit, source, licence;
  importing::ContextOptions context;
  InsideChoice inside = InsideChoice::unsaid;  ///< of buildings that stand inside a site of the scene
  AskToClear ask_to_clear;                     ///< who is asked where that is unsaid; empty: they are kept, and a note says so
  std::vector<std::string> keep_clear;         ///< of `kClearGrounds`: what sites leave out
  double least_green = kLeastGreen;            ///< [m²] of an area of green that is kept clear
  bool keeps = false, clears = false;          ///< as the command line has it; `inside` is what counts
  bool is_forced = false, is_extruded = false, takes_all_streets = false;
};

/// What came of it. Without a scene there are errors, each with the file that it is in.
struct ImportedScene {
  std::optional<Scene> scene;
  Command command;  ///< leads from the scene that was added to to that one, as one step; without an id where both are the same
  std::pair<Point3, Point3> bounds;          ///< around all that was added [m]; the first is above the second where nothing was
  importing::ImportReports reports;          ///< of a file that could not be read: one row that says so
  std::map<std::string, std::size_t> nodes;  ///< how many were made, by typification
  std::vector<std::string> notes, warnings;  ///< warnings: what was asked for and did not come of it
  std::vector<std::pair<std::string, Error>> errors;
};

/// `scene`: the one that is added to.
ImportedScene import_context(const Scene& scene, const ImportOptions& options, const Registry& registry);

/// Does the file, by its name and how it begins, hold surroundings that can be imported? A scene does not.
bool is_context_file(const std::string& path);
/// Endings of such files, for lists of files; `.json` is a scene as well.
const std::vector<std::string>& context_endings();

}  // namespace bl::making
