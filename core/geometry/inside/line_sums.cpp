// The sums of the sampled diagram: lines cut into stretches of one owner, stretches cut by the owner's ball.
#include "core/geometry/inside/line_sums.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "core/geometry/inside/line_blocks.h"
#include "core/geometry/inside/line_envelope.h"

namespace bl::geometry {

namespace {

// Blocks of so many steps are walked line by line.
constexpr int kLeaf = 6;
// Places nearer than this share of the step are one place.
constexpr double kTiny = 1e-10;

void for_each_task(ThreadPool* pool, std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto body = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) work(k);
  };
  if (pool != nullptr) {
    pool->for_each_chunk(count, 1, body);
  } else {
    body(0, count);
  }
}

// Facets by (site, kind, index), equal ones added up in the order in which they were found.
void merge(std::vector<LineFacetSum>& facets) {
  const auto key = [](const LineFacetSum& f) { return std::tuple(f.site, f.kind, f.index); };
  std::stable_sort(facets.begin(), facets.end(), [&](const LineFacetSum& a, const LineFacetSum& b) { return key(a) < key(b); });
  std::size_t last = 0;
  for (std::size_t k = 1; k < facets.size(); ++k) {
    if (key(facets[k]) == key(facets[last])) {
      facets[last].area += facets[k].area;
      facets[last].response += facets[k].response;
    } else {
      facets[++last] = facets[k];
    }
  }
  if (!facets.empty()) facets.resize(last + 1);
}

// Looks at the lines of a leaf along one axis, with its candidates as these lines see them.
template <Metric M>
class LineView {
 public:
  LineView(const SampleFrame& frame, std::span<const FrameSite> sites, std::size_t along)
      : frame_(frame), sites_(sites), along_(along), across_u_((along + 1) % 3), across_v_((along + 2) % 3) {}

  std::size_t along() const { return along_; }
  std::size_t across_u() const { return across_u_; }
  std::size_t across_v() const { return across_v_; }

  void look(std::span<const std::uint32_t> candidates, int u, int v) {
    at_u_ = frame_.line_at(across_u_, u);
    at_v_ = frame_.line_at(across_v_, v);
    candidates_ = candidates;
    seen_.resize(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const FrameSite& site = sites_[candidates[c]];
      const double du = at_u_ - site.at[across_u_], dv = at_v_ - site.at[across_v_];
      seen_[c] = {site.at[along_], du * du + dv * dv, site.weight, site.radius};
    }
  }

  std::span<const SiteOnLine> seen() const { return seen_; }
  double at_u() const { return at_u_; }
  double at_v() const { return at_v_; }
  // From a candidate to the place t on the line: components along the line, then across it.
  Vector3 way(std::size_t candidate, double t) const {
    const FrameSite& site = sites_[candidates_[candidate]];
    return {t - seen_[candidate].along, at_u_ - site.at[across_u_], at_v_ - site.at[across_v_]};
  }

 private:
  const SampleFrame& frame_;
  std::span<const FrameSite> sites_;
  std::size_t along_, across_u_, across_v_;
  double at_u_ = 0, at_v_ = 0;
  std::span<const std::uint32_t> candidates_;
  std::vector<SiteOnLine> seen_;
};

// Half of the ball's chord on the line, 0 where it has none.
double half_chord(const SiteOnLine& site) { return site.weight > site.aside ? std::sqrt(site.weight - site.aside) : 0; }

// The sums of one task. Sites are counted by their place in the task's list of candidates.
template <Metric M>
class TaskSums {
 public:
  TaskSums(const SampleFrame& frame, const std::array<SampleLines, 3>& lines, std::span<const FrameSite> sites,
           std::span<const std::uint32_t> candidates)
      : frame_(frame), lines_(lines), sites_(sites), known_(candidates), sums_(candidates.size()) {}

