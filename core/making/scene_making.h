// Makes a scene from files of a boundary and a programme, for the command line and the window.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/making/new_scene.h"

namespace bl::making {

/// What the volumes of a new scene can be; the first is the default.
struct VolumeForm {
  const char* id;
  const char* words;
};
inline constexpr VolumeForm kVolumeForms[] = {{"standing", "whole storeys on footprints"}, {"rounded", "cells cut to balls"}};

struct NewOptions {
  std::string boundary, programme, out, feature, crs, title;
  std::string form = kVolumeForms[0].id;  ///< of the volumes
  double height = 0;                      ///< [m]
  double storey_height = 3.2;             ///< [m]
  double margin = 1;                      ///< [m]
  std::uint64_t seed = 1;
  bool use_hull = false, is_forced = false;
  std::vector<std::string> columns;
};

/// The result. Without a scene there are errors; all errors of the input are reported together.
struct MadeScene {
  std::optional<Scene> scene;
  std::optional<importing::PlanBoundary> plan;
  SceneParts parts;
  double plan_area = 0;   ///< [m²] of the plan that was taken
  double demand = 0;      ///< [m³] of all volumes
  double footprints = 0;  ///< [m²] of all buildings on the ground, by their storeys; 0 where they do not stand
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, Error>> warnings;  ///< each with the file that it is in
  std::vector<std::pair<std::string, Error>> errors;    ///< each with the file that it is in; empty: in the options

  /// Demanded volume as a share of the boundary's.
  double fill() const { return demand / (ground() * parts.height); }
  double ground() const { return plan_area - parts.open_area(); }  ///< that can be built on [m²]
};
MadeScene make_scene(const NewOptions& options, const Registry& registry);

}  // namespace bl::making
