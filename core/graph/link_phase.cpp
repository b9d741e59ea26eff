// Phase 3: links read the frozen state and make proposals.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/graph/phases.h"

namespace bl {

namespace {

// Proposals of all pairs of one link on one target, taken together in the order of the pairs. A link speaks with one voice: the
// mean of the pairs that move anything, so that a node pulled by sixty partners is moved no farther than by one, and
// links to sets settle whatever the size of the set. A pair counts as far as it moves anything: if it counted whole from its
// first millimetre on, the voice of the others would jump to half whenever a second pair comes in, and nodes would saw for ever.
struct Collected {
  int count = 0, moving = 0;
  double number = 0;
  Vector3 vector;
  double magnitude = 0, squares = 0;
  std::vector<std::string> texts;

  void add(const Value& value, CombineRule rule) {
    ++count;
    if (const auto* list = std::get_if<Shared<std::vector<std::string>>>(&value)) {
      texts.insert(texts.end(), (*list)->begin(), (*list)->end());
      return;
    }
    if (const auto* v = std::get_if<Vector3>(&value)) {
      vector += *v;
      magnitude += norm(*v);
      squares += squared_norm(*v);
      if (*v != Vector3{}) ++moving;
      return;
    }
    const double x = as_number(value);
    magnitude += std::abs(x);
    squares += x * x;
    if (x != 0) ++moving;
    if (rule == CombineRule::min) number = count == 1 ? x : std::min(number, x);
    else if (rule == CombineRule::max) number = count == 1 ? x : std::max(number, x);
    else number += x;
  }

  Voice voice(PortRef target, const PortDefinition& port, double strength) const {
    if (port.rule == CombineRule::collect) {
      std::vector<std::string> all = texts;
      // Mostly they come in order, because pairs do.
      if (std::adjacent_find(all.begin(), all.end(), std::greater_equal<>()) != all.end()) {
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
      }
      return {target, Shared(std::move(all)), 0, strength};
    }
    const double share = port.rule == CombineRule::blend ? 1.0 / count : port.rule == CombineRule::sum ? share_of_sum() : 1.0;
    if (port.kind == ValueKind::point) return {target, vector * share, magnitude * share, strength};
    return {target, number * share, magnitude * share, strength};
  }

  // One over the number of pairs that move anything, each counted by how much it moves: (sum m)² / sum m² of n equal ones is n,
  // and one that hardly moves hardly counts. The sum times this share is never more than the largest move.
  double share_of_sum() const {
    if (moving <= 1) return 1;
    const double share = squares / (magnitude * magnitude);
    return share > 0 && share <= 1 ? share : 1.0 / moving;  // squares of extreme numbers overflow
  }
};

// What a link goes on to want, as loud as people want it now.
Voice held_voice(const Voice& voice, const LinkPlan& plan) {
  Voice held = voice;
  held.strength = plan.strength;
  return held;
}

class LinkRun {
 public:
  LinkRun(const State& frozen, const LinkPlan& plan) : LinkRun(frozen, plan, {}) {
    collected_.resize(plan.targets.size());
    has_failed_.resize(plan.targets.size());
  }
  // Of pairs that speak to some targets only: `targets` are their indices, ascending.
  LinkRun(const State& frozen, const LinkPlan& plan, std::vector<std::uint32_t> targets)
      : frozen_(frozen), plan_(plan), definition_(*plan.definition), targets_(std::move(targets)) {
    for (const LinkRead& read : definition_.reads) reads_.values.emplace_back(read.is_whole ? count(read.end) : 1);
    for (const LinkWrite& write : definition_.proposes) writes_.values.emplace_back(write.is_whole ? count(write.end) : 1);
    collected_.resize(targets_.size());
    has_failed_.resize(targets_.size());
  }

  // Every pair once; an end that is read whole takes part in one evaluation for all of its nodes. A pair that fails does not stop
  // the others, unless the link as a whole has used up what it may.
  void run(const Tick& tick) {
    const std::size_t from_count = definition_.is_whole(End::from) ? 1 : count(End::from);
    const std::size_t to_count = definition_.is_whole(End::to) ? 1 : count(End::to);
    const bool is_pairwise = !definition_.is_whole(End::from) && !definition_.is_whole(End::to);
    for (std::size_t f = 0; f < from_count; ++f)
      for (std::size_t t = 0; t < to_count; ++t) {
        if (is_pairwise && plan_.nodes[0][f] == plan_.nodes[1][t] && (from_count > 1 || to_count > 1)) continue;
        if (is_pairwise && plan_.is_symmetric && f > t) continue;
        run_pair(f, t, tick);
      }
  }

