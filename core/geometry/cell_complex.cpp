// Following the diagram: which cells are read, which of them differ, and what has become of which element.
#include "core/geometry/cell_complex.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

#include "core/geometry/inside/complex_body.h"
#include "core/geometry/inside/complex_update.h"

namespace bl::geometry {

namespace {

// Corners nearer than this share of the domain's size may be one place, cells thinner than it are none. A million roundings:
// lattices stay lattices after they have been moved about, and no person sees an edge of this length.
constexpr double kMergeShare = 1e-9;
// Positions far from the world's origin are rounded more coarsely.
constexpr double kComplexRounding = 1e-15;

double tolerance_of(const Domain& domain) {
  const auto largest = [](const Vector3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  return kMergeShare * domain.size() + kComplexRounding * std::max(largest(domain.minimum), largest(domain.maximum));
}

ElementKey cell_key(const ElementLabel& label) { return {ElementKind::cell, ElementName{label}}; }

}  // namespace

std::string_view name_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::cell: return "cell";
    case ElementKind::facet: return "facet";
    case ElementKind::edge: return "edge";
    case ElementKind::vertex: return "vertex";
  }
  return "unknown";
}

CellComplex::CellComplex() : body_(std::make_unique<Body>()) {}
CellComplex::~CellComplex() = default;
CellComplex::CellComplex(CellComplex&&) noexcept = default;
CellComplex& CellComplex::operator=(CellComplex&&) noexcept = default;

const ComplexChange& CellComplex::change() const { return body_->change; }
const ComplexWork& CellComplex::work() const { return body_->work; }

Result<void> CellComplex::set_labels(std::span<const std::uint32_t> labels) {
  if (std::equal(labels.begin(), labels.end(), body_->labels.begin(), body_->labels.end())) return {};
  std::vector<std::uint32_t> sorted(labels.begin(), labels.end());
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    return Error{ErrorCode::duplicate, "", "two sites have the label " + std::to_string(*twice)};
  }
  body_->labels.assign(labels.begin(), labels.end());
  body_->is_whole = false;
  return {};
}

Result<void> CellComplex::Body::check(const PowerDiagram& diagram, std::span<const PowerSite> sites,
                                      std::span<const std::uint32_t> which) const {
  if (diagram.cells().size() != sites.size()) {
    return Error{ErrorCode::conflict, "", "the complex got other sites than the diagram was made from"};
  }
  if (!labels.empty() && labels.size() != sites.size()) {
    return Error{ErrorCode::conflict, "", "there has to be one label for each site"};
  }
  for (const std::uint32_t site : which) {
    const CellMeasure& cell = diagram.cells()[site];
    if (cell.outlines == nullptr && cell.state != SiteState::coincident) {
      return Error{ErrorCode::missing, "", "the diagram was made without outlines, which the complex is read from"};
    }
  }
  return {};
}

// Finds or makes the cell of each site; returns the cells whose labels are no more.
std::vector<std::uint32_t> CellComplex::Body::assign_labels(std::size_t count) {
  std::vector<std::uint32_t> gone, now(count);
  std::iota(now.begin(), now.end(), 0u);
  if (!labels.empty()) now = labels;
  std::vector<std::uint32_t> sorted = now;
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [label, cell] : store.cell_of_label) {
    if (!std::binary_search(sorted.begin(), sorted.end(), label)) gone.push_back(cell);
  }
  cell_of_site.clear();
  for (const std::uint32_t label : now) {
    const auto known = store.cell_of_label.find(label);
    cell_of_site.push_back(known != store.cell_of_label.end() ? known->second : store.add_cell(label));
  }
  return gone;
}

