// A clock: the time of day in the scene, which passes by a set amount in each tick.
#include <algorithm>
#include <cmath>

#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

constexpr double kDayLength = 86400;  // [s]
constexpr double kMostPassed = 1e15;  // [s]: beyond it a day is no longer told from the next

struct Clock {
  // The time that has passed since `begun`, the start that it counts from. It is a memory and no multiple of the tick's number: a
  // clock that is stopped, or runs at another pace, goes on from where it is.
  struct Memory {
    double passed = 0, begun = -1;
  };
  struct In {
    double start = 21600, step = 120, runs_for = kDayLength;
    bool is_running = true;
    Memory last;
  };
  struct Out {
    double time_of_day = 0, share = 0;
    std::int64_t day = 0;
    bool has_ended = false;
    Memory kept;
  };

  static void declare(TypificationBuilder<Clock>& t) {
    t.id("clock").label("Clock");
    t.column(CanvasColumn::first).icon(Icon::step);
    t.doc(
        "The time of day in the scene. It passes in every tick while the clock runs. Links carry it to the sun, or make demand, "
        "traffic and light follow the hours.");
    t.in(&In::start, "start")
        .unit(Unit::second)
        .range(0, kDayLength)
        .doc("Time of day at which the clock starts, since midnight. A new start sets the clock back to it.");
    t.in(&In::step, "step").unit(Unit::second).range(0, kDayLength).soft(0, 3600).doc("How much time passes in one tick.");
    t.in(&In::runs_for, "runs_for")
        .unit(Unit::second)
        .min(0)
        .soft(0, 604800)
        .doc("How long the clock runs; then it stops, and the scene can come to rest. 0: it runs on without end.");
    t.in(&In::is_running, "is_running").doc("Off: the time stands still. On again, it goes on from there.");
    t.out(&Out::time_of_day, "time_of_day").traced().shown_first().unit(Unit::second).doc("Time since midnight.");
    t.out(&Out::share, "share").unit(Unit::ratio).doc("The share of the day that has passed, from 0 at midnight to 1.");
    t.out(&Out::day, "day").shown_first().unit(Unit::count).doc("How many midnights have passed since the start.");
    t.out(&Out::has_ended, "has_ended").doc("On once the clock has run for as long as it should.");
    t.memory(&Out::kept, &In::last, &Memory::passed, "passed")
        .unit(Unit::second)
        .doc("The time that has passed since the start.");
    t.memory(&Out::kept, &In::last, &Memory::begun, "begun").unit(Unit::second).doc("The start that this time counts from.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    Out out;
    out.kept.begun = in.start;
    const double before = std::clamp(in.last.passed, 0.0, kMostPassed);
    if (in.last.begun == in.start) out.kept.passed = before + (in.is_running ? in.step : 0);
    // A clock that ran on and is given an end now does not run backwards.
    if (in.runs_for > 0) out.kept.passed = std::min(out.kept.passed, std::max(in.runs_for, before));
    out.has_ended = in.runs_for > 0 && out.kept.passed >= in.runs_for;
    const double time = in.start + out.kept.passed;
    out.time_of_day = std::fmod(time, kDayLength);
    out.share = out.time_of_day / kDayLength;
    out.day = static_cast<std::int64_t>(time / kDayLength);
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(clock, Clock)
