// A volume account: how much volume its node may have, and what it has bought and paid; a second role of a SmartVolume.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct VolumeAccount {
  struct In {
    double allotment = 1000, bought = 0, paid = 0;
  };
  struct Out {
    double right = 0;
  };

  static void declare(TypificationBuilder<VolumeAccount>& t) {
    t.id("volume_account").label("Volume account");
    t.doc(
        "How much volume a SmartVolume may have, as a second role of its node. Links of trade move volume between two accounts, "
        "and "
        "money the other way. What one gives, the other gets.");
    t.in(&In::allotment, "allotment")
        .unit(Unit::cubic_metre)
        .range(0, 1e9)
        .soft(0, 20000)
        .doc("The volume that it was given before any trade.");
    t.in(&In::bought, "bought")
        .unit(Unit::cubic_metre)
        .combine(CombineRule::sum)
        .doc("All that it has bought, less all that it has sold.");
    t.in(&In::paid, "paid").unit(Unit::euro).combine(CombineRule::sum).doc("All that it has paid, less all that it was paid.");
    t.out(&Out::right, "right")
        .traced()
        .shown_first()
        .unit(Unit::cubic_metre)
        .doc("The volume that it may have now: the allotment and what it has bought.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) { return Out{in.allotment + in.bought}; }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(volume_account, VolumeAccount)
