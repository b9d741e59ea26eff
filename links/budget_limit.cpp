// Holds what a group spends under its budget by limiting the demands of a whole set in one proportion.
#include <optional>
#include <string>

#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"

namespace bl {

namespace {

struct BudgetLimit {
  struct In {
    double gain = 0.2, tolerance = 0.02, least = 0.2;
  };
  struct Ends {
    double budget = 0, spent = 0;
    All<std::string> ids;
    All<double> demands, limits, wanted, volumes;
    All<bool> locked;
  };
  struct Out {
    All<std::optional<double>> limits;
  };

  static void declare(LinkBuilder<BudgetLimit>& l) {
    l.family(LinkFamily::numbers);
    l.id("budget_limit")
        .label("Budget limit")
        .doc(
            "Holds what a group spends under its budget. While it spends too much, the demands of all volumes of the set are "
            "limited "
            "in one proportion; when there is money again, they rise in the same way, up to what each volume wants.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc("Gain: how strongly the limit changes in one tick with what is spent too much or too little.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.0001, 0.5)
        .soft(0.005, 0.05)
        .doc(
            "Dead band: the limit stays as it is while what is spent is below the budget by no more than this share. The band "
            "must be wider than the errors of volumes (the solver's tolerance).");
    l.param(&In::least, "least").unit(Unit::ratio).range(0.001, 1).doc("Share of a demand that the budget does not take away.");
    l.reads(&Ends::budget, End::from, "stakeholder_group.budget", Unit::euro);
    l.reads(&Ends::spent, End::from, "stakeholder_group.spent", Unit::euro);
    l.reads(&Ends::ids, End::to, "node.id");
    l.reads(&Ends::demands, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volumes, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads_lock(&Ends::locked, End::to, "smart_volume.demand_limit");
    l.proposes(&Out::limits, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (!(ends.budget > 0)) return Error{ErrorCode::missing, "from", "the group has no budget: set one, or take this link away"};
    Out out;
    if (!(ends.spent > 0)) return out;
    const demand::LimitedVolumes held{ends.ids.values,    ends.demands.values, ends.limits.values,
                                      ends.wanted.values, ends.volumes.values, ends.locked.values};
    const demand::Cap cap{ends.budget, ends.spent, in.gain, in.tolerance, in.least};
    out.limits.values = limits_under_cap(held, cap);
    if (!(ends.spent > ends.budget)) return out;
    const std::string found = "costs of " + demand::found_of_allowed(ends.spent, ends.budget, 0, " €");
    const std::string failure = why_cap_fails(held, cap, "the budget cannot be kept: " + found, "the budget");
    remark(tick, failure.empty() ? LinkRemark::at_work : LinkRemark::unmet,
           {ErrorCode::infeasible, "from", failure.empty() ? found : failure});
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(budget_limit, BudgetLimit)
