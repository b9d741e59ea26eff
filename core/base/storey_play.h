// How storeys come back that a lack of height has taken: known to who builds them and to who sets limits.
#pragma once

namespace bl {

/// The room for storeys must have grown by this share of a storey since it was least, or there must be room for this share of a
/// storey beyond the whole ones. So storeys do not come and go with a limit that trembles, and come back with a limit that is put
/// back.
inline constexpr double kStoreyPlay = 0.15;

}  // namespace bl
