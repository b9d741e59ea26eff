// The blocks of an OpenStreetMap PBF, unopened: whether they are all there, and what they say that they unpack to.
#pragma once

#include <string_view>

#include "core/base/result.h"

namespace bl::importing {

/// Nothing, or why it is not worth opening the first block: the file ends within one, or they unpack to more than anybody reads.
/// What is no block at all is left to the reader.
Result<void> check_pbf_blocks(std::string_view bytes);

}  // namespace bl::importing
