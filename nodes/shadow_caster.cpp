// A shadow caster: a node whose shape shades others, with the sun that it takes from them.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct ShadowCaster {
  struct In {
    bool casts = true;
  };

  struct Out {
    double sun_lost = 0, sun_shared = 0;
    std::string worst;
    Table taken;
    std::vector<Point3> outline;
  };

  static void declare(TypificationBuilder<ShadowCaster>& t) {
    t.id("shadow_caster").label("Shadow caster");
    t.doc(
        "A role for nodes with a shape, which are SmartVolumes and existing buildings. A sun study measures the sun that the "
        "shape takes from receivers, and draws its shadow.");
    t.in(&In::casts, "casts").doc("When off, the shape casts no shadow, as if it were not built yet.");
    t.out(&Out::sun_lost, "sun_lost")
        .unit(Unit::second)
        .doc(
            "Sun per day that the receivers would gain without this one caster, as the mean over their whole area. Where two "
            "casters shade a point at once, neither of them alone takes the sun.");
    t.out(&Out::sun_shared, "sun_shared")
        .unit(Unit::second)
        .doc(
            "This caster's part of the sun per day that the receivers lose, as the mean over their whole area. At each moment "
            "all casters that shade a point share its loss equally.");
    t.out(&Out::worst, "worst").doc("Id of the receiver that it takes most sun from; empty where it takes none.");
    t.out(&Out::taken, "taken")
        .column({.id = "receiver", .is_text = true, .default_value = std::string(), .doc = "Id of the receiver."})
        .column({.id = "lost", .unit = Unit::second, .doc = "Sun per day that it would gain without this one caster."})
        .column({.id = "shared", .unit = Unit::second, .doc = "This caster's part of the sun per day that the receiver loses."})
        .doc("The sun that it takes from each receiver, in ascending id; receivers that it takes nothing from are left out.");
    t.out(&Out::outline, "outline")
        .unit(Unit::metre)
        .doc("Outline of its shadow on the study's ground at the sun's date and time: exact for convex shapes, else the hull.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(shadow_caster, ShadowCaster)
