// One link asked about its pairs.
#include "core/graph/link_run.h"

#include <algorithm>
#include <numeric>

namespace bl {

Voice held_voice(const Voice& voice, const LinkPlan& plan) {
  Voice held = voice;
  held.strength = plan.strength;
  return held;
}

std::optional<std::uint32_t> place_in(const std::vector<std::uint32_t>& nodes, std::uint32_t node) {
  const auto at = std::lower_bound(nodes.begin(), nodes.end(), node);
  if (at == nodes.end() || *at != node) return std::nullopt;
  return static_cast<std::uint32_t>(at - nodes.begin());
}

const Value* value_read(const State& frozen, const LinkRead& read, PortRef ref) {
  static const Value locked = true, open = false;
  if (read.is_optional && ref.type == PortRef::kNodeId) return nullptr;
  if (!read.is_lock) return &frozen.value(ref);
  return frozen.plan->nodes[ref.node].types[ref.type].is_locked[ref.port] ? &locked : &open;
}

LinkRun::LinkRun(const State& frozen, const LinkPlan& plan, LinkReads* whole)
    : LinkRun(frozen, plan, plan.targets.size(), whole) {}

LinkRun::LinkRun(const State& frozen, const LinkPlan& plan, std::vector<std::uint32_t> targets)
    : LinkRun(frozen, plan, targets.size(), nullptr) {
  targets_ = std::move(targets);
}

LinkRun::LinkRun(const State& frozen, const LinkPlan& plan, std::size_t targets, LinkReads* whole)
    : frozen_(frozen), plan_(plan), definition_(*plan.definition), reads_(whole == nullptr ? &own_reads_ : whole) {
  is_pairwise_ = !definition_.is_whole(End::from) && !definition_.is_whole(End::to);
  if (whole == nullptr)
    for (const LinkRead& read : definition_.reads) own_reads_.values.emplace_back(read.is_whole ? count(read.end) : 1);
  for (const LinkWrite& write : definition_.proposes) writes_.values.emplace_back(write.is_whole ? count(write.end) : 1);
  has_failed_.resize(targets);
}

void LinkRun::run(const Tick& tick) {
  const std::size_t from_count = steps(End::from), to_count = steps(End::to);
  for (std::size_t f = 0; f < from_count; ++f)
    for (std::size_t t = 0; t < to_count; ++t) run_pair(f, t, tick);
}

void LinkRun::run_pair(std::size_t f, std::size_t t, const Tick& tick) {
  if (is_pairwise_ && plan_.nodes[0][f] == plan_.nodes[1][t] && (count(End::from) > 1 || count(End::to) > 1)) return;
  if (is_pairwise_ && plan_.is_symmetric && f > t) return;
  if (is_stopped_) return fail(f, t);
  ++pairs_;
  LinkRemarks remarks;
  Tick one = tick;
  one.remarks = &remarks;
  if (auto done = evaluate(f, t, one); !done) note(f, t, done.error());
  hear(remarks);
}

std::optional<Error> LinkRun::error() const {
  std::optional<Error> error = first_error_;
  if (failures_ > 1 && !is_stopped_) error->message += " (and " + std::to_string(failures_ - 1) + " more of its pairs fail)";
  return error;
}

LinkRemarks LinkRun::remarks() const {
  LinkRemarks remarks = remarks_;
  if (remarked_ > 1) remarks.said->message += " (and " + std::to_string(remarked_ - 1) + " more of its pairs)";
  return remarks;
}

std::vector<Voice> LinkRun::voices(const std::vector<Voice>& last) {
  std::vector<Voice> voices;
  if (collected_.empty() && failures_ == 0) return voices;
  collected_.resize(has_failed_.size());
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    const std::size_t index = targets_.empty() ? i : targets_[i];
    const PortRef target = plan_.targets[index];
    const PortDefinition& port = frozen_.plan->port(target);
    bool is_missing = collected_[i].count == 0 && has_failed_[i];
    if (collected_[i].count > 0) {
      // Means of numbers that are finite may be none, and zeros may get a sign.
      Voice voice = collected_[i].voice(target, port, plan_.strength);
      is_missing = !make_storable(voice.value);
      if (is_missing) note_overflow(target);
      else voices.push_back(std::move(voice));
    }
    if (is_missing && port.rule != CombineRule::sum) {
      const auto held = std::lower_bound(last.begin(), last.end(), target,
                                         [](const Voice& voice, const PortRef& ref) { return voice.target < ref; });
      if (held != last.end() && held->target == target) voices.push_back(held_voice(*held, plan_));
    }
  }
  return voices;
}

