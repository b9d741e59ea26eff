// How a SmartVolume stands: the form of its footprint, its storeys, set-backs and courtyard, and the plates that it got.
#include "core/geometry/footprint.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

constexpr double kAsLowAsPossible = -1e4;  // [m]

struct Footprint {
  using Form = geometry::FootprintForm;
  struct In {
    Form form = Form::block;
    double angle = 0, aspect = 1;
    int storeys = 4, storeys_min = 1;
    double height_limit = 1e6, setback = 0, depth = 1000, ground = kAsLowAsPossible;
    double courtyard_setback = 0, wing_depth = 1000, border_distance = 0, street_distance = 0, exclusion_distance = 0;
    int full_storeys = 0, order = 0, cellar_storeys = 0;
    double cellar_height = 3;
    bool has_party_walls = true, has_border_walls = false;
    std::vector<std::string> bases, shares;
  };

  struct Out {
    int storeys_built = 0, storeys_held = 0, cellars_built = 0;
    bool is_limited = false;
    double least_room = 0, facade_area = 0, roof_area = 0, cellar_area = 0;
    Table plates, building;
    Point3 stands_at;
  };

  static void declare(TypificationBuilder<Footprint>& t) {
    t.id("footprint").label("Footprint");
    t.column(CanvasColumn::field).icon(Icon::cube);
    t.doc(
        "Lets a SmartVolume stand: whole storeys on a footprint, the part of the plot that its cell and its form leave it. A "
        "solver "
        "of standing volumes adapts its weight until the floor area of all storeys is what the volume wants.");
    declare_form(t);
    declare_sides(t);
    declare_storeys(t);
    declare_sharing(t);
    declare_cellar(t);
    declare_results(t);
  }

  static void declare_sharing(TypificationBuilder<Footprint>& t) {
    t.in(&In::shares, "shares")
        .collect()
        .doc(
            "Id of the volume whose footprint it shares; empty where it has its own. The footprint, its form, storeys, set-backs "
            "and height limits are those of that volume, the host. It is fitted to what all want together, and each gets floors "
            "from the ground up in the order of `order`. A storey that two have is cut straight across, and as high as the "
            "higher of both asks. Links of the kind `share_footprint` add to it; of several the first counts.");
    t.in(&In::order, "order")
        .range(-100, 100)
        .soft(-5, 5)
        .doc(
            "Place among the volumes that share a footprint, from the ground up. Of equal ones the host is the lowest, and then "
            "the ids decide.");
  }

  static void declare_cellar(TypificationBuilder<Footprint>& t) {
    t.in(&In::cellar_storeys, "cellar_storeys")
        .unit(Unit::count)
        .range(0, 20)
        .soft(0, 4)
        .doc(
            "Number of storeys below the ground, under the whole lowest plate and its courtyard. They are no part of the floor "
            "area that is asked for, nor of the floor space index. What stands on a roof has none.");
    t.in(&In::cellar_height, "cellar_height")
        .unit(Unit::metre)
        .range(1, 50)
        .soft(2.2, 5)
        .doc("Height from floor to floor of the storeys below the ground.");
  }

  static void declare_form(TypificationBuilder<Footprint>& t) {
    t.in(&In::form, "form",
         {{Form::round, "round", "A disc about the position."},
          {Form::block, "block", "A rectangle about the position."},
          {Form::cell, "cell", "All that the neighbours and the plot leave: walls everywhere."}})
        .doc("What bounds the footprint besides its neighbours and the plot.");
    t.in(&In::angle, "angle")
        .unit(Unit::degree)
        .range(-360, 360)
        .soft(0, 180)
        .combine(CombineRule::blend)
        .doc("Direction of a block's first side, counter-clockwise from east.");
    t.in(&In::aspect, "aspect")
        .unit(Unit::ratio)
        .range(0.05, 20)
        .soft(0.25, 4)
        .combine(CombineRule::blend)
        .doc("Length of a block's first side divided by that of its second.");
  }

