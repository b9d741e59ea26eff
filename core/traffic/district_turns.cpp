// Finds the links that rules of turning speak of, or says why there are none.
#include "core/traffic/district_turns.h"

#include <map>
#include <set>

namespace bl::traffic {

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

  // Adds what is forbidden at one junction.
  DistrictResult::Rules read(const DistrictRules& rules, std::vector<ForbiddenTurn>& turns) const {
    DistrictResult::Rules result;
    std::vector<ForbiddenTurn> found(rules.turns.size());
    std::vector<bool> holds;
    std::map<std::string, std::set<std::string>> allowed;  // by way in: several rules of the kind `only` leave the choice
    for (std::size_t r = 0; r < rules.turns.size(); ++r) {
      const auto links = links_of(rules.turns[r], rules.junction);
      holds.push_back(links.ok());
      if (links) found[r] = *links;
      else result.reason += (result.reason.empty() ? "turns/" : "; turns/") + std::to_string(r) + "/" + links.error().text();
      if (links && rules.turns[r].rule == "only") allowed[links->from].insert(links->to);
    }
    const std::size_t before = turns.size();
    for (std::size_t r = 0; r < rules.turns.size(); ++r) {
      if (!holds[r] || !links_.contains(found[r].from)) continue;
      if (rules.turns[r].rule == "only") forbid_others(found[r].from, rules.junction, allowed.at(found[r].from), turns);
      else if (links_.contains(found[r].to)) turns.push_back(found[r]);
    }
    result.forbidden = static_cast<int>(turns.size() - before);
    return result;
  }

 private:
  // An error's place is the member that is wrong.
  Result<ForbiddenTurn> links_of(const DistrictTurn& turn, const std::string& junction) const {
    ForbiddenTurn found;
    for (const bool is_to : {false, true}) {
      const std::string& id = is_to ? turn.to : turn.from;
      const char* const place = is_to ? "to" : "from";
      const auto street = street_of_.find(id);
      if (street == street_of_.end())
        return Error{ErrorCode::not_found, place,
                     id.empty() ? "it names no street" : "`" + id + "` is no street of this network"};
      if (street->second->start != junction && street->second->end != junction)
        return Error{ErrorCode::conflict, place, "`" + id + "` neither begins nor ends at `" + junction + "`"};
      if (street->second->start == street->second->end)
        return Error{ErrorCode::conflict, place, "`" + id + "` begins and ends at `" + junction + "`: no way leads over it"};
      std::string& link = is_to ? found.to : found.from;
      link = is_to ? link_out_of(*street->second, junction) : link_into(*street->second, junction);
      if (link.empty())
        return Error{ErrorCode::conflict, place,
                     "`" + id +
                         (is_to ? "` is one-way and leads here: nobody leaves by it"
                                : "` is one-way and leads away: nobody arrives by it")};
    }
    if (turn.rule != "no" && turn.rule != "only")
      return Error{ErrorCode::parse, "rule", "`" + turn.rule + "` is no rule; write `no` or `only`"};
    return found;
  }

  void forbid_others(const std::string& from, const std::string& junction, const std::set<std::string>& allowed,
                     std::vector<ForbiddenTurn>& turns) const {
    const auto here = departures_.find(junction_node(junction));
    if (here == departures_.end()) return;
    for (const std::string& departure : here->second)
      if (!allowed.contains(departure)) turns.push_back({from, departure});
  }

  std::map<std::string, const DistrictStreet*> street_of_;
  std::map<std::string, std::set<std::string>> departures_;  // by node
  std::set<std::string> links_;
};

}  // namespace

std::vector<ForbiddenTurn> forbidden_turns(std::span<const DistrictRules> rules, std::span<const DistrictStreet> streets,
                                           std::span<const TrafficLink> links, std::vector<DistrictResult::Rules>& results) {
  std::vector<ForbiddenTurn> turns;
  results.clear();
  if (rules.empty()) return turns;
  const Rules reader(streets, links);
  for (const DistrictRules& one : rules) results.push_back(reader.read(one, turns));
  return turns;
}

}  // namespace bl::traffic
