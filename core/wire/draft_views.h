// Drafts and proposals as views.
#pragma once

#include "core/wire/views.h"

namespace bl::wire {

/// What was proposed, for everybody: who, why, the steps in words, conflicts with what has changed since, and the trial.
View proposals_view(const ViewSources& sources);
/// The drafts of a seat, as `proposals_view` tells of those that were proposed.
View drafts_view(const ViewSources& sources, std::int64_t seat);
/// The steps of these drafts as commands, for windows that work in them.
View draft_steps_view(const ViewSources& sources, std::int64_t seat);
/// Plans of the drafts that pages of this seat look at.
View draft_plans_view(const ViewSources& sources, std::int64_t seat);

}  // namespace bl::wire
