// An import on a thread of its own: the window goes on while a large file is read.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "core/making/context_import.h"

namespace bl::desktop {

class ImportTask {
 public:
  /// Begins at once. `scene` is the scene to add to; it is not changed. The registry must outlive the task.
  ImportTask(Scene scene, making::ImportOptions options, const Registry& registry);
  /// Stops the import, and waits until it has ended.
  ~ImportTask();
  ImportTask(const ImportTask&) = delete;
  ImportTask& operator=(const ImportTask&) = delete;

  const importing::ImportWatch& watch() const { return watch_; }
  /// Asks the import to end; it ends between two elements.
  void stop() { watch_.is_stopped = true; }
  bool is_done() const { return is_done_; }
  void wait();
  /// The result, once the import is done.
  making::ImportedScene& result() { return *result_; }

 private:
  void run();

  Scene scene_;
  making::ImportOptions options_;
  const Registry* registry_;
  importing::ImportWatch watch_;
  std::optional<making::ImportedScene> result_;
  std::atomic<bool> is_done_{false};
  std::thread thread_;
};

}  // namespace bl::desktop
