// A street junction: where streets meet, and where volumes have their access to the streets.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Junction {
  struct In {
    double delay = 0;
  };
  struct Out {
    std::int64_t streets = 0;
    double flow = 0, volume_over_capacity = 0;
  };

  static void declare(TypificationBuilder<Junction>& t) {
    t.id("junction").label("Street junction");
    t.doc(
        "A place where streets meet. A volume may be a junction as well, and is then part of the street network. Its figures "
        "come "
        "from the traffic network that it belongs to.");
    t.in(&In::delay, "delay")
        .unit(Unit::second)
        .range(0, 3600)
        .soft(0, 60)
        .combine(CombineRule::blend)
        .doc("Time that each vehicle loses on arriving here by a street: at a signal, or in giving way.");
    t.out(&Out::streets, "streets").unit(Unit::count).doc("Number of streets that begin or end here.");
    t.out(&Out::flow, "flow").unit(Unit::per_hour).doc("Vehicles per hour that arrive by all streets together.");
    t.out(&Out::volume_over_capacity, "volume_over_capacity")
        .unit(Unit::ratio)
        .doc("Largest volume over capacity of the streets here; above 1 a street is overloaded.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(junction, Junction)
