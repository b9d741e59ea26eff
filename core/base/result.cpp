// Names of the error codes and the composition of places.
#include "core/base/result.h"

namespace bl {

std::string_view name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::parse: return "parse";
    case ErrorCode::unknown_field: return "unknown_field";
    case ErrorCode::unknown_type: return "unknown_type";
    case ErrorCode::wrong_kind: return "wrong_kind";
    case ErrorCode::wrong_unit: return "wrong_unit";
    case ErrorCode::out_of_range: return "out_of_range";
    case ErrorCode::not_finite: return "not_finite";
    case ErrorCode::missing: return "missing";
    case ErrorCode::duplicate: return "duplicate";
    case ErrorCode::not_found: return "not_found";
    case ErrorCode::conflict: return "conflict";
    case ErrorCode::geometry: return "geometry";
    case ErrorCode::infeasible: return "infeasible";
    case ErrorCode::version: return "version";
    case ErrorCode::io: return "io";
    case ErrorCode::cancelled: return "cancelled";
    case ErrorCode::internal: return "internal";
  }
  return "internal";
}

Error Error::within(std::string_view prefix) const {
  Error outer = *this;
  if (prefix.empty()) return outer;
  outer.place = place.empty() ? std::string(prefix) : std::string(prefix) + "/" + place;
  return outer;
}

}  // namespace bl
