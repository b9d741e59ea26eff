// A plot, its rules, and what is built on it.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// What is built, and what is allowed at most.
struct PlotFigures {
  std::vector<Point3> polygon;  ///< [m]
  double ground = 0;            ///< height above the origin [m]
  double fsi_max = 0;
  double gsi_max = 0;
  double height_max = 0;         ///< [m]
  double fsi = 0;                ///< floor space index
  double gsi = 0;                ///< ground space index
  double osr = 0;                ///< open space ratio
  double storeys = 0;            ///< floor area over built ground
  double top = 0;                ///< of the highest volume above the ground [m]
  double overshoot = 0;          ///< by how much the worst of the rules is broken
  double setback = 0;            ///< [m]
  double setback_overshoot = 0;  ///< the largest depth of a volume in it [m]
  std::string message;           ///< what no smaller demand corrects

  static void declare(ViewBuilder<PlotFigures>& v);
  static const ViewDefinition& view();
};

/// What the rules of a plot read of a volume.
struct PlotVolume {
  Point3 position;           ///< [m]
  Point3 centroid;           ///< [m]
  double volume = 0;         ///< [m³]
  double floor_area = 0;     ///< [m²]
  double footprint = 0;      ///< [m²]
  double bottom = 0;         ///< height of its lowest point above the origin [m]
  double height = 0;         ///< from its lowest to its highest point [m]
  double storey_height = 0;  ///< [m]
  std::string stands_on;     ///< what carries it

  static void declare(ViewBuilder<PlotVolume>& v);
  static const ViewDefinition& view();
};

/// And of one that stands.
struct PlotStanding {
  Table plates;       ///< see core/geometry/plates_table.h
  Point3 stands_at;   ///< [m]
  double ground = 0;  ///< where it stands [m]

  static void declare(ViewBuilder<PlotStanding>& v);
  static const ViewDefinition& view();
};

/// Which of its rules a link holds.
struct PlotRuleParameters {
  bool hold_fsi = false;
  bool hold_gsi = false;
  bool hold_height = false;
  bool hold_setback = false;

  static void declare(ViewBuilder<PlotRuleParameters>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
