// Demands as numbers, intervals and floor areas, and the groups that they belong to.
#include "ui/cli/demand_fields.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "ui/cli/json_fields.h"
#include "ui/cli/scene_loading.h"

namespace bl::cli {

namespace {

constexpr const char* kDemandForms =
    "a volume in m³ such as 1200, {\"min\": 900, \"max\": 1200}, or {\"floor_area\": 400, \"storey_height\": 3}";
// More than any boundary can hold, whose coordinates end at 1e8 m.
constexpr double kLargestDemand = 1e25;

// What a demand without a maximum is told instead: twice what the box about the domain could hold, or all storeys on it.
double largest_possible(const SiteCase& c, const geometry::VolumeDemand& demand) {
  const Vector3 box = c.boundary.domain.maximum - c.boundary.domain.minimum;
  if (!c.standing.empty()) {
    double storeys = 0;
    for (const geometry::StandingSite& site : c.standing) storeys += site.storeys();
    const double floors = 2 * box.x * box.y * storeys;
    return demand.kind == geometry::VolumeDemand::Kind::volume ? floors * c.standing.front().storey_height : floors;
  }
  if (demand.kind == geometry::VolumeDemand::Kind::volume) return 2 * box.x * box.y * box.z;
  return 2 * box.x * box.y * (box.z / demand.storey_height + 1);
}

Result<double> amount_at(const Json& json, const std::string& place) {
  const auto amount = number_at(json, place);
  if (!amount) return amount.error();
  if (*amount < 0) return Error{ErrorCode::out_of_range, place, "a demand is 0 or more, found " + excerpt(json)};
  if (*amount > kLargestDemand)
    return Error{ErrorCode::out_of_range, place, "no boundary is that large (" + excerpt(json) + "): check the unit"};
  return amount;
}

// Sets least and most from a number or from {"min", "max"}.
Result<void> read_bounds(const Json& json, const SiteCase& c, const std::string& place, geometry::VolumeDemand& demand) {
  if (!json.is_object()) {
    const auto amount = amount_at(json, place);
    if (!amount) return amount.error();
    demand.least = demand.most = *amount;
    return {};
  }
  if (auto checked = check_keys(json, {"min", "max"}, place); !checked) return checked.error();
  if (json.empty()) return Error{ErrorCode::missing, place, "has neither `min` nor `max`: give one of them, or both"};
  const auto least = json.contains("min") ? amount_at(json["min"], slash(place, "min")) : Result<double>(0.0);
  if (!least) return least.error();
  const auto most = json.contains("max") ? amount_at(json["max"], slash(place, "max"))
                                         : Result<double>(std::max(*least, largest_possible(c, demand)));
  if (!most) return most.error();
  if (*least > *most)
    return Error{ErrorCode::conflict, place,
                 "the minimum " + shortest(*least) + " is more than the maximum " + shortest(*most) + ": exchange them"};
  demand.least = *least;
  demand.most = *most;
  return {};
}

Result<geometry::VolumeDemand> demand_at(const Json& json, const SiteCase& c, const std::string& place) {
  geometry::VolumeDemand demand;
  if (!c.standing.empty()) demand.storey_height = c.standing.front().storey_height;
  if (!json.is_number() && !json.is_object())
    return Error{ErrorCode::wrong_kind, place, std::string("expects ") + kDemandForms + ", found " + excerpt(json)};
  if (!json.is_object() || !(json.contains("floor_area") || json.contains("storey_height"))) {
    if (auto read = read_bounds(json, c, place, demand); !read) return read.error();
    return demand;
  }
  if (auto checked = check_keys(json, {"floor_area", "storey_height"}, place); !checked) return checked.error();
  if (!json.contains("floor_area"))
    return Error{ErrorCode::missing, slash(place, "floor_area"), "`floor_area` is missing beside `storey_height`"};
  demand.kind = geometry::VolumeDemand::Kind::floor_area;
  if (json.contains("storey_height")) {
    const std::string here = slash(place, "storey_height");
    const auto height = number_at(json["storey_height"], here);
    if (!height) return height.error();
    if (!c.standing.empty() && *height != demand.storey_height)
      return Error{ErrorCode::conflict, here,
                   "is " + excerpt(json["storey_height"]) + " here and " + shortest(demand.storey_height) +
                       " in `form`: leave it out here"};
    const geometry::Domain& domain = c.boundary.domain;
    const double least = (domain.maximum.z - domain.minimum.z) / geometry::kMostStoreys;
    if (!(*height > 0) || *height < least || *height > 2 * geometry::kLargestCoordinate)
      return Error{ErrorCode::out_of_range, here,
                   "must be a height in m with at most " + shortest(geometry::kMostStoreys) + " storeys in the boundary, found " +
                       excerpt(json["storey_height"])};
    demand.storey_height = *height;
  }
  if (auto read = read_bounds(json["floor_area"], c, slash(place, "floor_area"), demand); !read) return read.error();
  return demand;
}

// Which sites keep their weight because they are in `locked`.
Result<std::vector<bool>> locked_at(const Json& json, const SiteCase& c) {
  std::vector<bool> locked(c.problem.sites.size(), false);
  if (!json.contains("locked")) return locked;
  const auto indices = indices_at(json["locked"], locked.size(), "site", slash(c.place, "locked"));
  if (!indices) return indices.error();
  for (const std::uint32_t site : *indices) locked[site] = true;
  return locked;
}

Result<std::vector<std::vector<std::uint32_t>>> groups_at(const Json& json, const SiteCase& c, const std::vector<bool>& locked) {
  const auto list = list_at(json, "groups", c.place);
  if (!list) return list.error();
  std::vector<std::vector<std::uint32_t>> groups;
  std::map<std::uint32_t, std::size_t> group_of;
  for (std::size_t g = 0; g < (*list)->size(); ++g) {
    const std::string here = slash(slash(c.place, "groups"), g);
    auto sites = indices_at((**list)[g], c.problem.sites.size(), "site", here);
    if (!sites) return sites.error();
    if (sites->empty()) return Error{ErrorCode::missing, here, "the group is empty: name its sites, or remove it and its demand"};
    for (const std::uint32_t site : *sites) {
      const auto [before, is_new] = group_of.emplace(site, g);
      if (!is_new)
        return Error{ErrorCode::duplicate, here,
                     "site " + std::to_string(site) + " is in group " + std::to_string(before->second) +
                         " already: a site belongs to one group at most"};
      if (locked[site])
        return Error{ErrorCode::conflict, here,
                     "site " + std::to_string(site) + " is locked: take it out of the group or out of `locked`"};
    }
    groups.push_back(std::move(*sites));
  }
  return groups;
}

Result<void> read_group_demands(const Json& json, const Json& demands, const std::vector<bool>& locked, SiteCase& into) {
  auto groups = groups_at(json, into, locked);
  if (!groups) return groups.error();
  const std::string place = slash(into.place, "demands");
  if (demands.size() != groups->size())
    return Error{
        ErrorCode::conflict, place,
        "expects one demand for each group: " + counted(groups->size(), "group") + ", " + counted(demands.size(), "demand")};
  for (std::size_t g = 0; g < groups->size(); ++g) {
    auto demand = demand_at(demands[g], into, slash(place, g));
    if (!demand) return demand.error();
    demand->sites = std::move((*groups)[g]);
    into.problem.demands.push_back(std::move(*demand));
  }
  return {};
}

Result<void> read_single_demands(const Json& demands, const std::vector<bool>& locked, SiteCase& into) {
  const std::string place = slash(into.place, "demands");
  if (demands.size() != locked.size())
    return Error{
        ErrorCode::conflict, place,
        "expects one demand for each site: " + counted(locked.size(), "site") + ", " + counted(demands.size(), "demand")};
  for (std::uint32_t site = 0; site < locked.size(); ++site) {
    const std::string here = slash(place, site);
    if (locked[site] && demands[site].is_null()) continue;
    if (demands[site].is_null())
      return Error{ErrorCode::missing, here,
                   "null stands for a site that keeps its weight: list site " + std::to_string(site) + " in `locked`, or give " +
                       kDemandForms};
    auto demand = demand_at(demands[site], into, here);
    if (!demand) return demand.error();
    demand->sites = {site};
    if (!locked[site]) into.problem.demands.push_back(std::move(*demand));
  }
  return {};
}

// Sites without a demand keep their weight, which somebody has to have given then.
Result<void> check_kept(const Json& json, const SiteCase& c) {
  if (c.problem.demands.empty())
    return Error{ErrorCode::missing, slash(c.place, "demands"),
                 "there is no demand to meet: give one to a site or group that is not locked"};
  if (json.contains("weights")) return {};
  std::vector<bool> is_free(c.problem.sites.size(), false);
  for (const geometry::VolumeDemand& demand : c.problem.demands)
    for (const std::uint32_t site : demand.sites) is_free[site] = true;
  const auto kept = std::find(is_free.begin(), is_free.end(), false);
  if (kept == is_free.end()) return {};
  return Error{ErrorCode::missing, slash(c.place, "weights"),
               "`weights` is missing: site " + std::to_string(kept - is_free.begin()) +
                   " has no demand and keeps its weight, so it needs one"};
}

// --- Tables ---------------------------------------------------------------------------------------------------------

std::string line_place(std::size_t line) { return "line " + std::to_string(line); }

bool has_demand(const importing::SiteRow& row) { return row.demand || row.demand_min || row.demand_max; }

Result<geometry::VolumeDemand> demand_of(const importing::SiteRow& row, const SiteCase& c) {
  if (row.demand && (row.demand_min || row.demand_max))
    return Error{ErrorCode::conflict, line_place(row.line),
                 "has both a demand and bounds of it: keep `demand`, or `demand_min` and `demand_max`"};
  Json json;
  if (row.demand) json = *row.demand;
  if (row.demand_min) json["min"] = *row.demand_min;
  if (row.demand_max) json["max"] = *row.demand_max;
  return demand_at(json, c, line_place(row.line));
}

// A row joins the group of its text; the demand of a group stands in one of its rows, or alike in several.
Result<void> join_group(const importing::SiteRow& row, const importing::SiteRow& first, geometry::VolumeDemand& group,
                        SiteCase& into) {
  if (!has_demand(row)) return {};
  auto demand = demand_of(row, into);
  if (!demand) return demand.error();
  if (has_demand(first) && (demand->least != group.least || demand->most != group.most))
    return Error{ErrorCode::conflict, line_place(row.line),
                 "group `" + row.group + "` has another demand in line " + std::to_string(first.line) +
                     ": give the demand of the whole group in one row, or the same number in all"};
  group.least = demand->least;
  group.most = demand->most;
  return {};
}

}  // namespace

Result<void> read_demands(const Json& json, SiteCase& into) {
  const auto demands = list_at(json, "demands", into.place);
  if (!demands) return demands.error();
  const auto locked = locked_at(json, into);
  if (!locked) return locked.error();
  auto read = json.contains("groups") ? read_group_demands(json, **demands, *locked, into)
                                      : read_single_demands(**demands, *locked, into);
  return read ? check_kept(json, into) : read;
}

Result<void> read_demands(const importing::SiteTable& table, SiteCase& into) {
  const std::string header = line_place(table.header_line);
  if (!table.has_demands)
    return Error{ErrorCode::missing, header,
                 "there is no column demand, demand_min or demand_max; accepted are " + importing::site_table_columns()};
  struct Group {
    std::size_t demand = 0;                    // index into the problem's demands
    const importing::SiteRow* told = nullptr;  // the row whose demand it has, or its first row
  };
  std::map<std::string, Group> groups;
  for (std::uint32_t site = 0; site < table.rows.size(); ++site) {
    const importing::SiteRow& row = table.rows[site];
    const auto known = row.group.empty() ? groups.end() : groups.find(row.group);
    if (known != groups.end()) {
      geometry::VolumeDemand& demand = into.problem.demands[known->second.demand];
      if (auto joined = join_group(row, *known->second.told, demand, into); !joined) return joined.error();
      if (has_demand(row)) known->second.told = &row;
      demand.sites.push_back(site);
      continue;
    }
    if (row.group.empty() && !has_demand(row)) {
      if (row.weight) continue;
      return Error{ErrorCode::missing, line_place(row.line), "has neither a demand nor a weight to keep: give one of them"};
    }
    auto demand = has_demand(row) ? demand_of(row, into) : Result<geometry::VolumeDemand>(geometry::VolumeDemand{});
    if (!demand) return demand.error();
    demand->sites = {site};
    if (!row.group.empty()) groups[row.group] = {into.problem.demands.size(), &row};
    into.problem.demands.push_back(std::move(*demand));
  }
  for (const auto& [name, group] : groups)
    if (!has_demand(*group.told))
      return Error{ErrorCode::missing, line_place(group.told->line),
                   "no row of group `" + name + "` has its demand: give it in one of them"};
  if (into.problem.demands.empty())
    return Error{ErrorCode::missing, header, "there is no demand to meet: give one to a site or group"};
  return {};
}

}  // namespace bl::cli
