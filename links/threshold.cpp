// Switches a number between two values when another number crosses a limit.
#include <cmath>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Threshold {
  struct In {
    PortChoice source{"statistics.sum"}, target{"smart_volume.demand_limit"};
    double limit = 0, band = 0, below = 0, above = 1;
  };
  struct Ends {
    double value = 0, present = 0;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<Threshold>& l) {
    l.family(LinkFamily::numbers);
    l.id("threshold")
        .label("Threshold")
        .doc(
            "Switches a number when another one crosses a limit: a second stop once two thousand people live there, a lower "
            "ceiling "
            "once the sum is reached. It switches on above the limit, and off below the limit by the band.");
    l.param(&In::source, "source").doc("The port that is watched, written `typification.port`.");
    l.param(&In::target, "target").doc("The port that is switched, written `typification.port`. Nobody else should change it.");
    l.param(&In::limit, "limit").unit_from("source").doc("The limit that the watched number crosses.");
    l.param(&In::band, "band")
        .unit_from("source")
        .min(0)
        .doc(
            "Hysteresis: how far the number has to fall below the limit before the link switches off. Without a band, a number "
            "that the switched one acts upon may swing across the limit for ever.");
    l.param(&In::below, "below").unit_from("target").doc("The value that the target gets while the link is off.");
    l.param(&In::above, "above").unit_from("target").doc("The value that the target gets while the link is on.");
    l.reads_chosen(&Ends::value, End::from, "source");
    l.reads_chosen(&Ends::present, End::to, "target");
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (in.above == in.below)
      return Error{
          ErrorCode::conflict, "above",
          "the values for above and below the limit are the same (" + shortest(in.above) + "): give them different values"};
    if (ends.value > in.limit) return Out{in.above};
    // Exactly at the limit it is off, also without a band.
    if (ends.value < in.limit - in.band || in.band == 0) return Out{in.below};
    // Links have no memory: within the band the target tells which of the two values it was given last.
    const bool was_on = std::abs(ends.present - in.above) < std::abs(ends.present - in.below);
    return Out{was_on ? in.above : in.below};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(threshold, Threshold)
