// What the makers of convex domains share.
#pragma once

#include <span>
#include <string_view>

#include "core/geometry/convex_domain.h"

namespace bl::geometry {

/// Every coordinate finite and no larger than kLargestCoordinate, or an error that names the point as "`what` number".
Result<void> check_points(std::span<const Point3> points, std::string_view what);

/// Volume, centroid and box of a domain whose planes, vertices and faces are set; an error where it is flat.
Result<ConvexDomain> finish_domain(ConvexDomain domain);

/// Every edge has one triangle on either side, turned the same way; at least 4 triangles; no vertex that is not there.
Result<void> check_closed(const Mesh& mesh);

}  // namespace bl::geometry
