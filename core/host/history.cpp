// One step for each gesture, named by its first entry.
#include "core/host/history.h"

#include <algorithm>

#include "core/host/step_labels.h"

namespace bl::host {

void History::take(const LogEntry& entry, const Scene& scene) {
  const bool is_own = entry.author == author_;
  if (!entry.is_command() || (!is_own && (whose_ == HistoryOf::holder || entry.author.kind == AuthorKind::device))) return;
  if (entry.undoes != 0 || entry.redoes != 0) {
    if (is_own) last_step_ = 0;
    return take_back(entry);
  }
  if (is_own) last_step_ = entry.gesture;
  auto step = std::find_if(steps_.begin(), steps_.end(), [&](const HistoryStep& s) { return s.gesture == entry.gesture; });
  if (step == steps_.end()) {
    // A new step ends what its author had undone before it.
    std::erase_if(steps_, [&](const HistoryStep& s) { return s.is_undone && s.author == entry.author; });
    const std::string label = entry.label.empty() ? label_of_step(*registry_, entry.command, scene) : entry.label;
    steps_.push_back({entry.gesture, entry.tick, label, false, 0, entry.author});
    step = steps_.end() - 1;
  }
  ++step->entries;
}

void History::take_back(const LogEntry& entry) {
  const std::int64_t gesture = entry.undoes != 0 ? entry.undoes : entry.redoes;
  const auto step = std::find_if(steps_.begin(), steps_.end(), [&](const HistoryStep& s) { return s.gesture == gesture; });
  if (step == steps_.end()) return;
  if (entry.is_abandoned) {
    steps_.erase(step);
    return;
  }
  // The gesture that took it back is the one that a redo, or a further undo, will name.
  step->is_undone = entry.undoes != 0;
  step->gesture = entry.gesture;
}

}  // namespace bl::host
