// The words of headers, and the way from a scene's frame to the Earth.
#include "core/export/identity.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace bl::exporting {

std::vector<std::pair<std::string, std::string>> identity_of(const Proposal& proposal) {
  const importing::GeoReference& place = proposal.reference;
  std::vector<std::pair<std::string, std::string>> rows = {{"scene", proposal.name()},
                                                           {"file", proposal.file},
                                                           {"hash", proposal.hash},
                                                           {"tick", std::to_string(proposal.tick)},
                                                           {"settled", proposal.is_settled ? "yes" : "no"},
                                                           {"units", "m, m2, m3"},
                                                           {"volumes", reading::choice_of(proposal.form).measured}};
  rows.emplace_back("coordinate_system", place.has_system() ? place.crs : "local metres");
  if (place.has_system()) rows.emplace_back("origin", shortest(place.origin_x) + " " + shortest(place.origin_y));
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
  if (place.has_system()) text = place.crs + ", origin " + shortest(place.origin_x) + ", " + shortest(place.origin_y);
  if (place.is_on_earth())
    text += (text.empty() ? "" : "; ") + fixed(place.latitude, 6) + "°, " + fixed(place.longitude, 6) + "°";
  return text;
}

std::string way_to_system(const Proposal& proposal) {
  const importing::GeoReference& place = proposal.reference;
  if (!place.is_on_earth()) return "";
  // Zones of UTM are six degrees wide, the first from 180 degrees west on.
  const int zone = std::clamp(static_cast<int>(std::floor((place.longitude + 180) / 6)) + 1, 1, 60);
  const int code = (place.latitude < 0 ? 32700 : 32600) + zone;
  return "; make the scene with `new --crs EPSG:" + std::to_string(code) + "` (UTM), or with that of your country";
}

bool is_placed(const Proposal& proposal) { return proposal.reference.has_system() || proposal.reference.is_on_earth(); }

Result<WayToEarth> WayToEarth::make(const Proposal& proposal) {
  if (!is_placed(proposal))
    return Error{ErrorCode::missing, "",
                 "the scene does not say where it lies on Earth: set its coordinate system, or its latitude and longitude"};
  auto frame = importing::LocalFrame::into("OGC:CRS84", proposal.reference);
  if (!frame) return frame.error();
  return WayToEarth(std::move(*frame));
}

Point3 WayToEarth::degrees(const Point3& local) const { return frame_.from_local(local.x, local.y); }

}  // namespace bl::exporting
