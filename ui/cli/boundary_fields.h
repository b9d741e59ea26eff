// Reads the boundary of a case: planes, vertices, a plan with heights, or a mesh.
#pragma once

#include <string>

#include "core/define/json_text.h"
#include "core/geometry/domain.h"

namespace bl::cli {

/// The forms, as a sentence about a boundary without any of them says it.
extern const char* const kBoundaryForms;

struct BoundaryReading {
  geometry::Domain domain;
  bool has_given_planes = false;  ///< made of planes: side `#k` is the k-th of them, and nobody needs to be told
};

/// Further fields of the object are not looked at; where several forms stand side by side, the first of the forms counts.
Result<BoundaryReading> boundary_at(const Json& json, const std::string& place);

}  // namespace bl::cli
