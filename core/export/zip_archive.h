// A zip archive in memory, the same bytes for the same content.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace bl::exporting {

/// Names and contents in this order, compressed; all with the date 1980-01-01, since a clock would change the bytes.
/// `comment` stands at the end of the archive.
Result<std::string> zip_archive(const std::vector<std::pair<std::string, std::string>>& files, const std::string& comment);

}  // namespace bl::exporting
