// Rises and sets by search along the sun's way, and the moments of a study.
#include "core/sun/sun_day.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace bl::sun {

namespace {

constexpr double kDay = 86400;
constexpr double kScan = 600 / kDay;  // how densely the sun's way is searched [days]

// `angle` plus the turn that brings it next to `near`.
double unwound(double angle, double near) { return angle + 360 * std::round((near - angle) / 360); }

}  // namespace

SunTrack::SunTrack(const SunPlace& place, SunSpan span) : place_(place), span_(span) {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    EarthView& knot = knots_[k];
    knot = earth_view(span.begin + (span.end - span.begin) * 0.25 * static_cast<double>(k), place.delta_t);
    // Sidereal time turns once a day too often for a polynomial: what is kept is the rest after the mean turn.
    knot.sidereal_time -= 360.98564736629 * (span.end - span.begin) * 0.25 * static_cast<double>(k);
    knot.sidereal_time = unwound(knot.sidereal_time, knots_[0].sidereal_time);
    knot.right_ascension = unwound(knot.right_ascension, knots_[0].right_ascension);
  }
}

EarthView SunTrack::view(double moment) const {
  const double x = 4 * (moment - span_.begin) / (span_.end - span_.begin);
  EarthView view{0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    double share = 1;
    for (std::size_t j = 0; j < knots_.size(); ++j)
      if (j != k) share *= (x - static_cast<double>(j)) / (static_cast<double>(k) - static_cast<double>(j));
    view.right_ascension += share * knots_[k].right_ascension;
    view.declination += share * knots_[k].declination;
    view.sidereal_time += share * knots_[k].sidereal_time;
    view.distance += share * knots_[k].distance;
    view.equation_of_time += share * knots_[k].equation_of_time;
  }
  view.sidereal_time += 360.98564736629 * (moment - span_.begin);
  return view;
}

double SunTrack::height(double moment, double limit) const {
  const EarthView now = view(moment);
  return (limit == kHorizon ? earth_altitude(place_, now) : sun_position(place_, now).altitude) - limit;
}

