// A plot with its building rules, and by how much the volumes on it exceed them.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/plates_table.h"
#include "core/geometry/plot_measure.h"

namespace bl {

namespace {

struct Plot {
  struct In {
    std::vector<Point3> polygon = {{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}};
    Selection volumes{{}, "smart_volume", {}};
    double ground = 0, fsi_max = 100, gsi_max = 1, height_max = 10000, setback = 0;
  };
  struct Member {
    std::string id, stands_on;
    Point3 position, centroid;
    double floor_area = 0, footprint = 0, bottom = 0, height = 0, storey_height = 3.2, volume = 0;
  };
  struct Standing {
    std::string id;
    Table plates;
    Point3 stands_at;
    double ground = 0;
  };
  struct Sets {
    std::vector<Member> volumes;
    std::vector<Standing> standing;
  };
  struct Out {
    std::int64_t count = 0;
    double area = 0, floor_area = 0, footprint = 0, fsi = 0, gsi = 0, osr = 0, layers = 0, top = 0;
    double floor_overshoot = 0, footprint_overshoot = 0, height_overshoot = 0, setback_overshoot = 0, overshoot = 0;
    std::string message;
  };

  static void declare(TypificationBuilder<Plot>& t) {
    t.id("plot").label("Plot");
    t.doc(
        "A piece of land with the rules for building on it. It counts the volumes that stand within its polygon, and the rounded "
        "ones whose centre of gravity lies there. "
        "FSI is floor area over land, GSI built ground over land, OSR open ground over floor area, L floor area over built "
        "ground "
        "(Berghauser Pont and Haupt 2010).");
    t.in(&In::polygon, "polygon").unit(Unit::metre).doc("Corners of the plot, in order around it; their heights are ignored.");
    t.in(&In::volumes, "volumes").doc("The volumes that may stand on the plot; those outside its polygon are left out.");
    t.in(&In::ground, "ground").unit(Unit::metre).range(-1e4, 1e5).soft(-20, 50).doc("Height of the ground above the origin.");
    t.in(&In::fsi_max, "fsi_max")
        .unit(Unit::ratio)
        .range(0, 100)
        .soft(0, 10)
        .combine(CombineRule::min)
        .doc("The largest FSI allowed.");
    t.in(&In::gsi_max, "gsi_max").unit(Unit::ratio).range(0, 1).combine(CombineRule::min).doc("The largest GSI allowed.");
    t.in(&In::height_max, "height_max")
        .unit(Unit::metre)
        .range(0, 10000)
        .soft(3, 200)
        .combine(CombineRule::min)
        .doc(
            "The largest height above the ground allowed. For a volume that stands on ground above that of the plot, as on a "
            "slope, it counts from there.");
    t.in(&In::setback, "setback")
        .unit(Unit::metre)
        .range(0, 1000)
        .soft(0, 20)
        .doc("Least distance of volumes from the sides of the plot.");
    declare_results(t);
    auto set = t.set("volumes", &Sets::volumes);
    set.reads(&Member::id, "node.id").reads(&Member::position, "node.position", Unit::metre);
    set.reads(&Member::centroid, "smart_volume.centroid", Unit::metre)
        .reads(&Member::floor_area, "smart_volume.floor_area", Unit::square_metre);
    set.reads(&Member::footprint, "smart_volume.footprint", Unit::square_metre)
        .reads(&Member::bottom, "smart_volume.bottom", Unit::metre);
    set.reads(&Member::height, "smart_volume.height", Unit::metre)
        .reads(&Member::storey_height, "smart_volume.storey_height", Unit::metre);
    set.reads(&Member::volume, "smart_volume.volume", Unit::cubic_metre).reads(&Member::stands_on, "smart_volume.stands_on");
    auto standing = t.set("volumes", &Sets::standing);  // those of the volumes that have plates
    standing.reads(&Standing::id, "node.id").reads(&Standing::plates, "footprint.plates");
    standing.reads(&Standing::stands_at, "footprint.stands_at", Unit::metre);
    standing.reads(&Standing::ground, "footprint.ground", Unit::metre);
  }

  static void declare_results(TypificationBuilder<Plot>& t) {
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of volumes on the plot.");
    t.out(&Out::area, "area").unit(Unit::square_metre).doc("Area of the plot.");
    t.out(&Out::floor_area, "floor_area").unit(Unit::square_metre).doc("Floor area of the volumes on the plot.");
    t.out(&Out::footprint, "footprint")
        .unit(Unit::square_metre)
        .doc(
            "Built ground: the footprints of the volumes that stand on the ground. Rounded ones count where they begin within "
            "the lowest storey; one that begins in the upper half of that storey counts less, the higher it begins.");
    t.out(&Out::fsi, "fsi").unit(Unit::ratio).doc("Floor space index: floor area over the area of the plot.");
    t.out(&Out::gsi, "gsi").unit(Unit::ratio).soft(0, 1).doc("Ground space index: built ground over the area of the plot.");
    t.out(&Out::osr, "osr").unit(Unit::ratio).doc("Open space ratio, (1 - GSI) / FSI; 0 where nothing is built.");
    t.out(&Out::layers, "layers").unit(Unit::ratio).doc("Mean number of storeys, FSI / GSI; 0 where no ground is built on.");
    t.out(&Out::top, "top")
        .unit(Unit::metre)
        .doc("Height of the highest volume above the ground, or above that on which it stands where this is higher.");
    t.out(&Out::floor_overshoot, "floor_overshoot").unit(Unit::square_metre).doc("Floor area beyond the largest FSI.");
    t.out(&Out::footprint_overshoot, "footprint_overshoot").unit(Unit::square_metre).doc("Built ground beyond the largest GSI.");
    t.out(&Out::height_overshoot, "height_overshoot")
        .unit(Unit::metre)
        .doc("Height of the highest volume beyond the largest height.");
    t.out(&Out::setback_overshoot, "setback_overshoot")
        .unit(Unit::metre)
        .doc(
            "Largest depth of a volume in the setback. Of one that stands its plates count, of others a disc of the area of its "
            "footprint.");
    t.out(&Out::overshoot, "overshoot")
        .unit(Unit::ratio)
        .doc("The worst overshoot of FSI, GSI, height and setback, as a share of what is allowed.");
    t.out(&Out::message, "message")
        .doc("Volumes that no smaller demand brings below the largest height; empty where there are none.");
  }

