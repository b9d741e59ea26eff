// Catalogue pages in Markdown, made from the declarations.
#pragma once

#include <string>

#include "core/define/registry.h"

namespace bl {

/// One page each: what the type is for, its ports or parameters with kind, unit, default and range, and which links fit.
std::string catalogue_page(const TypificationDefinition& type, const Registry& registry);
std::string catalogue_page(const LinkDefinition& kind, const Registry& registry);
std::string catalogue_page(const CommandDefinition& command);
/// The list of everything, with one line for each type.
std::string catalogue_index(const Registry& registry);

}  // namespace bl
