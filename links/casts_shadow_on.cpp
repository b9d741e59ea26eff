// Says that a caster's shadow counts for a receiver: the receiver then looks at the casters that are linked to it, and at no
// others.
#include <string>
#include <vector>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct CastsShadowOn {
  struct In {};
  struct Ends {
    std::string id;
    bool casts = true;
  };
  struct Out {
    std::vector<std::string> casters;
  };

  static void declare(LinkBuilder<CastsShadowOn>& l) {
    l.id("casts_shadow_on")
        .label("Casts shadow on")
        .doc(
            "Says whose shadow counts for a receiver. Without such a link all casters of the study count; with one or more, "
            "those "
            "that are linked, and the receiver's table of losses then tells what each of these pairs costs in sun.");
    l.family(LinkFamily::sun);
    l.reads(&Ends::id, End::from, "node.id").reads(&Ends::casts, End::from, "shadow_caster.casts");
    l.proposes(&Out::casters, End::to, "shadow_receiver.casters");
  }

  // A caster that is switched off stays named: else the last link would let all others in.
  static Result<Out> evaluate(const In&, const Ends& ends, const Tick&) { return Out{{ends.id}}; }
};

}  // namespace

}  // namespace bl

BL_LINK(casts_shadow_on, CastsShadowOn)
