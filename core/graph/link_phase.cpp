// Phase 3: links turn the frozen state into voices.
#include <algorithm>
#include <cmath>

#include "core/graph/phases.h"

namespace bl {

namespace {

// Proposals of all pairs of one link on one target, taken together in the order of the pairs. A link speaks with one voice: the
// mean of the pairs that move anything, so that a node pulled by sixty partners is moved no farther than by one, and
// links to sets settle whatever the size of the set.
struct Collected {
  int count = 0, moving = 0;
  double number = 0;
  Vector3 vector;
  double magnitude = 0;
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
      if (*v != Vector3{}) ++moving;
      return;
    }
    const double x = as_number(value);
    magnitude += std::abs(x);
    if (x != 0) ++moving;
    if (rule == CombineRule::min) number = count == 1 ? x : std::min(number, x);
    else if (rule == CombineRule::max) number = count == 1 ? x : std::max(number, x);
    else number += x;
  }

  Voice voice(PortRef target, const PortDefinition& port, double strength) const {
    if (port.rule == CombineRule::collect) {
      std::vector<std::string> all = texts;
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      return {target, Shared(std::move(all)), 0, strength};
    }
    const int voices = port.rule == CombineRule::blend ? count : port.rule == CombineRule::sum ? std::max(1, moving) : 1;
    const double share = 1.0 / voices;
    if (port.kind == ValueKind::point) return {target, vector * share, magnitude * share, strength};
    return {target, number * share, magnitude * share, strength};
  }
};

class LinkRun {
 public:
  LinkRun(const State& frozen, const LinkPlan& plan) : frozen_(frozen), plan_(plan), definition_(*plan.definition) {
    for (const LinkRead& read : definition_.reads) reads_.values.emplace_back(read.is_whole ? count(read.end) : 1);
    for (const LinkWrite& write : definition_.proposes) writes_.values.emplace_back(write.is_whole ? count(write.end) : 1);
    collected_.resize(plan.targets.size());
  }

  // Every pair once; an end that is read whole takes part in one evaluation for all of its nodes.
  Result<void> run(const Tick& tick) {
    const std::size_t from_count = definition_.is_whole(End::from) ? 1 : count(End::from);
    const std::size_t to_count = definition_.is_whole(End::to) ? 1 : count(End::to);
    const bool is_pairwise = !definition_.is_whole(End::from) && !definition_.is_whole(End::to);
    for (std::size_t f = 0; f < from_count; ++f)
      for (std::size_t t = 0; t < to_count; ++t) {
        if (is_pairwise && plan_.nodes[0][f] == plan_.nodes[1][t] && (from_count > 1 || to_count > 1)) continue;
        if (is_pairwise && plan_.is_symmetric && f > t) continue;
        if (auto done = evaluate(f, t, tick); !done) return done;
      }
    return {};
  }

  std::vector<Voice> voices() const {
    std::vector<Voice> voices;
    for (std::size_t i = 0; i < collected_.size(); ++i)
      if (collected_[i].count > 0)
        voices.push_back(collected_[i].voice(plan_.targets[i], frozen_.plan->port(plan_.targets[i]), plan_.strength));
    return voices;
  }

 private:
  std::size_t count(End end) const { return plan_.nodes[static_cast<int>(end)].size(); }

  Result<void> evaluate(std::size_t f, std::size_t t, const Tick& tick) {
    for (std::size_t r = 0; r < definition_.reads.size(); ++r) {
      const LinkRead& read = definition_.reads[r];
      const std::size_t first = read.is_whole ? 0 : (read.end == End::from ? f : t);
      for (std::size_t i = 0; i < reads_.values[r].size(); ++i) reads_.values[r][i] = &frozen_.value(plan_.reads[r][first + i]);
    }
    for (auto& values : writes_.values) std::fill(values.begin(), values.end(), std::nullopt);
    if (auto done = definition_.evaluate(plan_.parameters.get(), reads_, writes_, tick); !done) return done;
    for (std::size_t w = 0; w < definition_.proposes.size(); ++w) {
      const LinkWrite& write = definition_.proposes[w];
      const std::size_t first = write.is_whole ? 0 : (write.end == End::from ? f : t);
      for (std::size_t i = 0; i < writes_.values[w].size(); ++i) {
        const auto& value = writes_.values[w][i];
        if (!value) continue;
        const std::uint32_t target = plan_.writes[w][first + i];
        if (!is_finite(*value))
          return Error{
              ErrorCode::not_finite, "",
              "proposed a value that is not a finite number for `" + frozen_.plan->nodes[plan_.targets[target].node].id + "`"};
        collected_[target].add(*value, frozen_.plan->port(plan_.targets[target]).rule);
      }
    }
    return {};
  }

  const State& frozen_;
  const LinkPlan& plan_;
  const LinkDefinition& definition_;
  LinkReads reads_;
  LinkWrites writes_;
  std::vector<Collected> collected_;
};

void evaluate_link(const State& frozen, std::size_t index, LinkState& next) {
  const LinkPlan& plan = frozen.plan->links[index];
  next = {};
  if (!plan.is_enabled) return;
  std::optional<Error> error = plan.error;
  if (!error) {
    LinkRun run(frozen, plan);
    Memo memo;
    if (auto done = run.run(Tick{.index = frozen.tick, .memo = &memo}); done) {
      next.voices = run.voices();
      return;
    } else {
      error = done.error().within("links/" + plan.id);
    }
  }
  next.error = std::move(error);
  // A wanted value of the last good tick stays in force; a push must not go on for ever.
  for (const Voice& voice : frozen.links[index].voices)
    if (frozen.plan->port(voice.target).rule != CombineRule::sum) next.voices.push_back(voice);
}

}  // namespace

void evaluate_links(const State& frozen, State& next, ThreadPool& pool) {
  pool.for_each_chunk(frozen.plan->links.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) evaluate_link(frozen, l, next.links[l]);
  });
}

}  // namespace bl
