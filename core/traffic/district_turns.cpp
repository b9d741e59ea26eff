// Finds the links that rules of turning speak of, or says why there are none.
#include "core/traffic/district_turns.h"

#include <map>
#include <set>
#include <utility>

namespace bl {

namespace {

// The direction of a street that ends at a junction, and the one that begins there; empty where there is none.
std::string link_into(const DistrictStreet& street, const std::string& junction) {
  if (street.end == junction) return street.id + ":forth";
  return street.start == junction && !street.is_one_way ? street.id + ":back" : "";
}
std::string link_out_of(const DistrictStreet& street, const std::string& junction) {
  if (street.start == junction) return street.id + ":forth";
  return street.end == junction && !street.is_one_way ? street.id + ":back" : "";
}

class Rules {
 public:
  Rules(std::span<const DistrictStreet> streets, std::span<const TrafficLink> links) {
    for (const DistrictStreet& street : streets) street_of_[street.id] = &street;
    for (const TrafficLink& link : links) departures_[link.from].insert(link.id), links_.insert(link.id);
  }

  std::vector<ForbiddenTurn> read(std::span<const DistrictTurn> rules, std::vector<DistrictResult::Turn>& results) {
    results.assign(rules.size(), {});
    for (std::size_t r = 0; r < rules.size(); ++r) find_links(rules[r], results[r]);
    // Several rules of the kind `only` about one way in leave the choice among what they name.
    for (std::size_t r = 0; r < rules.size(); ++r)
      if (rules[r].rule == "only" && results[r].reason.empty()) allowed_[found_[r].from].insert(found_[r].to);
    std::vector<ForbiddenTurn> turns;
    for (std::size_t r = 0; r < rules.size(); ++r)
      if (results[r].reason.empty()) results[r].forbidden = add(rules[r], found_[r], turns);
    return turns;
  }

 private:
  void find_links(const DistrictTurn& rule, DistrictResult::Turn& result) {
    ForbiddenTurn& turn = found_.emplace_back();
    for (const bool is_to : {false, true}) {
      const std::string& id = is_to ? rule.to : rule.from;
      const auto street = street_of_.find(id);
      std::string& link = is_to ? turn.to : turn.from;
      result.place = is_to ? "to" : "from";
      if (street == street_of_.end()) {
        result.reason = id.empty() ? "it names no street" : "`" + id + "` is no street of this network";
      } else if (street->second->start != rule.junction && street->second->end != rule.junction) {
        result.reason = "`" + id + "` neither begins nor ends at `" + rule.junction + "`";
      } else {
        link = is_to ? link_out_of(*street->second, rule.junction) : link_into(*street->second, rule.junction);
        if (!link.empty()) continue;
        result.reason =
            "`" + id +
            (is_to ? "` is one-way and leads here: nobody leaves by it" : "` is one-way and leads away: nobody arrives by it");
      }
      return;
    }
    result.place.clear();
    if (rule.rule == "no" || rule.rule == "only") return;
    result = {0, "rule", "`" + rule.rule + "` is no rule; write `no` or `only`"};
  }

  int add(const DistrictTurn& rule, const ForbiddenTurn& turn, std::vector<ForbiddenTurn>& turns) const {
    if (!links_.contains(turn.from)) return 0;
    const std::size_t before = turns.size();
    if (rule.rule != "only") {
      if (links_.contains(turn.to)) turns.push_back(turn);
    } else if (const auto here = departures_.find(junction_node(rule.junction)); here != departures_.end()) {
      for (const std::string& departure : here->second)
        if (!allowed_.at(turn.from).contains(departure)) turns.push_back({turn.from, departure});
    }
    return static_cast<int>(turns.size() - before);
  }

  std::map<std::string, const DistrictStreet*> street_of_;
  std::map<std::string, std::set<std::string>> departures_, allowed_;  // by node, and by way in
  std::set<std::string> links_;
  std::vector<ForbiddenTurn> found_;  // by rule
};

}  // namespace

std::vector<ForbiddenTurn> forbidden_turns(std::span<const DistrictTurn> rules, std::span<const DistrictStreet> streets,
                                           std::span<const TrafficLink> links, std::vector<DistrictResult::Turn>& results) {
  return Rules(streets, links).read(rules, results);
}

}  // namespace bl
