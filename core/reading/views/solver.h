// What a SmartVolumes solver divides, and how far it has come.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// Sums of its members, and what it says.
struct SolverFigures {
  std::int64_t tessellation_depth = 0;
  double total_demand = 0;     ///< [m³]
  double total_volume = 0;     ///< [m³]
  double boundary_volume = 0;  ///< [m³]
  double fill = 0;             ///< share of the boundary that the members take
  std::string message;         ///< what cannot be had

  static void declare(ViewBuilder<SolverFigures>& v);
  static const ViewDefinition& view();
};

/// What a solver of standing volumes has made of the ground.
struct StandingFigures {
  double plot_area = 0;                                ///< [m²]
  double open_area = 0;                                ///< the part of it that is kept open [m²]
  double fsi = 0, gsi = 0, osr = 0, mean_storeys = 0;  ///< as the solver documents them
  std::string message;                                 ///< what cannot be had

  static void declare(ViewBuilder<StandingFigures>& v);
  static const ViewDefinition& view();
};

/// What people have said of the space that volumes may take.
struct BoundarySettings {
  std::string form;              ///< which of the following counts
  std::vector<Point3> plan;      ///< of the form `plan` [m]
  double bottom = 0;             ///< of a plan [m]
  double height = 0;             ///< of a plan [m]
  std::vector<Point3> points;    ///< of the form `hull` [m]
  std::vector<Point3> vertices;  ///< of the form `mesh` [m]

  static void declare(ViewBuilder<BoundarySettings>& v);
  static const ViewDefinition& view();
};

/// The space that volumes may take.
struct BoundaryFigures {
  double volume = 0;       ///< [m³]
  double ground_area = 0;  ///< [m²]
  double open_area = 0;    ///< kept open beside it [m²]
  MeshPointer shape;
  Shared<Table> planes;

  static void declare(ViewBuilder<BoundaryFigures>& v);
  static const ViewDefinition& view();
};

/// The ground that a boundary keeps open, by use.
struct OpenGround {
  Shared<Table> areas;       ///< with the columns `use`, `area` and `drawn` [m²]
  Shared<Table> exclusions;  ///< its polygons are those with a use
  std::string form;
  double bottom = 0, height = 0;  ///< of a plan [m]

  static void declare(ViewBuilder<OpenGround>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
