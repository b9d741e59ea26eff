// An indicator: one number with a goal, and how far the number is from it.
#include <algorithm>
#include <cmath>

#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

constexpr double kUsualTolerance = 0.01;  // of the span

struct Indicator {
  enum class Direction { at_least, at_most, near };
  enum class Status { met, close, far };
  struct In {
    double value = 0, target = 0, tolerance = 0, span = 0;
    Direction direction = Direction::at_least;
    std::string unit, formula;
  };
  struct Out {
    double gap = 0, score = 0, pressure = 0;
    Status status = Status::far;
  };

  static void declare(TypificationBuilder<Indicator>& t) {
    t.id("indicator").label("Indicator");
    t.column(CanvasColumn::second).icon(Icon::balance);
    t.doc(
        "A number that people have agreed to look at, with a goal: floor area at least 40 000 m², cost at most 30 million. Links "
        "bring the number; a goal pressure may act on the scene until the goal is met.");
    t.in(&In::value, "value")
        .unit_from("unit")
        .combine(CombineRule::blend)
        .keeps_default()
        .doc("The number, proposed by links or set by people.");
    t.in(&In::unit, "unit")
        .doc("Unit of the number as a symbol, such as `m`, `m2`, `m3`, `s` or `EUR`; empty for a plain number.");
    t.in(&In::target, "target").unit_from("unit").doc("The number that is aimed at.");
    t.in(&In::direction, "direction",
         {{Direction::at_least, "at_least", "The number should reach the target or exceed it."},
          {Direction::at_most, "at_most", "The number should not exceed the target."},
          {Direction::near, "near", "The number should be the target, neither more nor less."}})
        .doc("On which side of the target the number should be.");
    t.in(&In::tolerance, "tolerance")
        .unit_from("unit")
        .min(0)
        .doc("How far the number may be on the wrong side of the target and still meet it. 0: a hundredth of `span`.");
    t.in(&In::span, "span")
        .unit_from("unit")
        .min(0)
        .doc("The distance from the goal at which the score is 0. 0: as large as the target, or 1 where that is 0.");
    t.in(&In::formula, "formula").doc("How the number is worked out, in words, for those who see the indicator.");
    t.out(&Out::score, "score")
        .traced()
        .shown_first()
        .unit(Unit::ratio)
        .doc("1 where the goal is met; it falls evenly to 0 at the distance `span` from it.");
    t.out(&Out::status, "status",
          {{Status::met, "met", "The goal is met."},
           {Status::close, "close", "The goal is missed, and the score is 0.5 or more."},
           {Status::far, "far", "The score is below 0.5."}})
        .shown_first()
        .doc("Whether the goal is met, in a word.");
    t.out(&Out::gap, "gap")
        .unit_from("unit")
        .doc("By how much the number has to grow to reach the target, negative where it has to fall; 0 where the goal is met.");
    t.out(&Out::pressure, "pressure")
        .unit(Unit::ratio)
        .doc("The gap as a share of `span`, from -1 to 1: what a goal pressure acts on.");
  }

  static double span_of(const In& in) {
    if (in.span > 0) return in.span;
    return in.target != 0 ? std::abs(in.target) : 1;
  }

  // Met within a band, and asked for at the target itself: a pressure that ended at the edge of the band would only approach it.
  static Result<Out> evaluate(const In& in, const Tick&) {
    if (const auto unit = stored_unit(in.unit); !unit) return unit.error().within("unit");
    Out out;
    const double span = span_of(in), tolerance = in.tolerance > 0 ? in.tolerance : kUsualTolerance * span;
    const double missing = in.target - in.value;
    const bool is_too_small = in.direction != Direction::at_most && missing > tolerance,
               is_too_large = in.direction != Direction::at_least && missing < -tolerance;
    if (!is_too_small && !is_too_large) {
      out.score = 1;
      out.status = Status::met;
      return out;
    }
    out.gap = missing;
    out.pressure = std::clamp(missing / span, -1.0, 1.0);
    out.score = 1 - std::abs(out.pressure);
    out.status = out.score >= 0.5 ? Status::close : Status::far;
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(indicator, Indicator)
