// Adds what something costs to what a group spends.
#include <cmath>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Cost {
  struct In {
    PortChoice source{"smart_volume.floor_area"};
    double price = 1500, fixed = 0;
  };
  struct Ends {
    double amount = 0;
  };
  struct Out {
    double spent = 0;
  };

  static void declare(LinkBuilder<Cost>& l) {
    l.family(LinkFamily::numbers);
    l.id("cost").label("Cost").doc(
        "Adds what something costs to what a group spends: a price for each square metre of floor, each metre of street, or each "
        "piece. The costs of all nodes and of all such links add up.");
    l.param(&In::source, "source").doc("The port that holds the amount, written `typification.port`.");
    l.param(&In::price, "price")
        .soft(0, 5000)
        .doc("Price in euros of one unit of the amount: of a square metre where the port holds square metres.");
    l.param(&In::fixed, "fixed").unit(Unit::euro).soft(0, 1e6).doc("What each node costs besides, whatever its amount.");
    l.reads_chosen(&Ends::amount, End::from, "source");
    l.proposes(&Out::spent, End::to, "stakeholder_group.spent", Unit::euro);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const double spent = in.fixed + in.price * ends.amount;
    if (!std::isfinite(spent))
      return Error{ErrorCode::not_finite, "price", "the cost is too large for a number: lower the price"};
    return Out{spent};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(cost, Cost)