  void run_pair(std::size_t f, std::size_t t, const Tick& tick) {
    if (is_stopped_) return fail(f, t);
    ++pairs_;
    LinkRemarks remarks;
    Tick one = tick;
    one.remarks = &remarks;
    if (auto done = evaluate(f, t, one); !done) note(f, t, done.error());
    hear(remarks);
  }

  std::size_t pairs() const { return pairs_; }

  // What the first pair that failed says, and how many others there are; nothing where all is well.
  std::optional<Error> error() const {
    std::optional<Error> error = first_error_;
    if (failures_ > 1 && !is_stopped_) error->message += " (and " + std::to_string(failures_ - 1) + " more of its pairs fail)";
    return error;
  }

  // The gravest that a pair has remarked; of several that are as grave the first, and how many others there are.
  LinkRemarks remarks() const {
    LinkRemarks remarks = remarks_;
    if (remarked_ > 1) remarks.said->message += " (and " + std::to_string(remarked_ - 1) + " more of its pairs)";
    return remarks;
  }

  // Ascending, as the targets are. A wanted value of the last good tick stays in force where all that has failed; a push must not
  // go on for ever.
  std::vector<Voice> voices(const std::vector<Voice>& last) {
    std::vector<Voice> voices;
    for (std::size_t i = 0; i < collected_.size(); ++i) {
      const PortRef target = plan_.targets[targets_.empty() ? i : targets_[i]];
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

 private:
  std::size_t count(End end) const { return plan_.nodes[static_cast<int>(end)].size(); }
  // The place of a target among those that are spoken to.
  std::size_t slot_of(std::uint32_t target) const {
    return targets_.empty()
               ? target
               : static_cast<std::size_t>(std::lower_bound(targets_.begin(), targets_.end(), target) - targets_.begin());
  }

  void note(std::size_t f, std::size_t t, const Error& error) {
    if (!first_error_) first_error_ = error;
    ++failures_;
    is_stopped_ = error.code == ErrorCode::cancelled;
    fail(f, t);
  }

  void note_overflow(PortRef target) {
    if (!first_error_)
      first_error_ =
          Error{ErrorCode::not_finite, "",
                "what its pairs propose for `" + frozen_.plan->nodes[target.node].id + "` adds up to more than any number"};
  }

  void hear(const LinkRemarks& remarks) {
    if (!remarks.said || (remarks_.said && remarks.kind < remarks_.kind)) return;
    if (remarks_.said && remarks.kind == remarks_.kind) {
      ++remarked_;
      return;
    }
    remarks_ = remarks;
    remarked_ = 1;
  }

  void fail(std::size_t f, std::size_t t) {
    for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
      const LinkWrite& write = definition_.proposes[w];
      const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
      for (std::size_t i = 0; i < writes_.values[w].size(); ++i) has_failed_[slot_of(plan_.writes[w][first + i])] = true;
    }
  }

  // A figure that does not follow any more must not be answered to tick by tick.
  bool is_out_of_date(PortRef ref) const {
    return ref.type != PortRef::kNodeId && frozen_.nodes[ref.node].types[ref.type].error && frozen_.plan->port(ref).is_computed;
  }

  const Value& lock_at(PortRef ref) const {
    static const Value locked = true, open = false;
    return frozen_.plan->nodes[ref.node].types[ref.type].is_locked[ref.port] ? locked : open;
  }

  Result<void> evaluate(std::size_t f, std::size_t t, const Tick& tick) {
    for (std::size_t r = 0; r < definition_.reads.size(); ++r) {
      const LinkRead& read = definition_.reads[r];
      const std::size_t first = read.is_whole ? 0 : (read.end == End::from ? f : t);
      for (std::size_t i = 0; i < reads_.values[r].size(); ++i) {
        const PortRef ref = plan_.reads[r][first + i];
        reads_.values[r][i] = read.is_lock ? &lock_at(ref) : &frozen_.value(ref);
      }
      if (!read.is_whole && is_out_of_date(plan_.reads[r][first]))
        return Error{ErrorCode::missing, "",
                     "`" + frozen_.plan->nodes[plan_.reads[r][first].node].id + "` has an error, so that its `" +
                         frozen_.plan->path_text(plan_.reads[r][first]) +
                         "` is out of date. What was proposed last stays in force"};
    }
    for (auto& values : writes_.values) std::fill(values.begin(), values.end(), std::nullopt);
    if (auto done = definition_.evaluate(plan_.parameters.get(), reads_, writes_, tick); !done) return done;
    for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
      const LinkWrite& write = definition_.proposes[w];
      const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
      for (std::size_t i = 0; i < writes_.values[w].size(); ++i)
        if (auto& value = writes_.values[w][i]; value && !make_storable(*value))
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
          collected_[slot_of(target)].add(*value, frozen_.plan->port(plan_.targets[target]).rule);
        }
    }
    return {};
  }

