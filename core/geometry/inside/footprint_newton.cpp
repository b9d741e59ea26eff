// Damped Newton steps on floor areas; see the README under "Standing volumes" for the matrix.
#include "core/geometry/inside/footprint_newton.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/inside/footprint_maker.h"
#include "core/geometry/inside/footprint_workshop.h"
#include "core/geometry/inside/row_system.h"

namespace bl::geometry {

namespace {

constexpr double kSmallShare = 0.02;
constexpr int kMostSmallSteps = 4, kMostHalvings = 10, kMostRepairs = 12, kRings = 2;
constexpr std::uint32_t kNoDemand = 0xffffffffu;
// Forms bound nothing where their part of all responses is below the first. They are lowered until the volume that loses most of
// its floor keeps a share between the other two.
constexpr double kTightShare = 1e-3, kKeptLeast = 0.6, kKeptMost = 0.9;
constexpr int kMostLoosenings = 3, kMostLowerings = 20;

}  // namespace

double weight_of_nothing(const StandingSite& site, const FootprintDiagram& diagram) {
  return site.form == FootprintForm::cell ? -4 * diagram.plot_area() : 0;
}

FootprintNewton::FootprintNewton(FootprintDiagram& diagram, std::vector<StandingSite>& sites,
                                 std::span<const FloorDemand> demands, const FootprintFitOptions& options, FootprintFit& report)
    : diagram_(diagram),
      sites_(sites),
      demands_(demands),
      options_(options),
      report_(report),
      demand_of_(sites.size(), kNoDemand),
      is_out_(demands.size(), 0),
      aims_(demands.size(), kAll) {
  for (std::uint32_t g = 0; g < demands.size(); ++g)
    for (const std::uint32_t i : demands[g].sites) demand_of_[i] = g;
}

Result<void> FootprintNewton::prepare() {
  if (auto done = measure(); !done) return done;
  leave_doubled();
  leave_groundless();
  find_filled();
  return {};
}

Result<bool> FootprintNewton::run(double factor, int most_steps, bool ends_with_lost) {
  factor_ = factor;
  is_stalled_ = false;
  make_room();
  if (auto done = evaluate(); !done) return done.error();
  began_empty_.assign(demands_.size(), 0);
  for (std::uint32_t g = 0; g < demands_.size(); ++g) began_empty_[g] = floors_[g] > 0 ? 0 : 1;
  if (auto done = repair(); !done) return done.error();
  // What has nothing however heavy it is has nothing at any factor.
  is_stalled_ = ends_with_lost && has_lost();
  if (is_stalled_) return false;
  least_ratio_ = 0.5 * std::min(1.0, smallest_ratio());
  int small_steps = 0;
  for (int step = 0; step < most_steps; ++step) {
    if (error() <= options_.tolerance) return true;
    const auto taken = take(newton_move());
    if (!taken) return taken.error();
    // Demands that cannot be met are approached by ever smaller steps.
    small_steps = share_ < kSmallShare ? small_steps + 1 : 0;
    if (!*taken || small_steps >= kMostSmallSteps) {
      const auto loosened = loosen();
      if (!loosened) return loosened.error();
      is_stalled_ = !*loosened;
      if (is_stalled_) return false;
      small_steps = 0;
      least_ratio_ = 0.5 * std::min(1.0, smallest_ratio());
      continue;
    }
    ++report_.steps;
    if (options_.progress && !options_.progress(report_.evaluations, error())) report_.is_stopped = true;
    if (report_.is_stopped) return false;
  }
  return error() <= options_.tolerance;
}

Result<void> FootprintNewton::evaluate() {
  ++report_.evaluations;
  return measure();
}

Result<void> FootprintNewton::measure() {
  if (auto made = diagram_.update(sites_, options_.pool); !made) return made.error();
  floors_.resize(demands_.size());
  double floors = 0, asked = 0;
  for (std::uint32_t g = 0; g < demands_.size(); ++g) {
    floors_[g] = floor_of(g);
    if (!counts(g)) continue;
    floors += floors_[g];
    asked += demands_[g].least;
  }
  if (fills_plot_ && asked > 0) factor_ = floors / asked;
  return {};
}

bool FootprintNewton::leave_out_worst() {
  std::uint32_t worst = kNoDemand;
  for (std::uint32_t g = 0; g < demands_.size(); ++g) {
    if (!counts(g) || !(demands_[g].least > 0)) continue;
    if (worst == kNoDemand || floors_[g] * demands_[worst].least < floors_[worst] * demands_[g].least) worst = g;
  }
  // What has half of what it wants is not what stands in the way of all.
  if (worst == kNoDemand || floors_[worst] > 0.5 * demands_[worst].least) return false;
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (g == worst || (counts(g) && demands_[g].least > 0 && !(floors_[g] > 0) && !(floors_[worst] > 0))) is_out_[g] = kLeftOut;
  return true;
}

bool FootprintNewton::leave_out_lost() {
  bool is_any = false;
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (is_lost(g)) is_out_[g] = kLeftOut, is_any = true;
  return is_any;
}

bool FootprintNewton::is_lost(std::uint32_t g) const {
  return counts(g) && demands_[g].least > 0 && !(floors_[g] > 0) && g < began_empty_.size() && began_empty_[g] != 0;
}

bool FootprintNewton::has_lost() const {
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (is_lost(g)) return true;
  return false;
}

double FootprintNewton::floor_of(std::uint32_t g) const {
  double sum = 0;
  for (const std::uint32_t i : demands_[g].sites) sum += diagram_.footprints()[i].floor_area;
  return sum;
}
double FootprintNewton::gain_of(std::uint32_t g) const {
  double sum = 0;
  for (const std::uint32_t i : demands_[g].sites) sum += diagram_.footprints()[i].own_response;
  return demands_[g].least > 0 ? sum / demands_[g].least : 0;
}

// Between its bounds a demand asks for nothing else than it has.
double FootprintNewton::error_of(std::uint32_t g, double factor) const {
  const double wanted = std::clamp(floor_of(g), factor * demands_[g].least, factor * demands_[g].most);
  return wanted > 0 ? std::abs(floor_of(g) - wanted) / wanted : 0;
}

std::size_t FootprintNewton::count_of(std::uint8_t why) const {
  return static_cast<std::size_t>(std::count(is_out_.begin(), is_out_.end(), why));
}
double FootprintNewton::wanted(std::uint32_t g) const {
  const double factor = std::min(factor_, aims_[g]);
  return std::clamp(floors_[g], factor * demands_[g].least, factor * demands_[g].most);
}

std::vector<std::vector<std::uint32_t>> FootprintNewton::touching() const {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::uint8_t> is_in(demands_.size(), 0);
  for (std::uint32_t first = 0; first < demands_.size(); ++first) {
    if (!counts(first) || is_in[first] != 0) continue;
    is_in[first] = 1;
    std::vector<std::uint32_t>& group = groups.emplace_back(1, first);
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const std::uint32_t i : demands_[group[k]].sites)
        for (const FootprintMeasure::Neighbour& n : diagram_.footprints()[i].neighbours) {
          const std::uint32_t h = demand_of_[n.site];
          if (h == kNoDemand || is_in[h] != 0 || !counts(h)) continue;
          is_in[h] = 1;
          group.push_back(h);
        }
  }
  return groups;
}

