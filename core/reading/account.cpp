// Reads demands, limits and results of all volumes once, and sums them by use, against what programmes ask for.
#include "core/reading/account.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text.h"
#include "core/demand/brief_sums.h"
#include "core/reading/figures.h"
#include "core/reading/storeys.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/programme.h"

namespace bl::reading {

namespace {

// A litre, a square centimetre: less than this is nothing that anybody asks for or misses.
constexpr double kNothing = 1e-3;

double share_missing(double asked, double had) { return asked > kNothing ? std::clamp((asked - had) / asked, 0.0, 1.0) : 0; }

VolumeAccount account_of(reading::Row<reading::VolumeFigures>&& row, const BriefTargets& targets,
                         const std::set<std::string_view>& uses_of_brief) {
  VolumeAccount account;
  account.node = row.node;
  account.figures = std::move(row.figures);
  const reading::VolumeFigures& figures = account.figures;
  const auto other = targets.use_by_node.find(account.node);
  account.use = other != targets.use_by_node.end() ? other->second : figures.use;
  account.is_by_area = uses_of_brief.contains(account.use) && targets.nodes.contains(account.node);
  account.is_alive = figures.state == "alive";
  account.asked = std::max(figures.demand, figures.demand_min);
  // Before a solver has seen the volume nobody aims at anything yet: then its limits themselves are the next best word.
  account.limited =
      figures.state == "idle" ? std::max(std::min(figures.demand, figures.demand_limit), figures.demand_min) : figures.wanted;
  account.volume = figures.volume;
  account.floor_area = figures.floor_area;
  if (figures.storey_height > 0) {
    account.asked_area = account.asked / figures.storey_height;
    account.limited_area = account.limited / figures.storey_height;
  }
  return account;
}

// A use gets what its brief asks for or what its volumes do, whichever is more: whoever asked, it is missing where it is not
// there.
void finish_use(UseAccount& use) {
  constexpr double kRounding = 1e-9;
  if (!use.is_in_programme) return;
  if (!(use.asked > use.brief_volume * (1 + kRounding))) use.asked = use.brief_volume;
  if (!(use.asked_area > use.brief_area * (1 + kRounding))) use.asked_area = use.brief_area;
  use.is_by_area = true;
}

// `name` gives the name, which only the worst has to be asked for.
template <class Name>
void note_worst(Accounts& accounts, double share, const Name& name) {
  if (!(share > accounts.worst_short)) return;
  accounts.worst_short = share;
  accounts.worst = name();
}

std::set<std::string_view> uses_of(const Brief& brief) {
  std::set<std::string_view> uses;
  for (const auto& [use, row] : brief) uses.insert(use);
  return uses;
}

// Names by commas, the last by "and"; no more than four of them.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), kMost); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return names.size() > kMost ? text + " and " + std::to_string(names.size() - kMost) + " more" : text;
}

// Which of the rules that a link holds are used up, or nearly: a plot has several, and one of them limits the volume.
std::string rules_used_up(const State& state, const LinkPlan& link, const reading::VolumeFigures& volume) {
  constexpr double kNearly = 0.98;
  const auto held = reading::parameters_of<reading::PlotRuleParameters>(link);
  if (!held || link.nodes[0].size() != 1) return "";
  const reading::PlotFigures plot =
      reading::row_of<reading::PlotFigures>(state, link.nodes[0].front()).value_or(reading::PlotFigures{});
  std::vector<std::string> rules;
  if (held->hold_fsi && plot.fsi >= kNearly * plot.fsi_max) rules.emplace_back("FSI");
  if (held->hold_gsi && plot.gsi >= kNearly * plot.gsi_max) rules.emplace_back("GSI");
  const double top = volume.bottom + volume.height;
  if (held->hold_height && top - plot.ground >= kNearly * plot.height_max) rules.emplace_back("height");
  return rules.empty() ? "" : " (" + listed(rules) + ")";
}

// The parts that all share: what limits take, what the room takes, what the shape takes.
std::string causes_of(const Account& account, const std::vector<std::string>& limiters, double tolerance) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (account.withheld() > tolerance * account.asked)
    add((limiters.empty() ? std::string("limits leave ") : listed(limiters) + (limiters.size() == 1 ? " leaves " : " leave ")) +
        quantity(account.limited, Unit::cubic_metre) + " of " + quantity(account.asked, Unit::cubic_metre));
  const double aimed = account.is_by_area ? account.limited_area : account.limited;
  const double has = account.is_by_area ? account.floor_area : account.volume;
  const Unit unit = account.is_by_area ? Unit::square_metre : Unit::cubic_metre;
  if (share_missing(aimed, has) > tolerance)
    add("there is room for " + quantity(has, unit) + " of the " + quantity(aimed, unit) + " aimed at");
  if (text.empty()) add("limits, room and shape each take a little");
  return text;
}

}  // namespace

double Account::missing() const { return is_by_area ? missing_area_share() * asked : std::max(0.0, asked - volume); }
double Account::missing_area() const { return std::max(0.0, asked_area - floor_area); }
double Account::withheld() const { return std::max(0.0, asked - limited); }

