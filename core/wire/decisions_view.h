// What was decided last, for those who come late.
#pragma once

#include "core/wire/views.h"

namespace bl::wire {

/// By entry. A vote is only named: its result stands in the view `votes`, where it is shown to whom and when its rules say.
View decisions_view(const ViewSources& sources);

}  // namespace bl::wire