  void add(const LineBlock& block, std::span<const std::uint32_t> candidates) {
    places_.clear();
    for (const std::uint32_t site : candidates) {
      places_.push_back(static_cast<std::size_t>(std::lower_bound(known_.begin(), known_.end(), site) - known_.begin()));
    }
    for (std::size_t along = 0; along < 3; ++along) {
      LineView<M> view(frame_, sites_, along);
      const double low = frame_.low[along] + block.low[along] * frame_.step;
      const double high = frame_.low[along] + block.high[along] * frame_.step;
      for (int v = block.low[view.across_v()]; v < block.high[view.across_v()]; ++v) {
        for (int u = block.low[view.across_u()]; u < block.high[view.across_u()]; ++u) {
          bool is_seen = false;
          for (const SampleLines::Stretch& stretch : lines_[along].on(u, v)) {
            if (stretch.to <= low || stretch.from >= high) continue;
            if (!is_seen) view.look(candidates, u, v);
            is_seen = true;
            walk(view, candidates, stretch, low, high);
          }
        }
      }
    }
  }

  std::vector<LineSums>& sums() { return sums_; }
  std::vector<LineFacetSum>& facets() { return facets_; }

 private:
  void walk(const LineView<M>& view, std::span<const std::uint32_t> candidates, const SampleLines::Stretch& stretch, double low,
            double high) {
    const double from = std::max(stretch.from, low), to = std::min(stretch.to, high);
    walk_line<M>(view.seen(), from, to, kTiny * frame_.step, [&](std::size_t c, double begin, double end, std::size_t next) {
      own(view, c, begin, end);
      if (begin == from && from == stretch.from) side(view, candidates, c, from, stretch.from_face);
      if (end == to && to == stretch.to) side(view, candidates, c, to, stretch.to_face);
      if (next < candidates.size()) facet(view, candidates, c, next, end);
    });
  }

  void own(const LineView<M>& view, std::size_t c, double begin, double end) {
    LineSums& sums = sums_[places_[c]];
    sums.cell[view.along()] += end - begin;
    const SiteOnLine& site = view.seen()[c];
    const double half = half_chord(site);
    const double first = std::max(begin, site.along - half), last = std::min(end, site.along + half);
    if (!(first < last)) return;
    const double length = last - first;
    sums.shape[view.along()] += length;
    std::array<double, 3> moment{};
    moment[view.along()] = 0.5 * (first + last) * length;
    moment[view.across_u()] = view.at_u() * length;
    moment[view.across_v()] = view.at_v() * length;
    sums.moment += {moment[0], moment[1], moment[2]};
    if (first > begin) sums.sphere += half / site.radius;
    if (last < end) sums.sphere += half / site.radius;
  }

  void side(const LineView<M>& view, std::span<const std::uint32_t> candidates, std::size_t c, double t, std::uint32_t number) {
    const SampleLines::Face& face = lines_[view.along()].face(number);
    if (face.side == Domain::kInner || std::abs(t - view.seen()[c].along) > half_chord(view.seen()[c])) return;
    facets_.push_back({candidates[c], FaceKind::plane, face.side, face.share, 0});
  }

  void facet(const LineView<M>& view, std::span<const std::uint32_t> candidates, std::size_t c, std::size_t next, double t) {
    if (!(std::abs(t - view.seen()[c].along) < half_chord(view.seen()[c]))) return;
    const Vector3 difference = cost_gradient<M>(view.way(c, t)) - cost_gradient<M>(view.way(next, t));
    const double size = norm(difference);
    if (!(size > 0) || !std::isfinite(size)) return;
    const double share = std::abs(difference.x) / size;
    const auto [a, b] = std::minmax(candidates[c], candidates[next]);
    facets_.push_back({a, FaceKind::site, b, share, share / size});
  }

  const SampleFrame& frame_;
  const std::array<SampleLines, 3>& lines_;
  std::span<const FrameSite> sites_;
  std::span<const std::uint32_t> known_;
  std::vector<LineSums> sums_;
  std::vector<LineFacetSum> facets_;
  std::vector<std::size_t> places_;
};

