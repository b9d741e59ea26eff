// Asks a façade for more or less glass, by a curve over a number such as its hours of sun.
#include <algorithm>

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
    const Table& curve = in.curve;
    if (curve.rows.empty()) return Error{ErrorCode::missing, "curve", "the curve needs at least one point"};
    std::size_t next = 0;
    for (std::size_t row = 1; row < curve.rows.size(); ++row)
      if (!(curve.number(row, "value") > curve.number(row - 1, "value")))
        return Error{ErrorCode::out_of_range, "curve/" + std::to_string(row) + "/value",
                     "the values have to ascend: each larger than the one before"};
    while (next < curve.rows.size() && curve.number(next, "value") <= ends.value) ++next;
    if (next == 0) return Out{curve.number(0, "glazing")};
    if (next == curve.rows.size()) return Out{curve.number(next - 1, "glazing")};
    const double low = curve.number(next - 1, "value"), high = curve.number(next, "value"), share = (ends.value - low) / (high - low);
    return Out{curve.number(next - 1, "glazing") * (1 - share) + curve.number(next, "glazing") * share};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(facade_performance, FacadePerformance)
