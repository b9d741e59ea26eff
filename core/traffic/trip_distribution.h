// Distributes the trips that leave zones over the zones where they end: a gravity model by travel time.
#pragma once

#include <span>
#include <vector>

namespace bl::traffic {

/// `origins`: exactly what leaves each zone; where it ends follows the attraction. `both`: what ends in each zone holds as well.
enum class TripConstraint { origins, both };

struct TripDistribution {
  std::vector<double> trips;  ///< from zone i to zone j at [i · zones + j]
  std::vector<double> lost;   ///< by origin: trips that find no destination, because nothing attracts within reach
  /// By destination, where both sides are held: trips that should end there and do not; below 0 where more end there.
  std::vector<double> missing;
  int rounds = 0;  ///< of balancing; 0 where one side alone is held
};

/// trips(i, j) = a_i · leaving_i · b_j · arriving_j · exp(-time_ij / fade) (Wilson 1967). Times that are not finite mean out of
/// reach; a zone sends nothing to itself. Where both sides are held, arriving is first scaled to the sum of leaving, and rows
/// and columns are balanced in turn (Furness) until the columns are right within `tolerance`, get no better, or 200 rounds are
/// over; the rows are exact in the end, and `missing` says what the columns lack of what was wanted, before the scaling.
TripDistribution distribute_trips(std::span<const double> times, std::span<const double> leaving,
                                  std::span<const double> arriving, double fade, TripConstraint constraint,
                                  double tolerance = 1e-9);

}  // namespace bl::traffic
