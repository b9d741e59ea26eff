// A use, such as housing: what its floor area brings and needs, and what that comes to for the volumes of this use.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Use {
  struct In {
    std::string name, source;
    double trips_per_100 = 0, car_share = 0.5, out_share = 0.5, parking_per_100 = 0, people_per_100 = 0;
    double cost_per_area = 0, value_per_area = 0, least_sun = 0, most_noise = 0;
    bool is_open = false;
    Selection volumes{{}, "use_figures", {}}, uses{{}, "use", {}};
  };
  struct Member {
    std::string use;
    double floor_area = 0;
  };
  struct Named {
    std::string id, name;
  };
  struct Sets {
    std::vector<Member> volumes;
    std::vector<Named> uses;
  };
  struct Reply {
    std::optional<std::string> use, message;
    std::optional<double> trips, parking, people, cost, value, car_share, out_share, least_sun, most_noise;
  };
  struct Out {
    std::int64_t count = 0;
    double floor_area = 0, trips = 0, parking = 0, people = 0, cost = 0, value = 0;
    std::vector<Reply> replies;
  };

  static void declare(TypificationBuilder<Use>& t) {
    t.id("use").label("Use");
    t.column(CanvasColumn::first).icon(Icon::balance);
    t.doc(
        "What 100 m² of floor of a use bring and need: trips, parking places, people, cost and value. It gives these figures to "
        "the volumes of this use and adds them up. Links to traffic, budgets and parking read them there.");
    t.in(&In::name, "use").doc("The use as volumes and rows of a programme name it, such as `housing`; each use has one node.");
    t.in(&In::is_open, "is_open")
        .doc(
            "The use is open space, such as a garden or a square: rows of a programme ask for ground that nobody builds on, and "
            "exclusions of a boundary keep it. It has no volumes and no floor area.");
    declare_rates(t);
    t.in(&In::source, "source").doc("Where the figures come from, for whoever reads them later.");
    t.in(&In::volumes, "volumes").doc("The volumes that may get figures; those of this use among them do.");
    t.in(&In::uses, "uses").doc("All uses of the scene, to find volumes whose use is none of them.");
    declare_sums(t);
    t.set("uses", &Sets::uses).reads(&Named::id, "node.id").reads(&Named::name, "use.use");
    auto volumes = t.set("volumes", &Sets::volumes, &Out::replies);
    volumes.reads(&Member::use, "smart_volume.use").reads(&Member::floor_area, "smart_volume.floor_area", Unit::square_metre);
    volumes.writes(&Reply::use, "use_figures.use").writes(&Reply::message, "use_figures.message");
    volumes.writes(&Reply::trips, "use_figures.trips").writes(&Reply::parking, "use_figures.parking");
    volumes.writes(&Reply::people, "use_figures.people").writes(&Reply::cost, "use_figures.cost");
    volumes.writes(&Reply::value, "use_figures.value").writes(&Reply::car_share, "use_figures.car_share");
    volumes.writes(&Reply::out_share, "use_figures.out_share").writes(&Reply::least_sun, "use_figures.least_sun");
    volumes.writes(&Reply::most_noise, "use_figures.most_noise");
  }

  static void declare_rates(TypificationBuilder<Use>& t) {
    t.in(&In::trips_per_100, "trips_per_100")
        .range(0, 1e4)
        .soft(0, 200)
        .doc("Trips per day and 100 m² of floor area, both ways together and by all means of transport.");
    t.in(&In::car_share, "car_share").unit(Unit::ratio).range(0, 1).doc("Share of the trips that are made by car.");
    t.in(&In::out_share, "out_share")
        .unit(Unit::ratio)
        .range(0, 1)
        .doc("Share of the trips in the hour studied that leave: more than half for housing in the morning.");
    t.in(&In::parking_per_100, "parking_per_100").range(0, 1e3).soft(0, 10).doc("Parking places that 100 m² of floor area need.");
    t.in(&In::people_per_100, "people_per_100").range(0, 1e3).soft(0, 20).doc("People who live or work on 100 m² of floor area.");
    t.in(&In::cost_per_area, "cost_per_area").range(0, 1e6).soft(0, 5000).doc("Cost of building in euro per m² of floor area.");
    t.in(&In::value_per_area, "value_per_area")
        .range(0, 1e6)
        .soft(0, 10000)
        .doc("What the floor area is worth when it is built, in euro per m².");
    t.in(&In::least_sun, "least_sun")
        .unit(Unit::second)
        .range(0, 86400)
        .soft(0, 4 * 3600)
        .doc("Time of sun a day that the use needs; 0 where it needs none.");
    t.in(&In::most_noise, "most_noise")
        .range(0, 140)
        .soft(40, 80)
        .doc("Loudest noise outside by day that suits the use [dB(A)]; 0 where it does not matter.");
  }

  static void declare_sums(TypificationBuilder<Use>& t) {
    t.out(&Out::count, "count").unit(Unit::count).doc("Number of volumes of this use.");
    t.out(&Out::floor_area, "floor_area").shown_first().unit(Unit::square_metre).doc("Their floor area.");
    t.out(&Out::trips, "trips").shown_first().unit(Unit::count).doc("Their trips per day.");
    t.out(&Out::parking, "parking").shown_first().unit(Unit::count).doc("Parking places that they need.");
    t.out(&Out::people, "people").shown_first().unit(Unit::count).doc("People who live or work there.");
    t.out(&Out::cost, "cost").unit(Unit::euro).doc("Cost of building them.");
    t.out(&Out::value, "value").unit(Unit::euro).doc("What they are worth when they are built.");
  }

  // Two nodes of one use would both write to its volumes.
  static Result<void> check_names(const In& in, const std::vector<Named>& uses) {
    if (in.name.empty()) return Error{ErrorCode::missing, "use", "name the use as its volumes do, such as `housing`"};
    std::vector<std::string> same;
    for (const Named& use : uses)
      if (use.name == in.name) same.push_back(use.id);
    if (same.size() < 2) return {};
    return Error{ErrorCode::duplicate, "use",
                 "`" + same[0] + "` and `" + same[1] + "` are both the use `" + in.name + "`: leave one of them out"};
  }

  static Reply reply_of(const In& in, double floor_area) {
    const double hundreds = floor_area / 100;
    return {in.name,
            "",
            in.trips_per_100 * hundreds,
            in.parking_per_100 * hundreds,
            in.people_per_100 * hundreds,
            in.cost_per_area * floor_area,
            in.value_per_area * floor_area,
            in.car_share,
            in.out_share,
            in.least_sun,
            in.most_noise};
  }

  static Reply reply_without_figures(const std::string& why) { return {"", why, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }

  static Reply reply_without_use(const std::string& name) {
    return reply_without_figures(name.empty() ? "it has no use" : "no node is the use `" + name + "`");
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick&) {
    if (auto sound = check_names(in, sets.uses); !sound) return sound.error();
    std::set<std::string> known;
    for (const Named& use : sets.uses) known.insert(use.name);
    // Volumes of no use must not keep the figures of an earlier one; the first use clears them.
    const bool clears = !sets.uses.empty() && sets.uses.front().name == in.name;
    Out out;
    out.replies.resize(sets.volumes.size());
    for (std::size_t v = 0; v < sets.volumes.size(); ++v) {
      const Member& volume = sets.volumes[v];
      if (clears && !known.contains(volume.use)) out.replies[v] = reply_without_use(volume.use);
      if (volume.use != in.name) continue;
      if (in.is_open) {
        out.replies[v] =
            reply_without_figures("its use `" + in.name + "` is open space, which no volume has: give it another one");
        continue;
      }
      const Reply& reply = out.replies[v] = reply_of(in, volume.floor_area);
      ++out.count;
      out.floor_area += volume.floor_area;
      out.trips += *reply.trips;
      out.parking += *reply.parking;
      out.people += *reply.people;
      out.cost += *reply.cost;
      out.value += *reply.value;
    }
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(use, Use)
