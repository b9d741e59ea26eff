// JSON Schema (2020-12) of scene files and command logs, made from the declarations.
#pragma once

#include "core/define/json_text.h"
#include "core/define/registry.h"

namespace bl {

/// Accepts exactly the files whose form the reader accepts. What needs the whole scene to judge (ids that point to nothing, ids
/// given twice, units that do not meet, revisions) is the checker's alone.
Json scene_schema(const Registry& registry, const TypeDefinition& settings, int version);

/// The schema of one value as its declaration wants it.
Json value_schema(const PortDefinition& port);

}  // namespace bl
