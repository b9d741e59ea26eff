// Holds the sum of a statistic under a cap by limiting the demands of a whole set in one proportion.
#include <optional>
#include <string>

#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"

namespace bl {

namespace {

struct SetCap {
  struct In {
    double cap = 10000, gain = 0.2, tolerance = 0.01, least = 0.2;
  };
  struct Ends {
    double total = 0;
    All<std::string> ids;
    All<double> demands, limits, wanted, volumes;
    All<bool> locked;
  };
  struct Out {
    All<std::optional<double>> limits;
  };

  static void declare(LinkBuilder<SetCap>& l) {
    l.family(LinkFamily::numbers);
    l.id("set_cap").label("Set cap").doc(
        "Holds the sum of a statistic under a cap. While the sum is too large, the demands of all volumes of the set are limited "
        "in one proportion. When there is room again, the limit rises in the same way, up to what each volume wants. Just below "
        "the cap the limit stays as it is. The statistic should count the same volumes.");
    l.param(&In::cap, "cap")
        .min(0.001)
        .soft(100, 100000)
        .doc(
            "The largest sum allowed, in the unit of the statistic: cubic metres where it adds up volumes, square metres where "
            "it adds up floor areas.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc(
            "Gain: how strongly the limit changes with the deviation of the sum in one tick. Volumes follow some ticks later, so "
            "that large gains oscillate.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.0001, 0.5)
        .soft(0.005, 0.05)
        .doc(
            "Dead band: the limit stays as it is while the sum is below the cap by no more than this share of it. The band must "
            "be wider than the errors of volumes (the solver's tolerance), or the limit never settles.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc(
            "Share of a demand that the cap does not take away. Where that is not enough, the link reports that the cap cannot "
            "be met.");
    l.reads(&Ends::total, End::from, "statistics.sum");
    l.reads(&Ends::ids, End::to, "node.id");
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volumes, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads_lock(&Ends::locked, End::to, "smart_volume.demand_limit");
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    Out out;
    if (!(ends.total > 0)) return out;
    const demand::LimitedVolumes held{ends.ids.values,    ends.demands.values, ends.limits.values,
                                      ends.wanted.values, ends.volumes.values, ends.locked.values};
    const demand::Cap cap{in.cap, ends.total, in.gain, in.tolerance, in.least};
    out.limits.values = limits_under_cap(held, cap);
    if (!(ends.total > in.cap)) return out;
    const std::string found = "a sum of " + demand::found_of_allowed(ends.total, in.cap, 0);
    const std::string failure = why_cap_fails(held, cap, "the cap cannot be met: " + found, "the cap");
    remark(tick, failure.empty() ? LinkRemark::at_work : LinkRemark::unmet,
           {ErrorCode::infeasible, "cap", failure.empty() ? found : failure});
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(set_cap, SetCap)
