// Finds the rows that other rows of a programme name: neighbours, and those whose roof or building they take part in.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/import/programme_columns.h"
#include "core/import/programme_csv.h"

namespace bl::importing {

/// Names in the columns adjacent_to, on and shares become uses of rows. `written_uses` are those of the file, before they were
/// made unique; `place` says where a field stands.
void join_rows(ProgrammeImport& import, const std::vector<std::string>& written_uses,
               const std::function<std::string(std::size_t row, ProgrammeColumn column)>& place, std::vector<Error>& errors);

}  // namespace bl::importing
