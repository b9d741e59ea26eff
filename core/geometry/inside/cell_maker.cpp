// The search and the cuts behind one power cell.
#include "core/geometry/inside/cell_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/inside/none.h"
#include "core/geometry/inside/shape_measure.h"

namespace bl::geometry {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// The box that stands in for everything beyond the ball is wider than the ball by this share.
constexpr double kFrameMargin = 1e-3;
// A ball of more than this share of the domain's size is no help: the domain itself is the tighter start.
constexpr double kLargeBall = 0.5;
// Where touching planes decide, all candidates that could come this little nearer take part.
constexpr double kNearlyReached = 1 + 1e-9;

// Squared distance of a point from an axis-parallel box.
double squared_gap(const Point3& p, const Vector3& low, const Vector3& high) {
  const double dx = std::max({0.0, low.x - p.x, p.x - high.x}), dy = std::max({0.0, low.y - p.y, p.y - high.y}),
               dz = std::max({0.0, low.z - p.z, p.z - high.z});
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

void CellInput::set_domain(const Domain& given) {
  domain = given;
  pieces.clear();
  for (const Domain::Piece& piece : domain.pieces) pieces.emplace_back(piece.shape, piece.sides);
}

double CellInput::limit_of(double weight, bool whole) const {
  if (whole) return kUnlimited;
  const double radius = std::sqrt(std::max(0.0, weight));
  return radius > kLargeBall * domain.size() ? kUnlimited : radius;
}

Result<void> CellInput::set_sites(std::span<const PowerSite> all, std::span<const std::uint32_t> participants) {
  sites = all;
  grid.build(all, participants);
  is_triangulated = grid.is_uneven();
  return is_triangulated ? find_power_neighbours(all, participants, neighbours) : Result<void>{};
}

double CellMaker::reach() const { return std::min(limit_, cell_.reach()); }

void CellMaker::begin(const CellInput& ground, std::uint32_t site) {
  const Point3& origin = ground.sites[site].position;
  if (limit_ < kUnlimited) {
    const double side = (1 + kFrameMargin) * limit_;
    cell_.start_box({-side, -side, -side}, {side, side, side});
    if (ground.domain.is_convex()) cell_.cut(ground.pieces.front(), origin, limit_);
  } else if (ground.domain.is_convex()) {
    cell_.start(ground.pieces.front(), origin);
  } else {
    const double margin = kFrameMargin * ground.domain.size();
    const Vector3 room{margin, margin, margin};
    cell_.start_box(ground.domain.minimum - origin - room, ground.domain.maximum - origin + room);
  }
}

void CellMaker::cut_by_search(const CellInput& ground, std::uint32_t site, std::span<const std::uint32_t> expected) {
  const PowerSite& own = ground.sites[site];
  const Point3 centre = own.position;
  const double weight = own.weight;
  double reach = this->reach(), four_reach_squared = 4 * reach * reach;
  const auto cut_by = [&](const Point3& position, double other_weight, std::uint32_t index) {
    const Vector3 to = position - centre;
    const double squared = squared_norm(to), sum = squared + (weight - other_weight);
    if (sum > 0 && sum * sum >= squared * four_reach_squared) return;
    if (cell_.is_clear_of(to, 0.5 * sum)) return;
    const double per_distance = 1 / std::sqrt(squared);
    cell_.cut(per_distance * to, 0.5 * sum * per_distance, FaceKind::site, index);
    reach = this->reach();
    four_reach_squared = 4 * reach * reach;
  };
  // A site that has a border with a site that is done is known to all its neighbours that are done. One that has none may be
  // swallowed by them, which they do not know: then they are searched like the others.
  SiteGrid::Range skip;
  if (!known_.empty()) {
    const std::uint32_t first = known_[ground.grid.place_of(site) - run_.begin];
    std::uint32_t last = kNone;
    for (std::uint32_t k = first; k != kNone; k = links_[k].next) {
      if (links_[k].is_sure) skip = run_;
      const SiteGrid::Entry other = ground.grid.at_place(links_[k].place);
      cut_by(other.position, other.weight, other.site);
      last = k;
    }
    if (last != kNone) {
      // Nobody asks for this list again: its links serve the sites to come, and stay where memory is near.
      links_[last].next = free_link_;
      free_link_ = first;
    }
  }
  // Nobody may cut twice: what touches is no longer sure.
  if (!expected.empty()) {
    is_done_.resize(ground.sites.size(), 0);
    // After four billion cells the numbers begin again: nobody may be left out by a mark of then.
    if (++cell_number_ == 0) {
      std::fill(is_done_.begin(), is_done_.end(), 0u);
      cell_number_ = 1;
    }
  }
  for (const std::uint32_t j : expected) {
    const SiteGrid::Entry other = ground.grid.of(j);
    cut_by(other.position, other.weight, j);
    is_done_[j] = cell_number_;
  }
  // All neighbours are likely to have cut by now, so that most of those who come are not even near.
  if (!expected.empty()) cell_.measure_reaches();
  ground.grid.search(
      centre, weight, site, skip, [&] { return reach; },
      [&](const SiteGrid::Entry& entry) {
        if (expected.empty() || is_done_[entry.site] != cell_number_) cut_by(entry.position, entry.weight, entry.site);
      });
}

void CellMaker::start_run(const CellInput& ground, std::uint32_t first_place, std::uint32_t count) {
  run_ = {first_place, first_place};
  known_.assign(ground.is_triangulated ? 0 : count, kNone);
  links_.clear();
  free_link_ = kNone;
}

// Tells the sites that are still to come who borders them.
void CellMaker::remember(const CellInput& ground, std::uint32_t site, bool is_sure) {
  const std::uint32_t place = ground.grid.place_of(site);
  run_.end = place + 1;
  for (const std::uint32_t j : borders_) {
    const std::uint32_t other = ground.grid.place_of(j);
    if (other <= place || other - run_.begin >= known_.size()) continue;
    std::uint32_t& known = known_[other - run_.begin];
    const Link link{place, known, is_sure};
    if (free_link_ == kNone) {
      known = static_cast<std::uint32_t>(links_.size());
      links_.push_back(link);
    } else {
      known = free_link_;
      free_link_ = links_[known].next;
      links_[known] = link;
    }
  }
}

// All sites whose bisectors may come nearer than `reach`, nearest bisector first.
void CellMaker::gather(const CellInput& ground, std::uint32_t site, double reach) {
  const PowerSite& own = ground.sites[site];
  candidates_.clear();
  const auto consider = [&](const Point3& position, double weight, std::uint32_t j) {
    const Vector3 to = position - own.position;
    // Rounded like the cuts of the search: the same plane has the same bits.
    const double squared = squared_norm(to), per_distance = 1 / std::sqrt(squared),
                 offset = 0.5 * (squared + (own.weight - weight)) * per_distance;
    if (offset < reach) candidates_.push_back({offset, j, per_distance * to});
  };
  if (ground.is_triangulated) {
    for (const std::uint32_t j : ground.neighbours.of(site)) consider(ground.sites[j].position, ground.sites[j].weight, j);
  } else {
    ground.grid.search(
        own.position, own.weight, site, {}, [&] { return reach; },
        [&](const SiteGrid::Entry& entry) { consider(entry.position, entry.weight, entry.site); });
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.offset != b.offset ? a.offset < b.offset : a.site < b.site; });
}

void CellMaker::cut_in_order(const CellInput& ground, std::uint32_t site) {
  begin(ground, site);
  for (const Candidate& candidate : candidates_) {
    if (!cell_.cut(candidate.normal, candidate.offset, FaceKind::site, candidate.site)) return;
  }
}

// Without the faces beyond the ball where that is enough to measure by.
bool CellMaker::finish(Clipper& shape, Polyhedron& out) {
  const bool is_sharp = shape.finish(out, limit_);
  const bool is_enough = limit_ == kUnlimited || shape.is_empty() || (!out.faces.empty() && is_centre_apart(out, limit_));
  return is_enough ? is_sharp : shape.finish(out);
}

Polyhedron& CellMaker::next_part() {
  if (part_count_ == parts_.size()) parts_.emplace_back();
  return parts_[part_count_++];
}

// The cell, cut up by the pieces of the domain. False where the order of the cuts that made the cell may show in a part.
bool CellMaker::keep_parts(const CellInput& ground, const Point3& origin) {
  bool is_sure = true;
  for (std::size_t k = 0; k < ground.pieces.size(); ++k) {
    const ConvexDomain& shape = ground.domain.pieces[k].shape;
    if (squared_gap(origin, shape.minimum, shape.maximum) > cell_.reach_squared()) continue;
    piece_.copy(cell_);
    const bool is_left = piece_.cut(ground.pieces[k], origin, kUnlimited);
    is_sure = is_sure && !piece_.is_touchy();
    if (is_left && piece_.is_touchy()) piece_.name_by(ground.pieces[k], origin);
    if (!is_left || (piece_.is_touchy() && piece_.is_flat())) continue;
    is_sure = finish(piece_, next_part()) && is_sure;
  }
  return is_sure;
}

void CellMaker::make(const CellInput& ground, std::uint32_t site, bool whole, std::span<const std::uint32_t> expected) {
  const PowerSite& own = ground.sites[site];
  part_count_ = 0;
  borders_.clear();
  faces_.clear();
  limit_ = ground.limit_of(own.weight, whole);
  if (limit_ == 0) return;
  // Swallowed: it has no neighbours that could cut it down.
  if (ground.is_triangulated && !ground.neighbours.has_cell[site]) return;
  // Of a cell that was cut only as far as its ball reaches, the borders beyond are not known to the neighbours.
  if (limit_ < kUnlimited) end_run();
  const bool is_run = !known_.empty();
  begin(ground, site);
  const bool is_in_order = ground.is_triangulated;
  if (ground.is_triangulated) {
    gather(ground, site, kUnlimited);
    cut_in_order(ground, site);
  } else {
    cut_by_search(ground, site, expected);
  }
  const bool is_convex = ground.domain.is_convex();
  Polyhedron& outline = is_convex ? next_part() : outline_;
  bool is_sure = finish(cell_, outline) && !cell_.is_touchy();
  if (!is_convex) is_sure = keep_parts(ground, own.position) && is_sure;
  if (!is_in_order && !is_sure) {
    // Here the order of the cuts may show: they are made again in an order that depends on the sites alone.
    gather(ground, site, cell_.is_empty() ? kUnlimited : kNearlyReached * reach());
    cut_in_order(ground, site);
    finish(cell_, outline);
    if (!is_convex) {
      part_count_ = 0;
      keep_parts(ground, own.position);
    }
    for (const Candidate& candidate : candidates_) borders_.push_back(candidate.site);
  }
  for (const PolyhedronFace& face : outline.faces) {
    if (face.kind == FaceKind::site) faces_.push_back(face.index);
  }
  // Faces come by index, but for those that rounding has split.
  if (!std::is_sorted(faces_.begin(), faces_.end())) std::sort(faces_.begin(), faces_.end());
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
  borders_.insert(borders_.end(), faces_.begin(), faces_.end());
  if (!is_sure) {
    std::sort(borders_.begin(), borders_.end());
    borders_.erase(std::unique(borders_.begin(), borders_.end()), borders_.end());
  }
  if (is_run) remember(ground, site, is_sure);
  if (is_convex && (outline.is_empty() || (!is_sure && cell_.is_flat()))) part_count_ = 0;
}

}  // namespace bl::geometry
