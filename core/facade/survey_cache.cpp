// Keeps surveys by the id of their shape.
#include "core/facade/survey_cache.h"

#include <algorithm>

namespace bl::facade {

namespace {

double size_of(const Mesh& mesh) {
  double size = 0;
  for (const Point3& vertex : mesh.vertices) size = std::max(size, distance(vertex, mesh.vertices.front()));
  return size;
}

std::vector<ShapeFace> marked_faces(const SurveyCase& one, const Mesh& mesh) {
  std::vector<ShapeFace> faces = faces_of(mesh);
  const double size = size_of(mesh);
  for (const MeshPointer& neighbour : one.neighbours) mark_shared(faces, faces_of(whole_cell(neighbour)), size);
  return faces;
}

bool covers_the_same(const std::vector<ShapeFace>& a, const std::vector<ShapeFace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ShapeFace& x, const ShapeFace& y) { return x.is_shared == y.is_shared; });
}

}  // namespace

// The entry stays as it was until all is there: making meshes may throw.
void SurveyCache::renew(const SurveyCase& one, Entry& entry) {
  const Mesh& mesh = whole_cell(one.mesh);
  Entry fresh{one, marked_faces(one, mesh), {}};
  const bool is_same = entry.asked.mesh == one.mesh && entry.asked.options == one.options;
  if (is_same && covers_the_same(entry.faces, fresh.faces)) fresh.survey = std::move(entry.survey);
  else fresh.survey = survey_facade(mesh, fresh.faces, one.options);
  entry = std::move(fresh);
}

std::vector<const FacadeSurvey*> SurveyCache::of(const std::vector<SurveyCase>& cases, ThreadPool* pool) {
  std::map<std::string, Entry> next;
  std::vector<Entry*> entries;
  std::vector<std::size_t> stale;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto found = kept_.find(cases[k].id);
    const auto entry = found != kept_.end() ? next.insert(kept_.extract(found)).position : next.try_emplace(cases[k].id).first;
    entries.push_back(&entry->second);
    if (!(entry->second.asked == cases[k])) stale.push_back(k);
  }
  kept_ = std::move(next);
  const auto make = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) renew(cases[stale[k]], *entries[stale[k]]);
  };
  if (pool != nullptr) pool->for_each_chunk(stale.size(), 1, make);
  else make(0, stale.size());
  std::vector<const FacadeSurvey*> surveys;
  for (const Entry* entry : entries) surveys.push_back(&entry->survey);
  return surveys;
}

}  // namespace bl::facade
