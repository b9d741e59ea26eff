// The figures of a SmartVolume: what is asked of it, and what a solver has made of it.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// Declared once for reports, windows, exporters and whoever else speaks of volumes.
struct VolumeFigures {
  Point3 position;     ///< [m]
  double tension = 0;  ///< how far proposals on its place disagree [m]
  std::string use;
  std::string standing;       ///< what it may stand on
  double demand = 0;          ///< [m³]
  double demand_limit = 0;    ///< [m³]
  double demand_min = 0;      ///< [m³]
  double storey_height = 0;   ///< [m]
  double wanted = 0;          ///< what its solver aims at [m³]
  double weight = 0;          ///< [m²]
  double radius = 0;          ///< of the ball that its cell is wrapped onto [m]
  double volume = 0;          ///< [m³]
  double cell_volume = 0;     ///< before it is wrapped [m³]
  double floor_area = 0;      ///< [m²]
  double surface_area = 0;    ///< [m²]
  double footprint = 0;       ///< [m²]
  double spherical_area = 0;  ///< [m²]
  double height = 0;          ///< from its lowest to its highest point [m]
  double bottom = 0;          ///< height of its lowest point above the origin [m]
  double error = 0;           ///< share of what its solver aims at
  MeshPointer mesh;
  std::string state;         ///< `alive`, or what became of it
  std::string reason;        ///< why it is not alive
  Shared<Table> neighbours;  ///< with whom it shares a face
  std::string stands_on;     ///< what carries it; empty where nothing does
  double hang = 0;           ///< how far above that its lowest point is [m]

  bool operator==(const VolumeFigures&) const = default;
  static void declare(ViewBuilder<VolumeFigures>& v);
  static const ViewDefinition& view();
};

/// How a volume stands, where it has that role.
struct FootprintFigures {
  std::string form;
  double angle = 0;   ///< of a block's first side, counter-clockwise from east [degree]
  double aspect = 0;  ///< of a block: first side / second side
  std::int64_t storeys = 0, storeys_built = 0;
  Table plates;  ///< see core/geometry/plates_table.h

  static void declare(ViewBuilder<FootprintFigures>& v);
  static const ViewDefinition& view();
};

/// The storeys of a volume that stands, for readers of nothing else.
struct StoreyFigures {
  std::int64_t storeys = 0, storeys_built = 0;  ///< wished; and there
  double height_limit = 0;                      ///< [m] above the ground
  bool is_limited = false;                      ///< it takes storeys that are wished
  std::vector<std::string> bases;               ///< id of the volume on whose roof it stands; none: the ground
  double ground = 0;                            ///< height of the ground below it [m]

  static void declare(ViewBuilder<StoreyFigures>& v);
  static const ViewDefinition& view();
};

/// Where a volume is and how it stands, for readers of nothing else.
struct VolumePlace {
  Point3 position;    ///< [m]
  double wanted = 0;  ///< what its solver aims at [m³]
  double hang = 0;    ///< how far above what carries it its lowest point is [m]
  double bottom = 0;  ///< height of its lowest point above the origin [m]

  static void declare(ViewBuilder<VolumePlace>& v);
  static const ViewDefinition& view();
};

/// How a link lets volumes down.
struct StandParameters {
  double stiffness = 0;  ///< share of the way down that is made in one tick

  static void declare(ViewBuilder<StandParameters>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
