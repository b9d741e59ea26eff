// Catalogue pages in Markdown, made from the declarations.
#pragma once

#include <string>

#include "core/define/registry.h"

namespace bl {

/// One page for each type: its purpose, its ports or parameters with kind, unit, default and range, and the links that fit.
std::string catalogue_page(const TypificationDefinition& type, const Registry& registry);
std::string catalogue_page(const LinkDefinition& kind, const Registry& registry);
std::string catalogue_page(const CommandDefinition& command);
/// The list of all types, with one line each.
std::string catalogue_index(const Registry& registry);

}  // namespace bl