  static void declare_sides(TypificationBuilder<Footprint>& t) {
    t.in(&In::depth, "depth")
        .unit(Unit::metre)
        .range(3, 1000)
        .soft(8, 40)
        .combine(CombineRule::min)
        .doc("Greatest depth of the building. What lies deeper inside is a courtyard.");
    t.in(&In::wing_depth, "wing_depth")
        .unit(Unit::metre)
        .range(3, 1000)
        .soft(4, 20)
        .combine(CombineRule::min)
        .doc(
            "Greatest depth along walls that touch neighbours or the border of the plot, where it is less than `depth`: such "
            "walls "
            "have no windows. Without effect where no walls touch. A side of the form that lies behind such a wall still keeps "
            "`depth`, so that floor areas change without a jump where walls come to touch.");
    t.in(&In::has_party_walls, "party_walls").doc("Set-backs do not hold towards neighbours: their walls touch in all storeys.");
    t.in(&In::has_border_walls, "border_walls")
        .doc("Set-backs do not hold towards the border of the plot either, but for its sides along streets: fire walls.");
    t.in(&In::border_distance, "border_distance")
        .unit(Unit::metre)
        .range(0, 1000)
        .soft(0, 10)
        .combine(CombineRule::max)
        .doc(
            "How far all storeys keep from the border of the boundary, but for its sides along streets. Ground that the boundary "
            "leaves out has `exclusion_distance`. Links of the kind `plot_rules` propose the set-back of the plot.");
    t.in(&In::street_distance, "street_distance")
        .unit(Unit::metre)
        .range(0, 1000)
        .soft(0, 10)
        .combine(CombineRule::max)
        .doc(
            "How far all storeys keep from the sides of the boundary along streets; the solver finds these sides. Streets that "
            "the "
            "boundary leaves out have `exclusion_distance`. Links of the kind `plot_rules` propose the set-back of the plot.");
    t.in(&In::exclusion_distance, "exclusion_distance")
        .unit(Unit::metre)
        .range(0, 1000)
        .soft(0, 10)
        .combine(CombineRule::max)
        .doc(
            "How far all storeys keep from the `exclusions` of the boundary: streets, water, trees, gardens, and buildings that "
            "stay. At 0 they stand at its edge. A set-back of the plot does not hold towards them.");
  }

  static void declare_storeys(TypificationBuilder<Footprint>& t) {
    t.in(&In::storeys, "storeys")
        .unit(Unit::count)
        .range(1, 500)
        .soft(1, 20)
        .doc("Number of storeys that is wished. The height limit and the boundary may leave fewer.");
    t.in(&In::storeys_min, "storeys_min")
        .unit(Unit::count)
        .range(1, 500)
        .soft(1, 10)
        .doc("Number of storeys that no height limit goes below.");
    t.in(&In::height_limit, "height_limit")
        .unit(Unit::metre)
        .range(0, 1e6)
        .soft(0, 100)
        .combine(CombineRule::min)
        .doc(
            "Greatest height above the ground or roof that it stands on; of a building that several share, on which they all "
            "stand, the least of theirs counts. Links that set limits propose here. A storey that it has taken away comes back "
            "when the limit leaves room for it and has risen by 0.15 storeys since it was least; else when it leaves room for "
            "1.15 storeys.");
    t.in(&In::bases, "bases")
        .collect()
        .doc(
            "Id of the volume on whose roof it stands; empty for the ground. Its footprint is clipped to the plate of the "
            "highest "
            "storeys there, and its own storeys begin on it. Links of the kind `stack` add to it; of several the first counts.");
    t.in(&In::ground, "ground")
        .unit(Unit::metre)
        .range(kAsLowAsPossible, 1e4)
        .soft(0, 30)
        .combine(CombineRule::blend)
        .doc(
            "Height of the ground where the volume stands, from which its storeys count; without effect on a roof. It stands "
            "no lower than the boundary. Links of the kind `terrain_follow` propose here.");
    t.in(&In::setback, "setback")
        .unit(Unit::metre)
        .range(0, 100)
        .soft(0, 5)
        .doc("How far the upper storeys lie behind the edge of the footprint.");
    t.in(&In::courtyard_setback, "courtyard_setback")
        .unit(Unit::metre)
        .range(0, 100)
        .soft(0, 5)
        .doc(
            "How far the same storeys lie behind the edge that a constant depth gives their courtyard. As much as the set-back: "
            "the walls of the courtyard are upright.");
    t.in(&In::full_storeys, "full_storeys")
        .unit(Unit::count)
        .range(0, 500)
        .soft(0, 10)
        .doc("Number of storeys from the ground up that do not set back.");
  }

