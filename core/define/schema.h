// JSON Schema (2020-12) of scene files and command logs, made from the declarations.
#pragma once

#include "core/define/json_text.h"
#include "core/define/registry.h"

namespace bl {

/// Accepts exactly the files whose form the reader accepts. Only the checker judges what needs the whole scene: ids of nothing,
/// duplicate ids, units that differ, revisions.
Json scene_schema(const Registry& registry, const TypeDefinition& settings, int version);

/// The schema of one value by its declaration.
Json value_schema(const PortDefinition& port);

}  // namespace bl