void CellComplex::Body::update(const PowerDiagram& diagram, std::span<const PowerSite> sites,
                               std::span<const std::uint32_t> which) {
  const double tolerance = tolerance_of(diagram.domain());
  const bool is_first = store.cell_of_label.empty(), same_tolerance = tolerance == store.tolerance;
  const std::vector<std::uint32_t> gone = is_whole ? std::vector<std::uint32_t>{} : assign_labels(sites.size());
  is_whole = false;
  store.tolerance = tolerance;
  store.is_convex = diagram.domain().is_convex();
  std::vector<std::pair<std::uint32_t, CellView>> fresh;
  std::vector<std::pair<ElementKey, bool>> cells;  // with: was it there before?
  const auto take = [&](std::uint32_t cell, CellView view) {
    cells.emplace_back(cell_key(view.own), !store.cells[cell].view.is_empty());
    fresh.emplace_back(cell, std::move(view));
  };
  for (const std::uint32_t site : which) {
    const std::uint32_t cell = cell_of_site[site];
    const auto& outlines = diagram.cells()[site].outlines;
    const std::span<const Polyhedron> parts = outlines ? std::span<const Polyhedron>(*outlines) : std::span<const Polyhedron>{};
    CellView view = read_cell(sites[site].position, store.cells[cell].view.own, parts, labels, tolerance);
    if (!same_tolerance || !view.is_same(store.cells[cell].view)) take(cell, std::move(view));
  }
  for (const std::uint32_t cell : gone) {
    CellView nothing;
    nothing.own = store.cells[cell].view.own;
    take(cell, std::move(nothing));
  }
  work = {which.size(), fresh.size(), 0, 0};
  store.notes.clear();
  store.keeps_notes = !is_first;
  ComplexUpdate step(store);
  step.replace(std::move(fresh), same_tolerance);
  work.cells_visited = step.cells_visited();
  work.elements_made = step.elements_made();
  if (is_first) {
    list_all();
  } else {
    list_change(cells);
  }
  for (const std::uint32_t cell : gone) store.remove_cell(cell);
  is_whole = true;
}

void CellComplex::Body::list_change(const std::vector<std::pair<ElementKey, bool>>& cells) {
  change = {};
  const auto list = [&](const ElementKey& key, bool was, bool is, bool is_same) {
    if (was && is && !is_same) change.changed.push_back(key);
    if (was && !is) change.removed.push_back(key);
    if (!was && is) change.added.push_back(key);
  };
  for (const auto& [key, was] : cells) {
    list(key, was, !store.cells[store.cell_of_label.at(key.name[0].number())].view.is_empty(), false);
  }
  for (const auto& [key, before] : store.notes) {
    const std::vector<Point3> now = store.geometry(key);
    list(key, !before.empty(), !now.empty(), before == now);
  }
  store.notes.clear();
  for (auto* keys : {&change.added, &change.removed, &change.changed}) std::sort(keys->begin(), keys->end());
}

void CellComplex::Body::list_all() {
  change = {};
  for (const auto& [label, cell] : store.cell_of_label) {
    if (!store.cells[cell].view.is_empty()) change.added.push_back(cell_key(ElementLabel::site(label)));
  }
  for (const ElementKind kind : {ElementKind::facet, ElementKind::edge, ElementKind::vertex}) {
    const auto& names = store.names(kind);
    for (auto at = names.begin(); at != names.end(); at = names.upper_bound(at->first)) change.added.push_back({kind, at->first});
  }
}

Result<void> CellComplex::update(const PowerDiagram& diagram, std::span<const PowerSite> sites, bool all) try {
  std::vector<std::uint32_t> every;
  std::span<const std::uint32_t> which = diagram.made();
  const bool is_whole = body_->is_whole && body_->cell_of_site.size() == sites.size();
  if (all || !is_whole || tolerance_of(diagram.domain()) != body_->store.tolerance) {
    every.resize(sites.size());
    std::iota(every.begin(), every.end(), 0u);
    which = every;
  }
  if (auto checked = body_->check(diagram, sites, which); !checked) return checked.error();
  body_->is_whole = is_whole;
  body_->update(diagram, sites, which);
  return {};
} catch (const std::exception& problem) {
  // Half an update is none: the next one builds everything anew.
  std::vector<std::uint32_t> labels = std::move(body_->labels);
  *body_ = Body{};
  body_->labels = std::move(labels);
  return Error{ErrorCode::internal, "", std::string("the cell complex failed: ") + problem.what()};
}

}  // namespace bl::geometry