template <Metric M>
DiagramSums sum_all(const SampleFrame& frame, const std::array<SampleLines, 3>& lines, std::span<const FrameSite> sites,
                    std::span<const std::uint32_t> participants, ThreadPool* pool) {
  const std::array<bool, 3> split{true, true, true};
  const std::vector<LineTask> tasks = tasks_of<M>(frame, sites, participants, split);
  std::vector<std::vector<LineSums>> sums(tasks.size());
  std::vector<std::vector<LineFacetSum>> facets(tasks.size());
  for_each_task(pool, tasks.size(), [&](std::size_t k) {
    TaskSums<M> task(frame, lines, sites, tasks[k].candidates);
    BlockDescent<M>(frame, sites, split, kLeaf)
        .go_down(tasks[k].block, tasks[k].candidates,
                 [&](const LineBlock& block, std::span<const std::uint32_t> candidates) { task.add(block, candidates); });
    merge(task.facets());
    sums[k] = std::move(task.sums());
    facets[k] = std::move(task.facets());
  });
  DiagramSums all;
  all.sites.resize(sites.size());
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    for (std::size_t c = 0; c < sums[k].size(); ++c) {
      LineSums& into = all.sites[tasks[k].candidates[c]];
      for (std::size_t d = 0; d < 3; ++d) {
        into.cell[d] += sums[k][c].cell[d];
        into.shape[d] += sums[k][c].shape[d];
      }
      into.moment += sums[k][c].moment;
      into.sphere += sums[k][c].sphere;
    }
    all.facets.insert(all.facets.end(), facets[k].begin(), facets[k].end());
  }
  merge(all.facets);
  return all;
}

// Counts the sections that lie in [from, to), heights above the lowest point of the shape: those of whole storeys, at
// (k + 1/2), and that of what is left above them, at its middle. A shape lower than a storey has one, at its mid-height.
void count_sections(double from, double to, double height, double storey, UprightSums& sums) {
  const double whole = std::floor(height / storey), middle = 0.5 * (std::max(0.0, whole * storey) + height);
  (whole < 1 ? sums.sections : sums.rest) += from <= middle && middle < to ? 1 : 0;
  const double first = std::max(0.0, std::ceil(from / storey - 0.5)), beyond = std::min(whole, std::ceil(to / storey - 0.5));
  if (beyond > first) sums.sections += static_cast<std::uint64_t>(beyond - first);
}

// Goes along all upright lines of a task and calls found(place of the site among the candidates, line, from, to) for the
// stretches of shapes; blocks may cut a stretch in two.
template <Metric M, class Found>
void walk_upright(const SampleFrame& frame, const SampleLines& lines, std::span<const FrameSite> sites, const LineTask& task,
                  Found&& found) {
  LineView<M> view(frame, sites, 2);
  std::vector<std::size_t> places;
  const auto walk = [&](std::size_t line, double begin, double end) {
    walk_line<M>(view.seen(), begin, end, kTiny * frame.step, [&](std::size_t c, double from, double to, std::size_t) {
      const SiteOnLine& site = view.seen()[c];
      const double half = half_chord(site);
      const double first = std::max(from, site.along - half), last = std::min(to, site.along + half);
      if (first < last) found(places[c], line, first, last);
    });
  };
  const auto leaf = [&](const LineBlock& block, std::span<const std::uint32_t> candidates) {
    places.clear();
    for (const std::uint32_t site : candidates) places.push_back(task.place_of(site));
    const double low = frame.low[2] + block.low[2] * frame.step, high = frame.low[2] + block.high[2] * frame.step;
    for (int v = block.low[1]; v < block.high[1]; ++v) {
      for (int u = block.low[0]; u < block.high[0]; ++u) {
        bool is_seen = false;
        for (const SampleLines::Stretch& stretch : lines.on(u, v)) {
          if (stretch.to <= low || stretch.from >= high) continue;
          if (!is_seen) view.look(candidates, u, v);
          is_seen = true;
          walk(task.line_number(u, v), std::max(stretch.from, low), std::min(stretch.to, high));
        }
      }
    }
  };
  BlockDescent<M>(frame, sites, {true, true, true}, kLeaf).go_down(task.block, task.candidates, leaf);
}