double Account::missing_share() const { return is_by_area ? missing_area_share() : share_missing(asked, volume); }
double Account::missing_area_share() const { return share_missing(asked_area, floor_area); }

double Account::short_share() const { return missing_share(); }

double Account::difference() const { return is_by_area ? area_difference() : asked > kNothing ? (volume - asked) / asked : 0; }
double Account::standing() const { return short_share() > 0 ? -short_share() : difference(); }
double Account::area_difference() const { return asked_area > kNothing ? (floor_area - asked_area) / asked_area : 0; }

void Account::add(const Account& other) {
  asked += other.asked;
  limited += other.limited;
  volume += other.volume;
  asked_area += other.asked_area;
  limited_area += other.limited_area;
  floor_area += other.floor_area;
}

Brief brief_of(const State& state) {
  Brief brief;
  std::map<std::string, std::size_t> index;
  const std::set<std::string> open = open_uses(state);
  for (const auto& [node, programme] : reading::rows<reading::ProgrammeFigures>(state)) {
    const Table& table = *programme.rows;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      if (table.text(r, "use").empty()) continue;  // nobody is asked by it, which the programme itself says
      if (open.contains(lower_case(table.text(r, "use")))) continue;
      const auto [found, is_new] = index.emplace(table.text(r, "use"), brief.size());
      if (is_new) brief.emplace_back(found->first, BriefRow{});
      BriefRow& row = brief[found->second].second;
      const demand::BriefSums sums = demand::brief_sums(table, r);
      row.area += sums.area;
      row.volume += sums.volume;
    }
  }
  return brief;
}

bool has_same_uses(const Brief& a, const Brief& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return x.first == y.first; });
}

double account_tolerance(const State& state) { return std::max(state.plan->settings.tolerance, 1e-6); }

BriefTargets brief_targets(const Plan& plan) {
  BriefTargets targets;
  for (const LinkPlan& link : plan.links) {
    const auto demand = reading::parameters_of<reading::DemandParameters>(link);
    if (!demand || !link.is_enabled || link.error) continue;
    for (const std::uint32_t node : link.nodes[1]) {
      if (!demand->use.empty()) targets.use_by_node.emplace(node, demand->use);
      if (!link.is_muted) targets.nodes.insert(node);
    }
  }
  return targets;
}

std::size_t Accounts::row_of(std::uint32_t node) const {
  const auto found = std::lower_bound(volumes.begin(), volumes.end(), node,
                                      [](const VolumeAccount& volume, std::uint32_t n) { return volume.node < n; });
  return found != volumes.end() && found->node == node ? static_cast<std::size_t>(found - volumes.begin()) : volumes.size();
}

std::vector<VolumeAccount> accounts_of_volumes(const State& state, const std::vector<std::uint32_t>& nodes,
                                               const BriefTargets& targets, const Brief& brief) {
  const std::set<std::string_view> uses = uses_of(brief);
  std::vector<VolumeAccount> accounts;
  for (const std::uint32_t node : nodes)
    if (auto figures = reading::row_of<reading::VolumeFigures>(state, node))
      accounts.push_back(account_of({node, std::move(*figures)}, targets, uses));
  return accounts;
}

namespace {

// The volumes of each use, in ascending node. Neighbours in the list often have the same use.
std::map<std::string_view, std::vector<const VolumeAccount*>> volumes_by_use(const std::vector<VolumeAccount>& volumes) {
  std::map<std::string_view, std::vector<const VolumeAccount*>> members;
  const std::string* last = nullptr;
  std::vector<const VolumeAccount*>* of_last = nullptr;
  for (const VolumeAccount& volume : volumes) {
    if (last == nullptr || volume.use != *last) of_last = &members[volume.use];
    last = &volume.use;
    of_last->push_back(&volume);
  }
  return members;
}

}  // namespace

void add_up(const State& state, const Brief& brief, Accounts& accounts) {
  accounts.tolerance = account_tolerance(state);
  accounts.uses.clear();
  accounts.all = {};
  accounts.worst_short = 0;
  accounts.worst.clear();
  std::map<std::string, std::size_t, std::less<>> index;
  const auto use_of = [&](std::string_view use) -> UseAccount& {
    const auto [found, is_new] = index.emplace(use, accounts.uses.size());
    if (is_new) accounts.uses.emplace_back().use = use;
    return accounts.uses[found->second];
  };
  for (const auto& [use, row] : brief) {
    UseAccount& account = use_of(use);
    account.is_in_programme = true;
    account.brief_volume = row.volume;
    account.brief_area = row.area;
  }
  for (const auto& [use, volumes] : volumes_by_use(accounts.volumes)) {
    UseAccount& account = use_of(use);
    for (const VolumeAccount* volume : volumes) {
      account.add(*volume);
      ++account.volumes;
      account.short_volumes += volume->is_short(accounts.tolerance) ? 1 : 0;
      note_worst(accounts, volume->short_share(), [&] { return "volume " + state.plan->nodes[volume->node].name; });
    }
  }
  for (UseAccount& use : accounts.uses) {
    finish_use(use);
    accounts.all.add(use);
    accounts.all.is_in_programme |= use.is_in_programme;
    accounts.all.volumes += use.volumes;
    accounts.all.short_volumes += use.short_volumes;
    accounts.all.brief_volume += use.brief_volume;
    accounts.all.brief_area += use.brief_area;
    note_worst(accounts, use.short_share(), [&] { return use.use.empty() ? "what has no use" : use.use; });
  }
  accounts.open = open_accounts(state);
  for (const OpenAccount& open : accounts.open) note_worst(accounts, open.missing_share(), [&] { return open.use; });
  accounts.all.use = "all";
  accounts.all.is_by_area = accounts.all.is_in_programme;
}

