// Reads uses, rows of programmes and the open ground of boundaries, and joins them by the names of uses.
#include "core/reading/open_space.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/demand/brief_sums.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/plan_ring.h"
#include "core/reading/figures.h"
#include "core/reading/views/programme.h"
#include "core/reading/views/solver.h"

namespace bl::reading {

namespace {

constexpr double kNoGround = 1e-3;     // [m²]
constexpr double kSameHeight = 0.001;  // [m]

}  // namespace

double OpenAccount::missing() const { return std::max(0.0, asked - area); }
double OpenAccount::missing_share() const { return asked > kNoGround ? missing() / asked : 0; }

std::set<std::string> open_uses(const State& state) {
  std::set<std::string> uses;
  for (const auto& [node, named] : rows<UseKind>(state))
    if (named.is_open) uses.insert(lower_case(named.use));
  return uses;
}

std::vector<OpenAccount> open_accounts(const State& state) {
  const std::set<std::string> open = open_uses(state);
  std::vector<OpenAccount> accounts;
  std::map<std::string, std::size_t> index;
  const auto account_of = [&](const std::string& use) -> OpenAccount& {
    const auto [found, is_new] = index.emplace(lower_case(use), accounts.size());
    if (is_new) accounts.emplace_back().use = use;
    return accounts[found->second];
  };
  if (!open.empty())
    for (const auto& [node, programme] : rows<ProgrammeFigures>(state))
      for (std::size_t row = 0; row < programme.rows->rows.size(); ++row) {
        const std::string& use = programme.rows->text(row, "use");
        if (!open.contains(lower_case(use))) continue;
        OpenAccount& account = account_of(use);
        account.is_in_programme = true;
        account.asked += demand::brief_sums(*programme.rows, row).area;
      }
  const auto of_brief = static_cast<std::ptrdiff_t>(accounts.size());
  for (const auto& [node, ground] : rows<OpenGround>(state)) {
    for (std::size_t row = 0; row < ground.areas->rows.size(); ++row) {
      OpenAccount& account = account_of(ground.areas->text(row, "use"));
      account.area += ground.areas->number(row, "area");
      account.drawn += ground.areas->number(row, "drawn");
    }
    if (ground.form != "plan") continue;
    for (const geometry::NamedRing& ring : geometry::read_rings(*ground.exclusions))
      if (const std::string& use = ground.exclusions->text(ring.first_row, "use");
          !use.empty() && ring.top < ground.bottom + ground.height - kSameHeight)
        account_of(use).roofed += std::abs(geometry::signed_area(ring.corners));
  }
  std::sort(accounts.begin() + of_brief, accounts.end(),
            [](const OpenAccount& a, const OpenAccount& b) { return a.use < b.use; });
  return accounts;
}

OpenAccount sum_of(const std::vector<OpenAccount>& accounts) {
  OpenAccount sum;
  sum.use = "all";
  for (const OpenAccount& account : accounts) {
    sum.is_in_programme |= account.is_in_programme;
    sum.asked += account.asked;
    sum.area += account.area;
    sum.drawn += account.drawn;
    sum.roofed += account.roofed;
  }
  return sum;
}

std::string why_short(const OpenAccount& account, double tolerance) {
  if (!account.is_short(tolerance)) return "";
  if (!(account.drawn > kNoGround))
    return "no boundary keeps ground open for it: lay it by `behaviourlinks add SCENE garden --open --use " + account.use +
           " --corners ...`, or as `exclusions` of a boundary with this use";
  const double lost = account.drawn - account.area;
  if (lost > kNoGround && account.roofed >= lost - kNoGround)
    return "of the " + quantity(account.drawn, Unit::square_metre) + " that are drawn, " +
           quantity(account.roofed, Unit::square_metre) +
           " end below the top of the boundary, so that volumes may stand above them: raise the `top` of its `exclusions`";
  if (lost > kNoGround && account.drawn >= account.asked * (1 - tolerance))
    return "of the " + quantity(account.drawn, Unit::square_metre) + " that are drawn, " + quantity(lost, Unit::square_metre) +
           " lie outside of the boundary, below what stays, or on ground that is open already: move them inside";
  return quantity(account.drawn, Unit::square_metre) + " are drawn" +
         (lost > kNoGround ? ", of which " + quantity(lost, Unit::square_metre) + " do not count" : std::string()) +
         ": make its `exclusions` in the boundary larger, or add more of them";
}

std::string shortage_of(const OpenAccount& account, double tolerance) {
  if (!account.is_short(tolerance)) return "";
  return quantity(account.asked, Unit::square_metre) + " of open space are asked for, and " +
         quantity(account.area, Unit::square_metre) + " are there: " + why_short(account, tolerance);
}

}  // namespace bl::reading
