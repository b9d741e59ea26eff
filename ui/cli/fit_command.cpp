// `fit`: the weights that give sites, or groups of them, their demanded volumes or floor areas.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/geometry/fit_text.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/json_fields.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/site_case.h"
#include "ui/cli/standing_fit.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr std::size_t kMostLines = 10;  // of one kind, on the terminal; the file has all

// A volume or an area as people write it; very small ones by their first digits.
std::string amount(double number) {
  const double size = std::abs(number);
  return size == 0 || size >= 0.1 ? fixed(number, size >= 1000 ? 1 : 3) : rough(number);
}

Json number_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }

// One object for each volume that stands; without floors where an interrupt left no time to measure them.
Json sites_json(const CaseFit& done, const SiteCase& c) {
  Json sites = Json::array();
  for (std::size_t i = 0; i < c.standing.size(); ++i) {
    const bool is_known = i < done.footprints.size();
    sites.push_back({{"weight", done.fit.weights[i]},
                     {"floor_area", is_known ? Json(done.footprints[i].floor_area) : Json()},
                     {"plates", is_known ? Json(plates_of(c.standing[i], done.footprints[i])) : Json::array()}});
  }
  return sites;
}

Json fit_json(const CaseFit& done, const SiteCase& c) {
  const geometry::VolumeFit& fit = done.fit;
  Json losses = Json::array();
  for (const geometry::VolumeLoss& loss : fit.losses)
    losses.push_back({{"demand", loss.demand},
                      {"sites", c.problem.demands[loss.demand].sites},
                      {"wanted", number_or_null(loss.wanted)},
                      {"had", number_or_null(loss.had)}});
  Json json = {{"weights", fit.weights},
               {"volumes", fit.volumes},
               {"iterations", fit.iterations},
               {"evaluations", fit.evaluations},
               {"max_relative_error", number_or_null(fit.max_relative_error)},
               {"status", std::string(name_of(fit.status))},
               {"reasons", fit.reasons},
               {"losses", std::move(losses)}};
  if (c.standing.empty()) return json;
  json["sites"] = sites_json(done, c);
  json["notes"] = done.notes;
  return json;
}

// What is said of cases that an interrupt left no time for: they keep what they came with.
CaseFit not_begun(const geometry::FitProblem& problem) {
  CaseFit done;
  for (const geometry::PowerSite& site : problem.sites) done.fit.weights.push_back(site.weight);
  done.fit.max_relative_error = std::numeric_limits<double>::quiet_NaN();  // nobody knows
  done.fit.status = geometry::FitStatus::cancelled;
  done.fit.reasons.emplace_back("was not begun");
  return done;
}

// "2, 5, 7": the sites of a demand by number or name.
std::string sites_text(const geometry::VolumeDemand& demand, const SiteCase& c) {
  std::string text;
  for (std::size_t i = 0; i < demand.sites.size(); ++i) {
    if (i == 6) return text + ", ...";
    text += (i > 0 ? ", " : "") + (c.names.empty() ? std::to_string(demand.sites[i]) : c.names[demand.sites[i]]);
  }
  return text;
}

class FitRun {
 public:
  explicit FitRun(const FitFileOptions& options) : options_(options) {}

  int execute() {
    if (!are_options_sound()) return kBadInput;
    const auto input = load_site_cases({options_.input, options_.boundary, options_.json}, CasePurpose::fit);
    if (!input || !is_method_sound(*input)) return kBadInput;
    catch_interrupts();
    ThreadPool pool(options_.threads);
    pool_ = &pool;
    if (!fit_all(*input) || !write(*input)) return kBadInput;
    for (std::size_t i = 0; i < fits_.size(); ++i) tell(input->cases[i], fits_[i].fit, fits_[i].notes);
    summarise();
    if (is_interrupted()) return interrupt_exit_code();
    return met_ == fits_.size() ? kDone : kNotMet;
  }

 private:
  bool are_options_sound() const {
    if (options_.tolerance > 0 && options_.tolerance < 1) return true;
    print_error("", {ErrorCode::out_of_range, "--tolerance",
                     "must be more than 0 and less than 1 (1e-6 is a millionth), found " + shortest(options_.tolerance)});
    return false;
  }

  bool is_method_sound(const SiteCases& input) const {
    if (options_.method == "newton") return true;
    for (const SiteCase& c : input.cases) {
      if (c.standing.empty()) continue;
      print_error(options_.input,
                  {ErrorCode::conflict, slash(c.place, "form"),
                   "volumes that stand are fitted by Newton's method only: leave out --method " + options_.method});
      return false;
    }
    return true;
  }

  bool fit_all(const SiteCases& input) {
    bool is_all_well = true;
    Progress progress;
    for (std::size_t i = 0; i < input.cases.size(); ++i) {
      const std::string label =
          input.is_list ? "case " + std::to_string(i + 1) + " of " + std::to_string(input.cases.size()) + ", " : "";
      auto fit = is_interrupted() ? Result<CaseFit>(not_begun(input.cases[i].problem)) : fit_one(input.cases[i], label, progress);
      if (!fit) {
        progress.clear();
        print_error(options_.input, fit.error().within(input.cases[i].place));
      }
      is_all_well &= fit.ok();
      if (fit) fits_.push_back(std::move(*fit));
    }
    return is_all_well;
  }

  Result<CaseFit> fit_one(const SiteCase& c, const std::string& label, Progress& progress) const {
    geometry::VolumeFitOptions how;
    how.method = options_.method == "feedback" ? geometry::FitMethod::feedback : geometry::FitMethod::newton;
    how.tolerance = options_.tolerance;
    how.most_steps = options_.steps;
    how.pool = pool_;
    how.progress = [&](int steps, double error) {
      if (progress.is_due())
        progress.show(label + "step " + std::to_string(steps) + ", largest error " + fixed(100 * error, 4) + " %");
      return !is_interrupted();
    };
    const StopScope scope(is_interrupted);
    if (!c.standing.empty()) return fit_standing(c, how);
    auto fit = fit_volumes(c.boundary.domain, c.problem, how);
    if (!fit) return fit.error();
    return CaseFit{std::move(*fit), {}, {}};
  }

