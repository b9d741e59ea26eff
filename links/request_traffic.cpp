// Turns the floor area of a volume into trips of its zone.
#include <optional>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct RequestTraffic {
  struct In {
    double trips_per_100 = 12, car_share = 0.5, out_share = 0.5;
  };
  struct Ends {
    double floor_area = 0, peak_share = 0;
    std::optional<double> trips, car_share, out_share;
  };
  struct Out {
    double trips_out = 0, trips_in = 0;
  };

  static void declare(LinkBuilder<RequestTraffic>& l) {
    l.id("request_traffic").label("Request traffic");
    l.doc(
        "Computes the trips that a volume causes and proposes them to its traffic zone: its present floor area, times the daily "
        "trips of its use, times the share of the day that the traffic network puts into the hour studied. Where the volume has "
        "trips by its use, these count with their shares, and not the settings of the link.");
    l.family(LinkFamily::traffic);
    l.param(&In::trips_per_100, "trips_per_100")
        .min(0)
        .soft(0, 200)
        .doc("Trips per day and 100 m² of floor area, both ways together: about 10 for housing, 20 for offices, 100 for shops.");
    l.param(&In::car_share, "car_share").unit(Unit::ratio).range(0, 1).doc("Share of the trips that are made by car.");
    l.param(&In::out_share, "out_share")
        .unit(Unit::ratio)
        .range(0, 1)
        .doc("Share of the trips in that hour that leave: more than half for housing in the morning, less for offices.");
    l.reads(&Ends::floor_area, End::from, "smart_volume.floor_area", Unit::square_metre);
    l.reads_if_there(&Ends::trips, End::from, "use_figures.trips", Unit::count);
    l.reads_if_there(&Ends::car_share, End::from, "use_figures.car_share", Unit::ratio);
    l.reads_if_there(&Ends::out_share, End::from, "use_figures.out_share", Unit::ratio);
    l.reads(&Ends::peak_share, End::to, "traffic_network.peak_share", Unit::ratio);
    l.proposes(&Out::trips_out, End::from, "traffic_zone.trips_out", Unit::per_hour);
    l.proposes(&Out::trips_in, End::from, "traffic_zone.trips_in", Unit::per_hour);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    // A use without a figure for trips leaves them to the link.
    const bool has_use = ends.trips.value_or(0) > 0;
    const double daily = has_use ? *ends.trips : ends.floor_area / 100 * in.trips_per_100;
    const double trips = daily * (has_use ? *ends.car_share : in.car_share) * ends.peak_share;
    const double out_share = has_use ? *ends.out_share : in.out_share;
    return Out{trips * out_share, trips * (1 - out_share)};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(request_traffic, RequestTraffic)
