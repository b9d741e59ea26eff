// The surroundings of the volumes, read from a state: ground, data, sun, plots, streets with their load, buildings.
#pragma once

#include <string>
#include <vector>

#include "core/base/mesh.h"
#include "core/geometry/mesh_lines.h"
#include "core/graph/state.h"

namespace bl::reading {

struct StreetLine {
  std::string name;
  std::vector<Point3> line;
  double lanes = 1, flow = 0, load = 0;  ///< flow both ways [1/h]; load as a share of what is open
  bool is_for_cars = true, is_open = true, has_traffic = false;
};

struct BuildingShape {
  std::string name, use;
  std::vector<std::vector<Point3>> rings;  ///< the outline and its courts
  double height = 0;                       ///< [m] above its underside
  bool is_assumed = false;
  MeshPointer mesh;
};

/// Hours of sun on one receiver: squares where it lies flat, a line where it stands upright.
struct SunField {
  std::string name;
  std::vector<std::pair<Point3, double>> points;  ///< sun per day [s]
  Vector3 half_across, half_up;                   ///< of one square
  bool is_upright = false;
  double mean = 0, possible = 0;       ///< per day [s]
  double required = 0, share_met = 0;  ///< [s], and the share of the area that has it
};

struct DataField {
  std::string name, unit;
  double low = 0, high = 0;
  std::vector<std::pair<Point3, double>> points;
};

struct Surroundings {
  std::vector<StreetLine> streets;
  std::vector<BuildingShape> buildings;
  std::vector<SunField> sun;
  std::vector<DataField> data;
  std::vector<std::pair<std::string, std::vector<Point3>>> plots;
  std::vector<MeshPointer> grounds;
  double most_sun = 0;  ///< [s] the most that any point has or could have

  bool is_empty() const {
    return streets.empty() && buildings.empty() && sun.empty() && data.empty() && plots.empty() && grounds.empty();
  }
};

Surroundings read_surroundings(const State& state);

/// The lowest and the highest corner, in plan, of a frame around `core` that contains the near surroundings: up to `around` times
/// the larger side of the core. Far streets are cut at its edge. The core itself where there are no surroundings.
std::vector<Point3> framed(const std::vector<Point3>& core, const Surroundings& surroundings, double around = 0.6);

}  // namespace bl::reading
