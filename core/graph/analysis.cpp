// Working analyses out on a thread of their own.
#include "core/graph/analysis.h"

#include <exception>
#include <new>
#include <optional>
#include <system_error>

#include "core/base/stop_wait.h"

namespace bl {

namespace {

// Meshes count as nothing in a state's hash, because they follow from the rest; the rest need not be among an analysis' inputs.
void add_input(Hash& hash, const Value& value) {
  const MeshPointer* mesh = std::get_if<MeshPointer>(&value);
  if (mesh == nullptr || *mesh == nullptr) return add_to(hash, value);
  hash.add(static_cast<std::uint64_t>((*mesh)->vertices.size()));
  for (const Point3& vertex : (*mesh)->vertices)
    for (const double coordinate : {vertex.x, vertex.y, vertex.z}) hash.add(coordinate);
  for (const auto& triangle : (*mesh)->triangles)
    for (const auto corner : triangle) hash.add(static_cast<std::uint64_t>(corner));
}

AnalysisResult worked_out(AnalysisInput& input) {
  const TypificationDefinition& definition = *input.definition;
  // One that somebody else has at the moment is not waited for.
  Memo none;
  std::unique_lock<std::mutex> lock;
  if (input.memo) lock = std::unique_lock(input.memo->mutex, std::try_to_lock);
  Memo& memo = lock ? input.memo->memo : none;
  const auto done = definition.evaluate(input.values, input.sets, Tick{.index = input.tick, .memo = &memo});
  // Who says that it was stopped has kept what is right; what others have kept for the next time may have gaps.
  if (is_stop_wished() && (done || done.error().code != ErrorCode::cancelled)) memo = Memo();
  AnalysisResult result;
  if (!done) {
    result.error = done.error();
    return result;
  }
  for (std::size_t p = 0; p < definition.ports.size(); ++p)
    if (definition.ports[p].is_computed)
      result.outputs.push_back({input.node, definition.id + "." + definition.ports[p].id, std::move(input.values[p])});
  for (std::size_t s = 0; s < input.sets.size(); ++s) {
    const auto& paths = input.write_paths[s];
    for (std::size_t w = 0; w < input.sets[s].writes.size(); ++w)
      if (auto& value = input.sets[s].writes[w])
        result.outputs.push_back(
            {input.members[s][input.sets[s].member_of(w / paths.size())], paths[w % paths.size()], std::move(*value)});
  }
  return result;
}

}  // namespace

std::uint64_t hash_of(const AnalysisInput& input) {
  Hash hash;
  for (std::size_t p = 0; p < input.values.size(); ++p)
    if (!input.definition->ports[p].is_computed && input.definition->ports[p].id != input.definition->latency)
      add_input(hash, input.values[p]);
  for (std::size_t s = 0; s < input.sets.size(); ++s) {
    for (const std::string& member : input.members[s]) hash.add(std::string_view(member));
    for (const Value& value : input.sets[s].reads) add_input(hash, value);
  }
  return hash.value();
}

void Analysis::run(const StopWish& is_unwanted) {
  {
    const std::lock_guard lock(mutex_);
    if (is_claimed_) return;
    is_claimed_ = true;
  }
  // What may be stopped works on a copy: values and tables are shared, so that this costs next to nothing. Nobody else could
  // catch an exception: this may be a thread of its own, and others wait for the result.
  AnalysisResult result;
  try {
    AnalysisInput input = input_;
    std::optional<StopScope> scope;
    if (is_unwanted) scope.emplace(is_unwanted);
    // A tick that works a result out itself counts that as its own time.
    const std::shared_ptr<BesideTime> time = is_unwanted ? input.time : nullptr;
    const double began = time ? time->now() : 0;
    result = worked_out(input);
    if (time) {
      time->seconds += time->now() - began;
      ++time->runs;
    }
  } catch (const std::bad_alloc&) {
    result = {
        {}, Error{ErrorCode::out_of_range, "", "memory ran out in this analysis: ask for less, such as fewer or coarser points"}};
  } catch (const std::exception& thrown) {
    result = {{}, Error{ErrorCode::internal, "", std::string("the analysis failed: ") + thrown.what()}};
  }
  {
    const std::lock_guard lock(mutex_);
    is_done_ = !(is_unwanted && is_unwanted()) && !is_stop_wished();
    is_claimed_ = is_done_;
    if (is_done_) {
      result_ = std::move(result);
      input_ = {};
    }
  }
  done_.notify_all();
}

const AnalysisResult* Analysis::result() {
  for (;;) {
    run();
    std::unique_lock lock(mutex_);
    // Another thread that works on it knows nothing of a wish of this one.
    wait_unless_stopped(done_, lock, [this] { return is_done_ || !is_claimed_; });
    if (is_done_) return &result_;
    if (is_stop_wished()) return nullptr;
  }
}

AnalysisRunner::~AnalysisRunner() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void AnalysisRunner::begin(const std::shared_ptr<Analysis>& analysis) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(analysis);
  if (!thread_.joinable()) {
    try {
      thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {
      // The system gives no more threads: whoever wants the result works it out then.
      waiting_.clear();
      return;
    }
  }
  wake_.notify_all();
}

void AnalysisRunner::work() {
  for (std::unique_lock lock(mutex_);;) {
    wake_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (is_ending_) return;
    const std::shared_ptr<Analysis> next = waiting_.front().lock();
    waiting_.pop_front();
    lock.unlock();
    // Unwanted is what no state holds any more: nobody can come back to it then.
    if (next) next->run([&] { return is_ending_ || next.use_count() == 1; });
    lock.lock();
  }
}

}  // namespace bl
