// A SmartVolume: a node that wants a certain volume, with the volume and shape that it got.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct SmartVolume {
  enum class Standing { ground, stack, bridge };

  struct In {
    std::string use;
    double demand = 1000, demand_limit = 1e9, demand_min = 0, by_floor_area = 0;
    double storey_height = 3.2;
    Standing standing = Standing::stack;
  };

  struct Out {
    double wanted = 0;
    double weight = 0, radius = 0;
    double volume = 0, cell_volume = 0, fitted = 0;
    double floor_area = 0, surface_area = 0, footprint = 0, spherical_area = 0;
    double height = 0, bottom = 0;
    double error = 1;
    std::string state = "idle", reason = "no solver takes care of it, or its solver fails";
    Table neighbours;
    double last_step = 0, last_direction = 0;
    Point3 centroid;
    MeshPointer mesh;
    double hang = 0, drop = 0;
    std::string stands_on;
  };

  static void declare(TypificationBuilder<SmartVolume>& t) {
    t.id("smart_volume").label("SmartVolume");
    t.column(CanvasColumn::field).icon(Icon::cube);
    t.doc(
        "A building volume that wants a certain amount of space around its position. A SmartVolumes solver gives it a cell of "
        "the bounded power diagram, cut to a ball, and adapts its weight until the shape has the wanted volume.");
    declare_settings(t);
    declare_shape(t);
    declare_standing(t);
  }

  static void declare_settings(TypificationBuilder<SmartVolume>& t) {
    t.in(&In::use, "use").doc("The use of the volume, such as `housing`; a programme finds its volumes by their use.");
    t.in(&In::demand, "demand")
        .unit(Unit::cubic_metre)
        .range(0, 1e9)
        .soft(0, 20000)
        .combine(CombineRule::blend)
        .doc("The volume that is asked for. Proposals of links are blended with the value that people set.");
    t.in(&In::demand_limit, "demand_limit")
        .unit(Unit::cubic_metre)
        .range(0, 1e9)
        .soft(0, 20000)
        .combine(CombineRule::min)
        .doc("The largest demand allowed. Links that set limits propose here, and the lowest limit applies.");
    t.in(&In::demand_min, "demand_min")
        .unit(Unit::cubic_metre)
        .range(0, 1e9)
        .soft(0, 20000)
        .combine(CombineRule::max)
        .doc("The least volume that the brief insists on. No limit brings the wanted volume below it.");
    t.in(&In::by_floor_area, "by_floor_area")
        .unit(Unit::ratio)
        .range(0, 1)
        .combine(CombineRule::max)
        .doc(
            "1: the demand is one of floor area. It is given as floor area times storey height, and the solver adapts the shape "
            "until its floor area is right, whatever volume that takes. 0: the volume itself is asked for. In between, both "
            "count in proportion. Links of the kind `demand` propose 1, because a programme asks for floor area.");
    t.in(&In::storey_height, "storey_height")
        .unit(Unit::metre)
        .range(1, 50)
        .soft(2.4, 6)
        .combine(CombineRule::blend)
        .doc("Height from floor to floor, used to compute the floor area.");
    t.in(&In::standing, "standing",
         {{Standing::ground, "ground", "It has to stand on the ground, as a garage or a supermarket does."},
          {Standing::stack, "stack", "It may also stand on other volumes, as flats do on shops."},
          {Standing::bridge, "bridge", "It may also hang between two or more volumes that stand and touch it."}})
        .doc(
            "What the volume may stand on. A volume that stands on nothing allowed is listed among the problems. It stands on "
            "another volume where the direction from that volume's position to its own rises by 27° or more.");
  }

  static void declare_shape(TypificationBuilder<SmartVolume>& t) {
    t.out(&Out::wanted, "wanted")
        .unit(Unit::cubic_metre)
        .doc(
            "The volume that the solver aims at, or floor area times storey height where floor area is asked for: the demand, at "
            "most its limit and at least its minimum.");
    t.out(&Out::weight, "weight")
        .means()
        .unit(Unit::square_metre)
        .doc("The weight in the power diagram: the square of the radius. The solver adapts it.");
    t.out(&Out::radius, "radius").means().unit(Unit::metre).doc("Radius of the ball that the cell is shrink-wrapped onto.");
    t.out(&Out::volume, "volume")
        .traced()
        .unit(Unit::cubic_metre)
        .doc("Volume of the shape: the part of the cell inside the ball.");
    t.out(&Out::fitted, "fitted")
        .means()
        .unit(Unit::cubic_metre)
        .doc(
            "What the solver compares with `wanted`: the volume, or floor area times storey height where floor area is asked "
            "for.");
    t.out(&Out::cell_volume, "cell_volume")
        .means()
        .unit(Unit::cubic_metre)
        .doc("Volume of the cell before the shrink-wrap; the cells of all volumes fill the boundary.");
    t.out(&Out::floor_area, "floor_area")
        .shown_first()
        .unit(Unit::square_metre)
        .doc(
            "Sum of the horizontal sections of the shape at the middle of each storey, from its lowest point up. What is left "
            "above the last whole storey counts by its share of a storey; a shape lower than a storey has one floor.");
    t.out(&Out::surface_area, "surface_area").unit(Unit::square_metre).doc("Area of the whole surface of the shape.");
    t.out(&Out::footprint, "footprint").unit(Unit::square_metre).doc("Area that the shape covers in plan, seen from above.");
    t.out(&Out::spherical_area, "spherical_area")
        .means()
        .unit(Unit::square_metre)
        .doc("The part of the surface that lies on the ball and so borders neither a neighbour nor the boundary.");
    t.out(&Out::height, "height")
        .shown_first()
        .unit(Unit::metre)
        .doc("Height of the shape from its lowest to its highest point.");
    t.out(&Out::bottom, "bottom").unit(Unit::metre).doc("Height of the lowest point of the shape above the origin.");
    t.out(&Out::centroid, "centroid")
        .unit(Unit::metre)
        .doc("Centre of gravity of the shape; the node's position where the shape is empty.");
    t.out(&Out::mesh, "mesh")
        .doc(
            "The shape as a closed triangle mesh, for display and export. The mesh lies within the shape, and approximates it "
            "better with a deeper tessellation of the solver.");
  }

  static void declare_standing(TypificationBuilder<SmartVolume>& t) {
    t.out(&Out::error, "error")
        .unit(Unit::ratio)
        .residual()
        .doc("Difference between `fitted` and `wanted`, as a share of `wanted`.");
    t.out(&Out::state, "state")
        .doc(
            "State of the site: `alive`, `hidden`, `outside`, `coincident` or `starved`; `idle` before a solver has evaluated "
            "it.");
    t.out(&Out::reason, "reason").doc("Why the volume is not alive, as a sentence; empty where it is.");
    t.out(&Out::neighbours, "neighbours")
        .column({.id = "node", .is_text = true, .default_value = std::string(), .doc = "Id of the volume on the other side."})
        .column({.id = "area", .unit = Unit::square_metre, .doc = "Area of the shared face, inside both balls."})
        .doc("The volumes that share a face with this one, in ascending id.");
    t.out(&Out::last_step, "last_step")
        .means()
        .unit(Unit::cubic_metre)
        .doc("The last change of the cube of the radius, which the solver keeps from tick to tick.");
    t.out(&Out::last_direction, "last_direction")
        .means()
        .unit(Unit::cubic_metre)
        .doc("The step that Newton's method is trying; the next tick accepts or rejects it.");
    t.out(&Out::stands_on, "stands_on").doc("What carries the volume: `the ground`, the id of a volume below it, or nothing.");
    t.out(&Out::hang, "hang")
        .unit(Unit::metre)
        .doc("Height of the lowest point above the ground, for a volume that stands on nothing allowed; else 0.");
    t.out(&Out::drop, "drop")
        .unit(Unit::metre)
        .doc(
            "Distance that the ball can sink until it touches what it may stand on; negative where it has sunk in by that much. "
            "A volume below can carry it from 30° of slope on, and stops carrying it below 27°, so that support at the limit "
            "does not alternate. A volume that still hangs although its ball has sunk in goes down by a quarter of what is "
            "missing, at most by a tenth of its radius.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(smart_volume, SmartVolume)
