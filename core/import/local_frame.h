// The local metric frame of a site: metres, x east, y north, near the origin, and the place of that origin on Earth.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::importing {

/// The name for coordinates in metres without a place on Earth, such as those of a drawn model.
inline constexpr const char* kLocalCrs = "local";

/// Where a local frame lies. A local point (x, y) is (origin_x + x, origin_y + y) in `crs`.
struct GeoReference {
  std::string crs;                     ///< "EPSG:28992", a PROJ text of the projection made for the site, or kLocalCrs
  double origin_x = 0, origin_y = 0;   ///< the local origin in `crs` [m]
  double latitude = 0, longitude = 0;  ///< of the local origin, WGS84 [deg]
  double true_north = 0;               ///< direction of true north, clockwise from local +y [deg]
  /// Is the place on Earth known? Zeros mean that it is not.
  bool is_on_earth() const { return latitude != 0 || longitude != 0; }
  /// Does it have a coordinate system of the Earth?
  bool has_system() const { return !crs.empty() && crs != kLocalCrs; }
  bool operator==(const GeoReference&) const = default;
};

/// "urn:ogc:def:crs:EPSG::28992", "http://www.opengis.net/def/crs/EPSG/0/28992", "epsg:28992" as "EPSG:28992";
/// all spellings of WGS84 longitude and latitude as "OGC:CRS84"; anything else as it is.
std::string tidy_crs_name(std::string_view name);
/// Does the tidy name mean WGS84 longitude and latitude in degrees?
bool is_longitude_latitude(std::string_view crs);

/// The part in plan of a CRS with heights: "EPSG:28992" of "EPSG:7415"; any other name as it is.
std::string horizontal_crs(const std::string& crs, const std::string& database = "");

/// How many metres one unit of height is in a CRS: of its vertical axis where it has one, else of its axes in plan where these
/// are lengths, since surveys measure heights in the unit of the plan; else 1.
double height_unit(const std::string& crs, const std::string& database = "");

/// The way from the coordinates of a CRS into the local frame of a site.
/// A CRS whose units are metres on the ground (within a part in a thousand, not mirrored, see README) is kept and only
/// shifted by whole metres; any other one goes through longitude and latitude into a transverse Mercator projection of
/// its own, which stretches lengths by less than 1e-7 within 2 km.
class LocalFrame {
 public:
  /// Of kLocalCrs the coordinates stay as they are; where the middle is far from 0, they are shifted, which a note says.
  /// `x`, `y`: middle of the site in `crs`, east or longitude first. `database`: path of PROJ's proj.db; empty: PROJ finds its
  /// own.
  static Result<LocalFrame> make(const std::string& crs, double x, double y, const std::string& database = "");
  /// Coordinates of kLocalCrs about an origin.
  static LocalFrame local(double x, double y);
  /// The way from `crs` into a frame that exists already: that of a scene. Coordinates in kLocalCrs are those of a scene that has
  /// another CRS itself. A scene without a CRS that knows its latitude and longitude is placed by these and its true north: its
  /// metres are those of a transverse Mercator projection about them.
  static Result<LocalFrame> into(const std::string& crs, const GeoReference& target, const std::string& database = "");
  LocalFrame(LocalFrame&&) noexcept;
  LocalFrame& operator=(LocalFrame&&) noexcept;
  ~LocalFrame();

  const GeoReference& reference() const { return reference_; }
  /// Notices about the frame: a stretched CRS, a site outside the area of its CRS.
  const std::vector<std::string>& notes() const { return notes_; }
  /// A point of the CRS in local metres; not finite where the projection has no answer.
  Point3 to_local(double x, double y) const;
  /// The way back: local metres as a point of the CRS, in x and y.
  Point3 from_local(double x, double y) const;

 private:
  struct Transforms;
  LocalFrame();
  void keep_crs(const std::string& crs, double x, double y, double north_x, double north_y);
  Result<void> use_own_projection();

  GeoReference reference_;
  std::vector<std::string> notes_;
  std::unique_ptr<Transforms> transforms_;
};

}  // namespace bl::importing