// Between a moment below and one above, by halving: to a microsecond.
double SunTrack::crossing(double low, double high, double limit) const {
  const bool is_low = height(low, limit) < 0;
  for (int i = 0; i < 50 && std::abs(high - low) * kDay > 1e-6; ++i) {
    const double middle = 0.5 * (low + high);
    ((height(middle, limit) < 0) == is_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<SunSpan> SunTrack::above(double limit) const {
  const auto steps = static_cast<std::size_t>(std::ceil((span_.end - span_.begin) / kScan));
  std::vector<double> times;
  for (std::size_t i = 0; i <= steps; ++i)
    times.push_back(span_.begin + (span_.end - span_.begin) * static_cast<double>(i) / static_cast<double>(steps));
  // A peak or dip between two looks would be missed: it is searched for by thirds where the heights turn.
  std::vector<double> turns;
  for (std::size_t i = 1; i + 1 < times.size(); ++i) {
    const double before = height(times[i - 1], limit), here = height(times[i], limit), after = height(times[i + 1], limit);
    const double sign = here >= before && here >= after ? 1 : here <= before && here <= after ? -1 : 0;
    if (sign == 0 || sign * here > 0) continue;
    double low = times[i - 1], high = times[i + 1];
    for (int k = 0; k < 60; ++k) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      (sign * height(left, limit) < sign * height(right, limit) ? low : high) =
          sign * height(left, limit) < sign * height(right, limit) ? left : right;
    }
    turns.push_back(0.5 * (low + high));
  }
  times.insert(times.end(), turns.begin(), turns.end());
  std::sort(times.begin(), times.end());
  std::vector<SunSpan> spans;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const bool is_up = height(times[i], limit) >= 0, will_be = height(times[i + 1], limit) >= 0;
    if (!is_up && !will_be) continue;
    const double begin = is_up ? times[i] : crossing(times[i], times[i + 1], limit);
    const double end = will_be ? times[i + 1] : crossing(times[i], times[i + 1], limit);
    if (!spans.empty() && spans.back().end == begin) spans.back().end = end;
    else spans.push_back({begin, end});
  }
  return spans;
}

std::optional<double> SunTrack::transit() const {
  const double turn = 360.9856;  // per day
  double moment = span_.begin - hour_angle(place_, view(span_.begin)) / turn;
  if (moment < span_.begin) moment += 360 / turn;
  for (int i = 0; i < 4; ++i) {
    const double back = hour_angle(place_, view(moment));
    moment -= back / turn;
  }
  if (moment < span_.begin || moment >= span_.end) return std::nullopt;
  return moment;
}

SunTrack track_of(const SunPlace& place, DayNumber day) {
  return {place, {moment_of(place, day, 0), moment_of(place, day + 1, 0)}};
}

SunDay sun_day(const SunPlace& place, DayNumber day) {
  const SunTrack track = track_of(place, day);
  SunDay result;
  const auto clock = [&](double moment) { return clock_at(place, day, moment); };
  for (const SunSpan& span : track.above(kHorizon)) {
    result.day_length += (span.end - span.begin) * kDay;
    if (span.begin > track.span().begin && !result.sunrise) result.sunrise = clock(span.begin);
    if (span.end < track.span().end) result.sunset = clock(span.end);
  }
  if (const auto transit = track.transit()) {
    result.transit = clock(*transit);
    result.transit_altitude = track.position(*transit).altitude;
  }
  return result;
}

Result<std::vector<SunMoment>> sun_moments(const SunPlace& place, const SunPeriod& period) {
  if (period.last < period.first)
    return Error{ErrorCode::out_of_range, "last_date", "the last day is before the first: exchange them"};
  if (!(period.from_time < period.to_time))
    return Error{ErrorCode::out_of_range, "to_time",
                 "no sun would count: the window of the day has to end after it begins, which is " +
                     fixed(period.from_time / 3600, 2) + " h after midnight; exchange the two, or take an earlier `from_time`"};
  const auto days = (period.last - period.first) / std::max(1, period.day_step) + 1;
  const double steps = kDay / std::max(1.0, period.step);
  constexpr double kMost = 100000;
  if (static_cast<double>(days) * steps > kMost)
    return Error{ErrorCode::out_of_range, "step",
                 "more than 100000 moments would be looked at: take a longer step, or leave out more days"};
  std::vector<SunMoment> moments;
  for (DayNumber day = period.first; day <= period.last; day += std::max(1, period.day_step)) {
    const SunTrack track = track_of(place, day);
    const std::vector<SunSpan> spans = track.above(period.lowest_altitude);
    const double first = std::max(track.span().begin, moment_of(place, day, period.from_time));
    const double last = std::min(track.span().end, moment_of(place, day, period.to_time));
    const double step = period.step / kDay;
    for (std::int64_t k = 0; track.span().begin + static_cast<double>(k) * step < last; ++k) {
      const double begin = track.span().begin + static_cast<double>(k) * step, end = begin + step;
      for (const SunSpan& span : spans) {
        const double from = std::max({begin, span.begin, first}), to = std::min({end, span.end, last});
        if (!((to - from) * kDay > 1e-3)) continue;  // what rounding leaves between two borders
        SunMoment& moment = moments.emplace_back();
        moment.moment = 0.5 * (from + to);
        const SunPosition sun = track.position(moment.moment);
        moment.altitude = sun.altitude;
        moment.toward = scene_direction(place, sun.azimuth, sun.altitude);
        moment.seconds = (to - from) * kDay / static_cast<double>(days);
      }
    }
  }
  return moments;
}

double possible_sun(std::span<const SunMoment> moments) {
  double sum = 0;
  for (const SunMoment& moment : moments) sum += moment.seconds;
  return sum;
}

}  // namespace bl::sun
