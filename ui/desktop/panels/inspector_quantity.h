// Numbers as people type them: with units, with a little arithmetic, or as a change of what stands there.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/unit.h"
#include "core/define/definition.h"
#include "core/define/no_value.h"
#include "ui/desktop/view/labels.h"

namespace bl::desktop {

/// "12 m", "0.4 ha * 3.2 m", "(1200+300)*1.5" as a number in SI of the unit. With `now`, also changes of it: "+10%", "*1.5",
/// "/2". The error is a sentence that says what would do.
Result<double> typed_number(std::string_view text, Unit unit, double now);
/// Does it change what stands there, so that several values stay different?
bool is_relative(std::string_view text);

/// As many digits as the number has, up to nine, in groups, with its unit: "7 200 m³", "0.05".
std::string shown_number(double value, Unit unit);
/// The same for a field to type into: "7200 m3".
std::string typed_form(double value, Unit unit);
/// A quantity of this unit in words: "a volume in cubic metres (m³)".
std::string unit_in_words(Unit unit);
/// Doc, unit, default and range of a port, for the card beside it.
std::string facts_of(const PortDefinition& port, Unit unit);

}  // namespace bl::desktop
