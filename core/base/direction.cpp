// Directions drawn from the hash of two names.
#include "core/base/direction.h"

#include "core/base/hash.h"
#include "core/base/random.h"

namespace bl {

Vector3 direction_by_name(std::string_view from, std::string_view to) {
  const bool is_ordered = from < to;
  Hash names;
  names.add(is_ordered ? from : to);
  names.add(is_ordered ? to : from);
  Random random(names.value());
  const Vector3 way{random.uniform(0.1, 1), random.uniform(-1, 1), 0};
  return way / (is_ordered ? norm(way) : -norm(way));
}

}  // namespace bl
