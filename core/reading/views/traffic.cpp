// Streets, junctions, zones and the network that carries their trips.
#include "core/reading/views/traffic.h"

namespace bl::reading {

void StreetFigures::declare(ViewBuilder<StreetFigures>& v) {
  v.of("street");
  v.reads(&StreetFigures::start, "street.start");
  v.reads(&StreetFigures::end, "street.end");
  v.reads(&StreetFigures::course, "street.course", Unit::metre);
  v.reads(&StreetFigures::lanes, "street.lanes", Unit::count);
  v.reads(&StreetFigures::capacity_per_lane, "street.capacity_per_lane", Unit::per_hour);
  v.reads(&StreetFigures::open, "street.open", Unit::ratio);
  v.reads(&StreetFigures::one_way, "street.one_way");
  v.reads(&StreetFigures::for_cars, "street.for_cars");
  v.reads(&StreetFigures::flow_forth, "street.flow_forth", Unit::per_hour);
  v.reads(&StreetFigures::flow_back, "street.flow_back", Unit::per_hour);
  v.reads(&StreetFigures::time_forth, "street.time_forth", Unit::second);
  v.reads(&StreetFigures::time_back, "street.time_back", Unit::second);
  v.reads(&StreetFigures::volume_over_capacity, "street.volume_over_capacity", Unit::ratio);
  v.reads(&StreetFigures::used_length, "street.used_length", Unit::metre);
  v.reads(&StreetFigures::reason, "street.reason");
}
BL_VIEW(StreetFigures)

void JunctionPlace::declare(ViewBuilder<JunctionPlace>& v) {
  v.of("junction");
  v.reads(&JunctionPlace::position, "node.position", Unit::metre);
}
BL_VIEW(JunctionPlace)

void TurnRules::declare(ViewBuilder<TurnRules>& v) {
  v.of("turn_rules");
  v.reads(&TurnRules::turns, "turn_rules.turns");
}
BL_VIEW(TurnRules)

void ZoneFigures::declare(ViewBuilder<ZoneFigures>& v) {
  v.of("traffic_zone");
  v.reads(&ZoneFigures::access, "traffic_zone.access");
  v.reads(&ZoneFigures::reason, "traffic_zone.reason");
}
BL_VIEW(ZoneFigures)

void NetworkFigures::declare(ViewBuilder<NetworkFigures>& v) {
  v.of("traffic_network");
  v.reads(&NetworkFigures::streets, "traffic_network.streets");
  v.reads(&NetworkFigures::junctions, "traffic_network.junctions");
  v.reads(&NetworkFigures::walking_speed, "traffic_network.walking_speed", Unit::metre_per_second);
  v.reads(&NetworkFigures::isochrone_step, "traffic_network.isochrone_step", Unit::second);
  v.reads(&NetworkFigures::isochrone_bands, "traffic_network.isochrone_bands");
  v.reads(&NetworkFigures::gap, "traffic_network.gap", Unit::ratio);
  v.reads(&NetworkFigures::relative_gap, "traffic_network.relative_gap", Unit::ratio);
  v.reads(&NetworkFigures::trip_flows, "traffic_network.trip_flows");
}
BL_VIEW(NetworkFigures)

BL_VIEWS(traffic, StreetFigures, JunctionPlace, TurnRules, ZoneFigures, NetworkFigures)

}  // namespace bl::reading
