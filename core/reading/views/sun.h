// The sun over a place, who casts shadows, and where sun falls.
#pragma once

#include "core/reading/view.h"

namespace bl::reading {

/// The place, its clock, and the moment that is looked at.
struct SunFigures {
  double latitude = 0;    ///< [degrees]
  double longitude = 0;   ///< [degrees]
  double elevation = 0;   ///< [m]
  double true_north = 0;  ///< [degrees]
  double utc_offset = 0;  ///< [s]
  std::string daylight_saving;
  std::string date;
  double days = 0;
  double time = 0;  ///< after midnight [s]
  bool refraction = false;
  double pressure = 0;  ///< [Pa]
  double temperature = 0;
  double delta_t = 0;  ///< [s]
  Vector3 direction;   ///< unit vector to the sun, of the last tick

  static void declare(ViewBuilder<SunFigures>& v);
  static const ViewDefinition& view();
};

/// A study of the sun on receivers.
struct SunStudyFigures {
  double ground = 0;  ///< where shadows fall [m]

  static void declare(ViewBuilder<SunStudyFigures>& v);
  static const ViewDefinition& view();
};

/// Who takes sun from others.
struct CasterFigures {
  bool casts = false;
  std::vector<Point3> outline;  ///< of its shadow on the ground [m]

  static void declare(ViewBuilder<CasterFigures>& v);
  static const ViewDefinition& view();
};

/// Sun on a rectangle, measured on a grid of points.
struct ReceiverFigures {
  bool upright = false;
  Vector3 half_across;        ///< [m]
  Vector3 half_up;            ///< [m]
  double sun_mean = 0;        ///< per day [s]
  double sun_possible = 0;    ///< per day without casters [s]
  double required_sun = 0;    ///< per day [s]
  double required_share = 1;  ///< of its area that should get as much
  double share_met = 0;       ///< of its area that gets what it requires
  std::int64_t columns = 0;   ///< of the grid
  Shared<Table> map;          ///< sun at each of its points

  static void declare(ViewBuilder<ReceiverFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
