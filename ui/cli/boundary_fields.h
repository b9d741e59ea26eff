// Reads the boundary of a case: planes, vertices, a plan with heights, or a mesh.
#pragma once

#include <string>

#include "core/define/json_text.h"
#include "core/geometry/domain.h"

namespace bl::cli {

/// The list of forms, for the message about a boundary that has none of them.
extern const char* const kBoundaryForms;

struct BoundaryReading {
  geometry::Domain domain;
  bool has_given_planes = false;  ///< made of planes: side `#k` is the k-th of them, so that the planes are not reported
};

/// Other fields of the object are ignored; where it has several forms, the first one counts.
Result<BoundaryReading> boundary_at(const Json& json, const std::string& place);

}  // namespace bl::cli
