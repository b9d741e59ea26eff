// Holds volumes to the rules of the plot that they stand on, by limiting their demands.
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/demand_limit.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/plan_ring.h"

namespace bl {

namespace {

struct PlotRules {
  struct In {
    bool hold_fsi = true, hold_gsi = true, hold_height = true;
    double gain = 0.2;
  };
  struct Ends {
    std::vector<Point3> polygon;
    double ground = 0, fsi = 0, fsi_max = 0, gsi = 0, gsi_max = 0, height_max = 0;
    All<Point3> centroids;
    All<double> demands, limits, bottoms, heights;
  };
  struct Out {
    All<std::optional<double>> limits;
  };

  static void declare(LinkBuilder<PlotRules>& l) {
    l.id("plot_rules")
        .label("Plot rules")
        .doc(
            "Turns what goes beyond the rules of a plot into tension: the demands of the volumes on it are limited in one "
            "proportion "
            "until FSI and GSI fit, and those of volumes that reach too high until they fit below the largest height. When there "
            "is room again, "
            "the limits are loosened in the same way, up to what each volume wants.");
    l.param(&In::hold_fsi, "hold_fsi").doc("When on, floor area beyond the largest FSI limits all volumes on the plot.");
    l.param(&In::hold_gsi, "hold_gsi").doc("When on, built ground beyond the largest GSI limits all volumes on the plot.");
    l.param(&In::hold_height, "hold_height")
        .doc("When on, a volume that reaches beyond the largest height is limited by itself.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc("How strongly one tick answers to an overshoot. Volumes answer some ticks later, so that large gains swing.");
    l.reads(&Ends::polygon, End::from, "plot.polygon", Unit::metre);
    l.reads(&Ends::ground, End::from, "plot.ground", Unit::metre)
        .reads(&Ends::height_max, End::from, "plot.height_max", Unit::metre);
    l.reads(&Ends::fsi, End::from, "plot.fsi", Unit::ratio).reads(&Ends::fsi_max, End::from, "plot.fsi_max", Unit::ratio);
    l.reads(&Ends::gsi, End::from, "plot.gsi", Unit::ratio).reads(&Ends::gsi_max, End::from, "plot.gsi_max", Unit::ratio);
    l.reads(&Ends::centroids, End::to, "smart_volume.centroid", Unit::metre);
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::bottoms, End::to, "smart_volume.bottom", Unit::metre)
        .reads(&Ends::heights, End::to, "smart_volume.height", Unit::metre);
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Out out;
    const std::size_t count = ends.demands.values.size();
    out.limits.values.resize(count);
    if (ends.polygon.size() < 3) return out;
    std::vector<bool> is_on_plot;
    double share = kLeastGranted;
    for (std::size_t i = 0; i < count; ++i) {
      is_on_plot.push_back(ring_contains(ends.polygon, ends.centroids.values[i]));
      if (is_on_plot[i]) share = std::max(share, granted(ends, i));
    }
    double room = 2;
    if (in.hold_fsi) room = std::min(room, allowed(ends.fsi_max, ends.fsi));
    if (in.hold_gsi) room = std::min(room, allowed(ends.gsi_max, ends.gsi, kLittleGround));
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_on_plot[i]) continue;
      // All volumes of the plot have the share of the least limited one, but for those that are too high.
      double limit = share * (1 + in.gain * (room - 1));
      const double top = ends.bottoms.values[i] + ends.heights.values[i] - ends.ground;
      if (in.hold_height)
        limit = std::min(limit, granted(ends, i) * (1 + in.gain * (allowed(ends.height_max, top) - 1)));
      out.limits.values[i] = limit_that_grants(ends.demands.values[i], limit);
    }
    return out;
  }

 private:
  static double granted(const Ends& ends, std::size_t i) { return granted_share(ends.demands.values[i], ends.limits.values[i]); }

  // Of the land. Where less of it is built on, the answer is to what is missing of it rather than to its share of the little that
  // is there: small footprints come and go with the lowest part of a volume, faster than volumes can follow.
  static constexpr double kLittleGround = 0.1;

  // How many times what there is now is allowed, at most twice. Where nothing is allowed and nothing is there, all rests.
  static double allowed(double most, double now, double little = 0) {
    if (now >= little && now > 0) return std::min(most / now, 2.0);
    if (little > 0) return std::min(1 + (most - now) / little, 2.0);
    return most > 0 ? 2 : 1;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(plot_rules, PlotRules)
