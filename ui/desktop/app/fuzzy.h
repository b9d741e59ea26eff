// Matching what people type against names, forgivingly: letters in order, starts of words first.
#pragma once

#include <optional>
#include <string_view>

namespace bl::desktop {

/// How well `query` fits `text`, higher is better; nothing where its letters do not all occur in order. Case and spaces in the
/// query do not matter; an empty query fits everything with 0.
std::optional<int> fuzzy_match(std::string_view query, std::string_view text);

}  // namespace bl::desktop
