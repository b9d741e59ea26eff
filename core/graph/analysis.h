// Long analyses beside the ticks: they start with the data of one tick, and their result counts a declared number of ticks later.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/base/stop.h"
#include "core/define/definition.h"

namespace bl {

/// One value that an analysis gives to a port, its own or that of a member. The port is named, because the scene may change
/// meanwhile.
struct AnalysisOutput {
  std::string node, path;  ///< "typification.port"
  Value value;
};

/// The result: outputs, or the reason why there are none.
struct AnalysisResult {
  std::vector<AnalysisOutput> outputs;
  std::optional<Error> error;
};

/// The cache that the analyses of a node hand on. One evaluation at a time uses it; another one meanwhile runs without it.
struct AnalysisMemo {
  std::mutex mutex;
  Memo memo;
};

/// The time that analyses take beside the ticks: their thread adds, whoever measures takes it away.
struct BesideTime {
  explicit BesideTime(double (*the_clock)()) : now(the_clock) {}
  double (*now)();
  std::atomic<std::size_t> runs = 0;
  std::atomic<double> seconds = 0;
};

/// The input of an analysis. Its result depends on this alone, except for the memo, which only saves work.
struct AnalysisInput {
  std::shared_ptr<const void> plan;  ///< the registry of the definition: the scene may get another one before the end
  const TypificationDefinition* definition = nullptr;
  std::string node;
  std::int64_t tick = 0;
  std::vector<Value> values;
  std::vector<SetValues> sets;
  std::vector<std::vector<std::string>> members;      ///< node ids, per set
  std::vector<std::vector<std::string>> write_paths;  ///< per set, as its declared writes
  std::shared_ptr<AnalysisMemo> memo;                 ///< may be nullptr
  std::shared_ptr<BesideTime> time;                   ///< where somebody measures
};
/// The hash of the data that the result depends on, meshes included.
std::uint64_t hash_of(const AnalysisInput& input);

/// An analysis that is waiting, running or done. The first thread that needs the result computes it; all get the same one.
class Analysis {
 public:
  explicit Analysis(AnalysisInput input) : input_(std::move(input)) {}
  /// An analysis that was done before the scene was saved.
  explicit Analysis(AnalysisResult result) : is_claimed_(true), is_done_(true), result_(std::move(result)) {}

  /// Computes the result unless another thread has begun. If `is_unwanted` or this thread's stop request becomes true meanwhile,
  /// the computation is dropped; a later caller can start it again.
  void run(const StopWish& is_unwanted = {});
  /// Waits for the result, or computes it. Returns nothing where this thread is stopped before.
  const AnalysisResult* result();

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_claimed_ = false, is_done_ = false;
  AnalysisInput input_;
  AnalysisResult result_;
};

/// One thread that computes analyses in the order in which they were started. Analyses whose result no state needs any more are
/// skipped, or stopped while they run.
class AnalysisRunner {
 public:
  AnalysisRunner() = default;
  AnalysisRunner(const AnalysisRunner&) = delete;
  AnalysisRunner& operator=(const AnalysisRunner&) = delete;
  /// Stops the running analysis; the others are dropped. A caller that still holds one can compute it.
  ~AnalysisRunner();
  void begin(const std::shared_ptr<Analysis>& analysis);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::weak_ptr<Analysis>> waiting_;
  std::atomic<bool> is_ending_ = false;
  std::thread thread_;  ///< started with the first analysis: most scenes have none
};

}  // namespace bl