  bool write(const SiteCases& input) const {
    Json results = Json::array();
    for (std::size_t i = 0; i < fits_.size(); ++i) results.push_back(fit_json(fits_[i], input.cases[i]));
    const Json output = input.is_list ? Json{{"cases", std::move(results)}} : std::move(results.front());
    const auto written = write_file(options_.json, write_json(output) + "\n");
    if (!written) print_error(options_.json, written.error());
    return written.ok();
  }

  // Why a case is not met, and who goes without.
  void tell(const SiteCase& c, const geometry::VolumeFit& fit, const std::vector<std::string>& notes) {
    for (std::size_t i = 0; i < notes.size() && i < kMostLines; ++i)
      print_line("note: " + options_.input + ": " + (c.place.empty() ? "" : c.place + ": ") + notes[i]);
    if (notes.size() > kMostLines)
      print_line("and " + std::to_string(notes.size() - kMostLines) + " more notes, all in " + options_.json);
    // Of cases that were stopped nobody may know it: then there is no largest one.
    is_error_known_ = is_error_known_ && std::isfinite(fit.max_relative_error);
    worst_error_ = std::max(worst_error_, fit.max_relative_error);
    evaluations_ += fit.evaluations;
    iterations_ += fit.iterations;
    if (fit.status == geometry::FitStatus::met) {
      ++met_;
      return;
    }
    std::vector<std::string> reasons = fit.reasons;
    if (reasons.empty()) reasons.push_back(own_reason(c, fit));
    for (std::size_t i = 0; i < reasons.size() && i < kMostLines; ++i)
      print_error(options_.input, {ErrorCode::infeasible, c.place, geometry::with_names(reasons[i], c.names)});
    if (reasons.size() > kMostLines)
      print_error(options_.input,
                  {ErrorCode::infeasible, c.place,
                   "and " + std::to_string(reasons.size() - kMostLines) + " more reasons, all in " + options_.json});
    print_losses(c, fit);
  }

  std::string own_reason(const SiteCase& c, const geometry::VolumeFit& fit) const {
    if (!std::isfinite(fit.max_relative_error)) return "stopped before the errors of the demands were known";
    std::string state = "the largest relative error is " + rough(fit.max_relative_error);
    if (fit.worst_demand < c.problem.demands.size()) {
      const geometry::VolumeDemand& demand = c.problem.demands[fit.worst_demand];
      state += ", of demand " + std::to_string(fit.worst_demand) + (demand.sites.size() == 1 ? " (site " : " (sites ") +
               sites_text(demand, c) + ")";
    }
    const std::string effort = counted(static_cast<std::size_t>(fit.evaluations), "evaluation");
    if (fit.status == geometry::FitStatus::cancelled) return "stopped after " + effort + "; " + state;
    if (fit.status == geometry::FitStatus::infeasible) return "the demands cannot be met together; " + state;
    return "not met after " + effort + "; " + state + ": allow more by --steps" +
           (options_.method == "feedback" ? ", or take --method newton" : "");
  }

  static void print_losses(const SiteCase& c, const geometry::VolumeFit& fit) {
    if (fit.losses.empty()) return;
    std::vector<geometry::VolumeLoss> losses = fit.losses;
    std::stable_sort(losses.begin(), losses.end(), [](const geometry::VolumeLoss& a, const geometry::VolumeLoss& b) {
      return a.wanted - a.had > b.wanted - b.had;
    });
    if (!c.place.empty()) print_line(c.place + ":");
    TextTable table({{"demand", true}, {"sites"}, {"wanted", true}, {"had", true}, {"short by %", true}});
    for (std::size_t i = 0; i < losses.size() && i < kMostLines; ++i) {
      const geometry::VolumeLoss& loss = losses[i];
      const geometry::VolumeDemand& demand = c.problem.demands[loss.demand];
      const std::string unit = demand.kind == geometry::VolumeDemand::Kind::volume ? " m³" : " m²";
      table.add({std::to_string(loss.demand), sites_text(demand, c), amount(loss.wanted) + unit, amount(loss.had) + unit,
                 loss.wanted > 0 ? fixed(100 * (loss.wanted - loss.had) / loss.wanted, 2) : ""});
    }
    table.print();
    if (losses.size() > kMostLines) print_line("and " + std::to_string(losses.size() - kMostLines) + " more");
  }

  void summarise() const {
    const std::string effort = counted(static_cast<std::size_t>(iterations_), "step") + " and " +
                               counted(static_cast<std::size_t>(evaluations_), "evaluation") +
                               (is_error_known_ ? ", largest relative error " + rough(worst_error_) : "");
    const bool is_met = met_ == fits_.size();
    const std::string head = fits_.size() == 1 ? std::string(name_of(fits_.front().fit.status))
                                               : std::to_string(met_) + " of " + counted(fits_.size(), "case") + " met";
    print_line(head + " after " + effort, is_met ? Colour::green : Colour::red);
  }

  const FitFileOptions& options_;
  ThreadPool* pool_ = nullptr;
  std::vector<CaseFit> fits_;
  std::size_t met_ = 0;
  long long iterations_ = 0, evaluations_ = 0;
  double worst_error_ = 0;
  bool is_error_known_ = true;
};

}  // namespace

int fit_command(const FitFileOptions& options) { return FitRun(options).execute(); }

}  // namespace bl::cli
