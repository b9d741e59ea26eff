// `run`: ticks a scene until it settles, and reports the result.
#include <algorithm>
#include <limits>
#include <memory>

#include <nlohmann/json.hpp>

#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/file/log_writer.h"
#include "core/graph/sums_of_now.h"
#include "core/making/script_file.h"
#include "core/making/use_rates.h"
#include "core/reading/report_model.h"
#include "core/reading/sun_problems.h"
#include "core/reading/survey.h"
#include "core/report/report.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/live_run.h"
#include "ui/cli/run_output.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/set_argument.h"
#include "ui/cli/settle_watch.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr long long kTicksPerCheck = 60;

class Run {
 public:
  explicit Run(const RunOptions& options)
      : options_(options), live_(options.scene, options.is_live, options.rate, options.reads_anywhere) {}

  int execute() {
    if (!start()) return kBadInput;
    catch_interrupts();
    tick_until_done();
    const bool is_saved = finish();
    if (!is_saved) return kBadInput;
    if (is_interrupted()) return interrupt_exit_code();
    if (options_.ticks >= 0 || session_->state()->is_settled()) return kDone;
    // A node that cannot be evaluated (a plan that crosses itself) is bad input; demands that cannot be met are not.
    return has_node_error(*session_->state()) ? kBadInput : kNotMet;
  }

 private:
  bool fail(const std::string& file, const Error& error) {
    print_error(file, error);
    return false;
  }

  bool start() {
    auto reading = load_scene(options_.scene, !options_.scripts.empty());
    if (!reading) return false;
    auto session = Session::start(full_registry(), reading->scene, reading->state ? &*reading->state : nullptr, options_.threads);
    if (!session) return fail(options_.scene, session.error());
    session_ = std::move(*session);
    // The log of an earlier run is replaced only once it is sure that there is another.
    std::string lines = log_header(write_scene(reading->scene, full_registry(), reading->state ? &*reading->state : nullptr));
    const std::size_t listener =
        session_->subscribe([&lines](const LogEntry& entry) { lines += log_line(entry, full_registry()); });
    for (const std::string& file : options_.scripts) {
      auto command = making::script_command(file);
      if (!command) return fail(file, command.error());
      if (auto done = session_->submit(*command, "command line"); !done) return fail(file, done.error());
    }
    if (!options_.scripts.empty()) {
      const std::vector<Problem> unfit = unfit_links(session_->scene(), full_registry());
      print_problems(options_.scene, unfit.empty() ? check_scene(session_->scene(), full_registry()) : unfit);
      if (!unfit.empty()) return false;
    }
    for (const std::string& argument : options_.set) {
      auto command = set_command(session_->scene(), full_registry(), argument);
      if (!command) return fail("", command.error());
      if (auto done = session_->submit(*command, "command line"); !done) return fail("--set " + argument, done.error());
    }
    session_->unsubscribe(listener);
    return options_.log.empty() || begin_log(lines);
  }

  bool begin_log(const std::string& lines) {
    if (auto opened = log_.open(options_.log); !opened) return fail(options_.log, opened.error());
    log_.write(lines);
    session_->subscribe([this](const LogEntry& entry) { log_.write(log_line(entry, full_registry())); });
    return true;
  }

  void record(const State& state) {
    if (options_.report.empty()) return;
    reading::ErrorSample sample{state.tick, 0, 0, state.largest_move};
    const auto volumes = reading::rows<reading::VolumeFigures>(state);
    for (const auto& [node, volume] : volumes) {
      sample.worst_error = std::max(sample.worst_error, volume.error);
      sample.mean_error += volume.error / static_cast<double>(volumes.size());
    }
    history_.push_back(sample);
  }

  void check(const State& state) {
    if (state.tick % kTicksPerCheck == 0) log_.write(log_line(LogCheck{state.tick, hex_digits(state.hash), false}));
  }

  // Ticks of a live run that only count on are slept through, at most so many. They leave what others leave: checks in the log,
  // for which the sleep is short, and samples for the report. Returns how many there were.
  long long rest(long long most, Progress& progress) {
    long long rested = 0;
    while (rested < most && !is_interrupted() && live_.can_rest(*session_)) {
      progress.clear();
      const std::shared_ptr<const State> before = session_->state();
      const long long left = most - rested, to_check = kTicksPerCheck - before->tick % kTicksPerCheck;
      const long long passed = live_.rest(*session_, log_.is_open() ? std::min(left, to_check) : left);
      if (passed == 0) break;
      before_ = before;
      rested += passed;
      for (long long tick = 0; tick < passed && !history_.empty(); ++tick) {
        history_.push_back(history_.back());
        ++history_.back().tick;
      }
      check(*session_->state());
    }
    return rested;
  }

