// A shadow receiver: a rectangle that needs sun, level or on a façade, with the sun that it gets.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct ShadowReceiver {
  struct In {
    bool upright = false;
    double azimuth = 180, width = 20, depth = 20, rotation = 0, raised = 0, spacing = 2;
    double required_sun = 7200, required_share = 1;
    std::vector<std::string> casters, held_back;
  };

  struct Out {
    Vector3 half_across{10, 0, 0}, half_up{0, 10, 0};
    double area = 400;
    double sun_min = 0, sun_mean = 0, sun_max = 0, sun_possible = 0;
    double share_met = 0, sun_of_share = 0, deficit = 0;
    Table losses;
    std::int64_t columns = 0, rows = 0;
    Table map;
  };

  static void declare(TypificationBuilder<ShadowReceiver>& t) {
    t.id("shadow_receiver").label("Shadow receiver");
    t.doc(
        "A rectangle around the node's position that needs direct sun: a playground, a roof, a façade. A sun study measures the "
        "sun on a grid of points, and lists how much each caster takes.");
    declare_settings(t);
    declare_rectangle(t);
    declare_sun(t);
  }

  static void declare_settings(TypificationBuilder<ShadowReceiver>& t) {
    t.in(&In::upright, "upright")
        .doc(
            "When off, the rectangle is level and open to the sky; when on, it is a façade, which sun from behind does not "
            "reach.");
    t.in(&In::azimuth, "azimuth")
        .unit(Unit::degree)
        .range(-360, 360)
        .soft(0, 360)
        .doc("Azimuth that an upright rectangle faces, clockwise from the scene's y axis. Used where it is upright.");
    t.in(&In::width, "width").unit(Unit::metre).range(0.01, 1e4).soft(1, 100).doc("Extent along the rectangle's lower side.");
    t.in(&In::depth, "depth")
        .unit(Unit::metre)
        .range(0.01, 1e4)
        .soft(1, 100)
        .doc("Depth of a level rectangle; height of an upright one.");
    t.in(&In::rotation, "rotation")
        .unit(Unit::degree)
        .range(-360, 360)
        .soft(-90, 90)
        .doc("Rotation of a level rectangle, counter-clockwise seen from above. Used where it is level.");
    t.in(&In::raised, "raised")
        .unit(Unit::metre)
        .range(-1e4, 1e4)
        .soft(0, 30)
        .doc("Height of the middle of the rectangle above the node's position.");
    t.in(&In::spacing, "spacing")
        .unit(Unit::metre)
        .range(0.05, 1000)
        .soft(0.5, 10)
        .doc("Largest distance between the points of the grid; it grows where there would be more than 4096 points.");
    t.in(&In::required_sun, "required_sun")
        .unit(Unit::second)
        .range(0, 86400)
        .soft(0, 36000)
        .combine(CombineRule::blend)
        .doc("Direct sun per day that points should have.");
    t.in(&In::required_share, "required_share")
        .unit(Unit::ratio)
        .range(0.01, 1)
        .soft(0.1, 1)
        .doc(
            "Share of the area that should have the required sun: 1 asks for it at each point. For gardens, half of the area on "
            "21 March is common (BRE report 209).");
    t.in(&In::casters, "casters")
        .collect()
        .doc(
            "Ids of the casters that count here; all count where none is named. Links of the kind `casts_shadow_on` add to "
            "them.");
    t.in(&In::held_back, "held_back")
        .collect()
        .doc(
            "Ids of volumes that stand and have fewer storeys for the sun of this receiver. Links of the kind `solar_right` add "
            "to "
            "them, and give back only what they took for this one.");
  }

  static void declare_rectangle(TypificationBuilder<ShadowReceiver>& t) {
    t.out(&Out::half_across, "half_across").unit(Unit::metre).doc("From the middle of the rectangle to the middle of a side.");
    t.out(&Out::half_up, "half_up")
        .unit(Unit::metre)
        .doc("From the middle to the middle of the next side; the rectangle faces the cross product of the two vectors.");
    t.out(&Out::area, "area").unit(Unit::square_metre).doc("Area of the rectangle.");
  }

  static void declare_sun(TypificationBuilder<ShadowReceiver>& t) {
    t.out(&Out::sun_min, "sun_min").unit(Unit::second).doc("Direct sun per day at the point with the least.");
    t.out(&Out::sun_mean, "sun_mean").unit(Unit::second).doc("Direct sun per day, as the mean over all points.");
    t.out(&Out::sun_max, "sun_max").unit(Unit::second).doc("Direct sun per day at the point with the most.");
    t.out(&Out::sun_possible, "sun_possible").unit(Unit::second).doc("Mean direct sun per day without any caster.");
    t.out(&Out::share_met, "share_met").unit(Unit::ratio).soft(0, 1).doc("Share of the area that has at least the required sun.");
    t.out(&Out::sun_of_share, "sun_of_share")
        .unit(Unit::second)
        .doc("Direct sun per day that the required share of the area has at least.");
    t.out(&Out::deficit, "deficit")
        .unit(Unit::second)
        .doc(
            "Sun that the required share of the area lacks to the required sun, as the mean over its points: those with the most "
            "sun; 0 where each of them has enough.");
    t.out(&Out::losses, "losses")
        .column({.id = "node", .is_text = true, .default_value = std::string(), .doc = "Id of the caster."})
        .column(
            {.id = "lost", .unit = Unit::second, .doc = "Mean sun per day that the receiver would gain without this one caster."})
        .column({.id = "shared",
                 .unit = Unit::second,
                 .doc = "The caster's part of all sun per day that is lost; the parts add up to the whole loss."})
        .doc("The sun that each caster takes, in ascending id; casters that take nothing are left out.");
    t.out(&Out::columns, "columns").unit(Unit::count).doc("Points along the width.");
    t.out(&Out::rows, "rows").unit(Unit::count).doc("Points along the depth.");
    t.out(&Out::map, "map")
        .column({.id = "x", .unit = Unit::metre, .doc = "East coordinate of the point."})
        .column({.id = "y", .unit = Unit::metre, .doc = "North coordinate of the point."})
        .column({.id = "z", .unit = Unit::metre, .doc = "Height of the point."})
        .column({.id = "sun", .unit = Unit::second, .doc = "Direct sun per day there."})
        .doc("The points of the grid, row by row, with the sun of each.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(shadow_receiver, ShadowReceiver)
