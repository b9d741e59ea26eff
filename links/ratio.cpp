// Ties the demand of one volume to the volume that another one has.
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Ratio {
  struct In {
    double ratio = 1;
  };
  struct Ends {
    double volume = 0;
  };
  struct Out {
    double demand = 0;
  };

  static void declare(LinkBuilder<Ratio>& l) {
    l.family(LinkFamily::numbers);
    l.id("ratio").label("Ratio").doc("Makes the demand of one volume a multiple of the volume that another one has reached.");
    l.param(&In::ratio, "ratio").unit(Unit::ratio).min(0).soft(0, 4).doc("The demand as a multiple of the other volume.");
    l.reads(&Ends::volume, End::from, "smart_volume.volume", Unit::cubic_metre);
    l.proposes(&Out::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) { return Out{in.ratio * ends.volume}; }
};

}  // namespace

}  // namespace bl

BL_LINK(ratio, Ratio)