  // What an interrupt meets in mid-tick is dropped: the tick before it is the last one.
  void tick_until_done() {
    const StopScope scope(is_interrupted);
    const bool is_settling = options_.ticks < 0 && !options_.is_live;
    const long long most = is_settling           ? options_.max_ticks
                           : options_.ticks >= 0 ? options_.ticks
                                                 : std::numeric_limits<long long>::max();
    Progress progress;
    if (is_settling && session_->state()->is_settled() && options_.set.empty()) return;
    for (long long done = 0; done < most && !is_interrupted(); ++done) {
      before_ = session_->state();
      live_.before_tick(*session_);
      if (!session_->tick()) return;
      live_.after_tick(*session_);
      const std::shared_ptr<const State> state = session_->state();
      record(*state);
      check(*state);
      if (progress.is_due())
        progress.show("tick " + std::to_string(state->tick) + ", largest error " + fixed(100 * state->largest_residual, 2) +
                      " %, largest move " + fixed(state->largest_move, 3) + " m");
      live_.wait(*session_);
      done += rest(most - done - 1, progress);
      if (!is_settling) continue;
      if (state->is_settled() || watch_.is_hopeless(*state)) return;
    }
  }

  // Whoever reads the last line alone must not take what has settled for what is allowed.
  static std::string rules_broken(const State& state) {
    const std::size_t count = reading::rule_problems(state).size();
    return count == 0   ? ""
           : count == 1 ? "; a rule of a plot is broken"
                        : "; " + std::to_string(count) + " rules of plots are broken";
  }
  static std::string sun_missed(const State& state) {
    const auto all = reading::sun_shortages(state);
    return all.empty()       ? ""
           : all.size() == 1 ? "; `" + state.plan->nodes[all.front().receiver].id + "` is short of sun"
                             : "; " + std::to_string(all.size()) + " receivers are short of sun";
  }

  std::string outcome(const reading::Survey& survey) const {
    const State& state = *session_->state();
    const auto idle = static_cast<std::size_t>(
        std::count_if(state.links.begin(), state.links.end(), [](const LinkState& link) { return link.has_failed(); }));
    const std::string without = idle == 0   ? ""
                                : idle == 1 ? " (1 link does not run)"
                                            : " (" + std::to_string(idle) + " links do not run)";
    const std::string stopped = is_interrupted() ? "stopped at tick " + std::to_string(state.tick) + "; " : "";
    if (state.tick == 0) return stopped + "not settled: " + std::string(kNothingComputed);
    if (state.is_settled())
      return stopped + "settled after " + std::to_string(state.tick) + " ticks" + without + ", worst error " +
             fixed(100 * survey.worst_error, 3) + " %, hash " + hex_digits(state.hash) + rules_broken(state) + sun_missed(state);
    return "not settled: " + stopped + why_not_settled(state, before_.get(), watch_);
  }

  bool write(const std::string& file, const Result<void>& written) { return written ? true : fail(file, written.error()); }

  // Everything that was asked for, even where a part of it fails.
  bool finish() {
    const std::shared_ptr<const State> state = session_->state();
    // What people and programs read: the sums of this tick beside the figures of this tick.
    const State seen = with_sums_of_now(*state);
    const reading::Survey survey = reading::survey_of(seen);
    const std::string last_line = outcome(survey);
    bool is_saved = true;
    if (log_.is_open()) {
      log_.write(log_line(LogCheck{state->tick, hex_digits(state->hash), true}));
      is_saved &= write(options_.log, log_.close());
    }
    if (!options_.save.empty()) {
      // What people changed before a tick that was stopped is in the scene already: the state has to fit it.
      const std::shared_ptr<const State> coming = session_->coming_state();
      // An analysis that is under way would be waited for.
      const StopScope scope(is_interrupted);
      const SavedState saved = save(*coming);
      is_saved &= write(options_.save, write_file(options_.save, write_scene(session_->scene(), full_registry(), &saved)));
    }
    if (!options_.json.empty())
      is_saved &= write(options_.json, write_file(options_.json, write_json(survey_json(survey, seen, last_line)) + "\n"));
    if (!options_.report.empty())
      is_saved &=
          write(options_.report, report::write_report(options_.report, {state.get(), history_, options_.scene, last_line}));
    print_survey(survey, seen);
    if (const std::string note = making::tell_uses_without_figures(session_->scene(), full_registry()); !note.empty())
      print_line("note: " + note);
    live_.sum_up(*state);
    const bool is_whole =
        std::none_of(state->links.begin(), state->links.end(), [](const LinkState& l) { return l.error.has_value(); });
    print_line(last_line, !state->is_settled() ? Colour::red : is_whole ? Colour::green : Colour::yellow);
    return is_saved;
  }

  const RunOptions& options_;
  LiveRun live_;
  std::unique_ptr<Session> session_;
  std::shared_ptr<const State> before_;
  SettleWatch watch_;
  LogWriter log_;
  std::vector<reading::ErrorSample> history_;
};

}  // namespace

int run_command(const RunOptions& options) { return Run(options).execute(); }

}  // namespace bl::cli