  const State& frozen_;
  const LinkPlan& plan_;
  const LinkDefinition& definition_;
  LinkReads reads_;
  LinkWrites writes_;
  std::vector<std::uint32_t> targets_;  // the only ones, by index, ascending; empty: all
  std::vector<Collected> collected_;    // by target
  std::vector<bool> has_failed_;        // by target: a pair that would have spoken to it
  std::optional<Error> first_error_;
  LinkRemarks remarks_;
  std::size_t failures_ = 0, remarked_ = 0, pairs_ = 0;
  bool is_stopped_ = false;
};

LinkState evaluated(const State& frozen, std::size_t index, std::size_t& pairs) {
  const LinkPlan& plan = frozen.plan->links[index];
  LinkState next;
  if (!plan.is_enabled) return next;
  const std::vector<Voice>& last = frozen.links[index].voices;
  if (plan.error) {
    next.error = plan.error;
    for (const Voice& voice : last)
      if (is_lasting(frozen, voice)) next.voices.push_back(held_voice(voice, plan));
    return next;
  }
  LinkRun run(frozen, plan);
  Memo memo;
  run.run(Tick{.index = tick_for(*plan.definition, frozen.tick), .memo = &memo});
  pairs += run.pairs();
  next.voices = run.voices(last);
  if (const auto error = run.error()) {
    next.error = error->within("links/" + plan.id);
    return next;
  }
  const LinkRemarks remarks = run.remarks();
  if (!remarks.said) return next;
  const Error said = remarks.said->within("links/" + plan.id);
  if (remarks.kind == LinkRemark::at_work) {
    next.work = said;
  } else {
    next.error = said;
    next.remark = remarks.kind;
  }
  return next;
}

// A link that has to be asked.
struct DueLink {
  std::uint32_t link = 0;
  bool is_whole = false;             // all of its pairs
  std::vector<std::uint32_t> nodes;  // else only those of these nodes, of which it reads something that has changed; ascending
};

// The end whose nodes each have a pair of their own, with the one node of the other end: then a pair says what it said as long
// as its nodes stay as they are.
std::optional<End> end_of_single_pairs(const LinkPlan& plan) {
  const LinkDefinition& definition = *plan.definition;
  if (definition.is_whole(End::from) || definition.is_whole(End::to) || definition.has_common_budget) return std::nullopt;
  const End many = plan.nodes[0].size() == 1 ? End::to : End::from;
  const bool is_alone = plan.nodes[many == End::to ? 0 : 1].size() == 1 && plan.nodes[static_cast<int>(many)].size() > 1;
  const bool speaks_there = std::all_of(definition.proposes.begin(), definition.proposes.end(),
                                        [&](const LinkWrite& write) { return write.end == many; });
  return is_alone && speaks_there ? std::optional(many) : std::nullopt;
}

// What the link says after changes of these nodes, or nothing where all of its pairs have to be asked.
std::optional<LinkState> evaluated_in_part(const State& frozen, const DueLink& due, std::size_t& asked) {
  const LinkPlan& plan = frozen.plan->links[due.link];
  const LinkState& last = frozen.links[due.link];
  if (due.is_whole || plan.error || last.error || last.remark || last.work) return std::nullopt;
  const auto many = end_of_single_pairs(plan);
  if (!many) return std::nullopt;
  const std::uint32_t alone = plan.nodes[*many == End::to ? 0 : 1].front();
  const std::vector<std::uint32_t>& nodes = plan.nodes[static_cast<int>(*many)];
  std::vector<std::size_t> pairs;
  std::vector<std::uint32_t> targets;
  for (const std::uint32_t node : due.nodes) {
    if (node == alone) return std::nullopt;
    pairs.push_back(static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()));
    for (const auto& writes : plan.writes) targets.push_back(writes[pairs.back()]);
  }
  if (2 * pairs.size() > nodes.size()) return std::nullopt;
  std::sort(targets.begin(), targets.end());
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  LinkRun run(frozen, plan, targets);
  Memo memo;
  const Tick tick{.index = tick_for(*plan.definition, frozen.tick), .memo = &memo};
  for (const std::size_t pair : pairs) run.run_pair(*many == End::to ? 0 : pair, *many == End::to ? pair : 0, tick);
  asked += run.pairs();
  const std::vector<Voice> fresh = run.voices(last.voices);
  if (run.error() || run.remarks().said) return std::nullopt;
  LinkState next;
  for (const Voice& voice : last.voices) {
    const auto at = std::lower_bound(plan.targets.begin(), plan.targets.end(), voice.target);
    const auto target = static_cast<std::uint32_t>(at - plan.targets.begin());
    if (!std::binary_search(targets.begin(), targets.end(), target)) next.voices.push_back(voice);
  }
  const auto kept = static_cast<std::ptrdiff_t>(next.voices.size());
  next.voices.insert(next.voices.end(), fresh.begin(), fresh.end());
  std::inplace_merge(next.voices.begin(), next.voices.begin() + kept, next.voices.end(),
                     [](const Voice& a, const Voice& b) { return a.target < b.target; });
  return next;
}