template <Metric M>
std::vector<UprightSums> sum_upright_lines(const SampleFrame& frame, const SampleLines& lines, std::span<const FrameSite> sites,
                                           std::span<const std::uint32_t> participants, std::span<const double> storeys,
                                           ThreadPool* pool) {
  const std::vector<LineTask> tasks = tasks_of<M>(frame, sites, participants, {true, true, false});
  const UprightSums nothing{1e300, -1e300, 0, 0, 0};
  std::vector<UprightSums> all(sites.size(), nothing);
  std::vector<std::vector<UprightSums>> parts(tasks.size());
  // Twice: sections are counted from the lowest point, which is known after the first time.
  for_each_task(pool, tasks.size(), [&](std::size_t k) {
    parts[k].assign(tasks[k].candidates.size(), nothing);
    std::vector<std::vector<bool>> is_met(tasks[k].candidates.size());
    walk_upright<M>(frame, lines, sites, tasks[k], [&](std::size_t c, std::size_t line, double from, double to) {
      UprightSums& sums = parts[k][c];
      sums.lowest = std::min(sums.lowest, from);
      sums.highest = std::max(sums.highest, to);
      if (is_met[c].empty()) is_met[c].resize(tasks[k].line_count());
      sums.footprint += is_met[c][line] ? 0 : 1;
      is_met[c][line] = true;
    });
  });
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    for (std::size_t c = 0; c < parts[k].size(); ++c) {
      UprightSums& sums = all[tasks[k].candidates[c]];
      sums.lowest = std::min(sums.lowest, parts[k][c].lowest);
      sums.highest = std::max(sums.highest, parts[k][c].highest);
      sums.footprint += parts[k][c].footprint;
    }
  }
  for_each_task(pool, tasks.size(), [&](std::size_t k) {
    walk_upright<M>(frame, lines, sites, tasks[k], [&](std::size_t c, std::size_t, double from, double to) {
      const std::uint32_t site = tasks[k].candidates[c];
      const double low = all[site].lowest;
      count_sections(from - low, to - low, all[site].highest - low, storeys[site], parts[k][c]);
    });
  });
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    for (std::size_t c = 0; c < parts[k].size(); ++c) {
      all[tasks[k].candidates[c]].sections += parts[k][c].sections;
      all[tasks[k].candidates[c]].rest += parts[k][c].rest;
    }
  }
  return all;
}

}  // namespace

DiagramSums sum_lines(Metric metric, const SampleFrame& frame, const std::array<SampleLines, 3>& lines,
                      std::span<const FrameSite> sites, std::span<const std::uint32_t> participants, ThreadPool* pool) {
  switch (metric) {
    case Metric::power: return sum_all<Metric::power>(frame, lines, sites, participants, pool);
    case Metric::additive: return sum_all<Metric::additive>(frame, lines, sites, participants, pool);
    case Metric::multiplicative: break;
  }
  return sum_all<Metric::multiplicative>(frame, lines, sites, participants, pool);
}

std::vector<UprightSums> sum_upright(Metric metric, const SampleFrame& frame, const SampleLines& lines,
                                     std::span<const FrameSite> sites, std::span<const std::uint32_t> participants,
                                     std::span<const double> storeys, ThreadPool* pool) {
  switch (metric) {
    case Metric::power: return sum_upright_lines<Metric::power>(frame, lines, sites, participants, storeys, pool);
    case Metric::additive: return sum_upright_lines<Metric::additive>(frame, lines, sites, participants, storeys, pool);
    case Metric::multiplicative: break;
  }
  return sum_upright_lines<Metric::multiplicative>(frame, lines, sites, participants, storeys, pool);
}

}  // namespace bl::geometry
