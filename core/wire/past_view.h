// The plan as people saw it when each of the last decisions was made.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "core/wire/views.h"

namespace bl::wire {

/// By the entry of the decision: the view `plan` of just before. It is no part of the record: a server that was started since
/// knows none of the decisions before.
using PastPlans = std::map<std::int64_t, std::shared_ptr<const View>>;

/// Those of the decisions that are told, with keys such as `17/n/cafe`.
View past_view(const ViewSources& sources);

}  // namespace bl::wire