std::size_t LinkRun::slot_of(std::uint32_t target) const {
  if (target == LinkPlan::kNoTarget) return kNone;
  if (targets_.empty()) return target;
  const auto at = std::lower_bound(targets_.begin(), targets_.end(), target);
  return at != targets_.end() && *at == target ? static_cast<std::size_t>(at - targets_.begin()) : kNone;
}

void LinkRun::note(std::size_t f, std::size_t t, const Error& error) {
  if (!first_error_) first_error_ = error;
  ++failures_;
  is_stopped_ = error.code == ErrorCode::cancelled;
  fail(f, t);
}

void LinkRun::note_overflow(PortRef target) {
  if (!first_error_)
    first_error_ =
        Error{ErrorCode::not_finite, "",
              "what its pairs propose for `" + frozen_.plan->nodes[target.node].id + "` adds up to more than any number"};
}

void LinkRun::hear(const LinkRemarks& remarks) {
  if (!remarks.said || (remarks_.said && remarks.kind < remarks_.kind)) return;
  if (remarks_.said && remarks.kind == remarks_.kind) {
    ++remarked_;
    return;
  }
  remarks_ = remarks;
  remarked_ = 1;
}

void LinkRun::fail(std::size_t f, std::size_t t) {
  for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
    const LinkWrite& write = definition_.proposes[w];
    const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
    for (std::size_t i = 0; i < writes_.values[w].size(); ++i)
      if (const std::size_t slot = slot_of(plan_.writes[w][first + i]); slot != kNone) has_failed_[slot] = true;
  }
}

bool LinkRun::is_out_of_date(PortRef ref) const {
  return ref.type != PortRef::kNodeId && frozen_.nodes[ref.node].types[ref.type].error && frozen_.plan->port(ref).is_computed;
}

Result<void> LinkRun::read(std::size_t f, std::size_t t) {
  for (std::size_t r = 0; r < definition_.reads.size(); ++r) {
    const LinkRead& read = definition_.reads[r];
    if (read.is_whole && reads_ != &own_reads_) continue;
    const std::size_t first = read.is_whole ? 0 : (read.end == End::from ? f : t);
    auto& values = reads_->values[r];
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_read(frozen_, read, plan_.reads[r][first + i]);
    if (!read.is_whole && is_out_of_date(plan_.reads[r][first]))
      return Error{ErrorCode::missing, "",
                   "`" + frozen_.plan->nodes[plan_.reads[r][first].node].id + "` has an error, so that its `" +
                       frozen_.plan->path_text(plan_.reads[r][first]) +
                       "` is out of date. What was proposed last stays in force"};
  }
  return {};
}

Result<void> LinkRun::evaluate(std::size_t f, std::size_t t, const Tick& tick) {
  if (auto done = read(f, t); !done) return done;
  for (auto& values : writes_.values)
    if (pairs_ > 1) std::fill(values.begin(), values.end(), std::nullopt);  // of the pair before
  if (auto done = definition_.evaluate(plan_.parameters.get(), *reads_, writes_, tick); !done) return done;
  for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
    const LinkWrite& write = definition_.proposes[w];
    const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
    for (std::size_t i = 0; i < writes_.values[w].size(); ++i)
      if (auto& value = writes_.values[w][i];
          value && plan_.writes[w][first + i] != LinkPlan::kNoTarget && !make_storable(*value))
        return Error{ErrorCode::not_finite, "",
                     "proposed a value that is not a finite number for `" +
                         frozen_.plan->nodes[plan_.targets[plan_.writes[w][first + i]].node].id + "`"};
  }
  for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
    const LinkWrite& write = definition_.proposes[w];
    const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
    for (std::size_t i = 0; i < writes_.values[w].size(); ++i)
      if (const auto& value = writes_.values[w][i]) {
        const std::uint32_t target = plan_.writes[w][first + i];
        if (const std::size_t slot = slot_of(target); slot != kNone) {
          if (collected_.empty()) collected_.resize(has_failed_.size());
          collected_[slot].add(*value, frozen_.plan->port(plan_.targets[target]).rule);
        }
      }
  }
  return {};
}

}  // namespace bl
