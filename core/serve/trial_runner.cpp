// The thread of a room's trials takes slices of a few ticks in turn.
#include "core/serve/trial_runner.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/define/registry.h"
#include "core/host/trial.h"

namespace bl::serve {

namespace {

constexpr std::int64_t kSlice = 20;            // ticks of one trial before the next one has its turn
constexpr std::int64_t kBetweenPictures = 60;  // ticks after which a trial that runs is shown again

}  // namespace

struct TrialRunner::Job {
  std::string draft;
  Basis basis;
  std::shared_ptr<const State> from;
  Scene scene;
  std::set<std::pair<std::string, std::string>> placed;
  std::unique_ptr<host::Trial> trial = {};  // of the trials' thread
  std::int64_t pictured = 0;                // the same
  bool is_given_up = false;                 // behind the mutex
};

TrialRunner::~TrialRunner() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TrialRunner::clear() {
  const std::lock_guard lock(mutex_);
  for (auto& [draft, job] : jobs_) job->is_given_up = true;
  jobs_.clear();
  outcomes_.clear();
  line_.clear();
  shown_ = {};
}

bool TrialRunner::has_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(has_news_, false);
}

// Drafts are tried for their owners, and proposals for facilitators.
std::vector<std::string> TrialRunner::wished(const room::Room& room) const {
  std::vector<std::string> list;
  for (const auto& [seat, drafts] : shown_.looked_at) {
    const room::Seat* who = room.state().seat(seat);
    for (const std::string& id : drafts) {
      const auto draft = room.drafts().find(id);
      if (who == nullptr || draft == room.drafts().end()) continue;
      const room::DraftState state = draft->second.state();
      const bool is_owner =
          draft->second.seat() == seat && (state == room::DraftState::open || state == room::DraftState::proposed);
      const bool is_judge = who->role == Role::facilitator && state == room::DraftState::proposed;
      if ((is_owner || is_judge) && std::find(list.begin(), list.end(), id) == list.end()) list.push_back(id);
    }
  }
  return list;
}

void TrialRunner::follow(room::Room& room, const std::map<std::int64_t, std::set<std::string>>& looked_at,
                         const std::function<std::shared_ptr<const State>()>& state) {
  shown_.looked_at = looked_at;
  const std::vector<std::string> list = wished(room);
  std::size_t running = 0;
  {
    const std::lock_guard lock(mutex_);
    end_unwished(room, list);
    for (const std::string& id : list) {
      const auto outcome = outcomes_.find(id);
      const bool is_known = outcome != outcomes_.end() && outcome->second.basis == basis_of(room, room.drafts().at(id)) &&
                            outcome->second.trial.state == wire::TrialState::done;
      if (!is_known && !jobs_.contains(id) && std::find(line_.begin(), line_.end(), id) == line_.end()) line_.push_back(id);
    }
    running = jobs_.size();
  }
  for (; running < kAtOnce && !line_.empty(); ++running) {
    const std::string id = line_.front();
    line_.erase(line_.begin());
    begin(room, id, state);
  }
  show(room);
}

// With the mutex held.
void TrialRunner::end_unwished(const room::Room& room, const std::vector<std::string>& list) {
  const auto is_wished = [&](const std::string& id) { return std::find(list.begin(), list.end(), id) != list.end(); };
  std::erase_if(line_, [&](const std::string& id) { return !is_wished(id); });
  std::erase_if(outcomes_, [&](const auto& one) { return !room.drafts().contains(one.first); });
  std::erase_if(jobs_, [&](const auto& one) {
    Job& job = *one.second;
    const bool has_other_steps = is_wished(one.first) && room.drafts().at(one.first).revision() != job.basis.revision;
    if (is_wished(one.first) && !has_other_steps) return false;
    job.is_given_up = true;
    if (has_other_steps) line_.insert(line_.begin(), one.first);
    return true;
  });
}

void TrialRunner::begin(room::Room& room, const std::string& id, const std::function<std::shared_ptr<const State>()>& state) {
  auto job = std::make_shared<Job>();
  job->draft = id;
  // The state first: it takes in what is still to be said of gestures.
  job->from = state();
  const room::Draft& draft = room.follow_draft(id);
  job->basis = basis_of(room, draft);
  job->scene = room.scene_of(id);
  job->placed = draft.placed();
  {
    const std::lock_guard lock(mutex_);
    jobs_[id] = std::move(job);
    if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  }
  wake_.notify_all();
}

void TrialRunner::show(const room::Room& room) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, wire::DraftTrial> trials;
  for (const auto& [id, outcome] : outcomes_) {
    trials[id] = outcome.trial;
    trials[id].state = outcome.basis == basis_of(room, room.drafts().at(id)) && outcome.trial.state == wire::TrialState::done
                           ? wire::TrialState::done
                           : wire::TrialState::old;
  }
  for (const auto& [id, job] : jobs_) trials[id].state = wire::TrialState::running;
  for (std::size_t k = 0; k < line_.size(); ++k) {
    wire::DraftTrial& trial = trials[line_[k]];
    trial.state = wire::TrialState::waiting;
    trial.line = static_cast<std::int64_t>(k + jobs_.size());
  }
  shown_.trials = std::move(trials);
}

void TrialRunner::work() {
  std::unique_lock lock(mutex_);
  std::string last;  // whose turn it was
  while (true) {
    wake_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
    if (is_ending_) return;
    auto next = jobs_.upper_bound(last);
    if (next == jobs_.end()) next = jobs_.begin();
    last = next->first;
    const std::shared_ptr<Job> job = next->second;
    lock.unlock();
    std::optional<wire::DraftTrial> news;
    try {
      if (!job->trial) job->trial = std::make_unique<host::Trial>(full_registry(), std::move(job->from), job->scene, job->placed);
      host::Trial& trial = *job->trial;
      const bool is_over = trial.go_on(kSlice);
      if (is_over || trial.ticks() - job->pictured >= kBetweenPictures) {
        job->pictured = trial.ticks();
        news = wire::DraftTrial{.state = is_over ? wire::TrialState::done : wire::TrialState::running,
                                .line = 0,
                                .ticks = trial.ticks(),
                                .seq = job->basis.seq,
                                .is_settled = trial.is_settled(),
                                .why = {},
                                .picture = std::make_shared<wire::TrialPicture>(wire::picture_of(trial.without(), trial.with()))};
      }
    } catch (const std::exception& exception) {
      news = wire::DraftTrial{.state = wire::TrialState::done, .seq = job->basis.seq, .why = exception.what()};
    }
    lock.lock();
    if (!news || job->is_given_up) continue;
    outcomes_[job->draft] = {job->basis, *news};
    if (news->state == wire::TrialState::done) jobs_.erase(job->draft);
    has_news_ = true;
  }
}

}  // namespace bl::serve
