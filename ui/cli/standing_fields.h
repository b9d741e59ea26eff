// Reads the form of standing volumes in a case of `fit`: storeys on footprints instead of balls.
#pragma once

#include "core/define/json_text.h"
#include "ui/cli/site_case.h"

namespace bl::cli {

/// Fills in `standing` from the field `form` of a case whose boundary and sites were read.
Result<void> read_form(const Json& json, SiteCase& into);

}  // namespace bl::cli
