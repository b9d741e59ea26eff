// Local frames by PROJ: each frame has a PROJ context of its own, so that threads never share one; no network is used.
#include "core/import/local_frame.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/base/mathematics.h"
#include "core/base/text.h"

namespace bl::importing {

namespace {

// A CRS is kept when 1 m on the ground is 1 m in it within this: UTM (4e-4) passes, web Mercator does not.
constexpr double kStretchKept = 1e-3;
constexpr double kNearOrigin = 10000;  // [m] so near to 0 the coordinates of a model need no shift
constexpr double kProbe = 100;         // [m] half the length over which the stretch is measured
constexpr double kDegree = std::numbers::pi / 180;

double whole(double number, double step) { return std::round(number / step) * step; }

std::string projection_about(const std::string& latitude, const std::string& longitude) {
  return "+proj=tmerc +lat_0=" + latitude + " +lon_0=" + longitude + " +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs";
}

}  // namespace

struct LocalFrame::Transforms {
  PJ_CONTEXT* context = nullptr;
  PJ* to_degrees = nullptr;  // CRS → longitude, latitude [deg]; null where the CRS is that already
  PJ* to_metres = nullptr;   // longitude, latitude [rad] → own projection; null where the CRS is kept
  PJ* to_target = nullptr;   // longitude, latitude [deg] → CRS of a scene; null where there is none, or it is the file's
  bool is_of_scene = false;  // the coordinates are local metres already
  bool is_turned = false;    // the scene lies about its latitude and longitude alone, turned to true north
  double cosine = 1, sine = 0;