// Of sites in one place only the heaviest has a footprint. The others have no weight with which they could get one.
void FootprintNewton::leave_doubled() {
  const auto is_doubled = [this](std::uint32_t i) { return diagram_.footprints()[i].state == SiteState::coincident; };
  for (std::uint32_t g = 0; g < demands_.size(); ++g) {
    const std::vector<std::uint32_t>& sites = demands_[g].sites;
    if (!counts(g) || floors_[g] > 0 || !std::all_of(sites.begin(), sites.end(), is_doubled)) continue;
    is_out_[g] = kDoubled;
    for (const std::uint32_t i : sites) sites_[i].site.weight = weight_of_nothing(sites_[i], diagram_);
  }
}

// Within their set-backs the plot has no ground for any of their storeys.
void FootprintNewton::leave_groundless() {
  const PlanPlot& plot = diagram_.workshop().plot;
  const auto has_ground = [&](std::uint32_t i) {
    return std::ranges::any_of(sites_[i].runs, [&](const StoreyRun& run) {
      const PlanPlot::Pieces* pieces = plot.made(outer_offset(sites_[i], run).plot);
      return pieces == nullptr || !pieces->empty();
    });
  };
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (counts(g) && demands_[g].least > 0 && !(floors_[g] > 0) && std::ranges::none_of(demands_[g].sites, has_ground))
      is_out_[g] = kLeftOut;
}

// A form leaves a part of its cell open, and who keeps its weight takes what the others leave. Whole cells alone leave nothing.
void FootprintNewton::find_filled() {
  fills_plot_ = true;
  for (std::uint32_t i = 0; fills_plot_ && i < sites_.size(); ++i) {
    const std::uint32_t g = demand_of_[i];
    if (g != kNoDemand && is_out_[g] != 0) continue;
    fills_plot_ = g != kNoDemand && sites_[i].form == FootprintForm::cell;
  }
}

// Those that are left out take no ground from the others.
void FootprintNewton::make_room() {
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (is_out_[g] == kLeftOut)
      for (const std::uint32_t i : demands_[g].sites) sites_[i].site.weight = weight_of_nothing(sites_[i], diagram_);
}

