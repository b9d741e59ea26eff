// Attaches a zone to the nearest junctions that can be walked to.
#include <algorithm>
#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct AccessRoute {
  struct In {
    double max_walk = 300;
    std::int64_t count = 1;
  };
  struct Ends {
    std::string zone;
    Point3 from;
    All<std::string> ids;
    All<Point3> positions;
    All<double> delays;  // only junctions have this port
  };
  struct Out {
    std::vector<std::string> access;
  };

  static void declare(LinkBuilder<AccessRoute>& l) {
    l.id("access_route").label("Access route");
    l.doc(
        "Attaches a zone to the nearest of the junctions at the other end, within walking distance. The zone's trips enter and "
        "leave the streets there. With several links or junctions the trips choose among them.");
    l.family(LinkFamily::traffic);
    l.param(&In::max_walk, "max_walk")
        .unit(Unit::metre)
        .range(0, 1e5)
        .soft(50, 1000)
        .doc("The longest walk, measured in a straight line.");
    l.param(&In::count, "count")
        .unit(Unit::count)
        .range(1, 100)
        .soft(1, 5)
        .doc("How many of the nearest junctions are attached at most.");
    l.reads(&Ends::zone, End::from, "node.id").reads(&Ends::from, End::from, "node.position", Unit::metre);
    l.reads(&Ends::ids, End::to, "node.id").reads(&Ends::positions, End::to, "node.position", Unit::metre);
    l.reads(&Ends::delays, End::to, "junction.delay", Unit::second);
    l.proposes(&Out::access, End::from, "traffic_zone.access");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    std::vector<std::pair<double, std::string>> near;
    for (std::size_t i = 0; i < ends.ids.values.size(); ++i)
      near.emplace_back(distance(ends.from, ends.positions.values[i]), ends.ids.values[i]);
    std::sort(near.begin(), near.end());
    Out out;
    if (near.empty()) return out;
    for (const auto& [walk, id] : near)
      if (walk <= in.max_walk && out.access.size() < static_cast<std::size_t>(in.count)) out.access.push_back(id);
    // Where no junction is near enough, the zone itself reports it. An error here would leave the access of other links in force.
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(access_route, AccessRoute)
