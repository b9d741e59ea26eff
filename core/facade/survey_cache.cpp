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

FacadeSurvey survey_of(const SurveyCase& one) {
  const Mesh& mesh = whole_cell(one.mesh);
  std::vector<ShapeFace> faces = faces_of(mesh);
  const double size = size_of(mesh);
  for (const MeshPointer& neighbour : one.neighbours) mark_shared(faces, faces_of(whole_cell(neighbour)), size);
  return survey_facade(mesh, faces, one.options);
}

}  // namespace

std::vector<const FacadeSurvey*> SurveyCache::of(const std::vector<SurveyCase>& cases, ThreadPool* pool) {
  std::map<std::string, Entry> next;
  std::vector<Entry*> entries, fresh;
  for (const SurveyCase& one : cases) {
    const auto found = kept_.find(one.id);
    const bool is_same = found != kept_.end() && found->second.asked == one;
    const auto entry = is_same ? next.insert(kept_.extract(found)).position : next.emplace(one.id, Entry{one, {}}).first;
    entries.push_back(&entry->second);
    if (!is_same) fresh.push_back(&entry->second);
  }
  kept_ = std::move(next);
  made_ = fresh.size();
  const auto make = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) fresh[k]->survey = survey_of(fresh[k]->asked);
  };
  if (pool != nullptr) pool->for_each_chunk(fresh.size(), 1, make);
  else make(0, fresh.size());
  std::vector<const FacadeSurvey*> surveys;
  for (const Entry* entry : entries) surveys.push_back(&entry->survey);
  return surveys;
}

}  // namespace bl::facade
