// Holds back the demand of a volume while the streets at its access are overloaded.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/demand/demand_limit.h"
#include "core/demand/shared_storeys.h"

namespace bl {

namespace {

struct CongestionFeedback {
  struct In {
    double limit = 0.9, gain = 0.1, tolerance = 0.02, least = 0.2;
  };
  struct Ends {
    Shared<Table> loads;
    std::string id;
    std::vector<std::string> access;
    double demand = 0, demand_limit = 0, wanted = 0, volume = 0, served = 0, lost = 0;
    bool is_locked = false;
    double storey_height = 0;
    std::optional<int> built, wished, least_storeys;
    std::optional<double> height_limit;
    std::optional<Shared<Table>> building;
  };
  struct Out {
    std::optional<double> demand_limit, height_limit;
  };

  static void declare(LinkBuilder<CongestionFeedback>& l) {
    l.id("congestion_feedback").label("Congestion feedback");
    l.doc(
        "Lowers the demand limit of a volume while a street at its access carries more than a share of its capacity, or while "
        "most of its trips find no way. The limit rises again when there is room. Together with `request_traffic` this is a "
        "feedback loop: the streets limit the size of the volume. A volume that stands gives up whole storeys with its demand, "
        "one for each part of the demand that filled one, and keeps about its footprint. Of a building that several share they "
        "go for its part in the floor area that all ask for.");
    l.family(LinkFamily::traffic);
    l.param(&In::limit, "limit")
        .unit(Unit::ratio)
        .range(0.01, 10)
        .soft(0.5, 1.5)
        .doc("Volume over capacity that the most used street at the access may have.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.3)
        .doc(
            "Gain: how strongly the limit changes in one tick. Volumes and streets follow some ticks later, so that large gains "
            "oscillate.");
    l.param(&In::tolerance, "tolerance")
        .unit(Unit::ratio)
        .range(0.0001, 0.5)
        .soft(0.005, 0.1)
        .doc(
            "Dead band: the volume stays as it is while the most used street is below the limit by no more than this share of "
            "it. Drivers never stop trying other ways, and without this band the volume would never settle.");
    l.param(&In::least, "least")
        .unit(Unit::ratio)
        .range(0.001, 1)
        .doc(
            "Share of the demand that congestion never takes away, as others may cause it. Where that is not enough, the link "
            "reports that the limit cannot be met.");
    l.reads(&Ends::loads, End::from, "traffic_network.loads");
    l.reads(&Ends::id, End::to, "node.id").reads(&Ends::access, End::to, "traffic_zone.access");
    l.reads(&Ends::served, End::to, "traffic_zone.trips_served", Unit::per_hour);
    l.reads(&Ends::lost, End::to, "traffic_zone.trips_lost", Unit::per_hour);
    l.reads(&Ends::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.reads(&Ends::demand_limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.reads(&Ends::wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::volume, End::to, "smart_volume.fitted", Unit::cubic_metre);
    l.reads_lock(&Ends::is_locked, End::to, "smart_volume.demand_limit");
    l.reads(&Ends::storey_height, End::to, "smart_volume.storey_height", Unit::metre);
    l.reads_if_there(&Ends::built, End::to, "footprint.storeys_held").reads_if_there(&Ends::wished, End::to, "footprint.storeys");
    l.reads_if_there(&Ends::least_storeys, End::to, "footprint.storeys_min");
    l.reads_if_there(&Ends::height_limit, End::to, "footprint.height_limit", Unit::metre);
    l.reads_if_there(&Ends::building, End::to, "footprint.building");
    l.proposes(&Out::demand_limit, End::to, "smart_volume.demand_limit", Unit::cubic_metre);
    l.proposes_if_there(&Out::height_limit, End::to, "footprint.height_limit", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    const std::vector<std::string> own{ends.id};
    double load = 0;
    for (const std::string& junction : ends.access.empty() ? own : ends.access)
      if (const std::size_t row = ends.loads->row_of("junction", junction); row < ends.loads->rows.size())
        load = std::max(load, ends.loads->number(row, "volume_over_capacity"));
    if (!(ends.demand > 0)) return Out{};
    // Starts from the share that the limit leaves now. One tick takes account of at most twice or half the allowed load. Where
    // most trips find no way, the largest excess counts.
    if (ends.lost > ends.served || load > in.limit) tell(in, ends, load, tick);
    const double room = ends.lost > ends.served ? 0.5 : std::max(0.5, demand::answer_within(in.limit, load, in.tolerance));
    const double answer = 1 + in.gain * (room - 1);
    const double share = std::max(demand::granted_share(ends.demand, ends.demand_limit) * answer, in.least);
    return Out{demand::limit_that_grants(ends.demand, share), height_for(in, ends, share, tick)};
  }

 private:
  // Storeys follow the share of the demand that is left, rounded: by less than half a storey the footprint changes.
  static std::optional<double> height_for(const In& in, const Ends& ends, double share, const Tick& tick) {
    if (!ends.built || share >= 1) return std::nullopt;
    const auto building = demand::building_in(ends.building);
    const demand::StandingVolume volume =
        demand::standing_in({*ends.built, *ends.wished, *ends.least_storeys, ends.storey_height, *ends.height_limit}, building);
    // Of a building only the part of this volume has become less.
    const double left = building ? 1 - building->part * (1 - share) : share;
    const auto limit = demand::limit_at(volume, (left * volume.wished + 0.5) * volume.storey_height, in.least);
    if (limit && volume.built < volume.wished && demand::takes_storeys(volume, *limit))
      remark(
          tick, LinkRemark::short_of,
          {ErrorCode::infeasible, "limit",
           demand::named_holder(building, ends.id) + " has " + demand::storeys_left(volume, *limit) + ", for the streets leave " +
               (building ? "`" + ends.id + "` " : "it ") + fixed(100 * share, 0) + " % of its demand"});
    return limit;
  }

  // Reports a load that is too high: as being worked on, or as unmet where the volume cannot be limited further. Drivers never
  // stop trying other ways, so a load within the tolerance of the limit does not keep the scene from settling.
  static void tell(const In& in, const Ends& ends, double load, const Tick& tick) {
    const std::vector<std::string> ids{ends.id};
    const std::vector<double> demands{ends.demand}, limits{ends.demand_limit}, wanted{ends.wanted}, volumes{ends.volume};
    const std::vector<bool> locked{ends.is_locked};
    const std::vector<std::size_t> it{0};
    const demand::LimitedVolumes held{ids, demands, limits, wanted, volumes, locked};
    const bool is_lost = ends.lost > ends.served;
    const std::string found =
        is_lost ? "of the trips of `" + ends.id + "` " + fixed(100 * ends.lost / (ends.lost + ends.served), 0) + " % find no way"
                : "the street at the access of `" + ends.id + "` carries " + demand::found_of_allowed(load, in.limit, 2);
    if (is_exhausted(held, it, in.least))
      return remark(tick, LinkRemark::unmet,
                    {ErrorCode::infeasible, "limit",
                     "cannot be met: " + found + ", " + held_by(held, it, in.least) + "; raise `limit`," +
                         unlocking(held, it, in.least) + " or lower what is insisted on or `least`"});
    if (is_lost || load > in.limit * (1 + in.tolerance))
      remark(tick, LinkRemark::at_work, {ErrorCode::infeasible, "limit", found});
  }
};

}  // namespace

}  // namespace bl

BL_LINK(congestion_feedback, CongestionFeedback)