  ~Transforms() {
    proj_destroy(to_degrees);
    proj_destroy(to_metres);
    proj_destroy(to_target);
    proj_context_destroy(context);
  }
  // x = longitude, y = latitude [deg]; infinite where PROJ has no answer.
  PJ_COORD degrees(double x, double y) const {
    const PJ_COORD from = proj_coord(x, y, 0, 0);
    return to_degrees ? proj_trans(to_degrees, PJ_FWD, from) : from;
  }
  PJ_COORD metres(const PJ_COORD& degree) const {
    return proj_trans(to_metres, PJ_FWD, proj_coord(degree.xy.x * kDegree, degree.xy.y * kDegree, 0, 0));
  }
  // The CRS coordinates of a point `east`, `north` metres off the origin of the own projection.
  PJ_COORD crs_of_offset(double east, double north) const {
    const PJ_COORD radian = proj_trans(to_metres, PJ_INV, proj_coord(east, north, 0, 0));
    return proj_trans(to_degrees, PJ_INV, proj_coord(radian.xy.x / kDegree, radian.xy.y / kDegree, 0, 0));
  }
  Result<void> open(const std::string& crs, const std::string& database);
  void start();
  void note_area_of_use(const std::string& crs, const PJ_COORD& middle, std::vector<std::string>& notes) const;
};

void LocalFrame::Transforms::start() {
  context = proj_context_create();
  proj_log_level(context, PJ_LOG_NONE);
  proj_context_set_enable_network(context, 0);
}

// Prepares `to_degrees`; the EPSG definitions come from proj.db, which may be missing.
Result<void> LocalFrame::Transforms::open(const std::string& crs, const std::string& database) {
  const bool own_path = database.empty() || proj_context_set_database_path(context, database.c_str(), nullptr, nullptr);
  if (!own_path || proj_context_get_database_metadata(context, "EPSG.VERSION") == nullptr)
    return Error{ErrorCode::io, "crs",
                 "The CRS `" + crs + "` needs PROJ's database proj.db, which was not found" +
                     (database.empty() ? std::string() : " at `" + database + "`") +
                     ". Install the package proj-data, or name the folder of proj.db in the environment variable PROJ_LIB."};
  PJ* source = proj_create(context, crs.c_str());
  const bool is_crs = source != nullptr && proj_is_crs(source);
  proj_destroy(source);
  PJ* raw = is_crs ? proj_create_crs_to_crs(context, crs.c_str(), "OGC:CRS84", nullptr) : nullptr;
  if (raw != nullptr) {
    to_degrees = proj_normalize_for_visualization(context, raw);
    proj_destroy(raw);
  }
  if (to_degrees == nullptr)
    return Error{
        ErrorCode::parse, "crs",
        "The CRS `" + crs + "` is not known. Write an EPSG code such as EPSG:28992, or OGC:CRS84 for longitude and latitude."};
  return {};
}

void LocalFrame::Transforms::note_area_of_use(const std::string& crs, const PJ_COORD& middle,
                                              std::vector<std::string>& notes) const {
  double west = 0, south = 0, east = 0, north = 0;
  const char* name = nullptr;
  PJ* source = proj_create(context, crs.c_str());
  const bool known = proj_get_area_of_use(context, source, &west, &south, &east, &north, &name) && west > -1000 && west <= east;
  const double x = middle.xy.x, y = middle.xy.y;
  if (known && (x < west || x > east || y < south || y > north))
    notes.push_back("The site lies at latitude " + fixed(y, 3) + "°, longitude " + fixed(x, 3) + "°, outside the area that " +
                    crs + " is made for (" + (name ? name : "unnamed") + "): check the CRS.");
  proj_destroy(source);
}

LocalFrame::LocalFrame() : transforms_(std::make_unique<Transforms>()) {}
LocalFrame::LocalFrame(LocalFrame&&) noexcept = default;
LocalFrame& LocalFrame::operator=(LocalFrame&&) noexcept = default;
LocalFrame::~LocalFrame() = default;

Result<void> LocalFrame::use_own_projection() {
  proj_destroy(transforms_->to_metres);
  reference_.crs = projection_about(fixed(reference_.latitude, 6), fixed(reference_.longitude, 6));
  transforms_->to_metres = proj_create(transforms_->context, reference_.crs.c_str());
  if (transforms_->to_metres == nullptr)
    return Error{ErrorCode::internal, "crs", "PROJ refused the local projection `" + reference_.crs + "`."};
  return {};
}

void LocalFrame::keep_crs(const std::string& crs, double x, double y, double north_x, double north_y) {
  reference_ = {crs, std::round(x), std::round(y), 0, 0, mathematics::arc_tangent(north_x, north_y) / kDegree};
  proj_destroy(transforms_->to_metres);
  transforms_->to_metres = nullptr;
  const PJ_COORD origin = transforms_->degrees(reference_.origin_x, reference_.origin_y);
  reference_.longitude = origin.xy.x;
  reference_.latitude = origin.xy.y;
}

LocalFrame LocalFrame::local(double x, double y) {
  LocalFrame frame;
  frame.reference_.crs = kLocalCrs;
  frame.reference_.origin_x = x;
  frame.reference_.origin_y = y;
  return frame;
}

Result<LocalFrame> LocalFrame::make(const std::string& crs, double x, double y, const std::string& database) {
  if (crs == kLocalCrs) {
    if (!std::isfinite(x) || !std::isfinite(y))
      return Error{ErrorCode::not_finite, "crs", "The middle of the coordinates is not finite: the file is damaged."};
    if (std::abs(x) <= kNearOrigin && std::abs(y) <= kNearOrigin) return local(0, 0);
    LocalFrame shifted = local(std::round(x), std::round(y));
    shifted.notes_.push_back("The coordinates lie far from 0: the origin of the scene is at (" + fixed(std::round(x), 0) + ", " +
                             fixed(std::round(y), 0) + ") of them.");
    return shifted;
  }
  LocalFrame frame;
  Transforms& transforms = *frame.transforms_;
  transforms.start();
  const bool degrees = is_longitude_latitude(crs);
  if (!degrees) {
    if (auto opened = transforms.open(crs, database); !opened) return opened.error();
  }
  const PJ_COORD middle = transforms.degrees(x, y);
  if (!(std::abs(middle.xy.x) <= 360) || !(std::abs(middle.xy.y) <= 90))
    return Error{ErrorCode::out_of_range, "crs",
                 "The middle of the site (" + fixed(x, 3) + ", " + fixed(y, 3) + ") is nowhere on Earth in " + crs +
                     ". Check the CRS, and that x (or longitude) comes before y (or latitude)."};
  // Six decimals of a degree are a decimetre: the text of the projection then says exactly where its origin is.
  frame.reference_.latitude = whole(middle.xy.y, 1e-6);
  frame.reference_.longitude = whole(middle.xy.x, 1e-6);
  if (auto made = frame.use_own_projection(); !made) return made.error();
  if (degrees) return frame;
  transforms.note_area_of_use(crs, middle, frame.notes_);

  const PJ_COORD e0 = transforms.crs_of_offset(-kProbe, 0), e1 = transforms.crs_of_offset(kProbe, 0);
  const PJ_COORD n0 = transforms.crs_of_offset(0, -kProbe), n1 = transforms.crs_of_offset(0, kProbe);
  const double ex = (e1.xy.x - e0.xy.x) / (2 * kProbe), ey = (e1.xy.y - e0.xy.y) / (2 * kProbe);
  const double nx = (n1.xy.x - n0.xy.x) / (2 * kProbe), ny = (n1.xy.y - n0.xy.y) / (2 * kProbe);
  const double east = std::sqrt(ex * ex + ey * ey), north = std::sqrt(nx * nx + ny * ny);
  const bool true_lengths = std::abs(east - 1) < kStretchKept && std::abs(north - 1) < kStretchKept;
  const bool true_angles = std::abs(ex * nx + ey * ny) < kStretchKept && ex * ny - ey * nx > 0 && ny > 0.5;
  if (true_lengths && true_angles) {
    frame.keep_crs(crs, x, y, nx, ny);
    if (std::abs(east - 1) > 1e-4)
      frame.notes_.push_back("Lengths are those of " + crs + ": 1 m on the ground is " + fixed(east, 5) + " m in it.");
  } else {
    frame.notes_.push_back("1 m on the ground is " + fixed(east, 5) + " (east) by " + fixed(north, 5) + " (north) units of " +
                           crs + ": the plan was projected anew in metres about its middle.");
  }
  return frame;
}

Result<LocalFrame> LocalFrame::into(const std::string& crs, const GeoReference& target, const std::string& database) {
  LocalFrame frame;
  Transforms& transforms = *frame.transforms_;
  frame.reference_ = target;
  transforms.start();
  if (crs == target.crs) return frame;  // a plain shift
  if (crs == kLocalCrs) {
    transforms.is_of_scene = true;
    frame.notes_.push_back("The coordinates were taken as metres from the origin of the scene.");
    return frame;
  }
  if (target.crs == kLocalCrs && !target.is_on_earth())
    return Error{
        ErrorCode::conflict, "crs",
        "The scene has metres of its own and no place on Earth, so that nothing in " + crs +
            " has a place in it. Set its coordinate system first, or give `--crs local` if the file is in these metres."};
  if (!is_longitude_latitude(crs)) {
    if (auto opened = transforms.open(crs, database); !opened) return opened.error();
  }
  if (!target.has_system() && target.is_on_earth()) {
    const std::string about = projection_about(shortest(target.latitude), shortest(target.longitude));
    transforms.to_metres = proj_create(transforms.context, about.c_str());
    if (transforms.to_metres == nullptr)
      return Error{ErrorCode::internal, "latitude", "PROJ refused the projection `" + about + "` about the scene."};
    transforms.is_turned = true;
    transforms.cosine = mathematics::cosine(target.true_north * kDegree);
    transforms.sine = mathematics::sine(target.true_north * kDegree);
    return frame;
  }
  if (target.crs.starts_with("+proj=")) {
    transforms.to_metres = proj_create(transforms.context, target.crs.c_str());
    if (transforms.to_metres != nullptr) return frame;
  } else if (auto known = LocalFrame::make(target.crs, target.origin_x, target.origin_y, database); !known) {
    return known.error();
  } else if (PJ* raw = proj_create_crs_to_crs(transforms.context, "OGC:CRS84", target.crs.c_str(), nullptr)) {
    transforms.to_target = proj_normalize_for_visualization(transforms.context, raw);
    proj_destroy(raw);
    if (transforms.to_target != nullptr) return frame;
  }
  return Error{ErrorCode::parse, "coordinate_system",
               "The coordinate system of the scene, `" + target.crs +
                   "`, is not understood: set it anew, or import into a scene without one."};
}

Point3 LocalFrame::to_local(double x, double y) const {
  if (transforms_->is_of_scene) return {x, y, 0};
  if (transforms_->to_target != nullptr) {
    const PJ_COORD there = proj_trans(transforms_->to_target, PJ_FWD, transforms_->degrees(x, y));
    return {there.xy.x - reference_.origin_x, there.xy.y - reference_.origin_y, 0};
  }
  if (transforms_->to_metres == nullptr) return {x - reference_.origin_x, y - reference_.origin_y, 0};
  const PJ_COORD point = transforms_->metres(transforms_->degrees(x, y));
  if (transforms_->is_turned) {
    const double east = point.xy.x, north = point.xy.y;
    return {transforms_->cosine * east + transforms_->sine * north, transforms_->cosine * north - transforms_->sine * east, 0};
  }
  return {point.xy.x - reference_.origin_x, point.xy.y - reference_.origin_y, 0};
}

Point3 LocalFrame::from_local(double x, double y) const {
  if (transforms_->is_of_scene) return {x, y, 0};
  double there_x = x + reference_.origin_x, there_y = y + reference_.origin_y;
  // North is `sine, cosine` in local metres, east a quarter turn right of it.
  if (transforms_->is_turned) {
    there_x = transforms_->cosine * x - transforms_->sine * y;
    there_y = transforms_->sine * x + transforms_->cosine * y;
  }
  PJ_COORD degree;
  if (transforms_->to_target != nullptr) {
    degree = proj_trans(transforms_->to_target, PJ_INV, proj_coord(there_x, there_y, 0, 0));
  } else if (transforms_->to_metres != nullptr) {
    const PJ_COORD radian = proj_trans(transforms_->to_metres, PJ_INV, proj_coord(there_x, there_y, 0, 0));
    degree = proj_coord(radian.xy.x / kDegree, radian.xy.y / kDegree, 0, 0);
  } else {
    return {there_x, there_y, 0};
  }
  if (transforms_->to_degrees != nullptr) degree = proj_trans(transforms_->to_degrees, PJ_INV, degree);
  return {degree.xy.x, degree.xy.y, 0};
}

std::string tidy_crs_name(std::string_view name) {
  while (!name.empty() && (name.front() == ' ' || name.front() == '\t')) name.remove_prefix(1);
  while (!name.empty() && (name.back() == ' ' || name.back() == '\t')) name.remove_suffix(1);
  std::string upper(name);
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  if (upper == "LOCAL") return kLocalCrs;
  if (upper.ends_with("CRS84") || upper == "WGS84" || upper == "WGS 84") return "OGC:CRS84";
  const std::size_t digits = upper.find_last_not_of("0123456789") + 1;
  const bool has_code = digits > 0 && digits < upper.size() && (upper[digits - 1] == ':' || upper[digits - 1] == '/');
  const bool epsg = upper.starts_with("EPSG:") || upper.find("DEF:CRS:EPSG:") != std::string::npos ||
                    upper.find("DEF/CRS/EPSG/") != std::string::npos;
  if (!has_code || !epsg) return std::string(name);
  const std::string code = upper.substr(digits);
  return code == "4326" ? "OGC:CRS84" : "EPSG:" + code;
}

namespace {

// A CRS outside of any frame, with a context of its own.
class LooseCrs {
 public:
  LooseCrs(const std::string& crs, const std::string& database) : context_(proj_context_create()) {
    proj_log_level(context_, PJ_LOG_NONE);
    proj_context_set_enable_network(context_, 0);
    if (!database.empty()) proj_context_set_database_path(context_, database.c_str(), nullptr, nullptr);
    crs_ = crs.empty() ? nullptr : proj_create(context_, crs.c_str());
  }
  LooseCrs(const LooseCrs&) = delete;
  LooseCrs& operator=(const LooseCrs&) = delete;
  ~LooseCrs() {
    proj_destroy(crs_);
    proj_context_destroy(context_);
  }
  PJ_CONTEXT* context() const { return context_; }
  const PJ* get() const { return crs_; }
  bool is_compound() const { return crs_ != nullptr && proj_get_type(crs_) == PJ_TYPE_COMPOUND_CRS; }

