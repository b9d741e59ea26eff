// Makes those who take most sun from a receiver give way, for as long as the receiver is short of what it needs.
#include <algorithm>
#include <optional>
#include <string>

#include "core/base/demand_limit.h"
#include "core/base/direction.h"
#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct SolarRight {
  enum class Mode { lower, move, shave };
  struct In {
    Mode mode = Mode::shave;
    double gain = 0.2, tolerance = 0.02, least = 0.2;
  };
  struct Ends {
    std::string receiver, caster;
    Point3 place, position;
    double deficit = 0, required = 0, possible = 0, least = 0;
    Shared<Table> losses;
    double demand = 0, limit = 0, radius = 0, bottom = 0;
  };
  struct Out {
    std::optional<Vector3> move;
    std::optional<double> limit;
  };

  static void declare(LinkBuilder<SolarRight>& l) {
    l.id("solar_right")
        .label("Solar right")
        .doc(
            "Defends the sun that a receiver needs. While points of it are short of it, the volumes in the way give way: the "
            "worst one most, the others in proportion to what they take, and none once the need is met. Who takes next to "
            "nothing "
            "is not held back.");
    l.param(&In::mode, "mode",
            {{Mode::lower, "lower", "The volume's position sinks, no lower than the foot of its shape: it grows wide, not high."},
             {Mode::move, "move", "The volume moves away in plan."},
             {Mode::shave, "shave", "The volume may demand less, until the receiver has its sun; then it may grow again."}})
        .doc("How a volume gives way.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc("How strongly one tick answers to what is missing: as a share of the volume's radius, height or demand.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .soft(0.005, 0.1)
        .doc("What may be missing on the mean of all points, as a share of the sun that is required.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc("Share of the demand that is not shaved off, whatever stands in the sun.");
    l.reads(&Ends::receiver, End::from, "node.id").reads(&Ends::place, End::from, "node.position", Unit::metre);
    l.reads(&Ends::deficit, End::from, "shadow_receiver.deficit", Unit::second);
    l.reads(&Ends::required, End::from, "shadow_receiver.required_sun", Unit::second);
    l.reads(&Ends::possible, End::from, "shadow_receiver.sun_possible", Unit::second);
    l.reads(&Ends::least, End::from, "shadow_receiver.sun_min", Unit::second);
    l.reads(&Ends::losses, End::from, "shadow_receiver.losses");
    l.reads(&Ends::caster, End::to, "node.id").reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.reads(&Ends::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::radius, End::to, "smart_volume.radius", Unit::metre);
    l.reads(&Ends::bottom, End::to, "smart_volume.bottom", Unit::metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
    l.proposes(&Out::limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
  }

  static constexpr double kLittle = 0.05;  // of what the worst one takes

  // What is missing beyond the tolerance, as a share of what is required; what no caster takes cannot be asked of one.
  static double shortage(const In& in, const Ends& ends) {
    const double unavoidable = std::max(0.0, ends.required - ends.possible);
    return std::clamp((ends.deficit - unavoidable) / ends.required, 0.0, 1.0) - in.tolerance;
  }

  // What even the worst point has beyond its need, as a share of the need.
  static double surplus(const Ends& ends) { return std::clamp((ends.least - ends.required) / ends.required, 0.0, 1.0); }

  // What the volume takes, as a share of what the worst one takes.
  static double share_of(const Ends& ends) {
    double own = 0, most = 0;
    for (std::size_t row = 0; row < ends.losses->rows.size(); ++row) {
      const double taken = ends.losses->number(row, "shared");
      most = std::max(most, taken);
      if (ends.losses->text(row, "node") == ends.caster) own = std::max(0.0, taken);
    }
    return most > 0 ? own / most : 0;
  }

  // Moves away from the receiver in plan; two on one point part by their names.
  static Vector3 away(const Ends& ends) {
    const Vector3 between{ends.position.x - ends.place.x, ends.position.y - ends.place.y, 0};
    const double length = norm(between);
    return length > 0 ? between / length : direction_by_name(ends.receiver, ends.caster);
  }

  // The worst one has given way as far as it has to, and still the sun is not there.
  static void tell(const In& in, const Ends& ends, const Tick& tick) {
    const double short_of = ends.deficit / 3600;
    remark(tick, LinkRemark::unmet,
           {ErrorCode::infeasible, "from",
            "cannot be met: `" + ends.receiver + "` is short of " + fixed(short_of, 2) + " h of sun, held by `" + ends.caster +
                "`, which is down to " + shortest(100 * in.least) +
                " % of its demand; lower `required_sun` or `least`, or move the volume"});
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (!(ends.required > 0)) return Out{};
    const double share = share_of(ends), missing = shortage(in, ends), answer = in.gain * std::max(0.0, missing) * share;
    if (in.mode == Mode::lower) {
      const double fall = answer * std::max(0.0, ends.position.z - ends.bottom);
      return fall > 0 ? Out{Vector3{0, 0, -fall}, {}} : Out{};
    }
    if (in.mode == Mode::move) return answer * ends.radius > 0 ? Out{away(ends) * (answer * ends.radius), {}} : Out{};
    // Between half the tolerance and all of it the limit rests, so that the last moments of sun do not make it chatter. Below
    // that it grows with the sun that is left over. Who takes little may grow nevertheless: what others limit, or limited once,
    // is not ours to hold.
    const double room = std::max({0.0, -missing - 0.5 * in.tolerance, surplus(ends), 1 - share / kLittle});
    if (missing > 0 && share >= 1 && granted_share(ends.demand, ends.limit) <= in.least * (1 + 1e-6)) tell(in, ends, tick);
    const double kept = granted_share(ends.demand, ends.limit) * (1 - answer) * (1 + in.gain * room);
    return Out{{}, limit_that_grants(ends.demand, std::max(in.least, kept))};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(solar_right, SolarRight)