// Those that read what has changed, that read the time, or that have to be asked again.
std::vector<DueLink> due_links(const State& frozen) {
  const Dependents& dependents = *frozen.plan->dependents;
  std::vector<bool> is_whole(frozen.links.size(), frozen.due.is_everything);
  for (const auto* more : {&frozen.due.links, &dependents.timed_links})
    for (const std::uint32_t link : *more) is_whole[link] = true;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changes;  // link and node
  for (const PortRef& ref : frozen.due.changed)
    for (const std::uint32_t link : dependents.links_reading[dependents.port_index(ref)])
      if (!is_whole[link]) changes.emplace_back(link, ref.node);
  std::sort(changes.begin(), changes.end());
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());
  std::vector<DueLink> due;
  auto change = changes.begin();
  for (std::uint32_t l = 0; l < is_whole.size(); ++l) {
    if (!is_whole[l] && (change == changes.end() || change->first != l)) continue;
    DueLink& one = due.emplace_back(DueLink{l, is_whole[l], {}});
    for (; change != changes.end() && change->first == l; ++change) one.nodes.push_back(change->second);
  }
  return due;
}

// The nodes to which one of two lists of voices, both in ascending order of targets, says something else than the other.
void add_differences(const std::vector<Voice>& before, const std::vector<Voice>& after, std::vector<std::uint32_t>& nodes) {
  auto b = before.begin(), a = after.begin();
  while (b != before.end() || a != after.end()) {
    const bool is_old = a == after.end() || (b != before.end() && b->target < a->target);
    const bool is_new = b == before.end() || (a != after.end() && a->target < b->target);
    if (is_old || is_new || !(*b == *a)) nodes.push_back((is_old ? b : a)->target.node);
    if (!is_new) ++b;
    if (!is_old) ++a;
  }
}

}  // namespace

void evaluate_links(TickWork& work, ThreadPool& pool) {
  const std::vector<DueLink> due = due_links(work.frozen);
  std::vector<LinkState> fresh(due.size());
  std::vector<std::size_t> pairs(due.size(), 0);
  pool.for_each_chunk(due.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double began = moment_of(work.times);
      auto in_part = evaluated_in_part(work.frozen, due[i], pairs[i]);
      fresh[i] = in_part ? std::move(*in_part) : evaluated(work.frozen, due[i].link, pairs[i]);
      if (work.times != nullptr) work.times->add_link(due[i].link, began, pairs[i]);
    }
  });
  work.counts.links += due.size();
  work.counts.pairs += std::accumulate(pairs.begin(), pairs.end(), std::size_t{0});
  for (std::size_t i = 0; i < due.size(); ++i) {
    const LinkState& before = work.frozen.links[due[i].link];
    if (before.says_the_same(fresh[i])) continue;
    add_differences(before.voices, fresh[i].voices, work.spoken_to);
    work.next.links.put(due[i].link, std::move(fresh[i]));
  }
  std::sort(work.spoken_to.begin(), work.spoken_to.end());
  work.spoken_to.erase(std::unique(work.spoken_to.begin(), work.spoken_to.end()), work.spoken_to.end());
}

}  // namespace bl
