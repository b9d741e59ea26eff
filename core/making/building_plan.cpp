// Items of a row are dealt out evenly among those of the row that carries or holds them.
#include "core/making/building_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "core/base/plural.h"
#include "core/base/text.h"

namespace bl::making {

namespace {

constexpr double kCoverage = 0.45;  // share of the ground that footprints cover where the brief says no storeys
// The same of a roof, by one building and by several, whose blocks have to fit beside each other.
constexpr double kRoofOfOne = 0.9, kRoofOfSeveral = 0.5;
constexpr int kMostCellarStoreys = 20;
constexpr double kLeastOfLargest = 0.25;  // footprint of a building that gets cellars, to the largest
constexpr std::size_t kMostTold = 5;      // buildings in a sentence

class Planner {
 public:
  Planner(const SceneParts& parts, const std::vector<NewVolume>& volumes, double ground, const Vector3& along)
      : rows_(parts.programme.rows), parts_(parts), volumes_(volumes), plan_(volumes.size()), ground_(ground), along_(along) {
    items_.resize(rows_.size());
    for (std::size_t r = 0; r < rows_.size(); ++r) row_of_[rows_[r].use] = r;
    for (std::size_t v = 0; v < volumes.size(); ++v) items_[volumes[v].row].push_back(v);
  }

  std::vector<BuildingPart> run(std::vector<std::string>& notes) {
    join();
    // What carries others has its storeys and footprint before those.
    for (std::size_t v = 0; v < plan_.size(); ++v) settle(v);
    place_on_roofs();
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (rows_[r].is_below_ground) notes.push_back(dig(r));
    return std::move(plan_);
  }

 private:
  void join() {
    for (std::size_t v = 0; v < plan_.size(); ++v) {
      const importing::ProgrammeRow& row = rows_[volumes_[v].row];
      const std::string& named = row.on.empty() ? row.shares : row.on;
      if (named.empty()) continue;
      const std::vector<std::size_t>& others = items_[row_of_.at(named)];
      const std::size_t number = v - items_[volumes_[v].row].front();  // items of a row stand together
      (row.on.empty() ? plan_[v].host : plan_[v].base) = others[number % others.size()];
    }
    sharers_.resize(plan_.size());
    carried_.resize(plan_.size());
    for (std::size_t v = 0; v < plan_.size(); ++v) sharers_[plan_[v].host.value_or(v)].push_back(v);  // in the order of rows
    for (std::size_t v = 0; v < plan_.size(); ++v) {
      if (!plan_[v].base) continue;
      // The roof of a building that several share is its host's.
      plan_[v].base = plan_[*plan_[v].base].host.value_or(*plan_[v].base);
      carried_[*plan_[v].base].push_back(v);
    }
    for (const std::vector<std::size_t>& sharers : sharers_)
      for (std::size_t k = 0; sharers.size() > 1 && k < sharers.size(); ++k)
        plan_[sharers[k]].order = static_cast<int>(std::min<std::size_t>(k, 100));
  }

  double floors_of(std::size_t v) const { return rows_[volumes_[v].row].floor_area; }

  // Storeys and footprint of a building: what its rows say, else as many as the ground or the roof below asks for.
  void settle(std::size_t v) {
    BuildingPart& part = plan_[v];
    if (part.footprint > 0) return;
    if (part.host) {
      settle(*part.host);
      part.footprint = plan_[*part.host].footprint;
      part.storeys = plan_[*part.host].storeys;
      return;
    }
    double all = 0, said = 0;
    int storeys_said = 0;
    double height = 0;
    for (const std::size_t one : sharers_[v]) {
      const importing::ProgrammeRow& row = rows_[volumes_[one].row];
      all += floors_of(one);
      height = std::max(height, row.storey_height);
      if (row.storeys == 0) continue;
      said += floors_of(one);
      storeys_said += row.storeys;
    }
    if (storeys_said > 0) part.storeys = storeys_said + static_cast<int>(std::ceil((all - said) / (said / storeys_said) - 1e-9));
    else part.storeys = usual_storeys(v, all, height);
    part.storeys = std::clamp(part.storeys, 1, 500);
    part.footprint = all / part.storeys;
  }

  int usual_storeys(std::size_t v, double floors, double height) {
    const int most = static_cast<int>(std::max(1.0, std::floor(parts_.height / height + 1e-9)));
    double needed = parts_.programme.floor_area / (kCoverage * ground_);
    if (plan_[v].base) {
      settle(*plan_[v].base);
      double carried = 0;
      for (const std::size_t other : carried_[*plan_[v].base])
        for (const std::size_t one : sharers_[other]) carried += floors_of(one);
      const double share = carried_[*plan_[v].base].size() == 1 ? kRoofOfOne : kRoofOfSeveral;
      needed = carried / (share * plan_[*plan_[v].base].footprint);
    } else if (!carried_[v].empty()) {
      needed = floors / (kCoverage * ground_);  // wide and low, as others stand on it
    }
    return static_cast<int>(std::clamp(std::ceil(needed - 1e-9), 1.0, static_cast<double>(most)));
  }

