// Streets of OpenStreetMap: lines cut at junctions, with lanes, speeds, directions and forbidden turns.
#include <algorithm>
#include <map>

#include "core/base/plural.h"
#include "core/import/osm_import.h"
#include "core/import/osm_tags.h"

namespace bl::importing {

namespace {

class Streets {
 public:
  explicit Streets(OsmImport& import) : in_(import) {}

  void run() {
    std::vector<std::pair<const OsmWay*, OsmRoad>> roads;
    for (const OsmWay& way : in_.store->ways) {
      ImportRow& row = in_.row_of(way);
      if (!row.reason.empty() || tag_of(way.tags, "highway").empty()) continue;
      OsmRoad road = osm_road(way.tags);
      if (!road.is_road) {
        decide(row, ImportOutcome::skipped, "street: " + road.why_not, "highway=" + road.road_class);
      } else if (way.nodes.size() < 2) {
        decide(row, ImportOutcome::skipped, "street: fewer than two nodes");
      } else {
        roads.emplace_back(&way, std::move(road));
      }
    }
    for (const auto& [way, road] : roads) {
      for (const std::int64_t node : way->nodes) ++visits_[node];
      ++visits_[way->nodes.front()];
      ++visits_[way->nodes.back()];
    }
    for (std::size_t i = 0; i < roads.size() && in_.goes_on("streets", i, roads.size()); ++i)
      cut(*roads[i].first, roads[i].second);
    for (std::size_t i = 0; i < in_.store->relations.size(); ++i)
      if (tag_of(in_.store->relations[i].tags, "type") == "restriction") restrict(in_.store->relations[i], in_.relations[i]);
  }

 private:
  std::size_t junction(std::int64_t node, const Point3& position) {
    const auto [it, is_new] = junctions_.emplace(node, in_.context->junctions.size());
    if (is_new) in_.context->junctions.push_back({"n" + std::to_string(node), position});
    return it->second;
  }

  // Pieces run from junction to junction, or to where a node is missing.
  void cut(const OsmWay& way, const OsmRoad& road) {
    std::vector<std::int64_t> nodes = way.nodes;
    if (road.direction < 0) std::reverse(nodes.begin(), nodes.end());
    std::size_t missing = 0, beyond = 0, pieces = 0, first = 0;
    const std::size_t before = in_.context->streets.size();
    std::vector<bool> is_there;
    for (const std::int64_t node : nodes) {
      std::size_t none = 0;
      (void)in_.places({node}, none);
      is_there.push_back(none == 0);
      missing += none;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const bool ends_here = i + 1 == nodes.size() || !is_there[i] || !is_there[i + 1] || visits_.at(nodes[i]) > 1;
      if (!ends_here || !is_there[i]) {
        if (!is_there[i]) first = i + 1;
        continue;
      }
      if (i > first) {
        if (add_piece(way, road,
                      {nodes.begin() + static_cast<std::ptrdiff_t>(first), nodes.begin() + static_cast<std::ptrdiff_t>(i) + 1},
                      pieces))
          ++pieces;
        else ++beyond;
      }
      first = i;
    }
    settle(in_.row_of(way), road, missing, beyond, in_.context->streets.size() - before);
  }

  bool add_piece(const OsmWay& way, const OsmRoad& road, const std::vector<std::int64_t>& nodes, std::size_t number) {
    std::size_t missing = 0;
    ContextStreet street;
    street.line = in_.places(nodes, missing);
    if (!out_of_reach(*in_.options, street.line).empty()) return false;
    street.id = "w" + std::to_string(way.id) + "/" + std::to_string(number);
    street.row = in_.index_of(in_.row_of(way));
    street.name = tag_of(way.tags, "name");
    street.street_class = road.road_class;
    street.start = junction(nodes.front(), street.line.front());
    street.end = junction(nodes.back(), street.line.back());
    street.lanes = road.lanes;
    street.speed = road.speed;
    street.width = road.width;
    street.is_lanes_assumed = road.is_lanes_assumed;
    street.is_speed_assumed = road.is_speed_assumed;
    street.is_one_way = road.direction != 0;
    street.for_cars = road.for_cars;
    street.for_cycles = road.for_cycles;
    street.for_feet = road.for_feet;
    pieces_of_[way.id].push_back(in_.context->streets.size());
    in_.context->streets.push_back(std::move(street));
    return true;
  }

