// Makes a building of several volumes: they share one footprint, storey by storey.
#include <string>
#include <vector>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct ShareFootprint {
  struct In {};
  struct Ends {
    std::string id;
    int from_storeys = 0;
  };
  struct Out {
    std::vector<std::string> shares;
  };

  static void declare(LinkBuilder<ShareFootprint>& l) {
    l.family(LinkFamily::order);
    l.id("share_footprint")
        .label("Share footprint")
        .doc(
            "Makes one building of several volumes. The second volume shares the footprint of the first, the host: the footprint "
            "is "
            "fitted to what all want together, and each gets floors from the ground up, in the order of the port `order`. A host "
            "shares no footprint itself.");
    l.reads(&Ends::id, End::from, "node.id").reads(&Ends::from_storeys, End::from, "footprint.storeys_built");
    l.proposes(&Out::shares, End::to, "footprint.shares");
  }

  static Result<Out> evaluate(const In&, const Ends& ends, const Tick&) { return Out{{ends.id}}; }
};

}  // namespace

}  // namespace bl

BL_LINK(share_footprint, ShareFootprint)
