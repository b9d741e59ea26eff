// A curve that people write as a table: points with ascending places, and a value at each.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/define/value.h"

namespace bl {

/// Two columns of a table, read as a curve.
struct Curve {
  const Table& points;
  std::string_view place, value;  ///< the names of the columns
};

/// Refuses a curve without points, and places that do not ascend; `port` is the id of the table's port.
Result<void> check_curve(const Curve& curve, const std::string& port);
/// The value of a curve that was checked: linear between its points, constant before the first and beyond the last.
double value_on(const Curve& curve, double place);
/// The same where the curve repeats itself after every `period`: from the last point it leads on to the first. The places lie
/// from 0 to `period`, as does `place`.
double value_on_cycle(const Curve& curve, double place, double period);
/// The same in steps: the value of a point holds until the next one.
double step_on_cycle(const Curve& curve, double place);

}  // namespace bl