  // The excess as a share of what is allowed; where nothing is allowed, any excess counts as 1.
  static double share(double overshoot, double allowed) {
    constexpr double kMost = 1e6;
    return overshoot <= 0 ? 0 : allowed > 0 ? std::min(overshoot / allowed, kMost) : 1;
  }

  static constexpr double kRounding = 1e-6;  // [m] of set-backs that are kept exactly
  static constexpr double kChords = 1e-3;    // [m] between arcs of plates and their chords

  // As one with plates; else nullptr.
  static const Standing* standing_of(const Sets& sets, const Member& member) {
    const auto found = std::ranges::lower_bound(sets.standing, member.id, {}, &Standing::id);
    return found != sets.standing.end() && found->id == member.id && !found->plates.rows.empty() ? &*found : nullptr;
  }

  // How far a volume stays inside the sides of the plot [m]: its plates where it stands, else a disc.
  static double clearance(const In& in, const Standing* standing, const Member& member) {
    return standing != nullptr ? geometry::clearance_of(geometry::read_body(standing->plates), in.polygon, kChords)
                               : geometry::clearance_of_disc(in.polygon, member.centroid, member.footprint);
  }

  // Of rounded shapes, which shrink towards their positions. What stands begins on its ground, wherever its position is.
  static void tell_height(const In& in, const Member& member, std::string& message) {
    const double height = member.position.z - in.ground;
    if (member.position.z > member.bottom + member.height || height < in.height_max ||
        member.bottom + member.height - in.ground <= in.height_max)
      return;
    message += (message.empty() ? "`" : "; `") + member.id + "` has its position " + fixed(height, 1) +
               " m above the ground, so that however small it becomes it stands above the largest height of " +
               fixed(in.height_max, 1) + " m: move it down, or raise `height_max`";
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
    if (in.polygon.size() < 3) return Error{ErrorCode::geometry, "polygon", "a plot needs at least 3 corners"};
    if (const auto crossing = geometry::find_self_crossing(in.polygon))
      return Error{ErrorCode::geometry, "polygon",
                   "the polygon meets itself at (" + fixed(crossing->where.x, 3) + ", " + fixed(crossing->where.y, 3) +
                       "): redraw it there"};
    Out out;
    out.area = std::abs(geometry::signed_area(in.polygon));
    if (!(out.area > 0)) return Error{ErrorCode::geometry, "polygon", "the polygon encloses no area"};
    std::vector<geometry::HeightBase> grounds;
    for (const Member& member : sets.volumes) {
      const Standing* standing = standing_of(sets, member);
      grounds.push_back({member.id, member.stands_on, standing == nullptr ? std::optional<double>() : standing->ground});
    }
    const std::vector<double> bases = geometry::height_bases(grounds, in.ground);
    for (std::size_t i = 0; i < sets.volumes.size(); ++i) {
      const Member& member = sets.volumes[i];
      const Standing* standing = standing_of(sets, member);
      const Point3& place = standing != nullptr ? standing->stands_at : member.centroid;
      if (!(member.volume > 0) || !geometry::ring_contains(in.polygon, place)) continue;
      ++out.count;
      out.floor_area += member.floor_area;
      out.footprint += member.footprint * geometry::built_share(standing != nullptr, member.stands_on, member.bottom,
                                                                member.storey_height, in.ground);
      if (standing == nullptr) tell_height(in, member, out.message);
      out.top = std::max(out.top, member.bottom + member.height - bases[i]);
      if (in.setback > 0) out.setback_overshoot = std::max(out.setback_overshoot, in.setback - clearance(in, standing, member));
    }
    if (out.setback_overshoot < kRounding) out.setback_overshoot = 0;
    out.fsi = out.floor_area / out.area;
    out.gsi = out.footprint / out.area;
    if (out.fsi > 0) out.osr = (1 - out.gsi) / out.fsi;
    if (out.gsi > 0) out.layers = out.fsi / out.gsi;
    out.floor_overshoot = std::max(0.0, out.floor_area - in.fsi_max * out.area);
    out.footprint_overshoot = std::max(0.0, out.footprint - in.gsi_max * out.area);
    out.height_overshoot = std::max(0.0, out.top - in.height_max);
    out.overshoot =
        std::max({share(out.floor_overshoot, in.fsi_max * out.area), share(out.footprint_overshoot, in.gsi_max * out.area),
                  share(out.height_overshoot, in.height_max), share(out.setback_overshoot, in.setback)});
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(plot, Plot)
