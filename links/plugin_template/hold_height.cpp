// Holds a node at a wanted height above another one.
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct HoldHeight {
  struct In {
    double height = 10, stiffness = 0.2;
  };
  struct Ends {
    Point3 base, here;
  };
  struct Out {
    Vector3 move;
  };

  static void declare(LinkBuilder<HoldHeight>& l) {
    l.id("hold_height")
        .label("Hold height")
        .doc("Holds a node at a wanted height above another one. Its position in plan does not change.");
    l.param(&In::height, "height").unit(Unit::metre).soft(-50, 50).doc("How far above the other node.");
    l.param(&In::stiffness, "stiffness").unit(Unit::ratio).range(0, 1).doc("Share of the error corrected in a tick.");
    l.reads(&Ends::base, End::from, "node.position", Unit::metre);
    l.reads(&Ends::here, End::to, "node.position", Unit::metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const double missing = ends.base.z + in.height - ends.here.z;
    return Out{{0, 0, in.stiffness * missing}};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(hold_height, HoldHeight)
