// Long analyses that run beside the loop: begun with the data of one tick, taken in a declared number of ticks later.
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

/// One value that an analysis gives to a port, its own or that of a member; named, because the scene may change meanwhile.
struct AnalysisOutput {
  std::string node, path;  ///< "typification.port"
  Value value;
};

/// What came of it: outputs, or why there are none.
struct AnalysisResult {
  std::vector<AnalysisOutput> outputs;
  std::optional<Error> error;
};

/// What the analyses of a node keep for the next one, which runs on any thread: one evaluation at a time has it,
/// another one meanwhile goes without.
struct AnalysisMemo {
  std::mutex mutex;
  Memo memo;
};

/// What an analysis was given. Its result depends on this alone, less the memo, which only saves work.
struct AnalysisInput {
  std::shared_ptr<const void> plan;  ///< whose types the definition is one of: the scene may have others before it is done
  const TypificationDefinition* definition = nullptr;
  std::string node;
  std::int64_t tick = 0;
  std::vector<Value> values;
  std::vector<SetValues> sets;
  std::vector<std::vector<std::string>> members;      ///< node ids, per set
  std::vector<std::vector<std::string>> write_paths;  ///< per set, as its declared writes
  std::shared_ptr<AnalysisMemo> memo;                 ///< may be nullptr
};
/// Of the data that the result depends on, meshes included.
std::uint64_t hash_of(const AnalysisInput& input);

/// An analysis, waiting, running or done. Whoever needs the result first works it out; everybody gets the same.
class Analysis {
 public:
  explicit Analysis(AnalysisInput input) : input_(std::move(input)) {}
  /// One that was done before the scene was saved.
  explicit Analysis(AnalysisResult result) : is_claimed_(true), is_done_(true), result_(std::move(result)) {}

  /// Works it out unless somebody has begun to. Where `is_unwanted` comes true meanwhile, or a wish of this thread to stop, the
  /// work is dropped, and left to whoever wants the result after all.
  void run(const StopWish& is_unwanted = {});
  /// Waits until it is done, or does it. Nothing where this thread is to stop before it is done.
  const AnalysisResult* result();

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_claimed_ = false, is_done_ = false;
  AnalysisInput input_;
  AnalysisResult result_;
};

/// One thread that works analyses off in the order in which they were begun. Those that nobody waits for any more are left out,
/// or stopped on the way.
class AnalysisRunner {
 public:
  AnalysisRunner() = default;
  AnalysisRunner(const AnalysisRunner&) = delete;
  AnalysisRunner& operator=(const AnalysisRunner&) = delete;
  /// Stops the one that is running; the others are dropped. Whoever still holds one works it out.
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
