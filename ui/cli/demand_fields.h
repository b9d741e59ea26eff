// Reads the demands of single sites or of groups, and the sites that keep their weight.
#pragma once

#include "core/define/json_text.h"
#include "core/import/site_table.h"
#include "ui/cli/site_case.h"

namespace bl::cli {

/// Fills in the demands of a case whose boundary and sites were read, from `demands`, `groups` and `locked`.
Result<void> read_demands(const Json& json, SiteCase& into);

/// The same from the columns of a table.
Result<void> read_demands(const importing::SiteTable& table, SiteCase& into);

}  // namespace bl::cli