double FootprintNewton::error() const {
  double largest = 0;
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (counts(g) && wanted(g) > 0) largest = std::max(largest, std::abs(floors_[g] - wanted(g)) / wanted(g));
  return largest;
}
double FootprintNewton::residual() const {
  double sum = 0;
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (counts(g) && wanted(g) > 0) sum += (floors_[g] - wanted(g)) * (floors_[g] - wanted(g)) / wanted(g);
  return std::sqrt(sum);
}
double FootprintNewton::smallest_ratio() const {
  double least = 1;
  for (std::uint32_t g = 0; g < demands_.size(); ++g)
    if (counts(g) && wanted(g) > 0) least = std::min(least, floors_[g] / wanted(g));
  return least;
}

// Sites without any floor say nothing about how they could get one: they are made heavier until they have some.
Result<void> FootprintNewton::repair() {
  for (int round = 0; round < kMostRepairs; ++round) {
    bool is_repaired = false;
    for (std::uint32_t g = 0; g < demands_.size(); ++g) {
      if (!counts(g) || !(demands_[g].least > 0) || floors_[g] > 0) continue;
      is_repaired = true;
      for (const std::uint32_t i : demands_[g].sites) sites_[i].site.weight = heavier(i, round);
    }
    if (!is_repaired) return {};
    if (auto done = evaluate(); !done) return done;
  }
  return {};
}

double FootprintNewton::heavier(std::uint32_t i, int round) const {
  const StandingSite& own = sites_[i];
  double deepest = 0;
  for (const StoreyRun& run : own.runs) {
    const PlateOffset offset = outer_offset(own, run);
    deepest = std::max({deepest, offset.own, offset.plot.border, offset.plot.street});
  }
  double weight = 1.5 * std::max(own.site.weight, deepest * deepest);
  // So heavy that the site lies in its own cell, the more so the longer that was not enough.
  const double share = 0.9 - 0.1 * std::min(round, 8);
  for (std::uint32_t j = 0; j < sites_.size(); ++j) {
    if (j == i) continue;
    const double x = sites_[j].site.position.x - own.site.position.x, y = sites_[j].site.position.y - own.site.position.y;
    weight = std::max(weight, sites_[j].site.weight - share * (x * x + y * y));
  }
  return weight;
}

// Which demands may move: all, or where few miss theirs, these and those around them.
std::vector<std::uint32_t> FootprintNewton::movable() const {
  std::vector<std::uint32_t> all, off;
  for (std::uint32_t g = 0; g < demands_.size(); ++g) {
    if (!counts(g) || !(wanted(g) > 0)) continue;
    all.push_back(g);
    if (std::abs(floors_[g] - wanted(g)) > 0.1 * options_.tolerance * wanted(g)) off.push_back(g);
  }
  if (!options_.is_local || 4 * off.size() > all.size()) return all;
  std::vector<std::uint8_t> is_in(demands_.size(), 0);
  for (const std::uint32_t g : off) is_in[g] = 1;
  for (int ring = 0; ring < kRings; ++ring) {
    const std::size_t count = off.size();
    for (std::size_t k = 0; k < count; ++k)
      for (const std::uint32_t i : demands_[off[k]].sites)
        for (const FootprintMeasure::Neighbour& n : diagram_.footprints()[i].neighbours) {
          const std::uint32_t h = demand_of_[n.site];
          if (h == kNoDemand || is_in[h] != 0 || !counts(h)) continue;
          is_in[h] = 1;
          off.push_back(h);
        }
  }
  if (2 * off.size() > all.size()) return all;
  std::sort(off.begin(), off.end());
  return off;
}

// The change of the weights of each demand [m²] by which the linear response meets all that may move.
std::vector<double> FootprintNewton::newton_move() const {
  const std::vector<std::uint32_t> active = movable();
  std::vector<std::uint32_t> row_of(demands_.size(), kNoDemand);
  for (std::uint32_t r = 0; r < active.size(); ++r) row_of[active[r]] = r;
  RowSystem system;
  std::vector<double> right, entries(active.size(), 0);
  std::vector<std::uint32_t> touched;
  for (std::uint32_t r = 0; r < active.size(); ++r) {
    double diagonal = 0;
    touched.clear();
    for (const std::uint32_t i : demands_[active[r]].sites) {
      const FootprintMeasure& measure = diagram_.footprints()[i];
      diagonal += measure.own_response;
      for (const FootprintMeasure::Neighbour& n : measure.neighbours) {
        const std::uint32_t h = demand_of_[n.site], column = h == kNoDemand ? kNoDemand : row_of[h];
        if (column == r) diagonal -= n.response;
        if (column == kNoDemand || column == r) continue;
        if (entries[column] == 0) touched.push_back(column);
        entries[column] -= n.response;
      }
    }
    // Where nobody has a free side, weights matter by their differences only: a little of the diagonal holds them.
    const double hold = 1e-9 * std::max(diagonal, 1e-12);
    system.diagonal.push_back(diagonal + hold);
    for (const std::uint32_t column : touched) {
      system.columns.push_back(column);
      system.values.push_back(entries[column]);
      entries[column] = 0;
    }
    system.starts.push_back(static_cast<std::uint32_t>(system.columns.size()));
    right.push_back(wanted(active[r]) - floors_[active[r]]);
  }
  const double share = std::clamp(0.1 * error(), 1e-10, 1e-3);
  const std::vector<double> found = solve(system, right, share);
  std::vector<double> move(demands_.size(), 0);
  for (std::uint32_t r = 0; r < active.size(); ++r) move[active[r]] = found[r];
  return move;
}

