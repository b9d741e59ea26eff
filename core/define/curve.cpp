// Checks curves, and reads values between their points.
#include "core/define/curve.h"

namespace bl {

namespace {

double between(double low, double low_value, double high, double high_value, double place) {
  // A level stretch is level to the last bit, so that what follows it rests.
  if (low_value == high_value) return low_value;
  const double share = (place - low) / (high - low);
  return low_value * (1 - share) + high_value * share;
}

// The first point beyond the place.
std::size_t after(const Curve& curve, double place) {
  std::size_t next = 0;
  while (next < curve.points.rows.size() && curve.points.number(next, curve.place) <= place) ++next;
  return next;
}

}  // namespace

Result<void> check_curve(const Curve& curve, const std::string& port) {
  if (curve.points.rows.empty()) return Error{ErrorCode::missing, port, "the curve needs at least one point"};
  for (std::size_t row = 1; row < curve.points.rows.size(); ++row)
    if (!(curve.points.number(row, curve.place) > curve.points.number(row - 1, curve.place)))
      return Error{ErrorCode::out_of_range, port + "/" + std::to_string(row) + "/" + std::string(curve.place),
                   "the " + std::string(curve.place) + "s have to ascend: each larger than the one before"};
  return {};
}

double value_on(const Curve& curve, double place) {
  const Table& points = curve.points;
  const std::size_t next = after(curve, place), last = points.rows.size() - 1;
  if (next == 0) return points.number(0, curve.value);
  if (next > last) return points.number(last, curve.value);
  return between(points.number(next - 1, curve.place), points.number(next - 1, curve.value), points.number(next, curve.place),
                 points.number(next, curve.value), place);
}

double value_on_cycle(const Curve& curve, double place, double period) {
  const Table& points = curve.points;
  const std::size_t next = after(curve, place), last = points.rows.size() - 1;
  if (next > 0 && next <= last) return value_on(curve, place);
  const double begin = points.number(last, curve.place), end = points.number(0, curve.place) + period;
  // Points at both ends of the period: nothing lies between them.
  if (!(end > begin)) return points.number(next == 0 ? 0 : last, curve.value);
  return between(begin, points.number(last, curve.value), end, points.number(0, curve.value), next == 0 ? place + period : place);
}

double step_on_cycle(const Curve& curve, double place) {
  const std::size_t next = after(curve, place);
  return curve.points.number(next == 0 ? curve.points.rows.size() - 1 : next - 1, curve.value);
}

}  // namespace bl
