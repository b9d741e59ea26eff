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
  double height_max = 0;  ///< [m]
  double fsi = 0;         ///< floor space index
  double gsi = 0;         ///< ground space index
  double overshoot = 0;   ///< by how much the worst rule is broken

  static void declare(ViewBuilder<PlotFigures>& v);
  static const ViewDefinition& view();
};

/// Which of its rules a link holds.
struct PlotRuleParameters {
  bool hold_fsi = false;
  bool hold_gsi = false;
  bool hold_height = false;

  static void declare(ViewBuilder<PlotRuleParameters>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