// As much of a move as brings the demands nearer and leaves every site some floor. False: nothing of it does.
Result<bool> FootprintNewton::take(const std::vector<double>& move) {
  std::vector<double> before;
  for (const StandingSite& s : sites_) before.push_back(s.site.weight);
  const double residual_before = residual();
  double share = 1;
  for (int halving = 0; halving <= kMostHalvings; ++halving, share *= 0.5) {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (demand_of_[i] == kNoDemand || is_out_[demand_of_[i]] != 0) continue;
      const double to = before[i] + share * move[demand_of_[i]];
      // A nearly singular matrix asks for moves without an end.
      const double most = 4 * std::abs(before[i]) + diagram_.plot_area();
      sites_[i].site.weight =
          std::clamp(to, sites_[i].form == FootprintForm::cell ? -most : std::min(most, 0.1 * before[i]), most);
    }
    if (auto done = evaluate(); !done) return done.error();
    if (smallest_ratio() >= least_ratio_ && residual() <= (1 - 0.1 * share) * residual_before) {
      share_ = share;
      return true;
    }
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].site.weight = before[i];
  if (auto done = evaluate(); !done) return done.error();
  return false;
}

// Does no form end inside its cell, where it could grow or shrink at nobody's cost?
bool FootprintNewton::is_tight() const {
  double own = 0, free = 0;
  bool has_form = false;
  for (std::uint32_t g = 0; g < demands_.size(); ++g) {
    if (!counts(g)) continue;
    for (const std::uint32_t i : demands_[g].sites) {
      own += diagram_.footprints()[i].own_response;
      free += diagram_.footprints()[i].free_response;
      has_form |= sites_[i].form != FootprintForm::cell;
    }
  }
  return has_form && free <= kTightShare * own;
}

void FootprintNewton::lower(const std::vector<double>& before, double by) {
  for (std::uint32_t i = 0; i < sites_.size(); ++i) {
    const std::uint32_t g = demand_of_[i];
    if (g == kNoDemand || !counts(g)) continue;
    const double weight = before[i] - by;
    sites_[i].site.weight = sites_[i].form == FootprintForm::cell ? weight : std::max(weight, 0.0);
  }
}

// The smallest share that a volume with a form has kept of the floor that it had.
double FootprintNewton::least_kept(const std::vector<double>& floors) const {
  double least = 1;
  for (std::uint32_t i = 0; i < sites_.size(); ++i)
    if (sites_[i].form != FootprintForm::cell && floors[i] > 0)
      least = std::min(least, diagram_.footprints()[i].floor_area / floors[i]);
  return least;
}

// Where no form ends inside its cell, weights count by their differences only, and no step says how large forms should be. To
// lower all weights alike moves no bisector, and lets forms shrink until one of them ends inside its cell. False: nothing of
// that helps.
Result<bool> FootprintNewton::loosen() {
  if (loosenings_ >= kMostLoosenings || !is_tight()) return false;
  ++loosenings_;
  std::vector<double> before, floors;
  double low = 0, high = 0;
  for (std::uint32_t i = 0; i < sites_.size(); ++i) {
    before.push_back(sites_[i].site.weight);
    floors.push_back(diagram_.footprints()[i].floor_area);
    if (sites_[i].form != FootprintForm::cell) high = std::max(high, before[i]);
  }
  for (int round = 0; round < kMostLowerings; ++round) {
    const double middle = 0.5 * (low + high);
    lower(before, middle);
    if (auto done = evaluate(); !done) return done.error();
    const double kept = least_kept(floors);
    if (kept >= kKeptLeast && kept <= kKeptMost) return true;
    (kept > kKeptMost ? low : high) = middle;
  }
  lower(before, 0);
  if (auto done = evaluate(); !done) return done.error();
  return false;
}

}  // namespace bl::geometry
