// Keeps volumes under the planes through which a neighbour's edge sees the sun.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"
#include "core/demand/shared_storeys.h"
#include "core/geometry/plates_table.h"
#include "core/sun/body_reach.h"
#include "core/sun/moment_table.h"
#include "core/sun/shadow_shape.h"

namespace bl {

namespace {

struct SolarEnvelope {
  enum class Mode { move, shave };
  struct In {
    std::vector<Point3> edge = {{-20, 30, 0}, {20, 30, 0}};
    Mode mode = Mode::move;
    double gain = 0.3, tolerance = 0.02, play = 0.125, least = 0.2;
  };
  struct Ends {
    Shared<Table> moments;
    Point3 position;
    double radius = 0, footprint = 0, bottom = 0, height = 0, demand = 0, limit = 0, wanted = 0, volume = 0;
    std::string id;
    bool is_limit_locked = false, is_position_locked = false;
    double storey_height = 0;
    std::optional<int> built, wished, least_storeys;
    std::optional<double> height_limit;
    std::optional<Shared<Table>> plates, building;
    std::optional<bool> is_height_locked;
  };
  struct Out {
    std::optional<Vector3> move;
    std::optional<double> limit, height_limit;
  };

  static void declare(LinkBuilder<SolarEnvelope>& l) {
    l.id("solar_envelope")
        .label("Solar envelope")
        .doc(
            "Limits how high volumes stand, so that a neighbour's edge keeps its sun at all moments of the sun's period. Each "
            "moment gives a plane that rises from the edge towards the sun. A volume that reaches through a plane is moved back "
            "or made smaller. Of a volume that stands the storeys go that reach through, and its footprint grows.");
    l.family(LinkFamily::sun);
    l.param(&In::edge, "edge")
        .unit(Unit::metre)
        .doc(
            "The neighbour's edge: a chain of points at the height that the sun must reach, such as the height of window sills.");
    l.param(&In::mode, "mode",
            {{Mode::move, "move", "The volume's position moves back under the plane by the shortest way."},
             {Mode::shave, "shave", "The volume's demand limit falls until it fits under the planes; then it may rise again."}})
        .doc("How a volume gives way. In the mode `shave` one that stands loses storeys, and keeps its demand.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc(
            "Share of the excess that is corrected in one tick. In the mode `shave` it is that share of the excess divided by "
            "the radius.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .soft(0.005, 0.1)
        .doc(
            "How far a volume may reach through a plane, as a share of its radius; of one that stands, of the radius of a disc "
            "as large as its footprint.");
    l.param(&In::play, "play")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc(
            "Dead band of the mode `shave`, beyond the tolerance and as a share of it: the limit stays as it is within it. The "
            "scene settles only when no volume reaches farther than that.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc(
            "Share of the demand, or of wished storeys, that is never taken away. If that is not enough, the link reports that "
            "the rule is not met.");
    read_ends(l);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
    l.proposes(&Out::limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes_if_there(&Out::height_limit, End::to, "footprint.height_limit", Unit::metre);
  }

  static void read_ends(LinkBuilder<SolarEnvelope>& l) {
    l.reads(&Ends::moments, End::from, "sun_and_sky.moments");
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.reads(&Ends::radius, End::to, "smart_volume.radius", Unit::metre);
    l.reads(&Ends::footprint, End::to, "smart_volume.footprint", Unit::square_metre);
    l.reads(&Ends::bottom, End::to, "smart_volume.bottom", Unit::metre);
    l.reads(&Ends::height, End::to, "smart_volume.height", Unit::metre);
    l.reads(&Ends::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::id, End::to, "node.id");
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volume, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads_lock(&Ends::is_limit_locked, End::to, "smart_volume.demand_limit");
    l.reads_lock(&Ends::is_position_locked, End::to, "node.position");
    l.reads(&Ends::storey_height, End::to, "smart_volume.storey_height", Unit::metre);
    l.reads_if_there(&Ends::built, End::to, "footprint.storeys_held").reads_if_there(&Ends::wished, End::to, "footprint.storeys");
    l.reads_if_there(&Ends::least_storeys, End::to, "footprint.storeys_min");
    l.reads_if_there(&Ends::height_limit, End::to, "footprint.height_limit", Unit::metre);
    l.reads_if_there(&Ends::plates, End::to, "footprint.plates").reads_if_there(&Ends::building, End::to, "footprint.building");
    l.reads_lock_if_there(&Ends::is_height_locked, End::to, "footprint.height_limit");
  }

  // The planes through each part of the edge, for volumes on either side of it. They are the same for all volumes of a tick.
  struct Planes {
    std::optional<Shared<Table>> moments;
    std::vector<std::array<std::vector<sun::SunPlane>, 2>> parts;

    void make(const std::vector<Point3>& edge, const Shared<Table>& from) {
      if (moments && &**moments == &*from) return;
      moments = from;
      parts.assign(edge.size() - 1, {});
      std::vector<Vector3> suns;
      for (const sun::SunMoment& moment : sun::moments_in(*from)) suns.push_back(moment.toward);
      for (std::size_t i = 0; i < parts.size(); ++i)
        for (const int side : {0, 1})
          parts[i][static_cast<std::size_t>(side)] =
              sun::solar_envelope(edge[i], edge[i + 1], edge[i] + (side == 0 ? -1.0 : 1.0) * across(edge, i), suns);
    }
    // Horizontal, at right angles to a part of the edge.
    static Vector3 across(const std::vector<Point3>& edge, std::size_t i) {
      return {(edge[i + 1] - edge[i]).y, -(edge[i + 1] - edge[i]).x, 0};
    }
  };

  // How far a shape reaches from its position towards `normal`, at most: it lies within its ball and below its top.
  static double reach(const Ends& ends, const Vector3& normal) {
    const double r = ends.radius, up = std::clamp(ends.bottom + ends.height - ends.position.z, -r, r);
    if (normal.z * r <= up) return r;
    return normal.z * up + std::sqrt(std::max(0.0, (r * r - up * up) * (1 - normal.z * normal.z)));
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (in.edge.size() < 2) return Error{ErrorCode::missing, "edge", "an edge has at least two points: add them"};
    if (!(radius_of(ends) > 0)) return Out{};
    Planes own;
    Planes& planes = tick.memo != nullptr ? tick.memo->of<Planes>() : own;
    planes.make(in.edge, ends.moments);
    if (ends.built) return evaluate_standing(in, ends, planes, tick);
    double worst = -ends.radius;
    Vector3 normal;
    // Most planes are far above the whole ball, with a small margin for rounding.
    const double most = ends.radius * (1 + 1e-12);
    for (std::size_t i = 0; i + 1 < in.edge.size(); ++i) {
      const double side = dot(Planes::across(in.edge, i), ends.position - in.edge[i]);
      if (side == 0) continue;
      for (const sun::SunPlane& plane : planes.parts[i][side > 0 ? 1 : 0]) {
        const double height = dot(plane.normal, ends.position);
        if (height + most - plane.offset <= worst) continue;
        const double excess = height + reach(ends, plane.normal) - plane.offset;
        if (excess <= worst) continue;
        worst = excess;
        normal = plane.normal;
      }
    }
    const double beyond = worst / ends.radius - in.tolerance;
    if (beyond > in.play * in.tolerance) tell(in, ends, beyond + in.tolerance, tick);
    if (in.mode == Mode::move) return beyond > 0 ? Out{normal * (-in.gain * beyond * ends.radius), {}, {}} : Out{};
    // The limit stays as it is from half the tolerance to a little beyond it; below that the volume may grow again. Without that
    // little, the last of the excess would be shaved off without end.
    const double room = std::min(0.5, std::max(0.0, -beyond - 0.5 * in.tolerance));
    const double excess = beyond > in.play * in.tolerance ? std::min(beyond, 0.5) : 0.0;
    const double answer = (1 - in.gain * excess) * (1 + in.gain * room);
    return Out{
        {},
        demand::limit_that_grants(ends.demand, std::max(in.least, demand::granted_share(ends.demand, ends.limit) * answer)),
        {}};
  }

 private:
  // Weights of volumes that stand may be below 0, and who shares a footprint has none.
  static double radius_of(const Ends& ends) {
    return ends.built ? std::sqrt(std::max(0.0, ends.footprint) / std::numbers::pi) : ends.radius;
  }

  static constexpr double kSameHeight = 1e-6;  // [m] of roofs

  // The height up to which the plates stay below the planes. With fewer storeys plates are larger and may be no higher still, so
  // storeys do not come and go.
  static Result<Out> evaluate_standing(const In& in, const Ends& ends, const Planes& planes, const Tick& tick) {
    // Who shares a footprint stands where its host does, not at its own position.
    const geometry::StandingBody body = geometry::read_body(**ends.plates);
    std::vector<sun::SunPlane> above;
    for (std::size_t i = 0; i + 1 < in.edge.size(); ++i) {
      const double side = dot(Planes::across(in.edge, i), body.centre - in.edge[i]);
      if (side == 0) continue;
      const auto& part = planes.parts[i][side > 0 ? 1 : 0];
      above.insert(above.end(), part.begin(), part.end());
    }
    const sun::BodyReach reach = sun::reach_of(body, above);
    const auto building = demand::building_in(ends.building);
    const demand::StandingVolume volume = demand::standing_in(
        {*ends.built, *ends.wished, *ends.least_storeys, ends.storey_height, *ends.height_limit, *ends.is_height_locked},
        building);
    const double radius = radius_of(ends), beyond = reach.excess / radius - in.tolerance;
    if (const std::string stays = demand::why_it_stays(building, ends.id); in.mode == Mode::move && !stays.empty()) {
      if (beyond > in.play * in.tolerance)
        remark(tick, LinkRemark::unmet,
               {ErrorCode::infeasible, "edge",
                "cannot be met: " + through(ends, reach.excess) + ", and " + stays +
                    "; lead this link to that one, or let it be shaved"});
      return Out{};
    }
    if (in.mode == Mode::move) {
      if (beyond > in.play * in.tolerance) tell(in, ends, beyond + in.tolerance, tick);
      return beyond > 0 ? Out{reach.back * (in.gain * beyond * radius), {}, {}} : Out{};
    }
    Out out;
    // What has others above it says nothing of them while it stays below the planes itself.
    const bool is_covered = building && ends.bottom + ends.height < building->top - kSameHeight;
    if (is_covered && reach.allowed >= ends.height) return out;
    const double below = ends.bottom - demand::ground_below(building, ends.bottom);
    out.height_limit = demand::limit_at(volume, below + reach.allowed, in.least);
    if (reach.allowed < ends.height && demand::is_at_least(volume, in.least))
      remark(tick, LinkRemark::unmet,
             {ErrorCode::infeasible, "edge",
              "cannot be met: " + through(ends, reach.excess) + ", " +
                  demand::held_at_least(demand::holder_of(building, ends.id), volume, in.least) +
                  "; move the edge or the volume, or " + demand::way_to_fewer(volume, in.least)});
    else if (out.height_limit && volume.built < volume.wished && demand::takes_storeys(volume, *out.height_limit) &&
             demand::is_in_force(volume, *out.height_limit))
      remark(tick, LinkRemark::short_of,
             {ErrorCode::infeasible, "edge",
              demand::named_holder(building, ends.id) + " has " + demand::storeys_left(volume, *out.height_limit) +
                  " to stay below the planes of the sun"});
    return out;
  }

  static std::string through(const Ends& ends, double metres) {
    return "`" + ends.id + "` reaches " + fixed(metres, 2) + " m through the planes of the sun";
  }

  // Reports a volume that reaches through the planes: as being worked on, or as unmet where something holds it.
  static void tell(const In& in, const Ends& ends, double share, const Tick& tick) {
    const std::string found = through(ends, share * radius_of(ends));
    const std::vector<bool> locked = {ends.is_limit_locked};
    const demand::LimitedVolumes held{{&ends.id, 1},     {&ends.demand, 1}, {&ends.limit, 1},
                                      {&ends.wanted, 1}, {&ends.volume, 1}, locked};
    std::string held_up;
    if (in.mode == Mode::move && ends.is_position_locked)
      held_up = ", and its position is locked; unlock the position, or let it be shaved";
    else if (in.mode == Mode::shave && is_exhausted(held, {0}, in.least))
      held_up = ", " + held_by(held, {0}, in.least) + "; move the edge or the volume," + unlocking(held, {0}, in.least) +
                " or lower what is insisted on or `least`";
    if (held_up.empty()) return remark(tick, LinkRemark::at_work, {ErrorCode::infeasible, "edge", found});
    remark(tick, LinkRemark::unmet, {ErrorCode::infeasible, "edge", "cannot be met: " + found + held_up});
  }
};

}  // namespace

}  // namespace bl

BL_LINK(solar_envelope, SolarEnvelope)
