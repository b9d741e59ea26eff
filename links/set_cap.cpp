// Holds the sum of a statistic under a cap by limiting the demands of a whole set in one proportion.
#include <algorithm>
#include <optional>

#include "core/base/demand_limit.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct SetCap {
  struct In {
    double cap = 10000, gain = 0.2;
  };
  struct Ends {
    double total = 0;
    All<double> demands, limits;
  };
  struct Out {
    All<std::optional<double>> limits;
  };

  static void declare(LinkBuilder<SetCap>& l) {
    l.id("set_cap").label("Set cap").doc(
        "Holds the sum of a statistic under a cap. When the sum is too large, the demands of all volumes of the set are limited "
        "in one "
        "proportion, tick by tick, until it fits; when there is room again, the limit is loosened in the same way, up to what "
        "each "
        "volume wants. The statistic should watch the same volumes.");
    l.param(&In::cap, "cap")
        .min(0.001)
        .soft(100, 100000)
        .doc(
            "The largest sum allowed, in the unit of the statistic: cubic metres where it adds up volumes, square metres where "
            "it adds up "
            "floor areas.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc(
            "How strongly one tick answers to the deviation of the sum. Volumes answer some ticks later, so that large gains "
            "swing.");
    l.reads(&Ends::total, End::from, "statistics.sum");
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Out out;
    out.limits.values.resize(ends.demands.values.size());
    if (!(ends.total > 0)) return out;
    const double answer = 1 + in.gain * (std::min(in.cap / ends.total, 2.0) - 1);
    const double share = share_granted(ends) * answer;
    for (std::size_t i = 0; i < out.limits.values.size(); ++i) out.limits.values[i] = limit_that_grants(ends.demands.values[i], share);
    return out;
  }

 private:
  // The proportion of the demands that the limits leave now: that of the least limited volume, because limits of others may
  // hold back some.
  static double share_granted(const Ends& ends) {
    double share = kLeastGranted;
    for (std::size_t i = 0; i < ends.demands.values.size(); ++i)
      share = std::max(share, granted_share(ends.demands.values[i], ends.limits.values[i]));
    return share;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(set_cap, SetCap)
