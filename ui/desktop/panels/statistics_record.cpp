// Samples of the run: walks over the volumes once per tick, and keeps six hundred of the results.
#include "ui/desktop/panels/statistics_record.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bl::desktop {

namespace {

constexpr std::size_t kMostSamples = 600;
constexpr double kRecordSmoothing = 0.1;
constexpr std::size_t kManyNodes = 500;
constexpr double kPauseOfNode = 1e-4;  // [s]
// Rows that change places more often than this cannot be read [s].
constexpr double kSortPause = 1;

// Frames further apart than this do not belong to one movement [s].
constexpr double kDrawingPause = 0.2;

double smooth(double old, double fresh) { return old == 0 ? fresh : old + kRecordSmoothing * (fresh - old); }

}  // namespace

double figures_pause(std::size_t nodes) { return nodes > kManyNodes ? kPauseOfNode * static_cast<double>(nodes) : 0; }

void RunRecord::forget_from(double number) {
  while (!tick.empty() && tick.back() >= number)
    for (auto* column : {&tick, &worst, &mean, &volume, &move, &tick_ms, &bytes}) column->pop_back();
}

void RunRecord::drop_oldest() {
  if (tick.size() <= kMostSamples) return;
  for (auto* column : {&tick, &worst, &mean, &volume, &move, &tick_ms, &bytes}) column->erase(column->begin());
}

void RunRecord::sample(const Workbench& editor) {
  // Pauses in which there was nothing to draw say nothing about how fast pictures follow each other.
  if (const double since = editor.now - last_frame_; last_frame_ > 0 && since > 0 && since < kDrawingPause)
    frame_rate = smooth(frame_rate, 1 / since);
  last_frame_ = editor.now;
  const std::shared_ptr<const State>& state = editor.moment->state;
  if (state == sampled_) return;
  const bool is_next = sampled_ && state->tick > sampled_->tick;
  const double ticks = is_next ? static_cast<double>(state->tick - sampled_->tick) : 1;
  if (!is_next) forget_from(static_cast<double>(state->tick));
  sampled_ = state;
  const reading::ReportModel& model = figures(editor);
  double sum = 0;
  for (const reading::VolumeRow& row : model.volumes) sum += std::abs(row.error());
  tick.push_back(static_cast<double>(state->tick));
  worst.push_back(state->largest_residual);
  mean.push_back(model.volumes.empty() ? 0 : sum / static_cast<double>(model.volumes.size()));
  volume.push_back(model.accounts.all.volume);
  move.push_back(state->largest_move);
  tick_ms.push_back(1000 * editor.moment->tick_seconds);
  bytes.push_back(static_cast<double>(editor.bytes_sent - bytes_sent_) / ticks);
  bytes_sent_ = editor.bytes_sent;
  drop_oldest();
}

std::vector<reading::ErrorSample> RunRecord::errors() const {
  std::vector<reading::ErrorSample> out(tick.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = {static_cast<std::int64_t>(tick[k]), worst[k], mean[k], move[k]};
  return out;
}

const reading::ReportModel& RunRecord::figures(const Workbench& editor) {
  const std::shared_ptr<const State>& state = editor.moment->state;
  const std::shared_ptr<const State>& figured = figures_.state();
  if (figured == state) return figures_.last();
  const bool has_the_same_rows = figured && figured->plan->dependents == state->plan->dependents;
  const double next = figured_at_ + figures_pause(state->nodes.size());
  if (has_the_same_rows && editor.now < next) {
    editor.wake_at(next);
    return figures_.last();
  }
  figured_at_ = editor.now;
  ++figures_revision_;
  return figures_.of(state);
}

const std::vector<std::size_t>& RunRecord::ordered(const Workbench& editor) {
  const auto& volumes = figures(editor).volumes;
  const bool is_stale = sorted_ != editor.moment->state, is_due = is_stale && editor.now >= sorted_at_ + kSortPause;
  if (!is_order_stale && ordered_.size() == volumes.size() && !is_due) {
    if (is_stale) editor.wake_at(sorted_at_ + kSortPause);
    return ordered_;
  }
  is_order_stale = false;
  sorted_ = editor.moment->state;
  sorted_at_ = editor.now;
  ordered_.resize(volumes.size());
  std::iota(ordered_.begin(), ordered_.end(), std::size_t{0});
  std::stable_sort(ordered_.begin(), ordered_.end(), [&](std::size_t a, std::size_t b) {
    const reading::VolumeRow &x = volumes[a], &y = volumes[b];
    switch (order) {
      case VolumeOrder::error: return std::abs(x.standing()) > std::abs(y.standing());
      case VolumeOrder::name: return x.name < y.name;
      case VolumeOrder::use: return x.use < y.use;
      case VolumeOrder::size: return x.asked > y.asked;
    }
    return a < b;
  });
  return ordered_;
}

}  // namespace bl::desktop
