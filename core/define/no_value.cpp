// A default beyond the slider's range at an end of the hard range is nothing that anybody means.
#include "core/define/no_value.h"

namespace bl {

std::optional<double> value_of_none(const PortDefinition& port) {
  if (port.is_computed || (port.kind != ValueKind::number && port.kind != ValueKind::integer)) return std::nullopt;
  const double value = as_number(port.default_value);
  const bool is_above = value == port.hard_maximum && port.soft_maximum && value > *port.soft_maximum;
  const bool is_below = value == port.hard_minimum && port.soft_minimum && value < *port.soft_minimum;
  return is_above || is_below ? std::optional(value) : std::nullopt;
}

bool means_none(const PortDefinition& port, double value) { return value_of_none(port) == value; }

}  // namespace bl