  static void settle(ImportRow& row, const OsmRoad& road, std::size_t missing, std::size_t beyond, std::size_t pieces) {
    std::string detail;
    const auto add = [&detail](const std::string& text) { detail += (detail.empty() ? "" : ", ") + text; };
    if (missing > 0) add(how_many(missing, "node") + by_number(missing, " is", " are") + " not in the file");
    if (beyond > 0) add(how_many(beyond, "piece") + by_number(beyond, " is", " are") + " out of reach");
    if (!road.fault.empty()) add("not understood: " + road.fault);
    if (pieces == 0)
      return decide(row, ImportOutcome::skipped,
                    beyond > 0 ? "street: it lies out of reach" : "street: its nodes are not in the file", detail);
    decide(row, missing > 0 || !road.fault.empty() ? ImportOutcome::repaired : ImportOutcome::taken, "street", detail);
  }

  // The piece of a way by which one comes to a junction, or leaves it.
  Result<std::size_t> piece_at(std::int64_t way, std::size_t via, bool is_from) const {
    const std::string name = "w" + std::to_string(way);
    const auto pieces = pieces_of_.find(way);
    if (pieces == pieces_of_.end())
      return Error{ErrorCode::not_found, name, "its streets are not in the file, or none for driving"};
    std::vector<std::size_t> found;
    bool is_against = false;
    for (const std::size_t index : pieces->second) {
      const ContextStreet& street = in_.context->streets[index];
      if (street.start != via && street.end != via) continue;
      if (!street.is_one_way || (is_from ? street.end : street.start) == via) found.push_back(index);
      else is_against = true;
    }
    if (found.size() == 1) return found.front();
    if (found.empty())
      return Error{ErrorCode::conflict, name,
                   is_against ? "it runs against a one-way street" : "its streets do not end at its junction"};
    return Error{ErrorCode::conflict, name, "one of its streets passes its junction, so that its side is not known"};
  }

  // The rule for cars: "no_left_turn" and the like, or why there is none.
  static Result<std::string> rule_of(const OsmTags& tags) {
    std::string key = "restriction";
    for (const char* vehicle : {"restriction:motor_vehicle", "restriction:motorcar"})
      if (!tag_of(tags, vehicle).empty()) key = vehicle;
    const std::string& rule = tag_of(tags, key);
    if (rule.empty()) {
      for (const auto& [name, value] : tags)
        if (name.starts_with("restriction:"))
          return Error{ErrorCode::conflict, name + "=" + value, "it is not for all cars at all times"};
    }
    if (!rule.starts_with("no_") && !rule.starts_with("only_"))
      return Error{ErrorCode::parse, key + "=" + rule, "its rule is not understood"};
    std::string except = ";" + tag_of(tags, "except") + ";";
    std::erase(except, ' ');
    for (const char* vehicle : {";motorcar;", ";motor_vehicle;", ";vehicle;"})
      if (except.find(vehicle) != std::string::npos)
        return Error{ErrorCode::conflict, "except=" + tag_of(tags, "except"), "it is not for all cars at all times"};
    return rule;
  }

  void restrict(const OsmRelation& relation, ImportRow& row) {
    const auto skip = [&row](const std::string& why, const std::string& detail = "") {
      decide(row, ImportOutcome::skipped, "turn restriction: " + why, detail);
    };
    const auto rule = rule_of(relation.tags);
    if (!rule) return skip(rule.error().message, rule.error().place);
    std::vector<const OsmMember*> from, via, to;
    for (const OsmMember& member : relation.members) {
      if (member.role == "from") from.push_back(&member);
      if (member.role == "via") via.push_back(&member);
      if (member.role == "to") to.push_back(&member);
    }
    // Several streets may be closed to one, or one to several; all else is between two.
    if (from.empty() || to.empty() || via.size() != 1 || (from.size() > 1 && *rule != "no_entry") ||
        (to.size() > 1 && *rule != "no_exit"))
      return skip("it does not have one from, one via and one to");
    if (via[0]->kind != 'n') return skip("it runs via a way");
    const auto junction = junctions_.find(via[0]->id);
    if (junction == junctions_.end()) return skip("its junction is not among the streets");
    std::vector<ContextRestriction> all;
    for (const OsmMember* start : from)
      for (const OsmMember* end : to) {
        const auto a = piece_at(start->id, junction->second, true), b = piece_at(end->id, junction->second, false);
        if (!a) return skip(a.error().message, a.error().place);
        if (!b) return skip(b.error().message, b.error().place);
        all.push_back({"r" + std::to_string(relation.id), *rule, *a, *b, junction->second, in_.index_of(row)});
      }
    in_.context->restrictions.insert(in_.context->restrictions.end(), all.begin(), all.end());
    decide(row, ImportOutcome::taken, "turn restriction");
  }

  OsmImport& in_;
  std::map<std::int64_t, int> visits_;  // of each node by streets; ends count twice, so that they are junctions
  std::map<std::int64_t, std::size_t> junctions_;
  std::map<std::int64_t, std::vector<std::size_t>> pieces_of_;
};

}  // namespace

void read_osm_streets(OsmImport& import) { Streets(import).run(); }

}  // namespace bl::importing
