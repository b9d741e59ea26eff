// What only those who lead a room need: what a rewind would take back, areas, and what areas can be made of.
#pragma once

#include "core/wire/views.h"

namespace bl::wire {

/// Empty for everybody but facilitators. `unchanged`: spans of entries, a rewind to one of which takes nothing back; `areas`: of
/// each its `nodes`, as files have selections, and the number of `corners` of its outline; `tags` and `roles`: what the nodes of
/// the scene carry, with the number of nodes, and of roles their labels.
View lead_view(const ViewSources& sources, std::int64_t seat);

}  // namespace bl::wire
