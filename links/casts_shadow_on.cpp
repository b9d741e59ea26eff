// Makes a caster's shadow count for a receiver: a receiver with such links counts the linked casters only.
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
            "Makes the shadow of a caster count for a receiver. Without such a link, all casters of the study count. With one or "
            "more, only the linked casters count, and the receiver's table of losses lists the sun that each of them takes.");
    l.family(LinkFamily::sun);
    l.reads(&Ends::id, End::from, "node.id").reads(&Ends::casts, End::from, "shadow_caster.casts");
    l.proposes(&Out::casters, End::to, "shadow_receiver.casters");
  }

  // A caster that is switched off stays in the list: with an empty list all casters would count.
  static Result<Out> evaluate(const In&, const Ends& ends, const Tick&) { return Out{{ends.id}}; }
};

}  // namespace

}  // namespace bl

BL_LINK(casts_shadow_on, CastsShadowOn)
