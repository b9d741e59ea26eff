// Asks a façade for more or less glass, by a curve over a number such as its hours of sun.
#include "core/define/curve.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct FacadePerformance {
  struct In {
    PortChoice source{"control.output"};
    Table curve{{"value", "glazing"}, {{0.0, 1.4}, {14400.0, 1.0}, {28800.0, 0.6}}};
  };
  struct Ends {
    double value = 0;
  };
  struct Out {
    double glazing = 1;
  };

  static void declare(LinkBuilder<FacadePerformance>& l) {
    l.id("facade_performance")
        .label("Façade performance")
        .doc(
            "Asks a façade for more or less glass according to its performance. A curve gives the factor on the glazing ratios "
            "of its style for any number, such as the seconds of sun on a receiver.");
    l.family(LinkFamily::facades);
    l.param(&In::source, "source").doc("The port that is read, written `typification.port`.");
    l.param(&In::curve, "curve")
        .column({.id = "value", .is_required = true, .doc = "The number at the source, in its unit."})
        .column({.id = "glazing",
                 .is_required = true,
                 .unit = Unit::ratio,
                 .default_value = 1.0,
                 .minimum = 0,
                 .maximum = 10,
                 .doc = "The factor that is asked for there."})
        .doc(
            "Points of the curve with ascending values. The curve is linear between them and constant beyond the first and the "
            "last.");
    l.reads_chosen(&Ends::value, End::from, "source");
    l.proposes(&Out::glazing, End::to, "facade.glazing", Unit::ratio);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Curve curve{in.curve, "value", "glazing"};
    if (auto sound = check_curve(curve, "curve"); !sound) return sound.error();
    return Out{value_on(curve, ends.value)};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(facade_performance, FacadePerformance)