  static void declare_results(TypificationBuilder<Footprint>& t) {
    t.out(&Out::storeys_built, "storeys_built").shown_first().unit(Unit::count).doc("Number of storeys that the volume has.");
    t.out(&Out::storeys_held, "storeys_held")
        .means()
        .unit(Unit::count)
        .doc(
            "Number of storeys that height limits hold: its own, or those of the whole building where others share its "
            "footprint.");
    t.out(&Out::is_limited, "is_limited").means().doc("The height limit leaves fewer storeys than are wished.");
    t.out(&Out::least_room, "least_room")
        .means()
        .unit(Unit::ratio)
        .doc(
            "Where there are fewer storeys than are wished: the least room for storeys since there have been as many as now, in "
            "storeys; else 0. More come back when the room has grown by 0.15 since.");
    t.out(&Out::stands_at, "stands_at")
        .unit(Unit::metre)
        .doc(
            "Where the volume stands: the place of its lowest plate that is nearest to its position; of a building that several "
            "share, nearest to the host's. Plots count the volumes that stand on them by it. Unlike its middle it does not move "
            "with the distance that a footprint keeps from a border.");
    t.out(&Out::facade_area, "facade_area")
        .unit(Unit::square_metre)
        .doc("Area of all walls, towards courtyards and neighbours too.");
    t.out(&Out::roof_area, "roof_area").unit(Unit::square_metre).doc("Area of all roofs, terraces included.");
    t.out(&Out::cellars_built, "cellars_built").means().unit(Unit::count).doc("Number of storeys below the ground.");
    t.out(&Out::cellar_area, "cellar_area")
        .unit(Unit::square_metre)
        .doc("Sum of the plates below the ground. It counts neither as floor area nor in the floor space index.");
    t.out(&Out::plates, "plates")
        .column({.id = "stack", .doc = "Number of the stack of equal storeys, from the ground up."})
        .column({.id = "storeys", .unit = Unit::count, .doc = "Number of storeys in the stack."})
        .column({.id = "bottom", .unit = Unit::metre, .doc = "Height of its lowest floor."})
        .column({.id = "storey_height", .unit = Unit::metre, .doc = "Height from floor to floor."})
        .column({.id = "area", .unit = Unit::square_metre, .doc = "Area of one of its plates."})
        .column({.id = "courtyard",
                 .doc = "0 where the ring bounds the plate, 1 where it bounds a courtyard, 2 where it bounds a part of a shared "
                        "plate with its part of the courtyard, as its cellar."})
        .column({.id = "centre_x", .unit = Unit::metre, .doc = "East coordinate of the centre of the ring's arcs."})
        .column({.id = "centre_y", .unit = Unit::metre, .doc = "North coordinate of that centre."})
        .column({.id = "corners",
                 .list = ListOf::numbers,
                 .default_value = Numbers(),
                 .doc =
                     "Of each corner: x and y [m], the radius of the arc that begins there or 0, and what is beyond: 0 nothing, "
                     "1 the border of the plot, 2 a neighbour."})
        .doc("The plates: one row for each ring of each stack.");
    declare_building(t);
  }

  static void declare_building(TypificationBuilder<Footprint>& t) {
    t.out(&Out::building, "building")
        .column({.id = "host", .is_text = true, .default_value = std::string(), .doc = "Id of the volume whose footprint it is."})
        .column({.id = "storeys", .unit = Unit::count, .doc = "Number of storeys that is wished."})
        .column({.id = "least", .unit = Unit::count, .doc = "Number of storeys that no height limit goes below."})
        .column({.id = "held", .unit = Unit::count, .doc = "Number of storeys that height limits hold."})
        .column(
            {.id = "storey_height",
             .unit = Unit::metre,
             .doc = "Mean height of a storey; the largest of the means that it may have with one storey less or all of them."})
        .column({.id = "bottom", .unit = Unit::metre, .doc = "Height of its lowest floor above the origin."})
        .column({.id = "top", .unit = Unit::metre, .doc = "Height of its roof above the origin."})
        .column({.id = "limit", .unit = Unit::metre, .doc = "The least height limit of the volumes that share it."})
        .column({.id = "part", .unit = Unit::ratio, .doc = "Part of this volume in the floor area that all of them ask for."})
        .column(
            {.id = "limited_by", .is_text = true, .default_value = std::string(), .doc = "Id of the volume that has this limit."})
        .doc("The building that several volumes share: one row, or none where the volume has a building of its own.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(footprint, Footprint)
