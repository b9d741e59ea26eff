// The proposal with its volumes in another form: balls, cells, slabs or standing bodies, with the figures of that form.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/define/port_builder.h"
#include "core/export/proposal_model.h"
#include "core/reading/volume_form.h"

namespace bl::exporting {

using reading::VolumeForm;

/// What options of formats begin with that write volumes in any form.
struct FormOptions {
  VolumeForm form = VolumeForm::as_is;
};
/// All forms, for a declaration of options.
std::vector<Choice<VolumeForm>> form_choices();

/// Buildings, uses and sums in that form; `as_is`: the proposal itself. Plots, indicators and conflicts stay those of the scene.
/// A volume that has no body in that form comes behind those without a shape, says why, and measures nothing.
Proposal in_form(const Proposal& proposal, VolumeForm form);

}  // namespace bl::exporting
