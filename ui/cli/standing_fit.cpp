// Demands on volumes become demands on floors, which is the same for storeys of one height; losses are told in their own unit.
#include "ui/cli/standing_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.h"
#include "core/geometry/footprint_fit.h"

namespace bl::cli {

namespace {

using geometry::FitStatus;
using geometry::SiteState;

double floor_of(const geometry::VolumeDemand& demand, double amount) {
  return demand.kind == geometry::VolumeDemand::Kind::volume ? amount / demand.storey_height : amount;
}

// Sites that are to have nothing, and need no weight for it.
std::vector<bool> unwanted_of(const SiteCase& c) {
  std::vector<bool> is_unwanted(c.problem.sites.size(), false);
  for (const geometry::VolumeDemand& demand : c.problem.demands)
    for (const std::uint32_t i : demand.sites) is_unwanted[i] = !(demand.most > 0);
  return is_unwanted;
}

// "storey 3 of site 5 has no floor: ..." where a site has some floor, but not on all of its storeys.
std::string empty_storey(const geometry::StandingSite& site, const geometry::FootprintMeasure& measure, std::size_t number) {
  int storey = 1;
  for (std::size_t r = 0; r < site.runs.size(); storey += site.runs[r].storeys, ++r)
    if (!(measure.plates[r] > 0))
      return "storey " + std::to_string(storey) + " of site " + std::to_string(number) + " has no floor: its set-back of " +
             shortest(site.runs[r].setback) + " m leaves nothing of the footprint";
  return "";
}

// Why a site has no floor at all.
std::string reason_of(const geometry::FootprintMeasure& measure, const geometry::StandingSite& site, std::size_t number) {
  const std::string name = "site " + std::to_string(number);
  if (measure.state == SiteState::coincident)
    return name + " has no floor: another one stands in the same place, and no line parts the two";
  double deepest = 0;
  for (const geometry::StoreyRun& run : site.runs) deepest = std::max(deepest, run.setback);
  return name + " has no floor: what others and the plot leave of its footprint is nothing" +
         (deepest > 0 ? " within its set-backs" : "");
}

class StandingRun {
 public:
  StandingRun(const SiteCase& c, const geometry::VolumeFitOptions& how)
      : case_(c), how_(how), sites_(c.standing), is_unwanted_(unwanted_of(c)) {}

  Result<CaseFit> run() {
    if (auto set = diagram_.set_domain(case_.boundary.domain, case_.streets); !set) return set.error();
    std::vector<geometry::FloorDemand> floors;
    for (const geometry::VolumeDemand& demand : case_.problem.demands)
      floors.push_back({demand.sites, floor_of(demand, demand.least), floor_of(demand, demand.most)});
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
      sites_[i].site.weight = case_.problem.sites[i].weight;
      if (sites_[i].site.weight > 0 && is_unwanted_[i]) sites_[i].site.weight = 0;
    }
    geometry::FootprintFitOptions options;
    options.tolerance = how_.tolerance;
    options.most_steps = how_.most_steps;
    options.pool = how_.pool;
    options.progress = [this](int evaluations, double error) {
      is_cancelled_ = how_.progress && !how_.progress(evaluations, error);
      return !is_cancelled_ && evaluations < how_.most_steps;
    };
    auto report = fit_footprints(diagram_, sites_, floors, options);
    if (!report) return report.error();
    return outcome(*report);
  }

 private:
  CaseFit outcome(const geometry::FootprintFit& report) {
    CaseFit done;
    done.footprints.assign(diagram_.footprints().begin(), diagram_.footprints().end());
    geometry::VolumeFit& fit = done.fit;
    fit.iterations = report.steps;
    fit.evaluations = report.evaluations;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      fit.weights.push_back(sites_[i].site.weight);
      fit.volumes.push_back(done.footprints[i].volume);
    }
    add_losses(done);
    fit.status = fit.losses.empty()           ? FitStatus::met
                 : is_cancelled_              ? FitStatus::cancelled
                 : !report.infeasible.empty() ? FitStatus::infeasible
                                              : FitStatus::step_limit;
    if (fit.status != FitStatus::met && !report.infeasible.empty()) fit.reasons.push_back(report.infeasible);
    explain(done);
    return done;
  }

  void add_losses(CaseFit& done) const {
    for (std::uint32_t k = 0; k < case_.problem.demands.size(); ++k) {
      const geometry::VolumeDemand& demand = case_.problem.demands[k];
      double has = 0;
      for (const std::uint32_t i : demand.sites) {
        const bool is_volume = demand.kind == geometry::VolumeDemand::Kind::volume;
        has += is_volume ? done.footprints[i].volume : done.footprints[i].floor_area;
      }
      const double bound = std::clamp(has, demand.least, demand.most);
      const double error = bound > 0 ? std::abs(has - bound) / bound : has > 0 ? 1.0 : 0.0;
      if (error > how_.tolerance) done.fit.losses.push_back({k, bound, has});
      if (!(error > done.fit.max_relative_error)) continue;
      done.fit.max_relative_error = error;
      done.fit.worst_demand = k;
    }
  }

  // Sites without a floor, and storeys: the reasons where demands are missed by them, else notes.
  void explain(CaseFit& done) const {
    std::vector<bool> is_missed(sites_.size(), false);
    for (const geometry::VolumeLoss& loss : done.fit.losses)
      for (const std::uint32_t i : case_.problem.demands[loss.demand].sites) is_missed[i] = loss.had < loss.wanted;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const geometry::FootprintMeasure& measure = done.footprints[i];
      const bool is_empty = !(measure.floor_area > 0);
      if (is_empty && is_unwanted_[i]) continue;
      std::string sentence = is_empty ? reason_of(measure, sites_[i], i) : empty_storey(sites_[i], measure, i);
      if (sentence.empty()) continue;
      (is_missed[i] ? done.fit.reasons : done.notes).push_back(std::move(sentence));
    }
  }

  const SiteCase& case_;
  const geometry::VolumeFitOptions& how_;
  std::vector<geometry::StandingSite> sites_;
  std::vector<bool> is_unwanted_;
  geometry::FootprintDiagram diagram_;
  bool is_cancelled_ = false;
};

}  // namespace

Result<CaseFit> fit_standing(const SiteCase& c, const geometry::VolumeFitOptions& how) { return StandingRun(c, how).run(); }

std::vector<double> plates_of(const geometry::StandingSite& site, const geometry::FootprintMeasure& measure) {
  std::vector<double> plates;
  for (std::size_t r = 0; r < site.runs.size() && r < measure.plates.size(); ++r)
    plates.insert(plates.end(), static_cast<std::size_t>(site.runs[r].storeys), measure.plates[r]);
  return plates;
}

}  // namespace bl::cli