Accounts accounts_of(const State& state) {
  Accounts accounts;
  const BriefTargets targets = brief_targets(*state.plan);
  const Brief brief = brief_of(state);
  const std::set<std::string_view> uses = uses_of(brief);
  for (reading::Row<reading::VolumeFigures>& row : reading::rows<reading::VolumeFigures>(state))
    accounts.volumes.push_back(account_of(std::move(row), targets, uses));
  add_up(state, brief, accounts);
  return accounts;
}

std::vector<std::string> who_limits(const State& state, const VolumeAccount& volume) {
  std::vector<std::string> who;
  const auto ref = reading::port_of<&reading::VolumeFigures::demand_limit>(*state.plan, volume.node);
  if (!ref || !(volume.withheld() > 0)) return who;
  const double limit = as_number(state.value(*ref));
  const auto holds = [&](const Value& value) { return as_number(value) <= limit * (1 + 1e-6); };
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    if (state.plan->links[l].is_muted) continue;
    const std::vector<Voice>& voices = state.links[l].voices;
    const auto voice =
        std::lower_bound(voices.begin(), voices.end(), *ref, [](const Voice& v, PortRef r) { return v.target < r; });
    if (voice != voices.end() && voice->target == *ref && voice->strength > 0 && holds(voice->value))
      who.push_back("link `" + state.plan->links[l].id + "`" + rules_used_up(state, state.plan->links[l], volume.figures));
  }
  const TypePlan& type = state.plan->nodes[volume.node].types[ref->type];
  if (type.is_set[ref->port] && holds(type.set_values[ref->port])) who.emplace_back("a limit set by hand");
  return who;
}

std::string why_short(const State& state, const Accounts& accounts, const VolumeAccount& volume) {
  if (!volume.is_short(accounts.tolerance)) return "";
  return causes_of(volume, who_limits(state, volume), accounts.tolerance);
}

namespace {

// What others of a use have too much makes up in its sum for what some go short of, and for nobody else.
std::string why_some_are_short(const State& state, const Accounts& accounts, const UseAccount& use) {
  const VolumeAccount* worst = nullptr;
  for (const VolumeAccount& volume : accounts.volumes)
    if (volume.use == use.use && volume.is_short(accounts.tolerance) &&
        (worst == nullptr || volume.short_share() > worst->short_share()))
      worst = &volume;
  if (worst == nullptr) return "";
  const std::string name = state.plan->nodes[worst->node].name;
  return (use.short_volumes > 1 ? std::to_string(use.short_volumes) + " of its volumes are short, `" + name + "` most: "
                                : "`" + name + "` alone is short: ") +
         why_short(state, accounts, *worst);
}

}  // namespace

std::string why_short(const State& state, const Accounts& accounts, const UseAccount& use) {
  if (!use.is_short(accounts.tolerance)) return why_some_are_short(state, accounts, use);
  if (use.volumes == 0) {
    const bool is_kept_open =
        std::ranges::any_of(accounts.open, [&](const OpenAccount& open) { return lower_case(open.use) == lower_case(use.use); });
    return "no volume has this use: add one, or give one that use" +
           std::string(is_kept_open ? "; ground is kept open for it, which counts once its node of the type `use` has `is_open`"
                                    : "");
  }
  std::vector<std::string> limiters;
  double unasked = use.asked;
  for (const VolumeAccount& volume : accounts.volumes) {
    if (volume.use != use.use) continue;
    unasked -= volume.asked;
    for (const std::string& who : who_limits(state, volume))
      if (std::find(limiters.begin(), limiters.end(), who) == limiters.end()) limiters.push_back(who);
  }
  if (unasked > accounts.tolerance * use.asked && use.limited >= (1 - accounts.tolerance) * (use.asked - unasked))
    return "its volumes ask for " + quantity(unasked, Unit::cubic_metre) +
           " less than the brief: other proposals change their demands, or no demand link connects the brief to them";
  std::size_t lacking = 0, full = 0;
  for (const VolumeAccount& volume : accounts.volumes)
    if (volume.use == use.use && volume.is_short(accounts.tolerance)) {
      ++lacking;
      full += has_all_storeys(state, volume.node) ? 1 : 0;
    }
  // Storeys are a wish of people, which no link raises: the ground alone is negotiated.
  return causes_of(use, limiters, accounts.tolerance) +
         (lacking > 0 && full == lacking ? "; all that lack it have the storeys that they wish: higher `storeys` need less ground"
                                         : "");
}

}  // namespace bl::reading
