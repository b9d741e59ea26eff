// What every file says of itself: the scene, its state, units and place.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/export/proposal_model.h"

namespace bl::exporting {

/// Name and value: scene, file, hash, tick, settled, units, the form of volumes, coordinate system, origin, place on Earth, true
/// north.
std::vector<std::pair<std::string, std::string>> identity_of(const Proposal& proposal);
/// The same in one line, for headers.
std::string identity_line(const Proposal& proposal);
/// The place of the local origin in its coordinate system, as people read it; empty where the scene has none.
std::string place_text(const Proposal& proposal);

/// Of a place on Earth without a coordinate system that programs know by a number: how a scene gets one, as the end of a sentence
/// that names UTM; empty for a scene without a place.
std::string way_to_system(const Proposal& proposal);

/// Does the scene say where it lies on Earth?
bool is_placed(const Proposal& proposal);
/// The way from local metres to longitude and latitude.
class WayToEarth {
 public:
  /// A scene that knows latitude and longitude alone is placed by these and its true north. Fails where it knows neither.
  static Result<WayToEarth> make(const Proposal& proposal);
  /// Longitude and latitude [deg] in x and y.
  Point3 degrees(const Point3& local) const;

 private:
  explicit WayToEarth(importing::LocalFrame frame) : frame_(std::move(frame)) {}
  importing::LocalFrame frame_;
};

}  // namespace bl::exporting
