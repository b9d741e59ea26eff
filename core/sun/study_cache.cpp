// A caster can be in the way only where its ball lies ahead of the receiver's ball, towards one of the suns.
#include "core/sun/study_cache.h"

#include <algorithm>
#include <cmath>

namespace bl::sun {

namespace {

struct Ball {
  Point3 centre;
  double radius = 0;
};

// Around all corners; far more than what single precision and rounding can do is added.
Ball ball_around(std::span<const Point3> points) {
  Point3 low = points.front(), high = low;
  for (const Point3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Ball ball{(low + high) * 0.5, 0};
  for (const Point3& p : points) ball.radius = std::max(ball.radius, distance(p, ball.centre));
  ball.radius += 0.01 + 1e-9 * norm(ball.centre);
  return ball;
}

bool is_same(const MeshPointer& a, const MeshPointer& b) {
  return a == b || (a->vertices == b->vertices && a->triangles == b->triangles);
}

bool is_same(const SunMoment& a, const SunMoment& b) { return a.toward == b.toward && a.seconds == b.seconds; }

bool is_same_place(const SunReceiver& a, const SunReceiver& b) {
  return a.centre == b.centre && a.half_across == b.half_across && a.half_up == b.half_up && a.spacing == b.spacing;
}

// Says yes where anything is not finite: then it is measured, and the study tells what is wrong.
bool may_shade(const Mesh& mesh, const Ball& receiver, std::span<const SunMoment> moments) {
  for (const Point3& vertex : mesh.vertices)
    if (!is_finite(vertex)) return true;
  const Ball caster = ball_around(mesh.vertices);
  const Vector3 way = caster.centre - receiver.centre;
  const double reach = caster.radius + receiver.radius;
  if (!(squared_norm(way) > reach * reach)) return true;
  for (const SunMoment& moment : moments) {
    const double ahead = dot(way, moment.toward);
    if (ahead > -reach && !(squared_norm(way) - ahead * ahead > reach * reach)) return true;
  }
  return false;
}

// Those that cast and count for the receiver.
std::map<std::string, MeshPointer> shapes_for(const SunReceiver& receiver, std::span<const SunCaster> casters) {
  std::map<std::string, MeshPointer> shapes;
  for (std::size_t k = 0; k < casters.size(); ++k) {
    const bool counts = receiver.mask.empty() || receiver.mask[k] != 0;
    if (counts && casters[k].mesh && !casters[k].mesh->triangles.empty()) shapes[casters[k].name] = casters[k].mesh;
  }
  return shapes;
}

}  // namespace

bool SunStudyCache::is_current(const Entry& kept, const SunReceiver& now, const Shapes& shapes) const {
  if (!is_same_place(kept.receiver, now)) return false;
  std::vector<Point3> corners;
  for (const double across : {-1.0, 1.0})
    for (const double up : {-1.0, 1.0}) corners.push_back(now.centre + across * now.half_across + up * now.half_up);
  const Ball ball = ball_around(corners);
  for (const auto& [name, mesh] : kept.shapes) {
    const auto it = shapes.find(name);
    if (it != shapes.end() && is_same(mesh, it->second)) continue;
    if (may_shade(*mesh, ball, moments_) || (it != shapes.end() && may_shade(*it->second, ball, moments_))) return false;
  }
  return std::all_of(shapes.begin(), shapes.end(), [&](const auto& shape) {
    return kept.shapes.contains(shape.first) || !may_shade(*shape.second, ball, moments_);
  });
}

// Those that are not current, in one study.
Result<void> SunStudyCache::measure(std::span<const SunCaster> casters, std::span<const SunCase> cases,
                                    std::span<const Shapes> shapes, ThreadPool* pool) {
  std::vector<SunReceiver> stale;
  std::vector<std::size_t> which;
  for (std::size_t r = 0; r < cases.size(); ++r) {
    const auto kept = kept_.find(cases[r].name);
    if (kept != kept_.end() && is_current(kept->second, cases[r].receiver, shapes[r])) continue;
    which.push_back(r);
    stale.push_back(cases[r].receiver);
  }
  measured_ = stale.size();
  std::vector<MeshPointer> meshes;
  for (const SunCaster& caster : casters) meshes.push_back(caster.mesh);
  if (stale.empty() && !cases.empty()) return {};
  auto fresh = sun_study(meshes, moments_, stale, pool);
  if (!fresh) return fresh.error();
  for (std::size_t k = 0; k < which.size(); ++k) {
    Entry& kept = kept_[cases[which[k]].name] = {stale[k], {}, std::move((*fresh)[k]), {}};
    for (std::size_t c = 0; c < casters.size(); ++c)
      if (const SunLoss& loss = kept.record.hours.casters[c]; loss.shared > 0) kept.losses[casters[c].name] = loss;
  }
  return {};
}

Result<std::vector<SunRecord>> SunStudyCache::of(std::span<const SunCaster> casters, std::span<const SunMoment> moments,
                                                 std::span<const SunCase> cases, ThreadPool* pool) {
  // What is refused must not depend on what is kept.
  std::vector<SunReceiver> all;
  for (const SunCase& one : cases) all.push_back(one.receiver);
  if (auto allowed = check_sun_rays(all, moments.size()); !allowed) return allowed.error();
  const auto same = [](const SunMoment& a, const SunMoment& b) { return is_same(a, b); };
  if (!std::equal(moments.begin(), moments.end(), moments_.begin(), moments_.end(), same)) {
    kept_.clear();
    moments_.assign(moments.begin(), moments.end());
  }
  std::vector<Shapes> shapes;
  for (const SunReceiver& receiver : all) shapes.push_back(shapes_for(receiver, casters));
  if (auto done = measure(casters, cases, shapes, pool); !done) return done.error();
  std::vector<SunRecord> records;
  std::map<std::string, Entry> next;
  for (std::size_t r = 0; r < cases.size(); ++r) {
    Entry kept = std::move(kept_.at(cases[r].name));
    kept.shapes = std::move(shapes[r]);
    kept.record.judge(all[r]);
    SunRecord& record = records.emplace_back(kept.record);
    record.hours.casters.assign(casters.size(), {});
    for (std::size_t c = 0; c < casters.size(); ++c)
      if (const auto loss = kept.losses.find(casters[c].name); loss != kept.losses.end()) record.hours.casters[c] = loss->second;
    next.emplace(cases[r].name, std::move(kept));
  }
  kept_ = std::move(next);
  return records;
}

}  // namespace bl::sun