  // Several on one roof begin beside each other.
  void place_on_roofs() {
    for (std::size_t base = 0; base < carried_.size(); ++base) {
      const std::vector<std::size_t>& all = carried_[base];
      const double step = std::sqrt(plan_[base].footprint) / static_cast<double>(std::max<std::size_t>(1, all.size()));
      for (std::size_t k = 0; k < all.size(); ++k) {
        plan_[all[k]].is_alone_on_roof = all.size() == 1;
        plan_[all[k]].offset = along_ * (step * (static_cast<double>(k) - 0.5 * static_cast<double>(all.size() - 1)));
      }
    }
    for (std::size_t v = 0; v < plan_.size(); ++v)
      plan_[v].cellar_storeys = root_of(plan_, v) == v || plan_[v].host ? rows_[volumes_[v].row].cellar_storeys : 0;
    // Those of a building are its host's.
    for (std::size_t v = 0; v < plan_.size(); ++v)
      if (plan_[v].host) {
        BuildingPart& host = plan_[*plan_[v].host];
        host.cellar_storeys = std::max(host.cellar_storeys, std::exchange(plan_[v].cellar_storeys, 0));
      }
    for (std::size_t v = 0; v < plan_.size(); ++v)
      if (!plan_[v].host) plan_[v].depth = depth_of(v);
  }

  double depth_of(std::size_t host) const {
    if (const auto& said = rows_[volumes_[host].row].depth) return *said;
    double least = 0;
    for (const std::size_t v : sharers_[host])
      if (const UseRates* rates = rates_of(rows_[volumes_[v].row]); rates != nullptr && rates->building_depth > 0)
        least = least > 0 ? std::min(least, rates->building_depth) : rates->building_depth;
    return least;
  }

  // A row below the ground becomes storeys under the buildings with the largest footprints, or under those that it names.
  std::string dig(std::size_t r) {
    const importing::ProgrammeRow& row = rows_[r];
    const double asked = row.floor_area * row.count;
    std::vector<std::size_t> sites;
    std::set<std::size_t> known;
    const std::size_t host_row = row.shares.empty() ? r : row_of_.at(row.shares);
    for (std::size_t v = 0; v < plan_.size(); ++v) {
      if (!row.shares.empty() && volumes_[v].row != host_row) continue;
      const std::size_t site = root_of(plan_, v);
      if (known.insert(site).second) sites.push_back(site);
    }
    const std::string name = "`" + row.use + "` ";
    if (sites.empty())
      return name + "lies below the ground, and there is no volume above it: its " + written_out(asked) + " m² were left out.";
    std::stable_sort(sites.begin(), sites.end(),
                     [this](std::size_t a, std::size_t b) { return plan_[a].footprint > plan_[b].footprint; });
    // Cellars under what is small are not worth their walls.
    const double largest = plan_[sites.front()].footprint;
    std::erase_if(sites, [&](std::size_t site) { return plan_[site].footprint < kLeastOfLargest * largest; });
    std::map<std::size_t, int> storeys;
    double dug = 0;
    for (int level = 1; level <= kMostCellarStoreys; ++level)
      for (std::vector<std::size_t> left = sites; !left.empty() && dug < asked * (1 - 1e-9);) {
        // The smallest that is enough for the rest, else the largest.
        const auto enough = std::find_if(left.rbegin(), left.rend(),
                                         [&](std::size_t site) { return plan_[site].footprint >= (asked - dug) * (1 - 1e-9); });
        const auto chosen = enough == left.rend() ? left.begin() : std::prev(enough.base());
        const std::size_t site = *chosen;
        left.erase(chosen);
        if (plan_[site].cellar_storeys >= kMostCellarStoreys) continue;
        ++plan_[site].cellar_storeys;
        ++storeys[site];
        dug += plan_[site].footprint;
      }
    std::string list;
    std::size_t told = 0;
    for (const std::size_t site : sites)
      if (storeys.contains(site) && told++ < kMostTold)
        list += (list.empty() ? "" : ", ") + how_many(static_cast<std::size_t>(storeys[site]), "storey") + " under `" +
                volumes_[site].id + "`";
    if (told > kMostTold) list += " and under " + std::to_string(told - kMostTold) + " more";
    if (list.empty()) list = "because all buildings have the most that they may have";
    return name + "lies below the ground and is no floor area: about " + written_out(std::round(dug)) +
           " m² of cellars for the " + written_out(asked) + " m² asked for, " + list + ".";
  }

  const std::vector<importing::ProgrammeRow>& rows_;
  const SceneParts& parts_;
  const std::vector<NewVolume>& volumes_;
  std::vector<BuildingPart> plan_;
  std::vector<std::vector<std::size_t>> items_, sharers_, carried_;  // of rows; of hosts, with themselves; of bases
  std::map<std::string, std::size_t> row_of_;
  double ground_ = 0;
  Vector3 along_;
};

}  // namespace

const UseRates* rates_of(const importing::ProgrammeRow& row) {
  const UseRates* rates = use_rates(row.use);
  return rates != nullptr && rates->is_open == row.is_open ? rates : nullptr;
}

std::size_t root_of(const std::vector<BuildingPart>& plan, std::size_t volume) {
  while (plan[volume].host || plan[volume].base) volume = plan[volume].host ? *plan[volume].host : *plan[volume].base;
  return volume;
}

std::vector<BuildingPart> plan_buildings(const SceneParts& parts, const std::vector<NewVolume>& volumes, double ground,
                                         const Vector3& along, std::vector<std::string>& notes) {
  return Planner(parts, volumes, ground, along).run(notes);
}

}  // namespace bl::making
