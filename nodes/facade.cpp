// A façade: the role of a SmartVolume whose surface a façade style designs, with the resulting areas and cost.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Facade {
  struct In {
    std::vector<std::string> style;
    double glazing = 1, ground = 0;
  };

  struct Out {
    std::string style_in_force;
    double facade_area = 0, glazed_area = 0, opaque_area = 0, roof_area = 0, shared_area = 0;
    double glazing_ratio = 0, cost = 0, panels = 0, true_north = 0;
    Table by_orientation, by_storey;
    std::string message = "no façade style looks at it: it has to be a SmartVolume, and the scene needs a node with a façade style";
  };

  static void declare(TypificationBuilder<Facade>& t) {
    t.id("facade").label("Façade");
    t.doc(
        "The façade of a SmartVolume: the parts of its surface that are steep, above the ground and not shared with a neighbour. "
        "A façade style gives it windows and writes its areas.");
    t.in(&In::style, "style")
        .collect()
        .doc(
            "Name of the style that applies. Links assign styles here; of several the first by name applies, and the façade "
            "reports it.");
    t.in(&In::glazing, "glazing")
        .unit(Unit::ratio)
        .range(0, 10)
        .soft(0, 2)
        .combine(CombineRule::blend)
        .doc("Factor on the glazing ratios of the style; 1 leaves them as they are. Links may ask for more or less glass.");
    t.in(&In::ground, "ground")
        .unit(Unit::metre)
        .range(-1e4, 1e4)
        .soft(-10, 10)
        .doc("Height of the ground. Surface below it does not count as façade, and surface on it does not count as underside.");
    declare_areas(t);
  }

  static void declare_areas(TypificationBuilder<Facade>& t) {
    t.out(&Out::style_in_force, "style_in_force").doc("Name of the style that was applied; empty where none was.");
    t.out(&Out::facade_area, "facade_area").unit(Unit::square_metre).doc("Area of the façade: glazed and opaque together.");
    t.out(&Out::glazed_area, "glazed_area").unit(Unit::square_metre).doc("Area of glass.");
    t.out(&Out::opaque_area, "opaque_area").unit(Unit::square_metre).doc("Area of wall.");
    t.out(&Out::roof_area, "roof_area").unit(Unit::square_metre).doc("Surface flatter than 45 degrees that faces up.");
    t.out(&Out::shared_area, "shared_area").unit(Unit::square_metre).doc("Surface that neighbours cover.");
    t.out(&Out::glazing_ratio, "glazing_ratio").unit(Unit::ratio).soft(0, 1).doc("Glazed share of the façade; 0 where there is none.");
    t.out(&Out::cost, "cost").unit(Unit::euro).doc("Cost of the façade by the prices of its style.");
    t.out(&Out::panels, "panels").unit(Unit::count).doc("Number of modules, one storey high; parts of modules count as parts.");
    t.out(&Out::true_north, "true_north")
        .unit(Unit::degree)
        .doc("True north according to the style, clockwise from the scene's y axis.");
    const auto number = [](const char* id, Unit unit, const char* doc) { return ColumnDefinition{.id = id, .unit = unit, .doc = doc}; };
    t.out(&Out::by_orientation, "by_orientation")
        .column({.id = "orientation", .is_text = true, .default_value = std::string(), .doc = "Orientation of this part."})
        .column(number("area", Unit::square_metre, "Area of the façade."))
        .column(number("glazed", Unit::square_metre, "Area of glass."))
        .column(number("opaque", Unit::square_metre, "Area of wall."))
        .column(number("cost", Unit::euro, "Cost."))
        .column(number("module", Unit::metre, "Width of a window with its pier."))
        .column(number("sill", Unit::metre, "Height of the sill above the floor."))
        .column(number("head", Unit::metre, "Height of the windows' upper edge above the floor."))
        .column(number("width", Unit::ratio, "Width of a window as a share of its module."))
        .doc("Areas for each of the eight orientations, clockwise from north, with the windows that are drawn there.");
    t.out(&Out::by_storey, "by_storey")
        .column(number("storey", Unit::count, "Number of the storey; the lowest of the volume is 0."))
        .column(number("area", Unit::square_metre, "Area of the façade."))
        .column(number("glazed", Unit::square_metre, "Area of glass."))
        .column(number("opaque", Unit::square_metre, "Area of wall."))
        .column(number("cost", Unit::euro, "Cost."))
        .doc("Areas for each storey that has a façade.");
    t.out(&Out::message, "message").doc("What is unclear or impossible, as a sentence; empty where there is no problem.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(facade, Facade)
