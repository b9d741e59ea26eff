// Options of formats as people type them, `name=value`, and the list of formats with their options for help and docs.
#pragma once

#include <string>
#include <vector>

#include "core/export/format.h"

namespace bl::exporting {

/// One value for each option of the format, in order. `texts`: each `name=value`; later ones win. Names that this format lacks
/// are passed over. Fails on a value of the wrong kind, unit or range.
Result<std::vector<Value>> option_values(const FormatDefinition& format, const std::vector<std::string>& texts);
/// A name that none of the formats has, or a text without `=`, is an error with the nearest name.
Result<void> check_option_names(const std::vector<const FormatDefinition*>& formats, const std::vector<std::string>& texts);

/// "dxf  AutoCAD drawing ...", and a line for each option under it.
std::string formats_text();
/// All formats with their options, for pages: a list of `{id, label, doc, ending, options: [{id, doc, kind, unit, default,
/// minimum, maximum, choices: [{id, doc}]}]}`; what an option has not is left out.
std::string formats_json();
/// A page of the catalogue.
std::string format_page(const FormatDefinition& format);

}  // namespace bl::exporting
