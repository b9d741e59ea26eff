// Turns the lists of a plan around: from who reads what to who is read by whom.
#include "core/graph/dependents.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/graph/phases.h"

namespace bl {

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// What is to be entered of links.
struct LinkEntries {
  std::vector<LinkLists::Entry> reading, at;
  std::vector<std::uint32_t> timed, broken;

  void add(const LinkPlan& link, std::uint32_t l) {
    for (const PortRef& ref : link.targets)
      if (at.empty() || at.back() != LinkLists::Entry{{ref.node, 0, 0}, l}) at.push_back({{ref.node, 0, 0}, l});
    if (!link.is_enabled) return;
    if (link.error) {
      broken.push_back(l);
      return;
    }
    const auto first = static_cast<std::ptrdiff_t>(reading.size());
    add_reads(link, End::from, l);
    const auto middle = static_cast<std::ptrdiff_t>(reading.size());
    add_reads(link, End::to, l);
    std::inplace_merge(reading.begin() + first, reading.begin() + middle, reading.end());
    if (link.definition->reads_time) timed.push_back(l);
  }

 private:
  // In ascending order, as the nodes of an end are.
  void add_reads(const LinkPlan& link, End end, std::uint32_t l) {
    for (std::size_t i = 0; i < link.nodes[static_cast<std::size_t>(end)].size(); ++i) {
      const auto first = static_cast<std::ptrdiff_t>(reading.size());
      for (std::size_t r = 0; r < link.reads.size(); ++r)
        if (link.definition->reads[r].end == end && link.reads[r][i].type != PortRef::kNodeId)
          reading.push_back({link.reads[r][i], l});
      if (reading.size() - static_cast<std::size_t>(first) > 1) std::sort(reading.begin() + first, reading.end());
    }
  }
};

std::uint32_t key_of(const PortRef& port) { return std::uint32_t{port.type} << 16 | port.port; }

bool has_same_entries(const LinkPlan& a, const LinkPlan& b) {
  return a.is_enabled == b.is_enabled && a.definition == b.definition && a.error.has_value() == b.error.has_value() &&
         a.reads == b.reads && a.targets == b.targets;
}

// Without `less`, renumbered, with `more`; all ascend.
std::vector<std::uint32_t> edited_list(const std::vector<std::uint32_t>& links, const std::vector<std::uint32_t>& less,
                                       std::span<const std::uint32_t> places, const std::vector<std::uint32_t>& more) {
  std::vector<std::uint32_t> kept, all;
  std::set_difference(links.begin(), links.end(), less.begin(), less.end(), std::back_inserter(kept));
  if (!places.empty())
    for (std::uint32_t& link : kept) link = places[link];
  std::merge(kept.begin(), kept.end(), more.begin(), more.end(), std::back_inserter(all));
  return all;
}

std::shared_ptr<const LinkDependents> edited(const LinkDependents& before, std::size_t nodes, LinkEntries&& less,
                                             std::span<const std::uint32_t> places, LinkEntries&& more) {
  return std::make_shared<const LinkDependents>(
      LinkDependents{.reading = before.reading.edited(nodes, std::move(less.reading), places, std::move(more.reading)),
                     .at = before.at.edited(nodes, std::move(less.at), places, std::move(more.at)),
                     .timed = edited_list(before.timed, less.timed, places, more.timed),
                     .broken = edited_list(before.broken, less.broken, places, more.broken)});
}

// Groups that write to one port come together, step by step, under the first of them all.
void find_rivals(SetDependents& index) {
  std::vector<std::size_t> first(index.groups.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto first_of = [&](std::size_t group) {
    while (first[group] != group) group = first[group];
    return group;
  };
  for (std::size_t port = 0; port < index.groups_writing.keys(); ++port) {
    const auto writers = index.groups_writing[port];
    for (std::size_t k = 1; k < writers.size(); ++k) {
      const std::size_t a = first_of(writers[0]), b = first_of(writers[k]);
      first[std::max(a, b)] = std::min(a, b);
      index.groups[writers[0]].rivals = index.groups[writers[k]].rivals = 0;
    }
  }
  std::vector<bool> has_analysis(index.groups.size());
  for (std::size_t g = 0; g < index.groups.size(); ++g) {
    if (index.groups[g].rivals == SetGroup::kNone) continue;
    index.groups[g].rivals = first_of(g);
    if (index.groups[g].analysis != SetGroup::kNone) has_analysis[first_of(g)] = true;
  }
  // What an analysis writes when it is done, the others write over in the tick after.
  for (SetGroup& group : index.groups)
    if (group.rivals != SetGroup::kNone && has_analysis[group.rivals]) group.is_always_due = true;
}

// Ports are written to twice by different groups, or by two sets of one.
void find_contests(SetDependents& index, const Pairs& writing, std::size_t ports) {
  constexpr std::uint32_t kNobody = ~std::uint32_t{0};
  std::vector<std::uint32_t> first(ports, kNobody);
  for (const auto& [port, group] : writing) {
    const std::uint32_t other = std::exchange(first[port], group);
    if (other != kNobody) index.groups[other].writes_alone = index.groups[group].writes_alone = false;
  }
}

void add_groups(const Plan& plan, SetDependents& index, std::size_t ports) {
  Pairs reading, writing;
  std::size_t analysis = 0;
  for (std::size_t begin = 0, end = 0; begin < plan.sets.size(); begin = end) {
    const SetPlan& head = plan.sets[begin];
    const auto group = static_cast<std::uint32_t>(index.groups.size());
    while (end < plan.sets.size() && plan.sets[end].node == head.node && plan.sets[end].type == head.type) ++end;
    SetGroup& one = index.groups.emplace_back(SetGroup{head.node, head.type, begin, end - begin});
    if (analysis < plan.analyses.size() && plan.analyses[analysis].first_set == begin) one.analysis = analysis++;
    const TypificationDefinition& definition = *plan.nodes[head.node].types[head.type].definition;
    one.is_always_due = definition.reads_time;
    for (std::uint16_t p = 0; p < definition.ports.size(); ++p) {
      const PortRef own{head.node, static_cast<std::uint16_t>(head.type), p};
      const PortDefinition& port = definition.ports[p];
      if (port.is_computed) writing.emplace_back(index.port_index(own), group);
      if (!port.is_computed || port.recall) reading.emplace_back(index.port_index(own), group);
    }
    for (std::size_t s = begin; s < end; ++s) {
      for (const PortRef& ref : plan.sets[s].reads)
        if (ref.type != PortRef::kNodeId) reading.emplace_back(index.port_index(ref), group);
      for (const PortRef& ref : plan.sets[s].writes) writing.emplace_back(index.port_index(ref), group);
    }
  }
  find_contests(index, writing, ports);
  index.groups_reading = NumberLists::made(ports, std::move(reading));
  index.groups_writing = NumberLists::made(ports, std::move(writing));
  find_rivals(index);
}

}  // namespace

NumberLists NumberLists::made(std::size_t keys, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  NumberLists lists;
  lists.starts_.assign(keys + 1, 0);
  std::vector<std::uint32_t> last(keys, ~std::uint32_t{0});
  const auto is_repeated = [&](std::uint32_t key, std::uint32_t number) { return std::exchange(last[key], number) == number; };
  for (const auto& [key, number] : pairs)
    if (!is_repeated(key, number)) ++lists.starts_[key + 1];
  for (std::size_t key = 0; key < keys; ++key) lists.starts_[key + 1] += lists.starts_[key];
  lists.numbers_.resize(lists.starts_.back());
  std::vector<std::uint32_t> next(lists.starts_.begin(), lists.starts_.end() - 1);
  last.assign(keys, ~std::uint32_t{0});
  for (const auto& [key, number] : pairs)
    if (!is_repeated(key, number)) lists.numbers_[next[key]++] = number;
  return lists;
}

std::span<const std::uint32_t> LinkLists::operator[](const PortRef& port) const {
  if (port.node + 1 >= starts_.size()) return {};
  const auto begin = ports_.begin() + starts_[port.node], end = ports_.begin() + starts_[port.node + 1];
  const auto [first, last] = std::equal_range(begin, end, key_of(port));
  return std::span(links_).subspan(static_cast<std::size_t>(first - ports_.begin()), static_cast<std::size_t>(last - first));
}

void LinkLists::append(const LinkLists& from, std::uint32_t first, std::uint32_t last, std::span<const std::uint32_t> places) {
  if (first >= last) return;
  const std::uint32_t begin = from.start(first), end = from.start(last);
  const auto before = static_cast<std::uint32_t>(links_.size());
  ports_.insert(ports_.end(), from.ports_.begin() + begin, from.ports_.begin() + end);
  links_.insert(links_.end(), from.links_.begin() + begin, from.links_.begin() + end);
  if (!places.empty())
    for (std::size_t i = before; i < links_.size(); ++i) links_[i] = places[links_[i]];
  for (std::uint32_t n = first; n < last; ++n) starts_.push_back(before + from.start(n + 1) - begin);
}

LinkLists LinkLists::edited(std::size_t nodes, std::vector<Entry> less, std::span<const std::uint32_t> places,
                            std::vector<Entry> more) const {
  for (std::vector<Entry>* entries : {&less, &more}) {
    if (!std::is_sorted(entries->begin(), entries->end())) std::sort(entries->begin(), entries->end());
    entries->erase(std::unique(entries->begin(), entries->end()), entries->end());
  }
  LinkLists lists;
  lists.starts_.reserve(nodes + 1);
  lists.ports_.reserve(ports_.size() + more.size());
  lists.links_.reserve(ports_.size() + more.size());
  std::uint32_t done = 0;
  auto gone = less.begin(), fresh = more.begin();
  const auto put = [&](std::uint32_t port, std::uint32_t link) {
    lists.ports_.push_back(port);
    lists.links_.push_back(link);
  };
  while (gone != less.end() || fresh != more.end()) {
    // Nodes up to the next one at which a list differs stay as they are.
    auto n = static_cast<std::uint32_t>(nodes);
    if (gone != less.end()) n = gone->port.node;
    if (fresh != more.end()) n = std::min(n, fresh->port.node);
    lists.append(*this, done, n, places);
    for (std::uint32_t i = start(n), end = start(n + 1); i < end; ++i) {
      const std::uint32_t port = ports_[i];
      if (gone != less.end() && gone->link == links_[i] && gone->port.node == n && key_of(gone->port) == port) {
        ++gone;
        continue;
      }
      const std::uint32_t link = places.empty() ? links_[i] : places[links_[i]];
      for (; fresh != more.end() && fresh->port.node == n; ++fresh) {
        const std::uint32_t key = key_of(fresh->port);
        if (key > port || (key == port && fresh->link > link)) break;
        put(key, fresh->link);
      }
      put(port, link);
    }
    for (; fresh != more.end() && fresh->port.node == n; ++fresh) put(key_of(fresh->port), fresh->link);
    lists.starts_.push_back(static_cast<std::uint32_t>(lists.ports_.size()));
    done = n + 1;
  }
  lists.append(*this, done, static_cast<std::uint32_t>(nodes), places);
  return lists;
}

namespace {

std::shared_ptr<const SetDependents> set_dependents_of(const Plan& plan) {
  SetDependents index;
  std::uint32_t ports = 0;
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    index.first_type.push_back(static_cast<std::uint32_t>(index.first_port.size()));
    bool is_timed = false;
    for (const TypificationDefinition* type : plan.forms->types_of(n)) {
      index.first_port.push_back(ports);
      ports += static_cast<std::uint32_t>(type->ports.size());
      is_timed |= type->evaluate && type->sets.empty() && type->reads_time;
    }
    if (is_timed) index.timed_nodes.push_back(n);
  }
  add_groups(plan, index, ports);
  return std::make_shared<const SetDependents>(std::move(index));
}

}  // namespace

