// The words of headers, and the way from a scene's frame to the Earth.
#include "core/export/identity.h"

#include <numbers>

#include "core/base/mathematics.h"
#include "core/base/text.h"

namespace bl::exporting {

namespace {

bool has_system(const Proposal& proposal) {
  return !proposal.reference.crs.empty() && proposal.reference.crs != importing::kLocalCrs;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> identity_of(const Proposal& proposal) {
  const importing::GeoReference& place = proposal.reference;
  std::vector<std::pair<std::string, std::string>> rows = {{"scene", proposal.name()},
                                                           {"file", proposal.file},
                                                           {"hash", proposal.hash},
                                                           {"tick", std::to_string(proposal.tick)},
                                                           {"settled", proposal.is_settled ? "yes" : "no"},
                                                           {"units", "m, m2, m3"},
                                                           {"volumes", reading::choice_of(proposal.form).measured}};
  rows.emplace_back("coordinate_system", has_system(proposal) ? place.crs : "local metres");
  if (has_system(proposal)) rows.emplace_back("origin", shortest(place.origin_x) + " " + shortest(place.origin_y));
  if (place.is_on_earth()) rows.emplace_back("latitude_longitude", shortest(place.latitude) + " " + shortest(place.longitude));
  rows.emplace_back("true_north", shortest(place.true_north));
  return rows;
}

std::string identity_line(const Proposal& proposal) {
  std::string line;
  for (const auto& [name, value] : identity_of(proposal)) line += (line.empty() ? "" : "; ") + name + " " + value;
  for (char& c : line) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return line;
}

std::string place_text(const Proposal& proposal) {
  const importing::GeoReference& place = proposal.reference;
  std::string text;
  if (has_system(proposal)) text = place.crs + ", origin " + shortest(place.origin_x) + ", " + shortest(place.origin_y);
  if (place.is_on_earth())
    text += (text.empty() ? "" : "; ") + fixed(place.latitude, 6) + "°, " + fixed(place.longitude, 6) + "°";
  return text;
}

bool is_placed(const Proposal& proposal) { return has_system(proposal) || proposal.reference.is_on_earth(); }

Result<WayToEarth> WayToEarth::make(const Proposal& proposal) {
  if (!is_placed(proposal))
    return Error{ErrorCode::missing, "",
                 "the scene does not say where it lies on Earth: set its coordinate system, or its latitude and longitude"};
  importing::GeoReference target = proposal.reference;
  const bool is_own = !has_system(proposal);
  if (is_own) {
    target.crs = "+proj=tmerc +lat_0=" + shortest(target.latitude) + " +lon_0=" + shortest(target.longitude) +
                 " +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs";
    target.origin_x = target.origin_y = 0;
  }
  auto frame = importing::LocalFrame::into("OGC:CRS84", target);
  if (!frame) return frame.error();
  WayToEarth way(std::move(*frame));
  if (is_own) {
    const double turn = target.true_north * std::numbers::pi / 180;
    way.cosine_ = mathematics::cosine(turn);
    way.sine_ = mathematics::sine(turn);
  }
  return way;
}

// North is `sine, cosine` in local metres, east a quarter turn right of it.
Point3 WayToEarth::degrees(const Point3& local) const {
  return frame_.from_local(cosine_ * local.x - sine_ * local.y, sine_ * local.x + cosine_ * local.y);
}

}  // namespace bl::exporting
