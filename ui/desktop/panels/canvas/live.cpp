// Samples at most ten times a second, however fast the ticks are, and only nodes that have changed.
#include "ui/desktop/panels/canvas/live.h"

#include "core/reading/changed_nodes.h"
#include "core/reading/figures.h"
#include "core/reading/report_model.h"
#include "ui/desktop/panels/canvas/sections.h"

namespace bl::desktop::canvas {

namespace {

constexpr double kSampleSeconds = 0.1;
// Moves of less than 2 mm, and changes below a thousandth, are not worth a pulse.
constexpr double kStillMove = 0.002, kStillShare = 1e-3;

}  // namespace

void Live::update(const Workbench& editor, const Model& model) {
  if (document_ != editor.document->id()) {
    *this = {};
    document_ = editor.document->id();
  }
  if (seen_ == model.state_revision) return;
  seen_ = model.state_revision;
  if (tick_ != editor.state().tick) listen(editor, model);
  tick_ = editor.state().tick;
  if (sampled_at_ >= 0 && editor.now - sampled_at_ < kSampleSeconds) return;
  sampled_at_ = editor.now;
  sample(editor, model);
}

void Live::sample(const Workbench& editor, const NodeBox& box) {
  if (box.in_state == kNoIndex) return;
  for (std::size_t k = 0; k < box.sections.size(); ++k) {
    const Section& section = box.sections[k];
    if (section.spark == kNoIndex) continue;
    const Value* value = value_of(editor, box, section, section.spark);
    if (value == nullptr) continue;
    Spark& steps = steps_[{box.id, k}];
    if (!steps.empty() && steps.back().second == as_number(*value)) continue;
    steps.emplace_back(editor.now, as_number(*value));
    while (steps.size() > 1 && steps[1].first <= times_.front()) steps.erase(steps.begin());
  }
}

void Live::sample(const Workbench& editor, const Model& model) {
  times_.push_back(editor.now);
  while (times_.size() > 2 && times_[1] < editor.now - kSparkSeconds) times_.pop_front();
  const std::shared_ptr<const State>& state = editor.moment->state;
  const bool is_same_model = sampled_ && revision_ == model.revision;
  const auto changed = is_same_model ? reading::changed_nodes(*sampled_, *state) : std::nullopt;
  sampled_ = state;
  revision_ = model.revision;
  if (!changed) {
    for (const NodeBox& box : model.boxes) sample(editor, box);
    return;
  }
  for (const std::uint32_t node : *changed)
    if (const std::size_t box = model.find_box(state->plan->nodes[node].id); box < model.boxes.size())
      sample(editor, model.boxes[box]);
}

void Live::listen(const Workbench& editor, const Model& model) {
  const State& state = editor.state();
  for (const Line& line : model.lines) {
    if (line.in_state == kNoIndex || line.in_state >= state.links.size()) continue;
    LinkPulse& pulse = pulses_[line.id];
    double loudest = 0;
    bool has_moved = false;
    const Voice* shown = nullptr;
    for (const Voice& voice : state.links[line.in_state].voices) {
      const bool is_sum = state.plan->port(voice.target).rule == CombineRule::sum;
      const double size = is_sum ? voice.magnitude : std::abs(as_number(voice.value));
      if (shown == nullptr || size > loudest) loudest = size, shown = &voice;
      has_moved |= is_sum && voice.magnitude > kStillMove;
    }
    if (shown == nullptr) {
      pulse.text.clear();
      continue;
    }
    const PortDefinition& port = state.plan->port(shown->target);
    if (port.rule != CombineRule::sum) has_moved = std::abs(loudest - pulse.magnitude) > kStillShare * std::abs(loudest);
    pulse.magnitude = loudest;
    if (has_moved && !line.is_muted) pulse.pulse_at = editor.now;
    if (port.rule == CombineRule::collect) pulse.text = reading::voice_text(state, *shown);
    else pulse.text = port.rule == CombineRule::sum && loudest <= kStillMove ? "" : reading::quantity(loudest, port.unit);
  }
}

Spark Live::spark(const std::string& node, std::size_t section) const {
  Spark samples;
  const auto found = steps_.find({node, section});
  if (found == steps_.end()) return samples;
  const Spark& steps = found->second;
  std::size_t next = 0;
  for (const double time : times_) {
    while (next < steps.size() && steps[next].first <= time) ++next;
    if (next > 0) samples.emplace_back(time, steps[next - 1].second);
  }
  return samples;
}

const LinkPulse* Live::pulse(const std::string& link) const {
  const auto found = pulses_.find(link);
  return found == pulses_.end() ? nullptr : &found->second;
}

}  // namespace bl::desktop::canvas
