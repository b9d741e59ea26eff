// Brings a node in line with another one: on a shared coordinate, or on a grid around it.
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/mathematics.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Align {
  enum class Mode { x, y, z, grid };
  struct In {
    Mode mode = Mode::x;
    double module = 8.1, angle = 0, stiffness = 0.2;
  };
  struct Ends {
    Point3 from, to;
  };
  struct Out {
    Vector3 to;
  };

  static void declare(LinkBuilder<Align>& l) {
    l.family(LinkFamily::order);
    l.id("align").label("Align").doc(
        "Moves a node in line with another one, which stays where it is. Either both share one coordinate, or the node moves to "
        "the nearest point of a square grid in plan around the other one.");
    l.param(&In::mode, "mode",
            {{Mode::x, "x", "Both nodes share their x: they stand on one line across it."},
             {Mode::y, "y", "Both nodes share their y: they stand on one line across it."},
             {Mode::z, "z", "Both nodes share their height."},
             {Mode::grid, "grid", "The node moves to the nearest point of a grid around the other one; heights do not change."}})
        .doc("What the two nodes share.");
    l.param(&In::module, "module").unit(Unit::metre).min(0.01).soft(0.6, 20).doc("The spacing of the grid.");
    l.param(&In::angle, "angle")
        .unit(Unit::degree)
        .soft(-90, 90)
        .range(-360, 360)
        .doc("Angle of the grid from the x axis, counter-clockwise seen from above.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the deviation that is corrected in one tick.");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::to, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Vector3 error = ends.from - ends.to;
    switch (in.mode) {
      case Mode::x: return Out{Vector3{error.x, 0, 0} * in.stiffness};
      case Mode::y: return Out{Vector3{0, error.y, 0} * in.stiffness};
      case Mode::z: return Out{Vector3{0, 0, error.z} * in.stiffness};
      case Mode::grid: break;
    }
    const double turn = in.angle * std::numbers::pi / 180;
    const Vector3 along{mathematics::cosine(turn), mathematics::sine(turn), 0}, across{-along.y, along.x, 0};
    const Vector3 wanted = along * to_line(dot(error, along), in.module) + across * to_line(dot(error, across), in.module);
    return Out{wanted * in.stiffness};
  }

 private:
  // The distance to the nearest grid line, where one grid line is `distance` away.
  static double to_line(double distance, double module) { return distance - module * std::floor(distance / module + 0.5); }
};

}  // namespace

}  // namespace bl

BL_LINK(align, Align)
