// Phase 3: links read the frozen state and make proposals.
#include <algorithm>
#include <iterator>
#include <numeric>

#include "core/define/last_proposals.h"
#include "core/graph/link_run.h"
#include "core/graph/phases.h"

namespace bl {

namespace {

// What was kept of a link, where it is of use; else nullptr.
struct Kept {
  LinkReach* reach = nullptr;  // whose silent pairs need not be looked at
  LinkReads* whole = nullptr;
};

Kept kept_of(const State& frozen, std::size_t index, LinkMemos* memos) {
  const LinkPlan& plan = frozen.plan->links[index];
  if (memos == nullptr || !plan.is_enabled || plan.error) return {};
  LinkMemo& memo = memos->links[index];
  return {memo.reach.follow(frozen, plan) ? &memo.reach : nullptr,
          memo.whole.follow(frozen, plan) ? &memo.whole.reads() : nullptr};
}

// What the link has said to the node at a place of an end that it writes whole.
std::optional<double> said_last(const State& frozen, std::size_t index, std::string_view path, std::size_t place) {
  const LinkPlan& plan = frozen.plan->links[index];
  const auto wanted = parse_port_path(path);
  for (std::size_t w = 0; w < plan.writes.size(); ++w) {
    const LinkWrite& write = plan.definition->proposes[w];
    if (!write.is_whole || !wanted || write.path.typification != wanted->typification || write.path.port != wanted->port)
      continue;
    if (place >= plan.writes[w].size() || plan.writes[w][place] == LinkPlan::kNoTarget) return std::nullopt;
    const std::vector<Voice>& voices = frozen.links[index].voices;
    const PortRef target = plan.targets[plan.writes[w][place]];
    const auto voice = std::lower_bound(voices.begin(), voices.end(), target,
                                        [](const Voice& said, const PortRef& ref) { return said.target < ref; });
    return voice != voices.end() && voice->target == target ? std::optional(as_number(voice->value)) : std::nullopt;
  }
  return std::nullopt;
}

// Also whether it has asked for what it said itself, and therefore has to be asked again once it says something else.
LinkState evaluated(const State& frozen, std::size_t index, const Kept& kept, std::size_t& pairs, bool& knows_itself) {
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
  LinkRun run(frozen, plan, kept.whole);
  Memo memo;
  const bool is_whole = plan.definition->is_whole(End::to);
  if (is_whole)
    memo.of<LastProposals>().said = [&frozen, index](std::string_view path, std::size_t place) {
      return said_last(frozen, index, path, place);
    };
  const Tick tick{.index = tick_for(*plan.definition, frozen.tick), .memo = &memo};
  if (kept.reach != nullptr) kept.reach->visit_all(plan, [&](std::uint32_t f, std::uint32_t t) { run.run_pair(f, t, tick); });
  else run.run(tick);
  pairs += run.pairs();
  knows_itself = is_whole && memo.of<LastProposals>().was_asked;
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

// What has to be asked of a link some of whose nodes have changed: no pair besides these says anything new, and all of them that
// say anything to the targets are among them.
struct DuePairs {
  std::vector<LinkReach::Pair> pairs;  // in the order in which all pairs would come
  std::vector<std::uint32_t> targets;  // indices, ascending
};

// Those of a link between one node and many; nothing where all have to be asked.
std::optional<DuePairs> single_pairs(const LinkPlan& plan, End many, const std::vector<std::uint32_t>& changed) {
  const std::uint32_t alone = plan.nodes[many == End::to ? 0 : 1].front();
  const std::vector<std::uint32_t>& nodes = plan.nodes[static_cast<int>(many)];
  DuePairs due;
  for (const std::uint32_t node : changed) {
    if (node == alone) return std::nullopt;
    const auto place = static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    due.pairs.push_back(many == End::to ? LinkReach::Pair{0, place} : LinkReach::Pair{place, 0});
    for (const auto& writes : plan.writes)
      if (writes[place] != LinkPlan::kNoTarget) due.targets.push_back(writes[place]);
  }
  if (2 * due.pairs.size() > nodes.size()) return std::nullopt;
  return due;
}

// Those of a link between sets that knows who may matter to whom; nothing where all have to be asked.
std::optional<DuePairs> near_pairs(const State& frozen, const LinkPlan& plan, LinkReach& reach,
                                   const std::vector<std::uint32_t>& changed) {
  const auto concerned = reach.concerned(frozen, plan, changed);
  if (!concerned) return std::nullopt;
  DuePairs due{reach.pairs_of(plan, *concerned), {}};
  for (const std::uint32_t node : *concerned)
    for (std::size_t w = 0; w < plan.writes.size(); ++w) {
      const auto& nodes = plan.nodes[static_cast<std::size_t>(plan.definition->proposes[w].end)];
      if (const auto at = place_in(nodes, node); at && plan.writes[w][*at] != LinkPlan::kNoTarget)
        due.targets.push_back(plan.writes[w][*at]);
    }
  return due;
}

// The voices of some targets, given by their indices, anew among those that stay.
std::vector<Voice> renewed(const LinkPlan& plan, const std::vector<Voice>& last, const std::vector<std::uint32_t>& targets,
                           std::vector<Voice>&& fresh) {
  std::vector<Voice> voices;
  voices.reserve(last.size() + fresh.size());
  auto target = targets.begin();
  auto next = fresh.begin();
  for (const Voice& voice : last) {
    while (target != targets.end() && plan.targets[*target] < voice.target) ++target;
    while (next != fresh.end() && next->target < voice.target) voices.push_back(std::move(*next++));
    if (target == targets.end() || plan.targets[*target] != voice.target) voices.push_back(voice);
  }
  voices.insert(voices.end(), std::make_move_iterator(next), std::make_move_iterator(fresh.end()));
  return voices;
}

// What the link says after changes of these nodes, or nothing where all of its pairs have to be asked.
std::optional<LinkState> evaluated_in_part(const State& frozen, const DueLink& due, LinkReach* reach, std::size_t& asked) {
  const LinkPlan& plan = frozen.plan->links[due.link];
  const LinkState& last = frozen.links[due.link];
  if (due.is_whole || plan.error || last.error || last.remark || last.work) return std::nullopt;
  const auto many = end_of_single_pairs(plan);
  if (!many && reach == nullptr) return std::nullopt;
  auto some = many ? single_pairs(plan, *many, due.nodes) : near_pairs(frozen, plan, *reach, due.nodes);
  if (!some) return std::nullopt;
  std::vector<std::uint32_t>& targets = some->targets;
  std::sort(targets.begin(), targets.end());
  targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
  LinkRun run(frozen, plan, targets);
  Memo memo;
  const Tick tick{.index = tick_for(*plan.definition, frozen.tick), .memo = &memo};
  for (const auto& [f, t] : some->pairs) run.run_pair(f, t, tick);
  asked += run.pairs();
  std::vector<Voice> fresh = run.voices(last.voices);
  if (run.error() || run.remarks().said) return std::nullopt;
  LinkState next;
  next.voices = renewed(plan, last.voices, targets, std::move(fresh));
  return next;
}

// Those that read what has changed, that read the time, or that have to be asked again.
std::vector<DueLink> due_links(const State& frozen) {
  const LinkDependents& dependents = *frozen.plan->dependents->links;
  std::vector<bool> is_whole(frozen.links.size(), frozen.due.is_everything);
  for (const auto* more : {&frozen.due.links, &dependents.timed})
    for (const std::uint32_t link : *more) is_whole[link] = true;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changes;  // link and node
  for (const PortRef& ref : frozen.due.changed)
    for (const std::uint32_t link : dependents.reading[ref])
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

void evaluate_links(TickWork& work, ThreadPool& pool, LinkMemos* memos) {
  if (memos != nullptr) memos->follow(*work.frozen.plan);
  const std::vector<DueLink> due = due_links(work.frozen);
  std::vector<LinkState> fresh(due.size());
  std::vector<std::size_t> pairs(due.size(), 0);
  std::vector<std::uint8_t> knows_itself(due.size(), 0);
  pool.for_each_chunk(due.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double began = moment_of(work.times);
      const Kept kept = kept_of(work.frozen, due[i].link, memos);
      auto in_part = evaluated_in_part(work.frozen, due[i], kept.reach, pairs[i]);
      bool asks = false;
      fresh[i] = in_part ? std::move(*in_part) : evaluated(work.frozen, due[i].link, kept, pairs[i], asks);
      knows_itself[i] = asks;
      if (work.times != nullptr) work.times->add_link(due[i].link, began, pairs[i]);
    }
  });
  work.counts.links += due.size();
  work.counts.pairs += std::accumulate(pairs.begin(), pairs.end(), std::size_t{0});
  for (std::size_t i = 0; i < due.size(); ++i) {
    const LinkState& before = work.frozen.links[due[i].link];
    if (before.says_the_same(fresh[i])) continue;
    add_differences(before.voices, fresh[i].voices, work.spoken_to);
    if (knows_itself[i] != 0) work.next.state.due.links.push_back(due[i].link);
    work.next.links.put(due[i].link, std::move(fresh[i]));
  }
  std::sort(work.spoken_to.begin(), work.spoken_to.end());
  work.spoken_to.erase(std::unique(work.spoken_to.begin(), work.spoken_to.end()), work.spoken_to.end());
}

}  // namespace bl
