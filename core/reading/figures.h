// Numbers as people read them: grouped thousands, sensible digits, units.
#pragma once

#include <string>

#include "core/base/unit.h"

namespace bl::reading {

/// "12 480": grouped by narrow spaces that do not break. Not finite: a dash.
std::string grouped(double value, int decimals = 0);
/// With decimals that fit the size of the number: "12 480", "84.2", "0.316".
std::string readable(double value);
/// A handy unit: seconds become minutes from two minutes on, and hours from two hours on; other units stay.
const UnitInfo& handy_unit(double value, Unit unit);
/// `readable` with the printed symbol of its handy unit: "84.2 m²", "8.50 h".
std::string quantity(double value, Unit unit);
/// A time that something takes, with the unit that fits: "2.31 ms", "840 µs", "35.0 ns".
std::string duration(double seconds);
/// A share as a percentage of two or three digits: "0.42 %".
std::string percent(double share);
/// The same with its sign, also where it is positive.
std::string signed_percent(double share);
/// A part of a whole as a percentage; and the signed deviation of a reached value from a wanted one. A dash where the whole is
/// below a thousandth of a unit, since a percentage of zero has no meaning.
std::string share_of(double part, double whole);
std::string difference_of(double reached, double wanted);
/// "1 volume", "3 volumes".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace bl::reading
