// One thread for one import; an exception in it becomes an error.
#include "ui/desktop/document/import_task.h"

#include <exception>
#include <new>
#include <utility>

#include "core/base/scarcity.h"

namespace bl::desktop {

ImportTask::ImportTask(Scene scene, making::ImportOptions options, const Registry& registry)
    : scene_(std::move(scene)), options_(std::move(options)), registry_(&registry) {
  options_.context.watch = &watch_;
  thread_ = std::thread([this] { run(); });
}

ImportTask::~ImportTask() {
  stop();
  wait();
}

void ImportTask::wait() {
  if (thread_.joinable()) thread_.join();
}

void ImportTask::run() {
  try {
    result_ = making::import_context(scene_, options_, *registry_);
  } catch (const std::bad_alloc&) {
    result_.emplace();
    result_->errors.push_back({"", {ErrorCode::out_of_range, "", "The import has stopped: " + memory_sentence()}});
  } catch (const std::exception& exception) {
    result_.emplace();
    result_->errors.push_back({"", {ErrorCode::internal, "", std::string("The import has failed: ") + exception.what()}});
  }
  is_done_ = true;
}

}  // namespace bl::desktop
