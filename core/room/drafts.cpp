// A draft's scene is made anew from the head of the log whenever that has moved on: applying commands costs microseconds.
#include "core/room/drafts.h"

#include <algorithm>
#include <utility>

namespace bl::room {

std::int64_t Draft::step_count() const {
  return std::count_if(steps_.begin(), steps_.end(), [](const Command& step) { return !step.id.empty(); });
}

const Scene& Draft::scene_on(const Scene& head, std::int64_t seq) {
  if (follows_ == seq) return scene_;
  scene_ = head;
  misfits_.clear();
  SceneEdit edit(scene_, *registry_);
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (steps_[k].id.empty()) continue;
    if (auto done = bl::apply(edit, steps_[k]); !done) misfits_.push_back({static_cast<std::int64_t>(k), done.error()});
  }
  placed_ = edit.placed();
  follows_ = seq;
  return scene_;
}

Result<void> Draft::apply_to_scene(const Command& command, const Scene& head, std::int64_t seq) {
  (void)scene_on(head, seq);
  SceneEdit edit(scene_, *registry_);
  if (auto done = bl::apply(edit, command); !done) return done.error();
  placed_.insert(edit.placed().begin(), edit.placed().end());
  ++revision_;
  return {};
}

Result<void> Draft::add(const Command& command, const Scene& head, std::int64_t seq) {
  if (auto done = apply_to_scene(command, head, seq); !done) return done;
  steps_.push_back(command);
  taken_back_.clear();
  return {};
}

std::int64_t Draft::take_back() {
  const auto last = std::find_if(steps_.rbegin(), steps_.rend(), [](const Command& step) { return !step.id.empty(); });
  if (last == steps_.rend()) return -1;
  const std::int64_t number = steps_.rend() - last - 1;
  taken_back_.emplace_back(number, std::exchange(*last, {}));
  follows_ = -1;
  ++revision_;
  return number;
}

// All steps behind it were taken back as well, and none has been added since: it is the last one again.
Result<void> Draft::bring_back(const Scene& head, std::int64_t seq) {
  auto& [number, command] = taken_back_.back();
  if (auto done = apply_to_scene(command, head, seq); !done) return done;
  steps_[static_cast<std::size_t>(number)] = std::move(command);
  taken_back_.pop_back();
  return {};
}

void Draft::restore(std::int64_t number, Command command) {
  if (static_cast<std::size_t>(number) >= steps_.size()) steps_.resize(static_cast<std::size_t>(number) + 1);
  steps_[static_cast<std::size_t>(number)] = std::move(command);
  follows_ = -1;
}

}  // namespace bl::room