 private:
  PJ_CONTEXT* context_;
  PJ* crs_ = nullptr;
};

// Metres per unit of the last axis, or 0 where that is no length.
double unit_of_last_axis(PJ_CONTEXT* context, const PJ* crs) {
  PJ* system = crs != nullptr ? proj_crs_get_coordinate_system(context, crs) : nullptr;
  const int count = system != nullptr ? proj_cs_get_axis_count(context, system) : 0;
  double metres = 0;
  const char* unit = nullptr;
  const bool is_known =
      count > 0 && proj_cs_get_axis_info(context, system, count - 1, nullptr, nullptr, nullptr, &metres, &unit, nullptr, nullptr);
  const std::string name = is_known && unit != nullptr ? unit : "";
  proj_destroy(system);
  return name.find("degree") != std::string::npos || name.find("rad") != std::string::npos ? 0 : metres;
}

}  // namespace

double height_unit(const std::string& crs, const std::string& database) {
  if (crs == kLocalCrs) return 1;
  const LooseCrs whole(crs, database);
  if (whole.get() == nullptr) return 1;
  PJ* vertical = whole.is_compound() ? proj_crs_get_sub_crs(whole.context(), whole.get(), 1) : nullptr;
  const double metres = unit_of_last_axis(whole.context(), vertical != nullptr ? vertical : whole.get());
  proj_destroy(vertical);
  return metres > 0 ? metres : 1;
}

std::string horizontal_crs(const std::string& crs, const std::string& database) {
  if (crs == kLocalCrs) return crs;
  const LooseCrs whole(crs, database);
  std::string name = crs;
  if (!whole.is_compound()) return name;
  PJ* part = proj_crs_get_sub_crs(whole.context(), whole.get(), 0);
  const char* authority = part ? proj_get_id_auth_name(part, 0) : nullptr;
  const char* code = part ? proj_get_id_code(part, 0) : nullptr;
  if (authority != nullptr && code != nullptr) name = tidy_crs_name(std::string(authority) + ":" + code);
  proj_destroy(part);
  return name;
}

bool is_longitude_latitude(std::string_view crs) { return crs == "OGC:CRS84"; }

}  // namespace bl::importing