std::shared_ptr<const Dependents> dependents_of(const Plan& plan) {
  LinkEntries entries;
  for (std::uint32_t l = 0; l < plan.links.size(); ++l) entries.add(plan.links[l], l);
  return std::make_shared<const Dependents>(
      Dependents{set_dependents_of(plan), edited({}, plan.nodes.size(), {}, {}, std::move(entries))});
}

std::shared_ptr<const Dependents> amended_dependents(const Plan& before, const Plan& plan, std::span<const ItemEdit> edits,
                                                     bool has_other_sets) {
  if (edits.empty() && !has_other_sets) return before.dependents;
  bool differs = false, is_renumbered = false;
  for (const ItemEdit& edit : edits) {
    const bool stays = !edit.is_added() && !edit.is_removed();
    differs |= !stays || !has_same_entries(before.links[edit.before], plan.links[edit.now]);
    is_renumbered |= !stays;
  }
  std::shared_ptr<const LinkDependents> links = before.dependents->links;
  if (differs) {
    LinkEntries less, more;
    for (const ItemEdit& edit : edits) {
      if (!edit.is_added()) less.add(before.links[edit.before], edit.before);
      if (!edit.is_removed()) more.add(plan.links[edit.now], edit.now);
    }
    const auto places = is_renumbered ? places_after(before.links.size(), edits) : std::vector<std::uint32_t>();
    links = edited(*links, plan.nodes.size(), std::move(less), places, std::move(more));
  }
  return std::make_shared<const Dependents>(
      Dependents{has_other_sets ? set_dependents_of(plan) : before.dependents->sets, std::move(links)});
}

}  // namespace bl
