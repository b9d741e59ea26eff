// What differs between two values that people have set: of tables and lists the rows and entries, and not all of them.
#pragma once

#include <string>

#include "core/define/definition.h"
#include "core/define/value.h"

namespace bl::report {

/// "300 -> 350"; "row 4 `garden`: floor_area 300 -> 350; row 6 `pool` in the second only; and 2 more rows". Values are compared
/// whole, however long they are; empty where they are the same.
std::string setting_difference(const Value& before, const Value& after, const PortDefinition& port);

/// The same of two texts. Of long ones the part from a little before the place where they begin to differ.
std::string text_difference(const std::string& before, const std::string& after);

}  // namespace bl::report
